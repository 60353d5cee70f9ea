#include "primitives/curved_pieces.h"

#include "base/parallel.h"

#include <algorithm>
#include <cstring>

namespace strandlab {
namespace {

/// More leaves than this for one curve do not pay, whatever it does.
constexpr uint32_t most_pieces = 64;

bool turns_more(const CurveD& curve, uint32_t pieces, double max_turn) {
    for (uint32_t i = 0; i < pieces; ++i) {
        const double a = double(i) / pieces, b = double(i + 1) / pieces;
        if (turning_bound(restricted(curve, a, b)) > max_turn) return true;
    }
    return false;
}

}  // namespace

ParameterInfo splits_parameter(uint32_t default_splits) {
    return {.name = "splits",
            .help = "leaves per curve, each testing its own parameter interval",
            .default_value = std::to_string(default_splits),
            .low = 1,
            .high = most_pieces,
            .integer = true};
}

std::vector<uint32_t> curved_pieces(const Curves& curves, uint32_t splits, double max_turn,
                                    const LeafBudget& budget) {
    std::vector<uint32_t> pieces(curves.curves.size(), budget.is_set() ? 1 : splits);
    parallel_for(pieces.size(), [&](size_t i) {
        const CurveD curve = to_double(curves.curves[i]);
        while (pieces[i] < most_pieces && turns_more(curve, pieces[i], max_turn))
            pieces[i] = std::min(most_pieces, 2 * pieces[i]);
    });
    if (budget.is_set()) return pieces_within(curves, pieces, budget);
    return pieces;
}

Geometry build_curved(const Curves& curves, const std::vector<uint32_t>& pieces, bool needs_flags) {
    Geometry geometry;
    make_leaves(curves, pieces, needs_flags, geometry);
    geometry.boxes.resize(geometry.leaves.size());
    parallel_for(geometry.leaves.size(), [&](size_t i) {
        const Leaf leaf = geometry.leaves[i];
        geometry.boxes[i] = bounds_of(curves.curves[leaf.curve], double(leaf.piece()) / leaf.pieces(),
                                      double(leaf.piece() + 1) / leaf.pieces());
    });
    geometry.curve_records.stride = sizeof(Curve);
    geometry.curve_records.overlap = sizeof(Curve::value_type);
    geometry.curve_records.bytes.resize(curves.curves.size() * sizeof(Curve));
    if (!curves.curves.empty())
        std::memcpy(geometry.curve_records.bytes.data(), curves.curves.data(),
                    geometry.curve_records.bytes.size());
    return geometry;
}

Surface curved_surface(const Curves& curves, Surface::Sweep sweep, Caps caps) {
    Surface surface;
    surface.sweep = sweep;
    surface.caps = caps;
    surface.pieces.resize(curves.curves.size());
    parallel_for(surface.pieces.size(), [&](size_t i) {
        SurfacePiece& piece = surface.pieces[i];
        const auto curve = static_cast<uint32_t>(i);
        piece.control = curves.curves[i];
        piece.curve = curve;
        piece.begins_strand = curves.begins_strand(curve);
        piece.ends_strand = curves.ends_strand(curve);
    });
    return surface;
}

}  // namespace strandlab
