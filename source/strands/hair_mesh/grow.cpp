#include "strands/hair_mesh/grow.h"

#include "base/parallel.h"
#include "strands/hair_mesh/curve_writer.h"
#include "strands/hair_mesh/recipe.h"
#include "strands/hair_mesh/root_samples.h"

#include <algorithm>
#include <limits>

namespace strandlab {
namespace {

constexpr uint32_t strands_per_block = 256;
/// Strands [first, last) of a face, whose curves begin at first_curve.
struct Block {
    uint32_t face, first, last;
    size_t first_strand;
};

std::vector<Block> make_blocks(const std::vector<BundleCount>& counts) {
    std::vector<Block> blocks;
    size_t strand = 0;
    for (uint32_t f = 0; f < counts.size(); ++f)
        for (uint32_t i = 0; i < counts[f].kept; i += strands_per_block) {
            const uint32_t last = std::min(counts[f].kept, i + strands_per_block);
            blocks.push_back({f, i, last, strand});
            strand += last - i;
        }
    return blocks;
}

/// Grows the strands of one block after another; keeps its memory.
template <class Real>
class BundleGrower {
  public:
    using Kernel = kernels::HairStrandKernel<Real>;
    using Vec2 = glm::vec<2, Real>;
    using Vec3 = glm::vec<3, Real>;
    using Vec4 = glm::vec<4, Real>;
    using RealCurve = std::array<Vec4, 4>;

    BundleGrower(const GrowthRecipe<Real>& recipe, uint32_t face)
        : recipe_(recipe),
          face_(recipe.mesh.faces[face]),
          face_id_(Kernel::combine(recipe.seed, face)),
          symmetry_(Kernel::combine(face_id_, 14u)),
          radii_(recipe.radii * recipe.counts[face].thickness) {
        if (!recipe.styled) return;
        points_.resize(recipe.level.pieces + 1);
        if (!recipe.has_clumps()) return;
        centres_.resize(recipe.clumps);
        middles_.resize(recipe.clumps);
        for (uint32_t i = 0; i < recipe.clumps; ++i) {
            centres_[i] = sample(i);
            middles_[i].blend_controls(recipe.columns, face_, corner_weights(centres_[i]));
        }
    }

    void grow(uint32_t index, RealCurve* out) {
        const glm::vec2 root = sample(index);
        const Vec4 weights = corner_weights(root);
        if (!recipe_.styled) {
            own_.blend_controls(recipe_.columns, face_, weights);
            return write_layers(out);
        }
        own_.blend_all_of(recipe_.columns, face_, weights);
        style_points(index, nearest_centre(root));
        write_points(points_, recipe_.level.morph, out);
    }

  private:
    glm::vec2 sample(uint32_t index) const { return face_sample(face_.is_triangle(), symmetry_, index); }

    Vec4 corner_weights(const glm::vec2& place) const {
        return Kernel::corner_weights(Vec2(place), face_.is_triangle());
    }

    uint32_t nearest_centre(const glm::vec2& root) const {
        uint32_t best = 0;
        float least = std::numeric_limits<float>::infinity();
        for (uint32_t i = 0; i < centres_.size(); ++i) {
            const float squared = HairStrandKernel::squared_distance(centres_[i], root);
            if (!(squared < least)) continue;
            least = squared;
            best = i;
        }
        return best;
    }

    void style_points(uint32_t index, uint32_t clump) {
        const auto& style = recipe_.style;
        const uint32_t layers = recipe_.columns.layers, id = Kernel::combine(face_id_, index);
        const uint32_t clump_id = Kernel::combine(Kernel::combine(face_id_, 13u), clump);
        const auto traits = Kernel::strand_traits(style, recipe_.seed, id, clump_id, own_.root_uv.x,
                                                  own_.root_uv.y, own_.w[layers]);
        const Real noise_u = traits.u * style.noise_across, noise_v = traits.v * style.noise_across;
        const auto shared_plane = [&](int k) {
            return Kernel::noise_plane(traits.noise_seed, noise_u, noise_v, k);
        };
        const auto own_knot = [&](int k) { return Kernel::noise_knot(traits.frizz_seed, k); };
        NoiseAlong<Real, decltype(shared_plane)> shared(shared_plane);
        NoiseAlong<Real, decltype(own_knot)> frizz(own_knot);
        const BlendedColumn<Real>& middle = style.clump > 0 ? middles_[clump] : own_;

        const uint32_t pieces = recipe_.level.pieces;
        const Real step = Real(1) / Real(pieces), range = traits.kept * Real(layers);
        for (uint32_t k = 0; k <= pieces; ++k) {
            const Real x = k == pieces ? Real(1) : Real(k) * step, place = range * x;
            const auto layer = std::min(static_cast<uint32_t>(place), layers - 1);
            const Real s = place - Real(layer);
            const Real w = Kernel::between(own_.w[layer], own_.w[layer + 1], s);
            const Vec2 shared_noise = style.noise > 0 ? shared.at(w * style.noise_along) : Vec2(0);
            const Vec2 own_noise = style.frizz > 0 ? frizz.at(w * style.frizz_frequency) : Vec2(0);
            const Vec2 offset = Kernel::displacement(style, traits, w, shared_noise, own_noise);
            const Real weight = style.clump > 0 ? Kernel::clump_weight(style, traits, w) : Real(0);
            const Vec3 p =
                Kernel::styled_point(own_.point(layer, s), middle.point(layer, s), weight, offset,
                                     own_.u[layer], own_.u[layer + 1], own_.v[layer], own_.v[layer + 1], s);
            points_[k] = Vec4(p, Kernel::between(Real(radii_.x), Real(radii_.y), x));
        }
    }

    void write_layers(RealCurve* out) const {
        const uint32_t layers = recipe_.columns.layers;
        const Real step = Real(1) / Real(3 * layers);
        for (uint32_t l = 0; l < layers; ++l)
            for (uint32_t i = 0; i < 4; ++i) {
                const uint32_t k = 3 * l + i;
                const Real x = k == 3 * layers ? Real(1) : Real(k) * step;
                out[l][i] = Vec4(own_.controls[k], Kernel::between(Real(radii_.x), Real(radii_.y), x));
            }
    }

    const GrowthRecipe<Real>& recipe_;
    const HairMeshFace& face_;
    uint32_t face_id_, symmetry_;
    glm::vec2 radii_;
    std::vector<glm::vec2> centres_;
    std::vector<BlendedColumn<Real>> middles_;
    BlendedColumn<Real> own_;
    std::vector<Vec4> points_;
};

}  // namespace

template <class Real>
GrownStrands<Real> grow_hair_mesh(const HairMesh& mesh, const Parameters& parameters) {
    const GrowthRecipe<Real> recipe = make_recipe<Real>(mesh, parameters);
    const std::vector<Block> blocks = make_blocks(recipe.counts);
    const uint64_t strands = recipe.strand_count();
    const uint32_t per_strand = recipe.curves_per_strand();
    GrownStrands<Real> grown;
    grown.curves.resize(strands * per_strand);
    grown.strands.resize(strands);
    parallel_for(blocks.size(), [&](size_t b) {
        const Block& block = blocks[b];
        BundleGrower<Real> grower(recipe, block.face);
        for (uint32_t i = block.first; i < block.last; ++i) {
            const size_t strand = block.first_strand + (i - block.first);
            grown.strands[strand] = {static_cast<uint32_t>(strand * per_strand), per_strand};
            grower.grow(i, &grown.curves[strand * per_strand]);
        }
    });
    return grown;
}

template GrownStrands<float> grow_hair_mesh<float>(const HairMesh&, const Parameters&);
template GrownStrands<double> grow_hair_mesh<double>(const HairMesh&, const Parameters&);

Curves grow_hair_mesh(const HairMesh& mesh, const Parameters& parameters) {
    GrownStrands<float> grown = grow_hair_mesh<float>(mesh, parameters);
    return {std::move(grown.curves), std::move(grown.strands)};
}

}  // namespace strandlab
