#include "measure/memory_budget.h"

#include "base/error.h"

#include <algorithm>

namespace strandlab {
namespace {

/// What a build takes, apart from what does not depend on the number of leaves.
struct Taken {
    uint64_t bytes = 0;
    double leaves = 0;
    double of_leaf = 0;  // bytes of the structure
    double fixed = 0;    // bytes of records but the table of leaves
};

Taken taken_by(const PreparedCase& prepared) {
    const SceneCost& cost = prepared.traced->cost();
    const bool has_table =
        std::find(cost.skipped.begin(), cost.skipped.end(), "leaf-table") == cost.skipped.end();
    Taken taken;
    taken.bytes = prepared.resident_bytes();
    taken.leaves = double(cost.leaf_count);
    taken.of_leaf = double(cost.builds.kept_bytes) / taken.leaves;
    taken.fixed = double(cost.record_bytes) - (has_table ? taken.leaves * sizeof(Leaf) : 0);
    return taken;
}

bool has_splits(const Primitive& primitive) {
    return std::any_of(primitive.parameters.begin(), primitive.parameters.end(),
                       [](const ParameterInfo& info) { return info.name == "splits"; });
}

}  // namespace

PrimitiveChoice within_memory(const CaseInput& input, const PrimitiveChoice& choice, double bytes_per_curve) {
    const auto curves = double(input.built().curve_count());
    if (!has_splits(*choice.primitive) || curves == 0) return choice;
    if (input.device.gpu() == nullptr)
        fail(ExitCode::usage,
             "--bytes-per-curve {}: {} has no acceleration structures; choose a Vulkan device",
             bytes_per_curve, input.device.name());
    const double available = bytes_per_curve * curves;
    const auto with = [&](const LeafBudget& budget) {
        PrimitiveChoice other = choice;
        other.options.leaf_budget = budget;
        return other;
    };
    PrimitiveChoice best = with({.leaves = 1e-9});  // the fewest
    Taken taken = taken_by(prepare_case(input, best));
    if (!(double(taken.bytes) <= available))
        fail(ExitCode::usage, "--bytes-per-curve {}: {} takes at least {:.1f} here; allow more",
             bytes_per_curve, choice.label(), double(taken.bytes) / curves);
    // A driver's own order, or ours, which leaves no equal counts in order: then every leaf has a table
    // entry.
    const bool reorders = GpuScene::reorders(input.device.info(), input.options);
    double of_leaf = taken.of_leaf;
    bool exceeded = false;
    constexpr int most_tries = 8;
    for (int i = 0; i < most_tries; ++i) {
        const double spare = available - taken.fixed;
        LeafBudget budget{spare / (of_leaf + sizeof(Leaf)) / curves, spare / of_leaf / curves};
        if (reorders) budget.uniform_leaves = budget.leaves;
        const PrimitiveChoice next = with(budget);
        const Taken now = taken_by(prepare_case(input, next));
        if (double(now.bytes) > available) {
            exceeded = true;
            of_leaf = std::max(1.02 * of_leaf, now.of_leaf);
            continue;
        }
        const bool gained = now.leaves > 1.01 * taken.leaves;
        if (now.leaves >= taken.leaves) best = next;
        taken = now;
        if (exceeded || !gained) break;
        of_leaf = now.of_leaf;
    }
    return best;
}

}  // namespace strandlab
