// What of a scene is not built because its caller allows it: strands out of every ray's reach, and strands
// smaller than a tolerance.
#pragma once

#include "scene/rays.h"
#include "scene/scene.h"
#include "scene/surface.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// What may be left out. Whole strands go or stay: those that stay keep their layout and their points.
struct Culling {
    /// Strands that no ray can meet: answers stay the same (trace/reach.h).
    bool reach = false;
    /// Strands whose box, radii included, has a diagonal shorter than this in every instance; in the scene's
    /// units. Answers change where such a strand was hit. 0: none.
    float detail = 0;

    bool is_any() const { return reach || detail > 0; }
    /// As parse_culling reads it: "reach,detail=0.001"; empty: nothing is left out.
    std::string to_string() const;
};

/// "reach", "detail=LENGTH" or both, separated by a comma; empty: nothing. Throws Error (usage).
Culling parse_culling(std::string_view text);

/// Of the option --cull.
inline constexpr const char* cull_help =
    "do not build strands that are not needed: reach (those that no ray can meet; the same answers), "
    "detail=LENGTH (those smaller than LENGTH in the scene's units; a model error), or reach,detail=LENGTH";

struct StrandCount {
    size_t strands = 0, curves = 0;
};

/// What is built of a scene.
struct CulledScene {
    Scene scene;  // the same instances of models that lack strands
    /// Number in the whole scene of each curve of this one: what hits are to name.
    std::shared_ptr<const std::vector<uint32_t>> curve_numbers;
    StrandCount out_of_reach, too_small;  // strands that are both count as too small
    std::vector<uint8_t> is_too_small;    // by curve of the whole scene; empty: none is
    double milliseconds = 0;              // to find out and to copy what stays

    StrandCount left_out() const {
        return {out_of_reach.strands + too_small.strands, out_of_reach.curves + too_small.curves};
    }
};

/// Leaves out what the culling allows, for these rays in world space.
CulledScene cull(const Scene& scene, const Culling& culling, std::span<const Ray> rays);

/// Takes the pieces of strands that are too small out of a model's surface.
void remove_too_small(Surface& surface, const CulledScene& culled, uint32_t first_curve);

}  // namespace strandlab
