// The body among the hair in a picture.
#pragma once

#include "report/shading.h"
#include "trace/gpu_scene.h"
#include "trace/occluder.h"
#include "trace/trace_device.h"

#include <vector>

namespace strandlab {

/// What primary rays see where they end at the body: matt skin in the light, shaded by hair and body; NaN
/// where they do not meet it. rays are those before they were cut.
std::vector<glm::vec3> occluder_colours(const Occluder& occluder, const Rays& rays, const TracedScene& scene,
                                        const ShadingOptions& shading, bool shadows);

}  // namespace strandlab
