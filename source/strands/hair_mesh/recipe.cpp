#include "strands/hair_mesh/recipe.h"

#include "base/error.h"

#include <limits>
#include <type_traits>

namespace strandlab {
namespace {

constexpr uint64_t largest_curve_count = std::numeric_limits<uint32_t>::max();

template <class Real>
auto style_of(const Parameters& parameters) {
    if constexpr (std::is_same_v<Real, float>)
        return strand_style(parameters);
    else
        return to_double(strand_style(parameters));
}

}  // namespace

template <class Real>
uint64_t GrowthRecipe<Real>::strand_count() const {
    uint64_t strands = 0;
    for (const BundleCount& count : counts) strands += count.kept;
    return strands;
}

template <class Real>
GrowthRecipe<Real> make_recipe(const HairMesh& mesh, const Parameters& parameters) {
    const LevelOfDetail lod = level_of_detail(parameters);
    const uint32_t points = parameters.integer("points"), seed = parameters.integer("seed");
    if (points == 1)
        fail(ExitCode::usage, "{}: points=1 is not 0 (unstyled) or a whole number from 2 to 4097", mesh.name);
    const double thickness = parameters.number("thickness");
    const glm::vec2 radii(thickness * parameters.number("root_radius"),
                          thickness * parameters.number("tip_radius"));
    GrowthRecipe<Real> recipe{mesh,
                              ColumnNumbers<Real>(mesh, make_columns(mesh)),
                              style_of<Real>(parameters),
                              seed,
                              parameters.integer("clumps"),
                              points == 0 ? PointLevel{} : point_level(points - 1, lod),
                              points != 0,
                              radii,
                              bundle_counts(mesh, parameters.integer("strands"), seed, lod.strands)};
    const uint64_t strands = recipe.strand_count();
    if (strands * recipe.curves_per_strand() >= largest_curve_count)
        fail(ExitCode::usage, "{}: {} strands of {} curves each are above the limit of 2^32 - 1 curves",
             mesh.name, strands, recipe.curves_per_strand());
    return recipe;
}

template struct GrowthRecipe<float>;
template struct GrowthRecipe<double>;
template GrowthRecipe<float> make_recipe<float>(const HairMesh&, const Parameters&);
template GrowthRecipe<double> make_recipe<double>(const HairMesh&, const Parameters&);

}  // namespace strandlab
