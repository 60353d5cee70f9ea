#include "gpu/hair_mesh/grow_on_device.h"

#include "base/stopwatch.h"
#include "gpu/compute_pipeline.h"
#include "gpu/embedded_shaders.h"
#include "shaders/strands/grow_parameters.h"
#include "strands/hair_mesh/recipe.h"
#include "strands/hair_mesh/root_samples.h"

#include <algorithm>

namespace strandlab {
namespace {

using Recipe = GrowthRecipe<float>;

constexpr uint32_t group_size = 64;
constexpr uint32_t points_at_a_time = 1u << 21;

/// The recipe on the device.
class Tables {
  public:
    Tables(const Device& device, const Recipe& recipe) : device_(device) {
        layout::GrowthTables tables{};
        const std::vector<layout::GrowthFace> faces = faces_of(recipe);
        tables.faces = add(faces);
        tables.controls = add(recipe.columns.controls);
        tables.u = add(recipe.columns.u);
        tables.v = add(recipe.columns.v);
        tables.w = add(recipe.columns.w);
        tables.uv = add(recipe.columns.uv);
        std::vector<glm::vec2> samples = square_samples();
        tables.sample_count = static_cast<uint32_t>(samples.size());
        samples.insert(samples.end(), triangle_samples().begin(), triangle_samples().end());
        tables.samples = add(samples);
        tables.shifts = add(shifts_of(recipe, tables.sample_count));
        tables.style = add(std::vector<StrandStyle>{recipe.style});
        tables.face_count = static_cast<uint32_t>(faces.size());
        tables.layers = recipe.columns.layers;
        tables.clumps = recipe.has_clumps() ? recipe.clumps : 0;
        tables.seed = recipe.seed;
        tables.pieces = recipe.curves_per_strand();
        tables.is_styled = recipe.styled ? 1 : 0;
        // Divided here: quotients of a device may be off by some ulp.
        tables.point_step = 1.0f / static_cast<float>(recipe.styled ? tables.pieces : 3 * tables.layers);
        tables.morph = tables.pieces % 2 == 0 ? static_cast<float>(recipe.level.morph) : 0.0f;
        address_ = add(std::vector<layout::GrowthTables>{tables});
    }

    uint64_t address() const { return address_; }
    uint64_t bytes() const { return bytes_; }

  private:
    static std::vector<layout::GrowthFace> faces_of(const Recipe& recipe) {
        std::vector<layout::GrowthFace> faces;
        uint32_t first = 0;
        for (size_t f = 0; f < recipe.mesh.faces.size(); ++f) {
            const HairMeshFace& face = recipe.mesh.faces[f];
            const glm::vec2 radii = recipe.radii * recipe.counts[f].thickness;
            faces.push_back({{face.vertex[0], face.vertex[1], face.vertex[2],
                              face.is_triangle() ? face.vertex[0] : face.vertex[3]},
                             face.is_triangle() ? 1u : 0u,
                             first,
                             radii.x,
                             radii.y});
            first += recipe.counts[f].kept;
        }
        return faces;
    }

    /// As many rounds of the samples as the fullest face needs.
    static std::vector<glm::vec4> shifts_of(const Recipe& recipe, uint32_t sample_count) {
        uint32_t most = recipe.clumps;
        for (const BundleCount& count : recipe.counts) most = std::max(most, count.kept);
        std::vector<glm::vec4> shifts;
        for (uint32_t round = 0; round <= most / sample_count; ++round)
            shifts.emplace_back(sample_shift(false, round), sample_shift(true, round));
        return shifts;
    }

    template <class T>
    uint64_t add(const std::vector<T>& items) {
        buffers_.push_back(make_buffer(device_, std::span<const T>(items), Buffer::Use::storage));
        bytes_ += items.size() * sizeof(T);
        return buffers_.back().address();
    }

    const Device& device_;
    std::vector<Buffer> buffers_;
    uint64_t address_ = 0, bytes_ = 0;
};

uint32_t groups_of(uint32_t threads) { return (threads + group_size - 1) / group_size; }

}  // namespace

Curves DeviceCurves::download() const {
    Curves curves;
    curves.curves.resize(curve_count());
    if (!curves.curves.empty()) records.download(std::as_writable_bytes(std::span(curves.curves)));
    for (uint32_t s = 0; s < strand_count; ++s)
        curves.strands.push_back({s * curves_per_strand, curves_per_strand});
    return curves;
}

DeviceCurves grow_on_device(const Device& device, const HairMesh& mesh, const Parameters& parameters) {
    const Stopwatch stopwatch;
    const Recipe recipe = make_recipe<float>(mesh, parameters);
    const Tables tables(device, recipe);
    DeviceCurves grown;
    grown.strand_count = static_cast<uint32_t>(recipe.strand_count());
    grown.curves_per_strand = recipe.curves_per_strand();
    grown.table_bytes = tables.bytes();
    grown.upload_ms = stopwatch.milliseconds();
    grown.records =
        Buffer(device, std::max<uint64_t>(1, grown.curve_count()) * sizeof(Curve), Buffer::Use::storage);
    const uint32_t points = grown.curves_per_strand + 1;
    const uint32_t at_a_time = std::min(std::max(1u, points_at_a_time / points), grown.strand_count);
    const Buffer scratch(device, std::max<uint64_t>(1, uint64_t(at_a_time) * points) * sizeof(glm::vec4),
                         Buffer::Use::storage);
    const auto pipeline = [&](const char* shader) {
        return ComputePipeline(device, embedded_shader(shader), {}, sizeof(layout::GrowthParameters));
    };
    const ComputePipeline make_points = pipeline("strand_points.comp"),
                          make_curves = pipeline("strand_curves.comp");
    for (uint32_t first = 0; first < grown.strand_count; first += at_a_time) {
        const uint32_t count = std::min(at_a_time, grown.strand_count - first);
        const layout::GrowthParameters push{
            tables.address(), scratch.address(),
            grown.records.address() + uint64_t(first) * grown.curves_per_strand * sizeof(Curve), first,
            count};
        const auto bytes = std::as_bytes(std::span(&push, 1));
        const ComputePipeline::Dispatch strands{bytes, groups_of(count)},
            curves{bytes, groups_of(count * grown.curves_per_strand)};
        if (recipe.styled) grown.device_ms += make_points.run({&strands, 1});
        grown.device_ms += make_curves.run({&curves, 1});
    }
    return grown;
}

}  // namespace strandlab
