// Pictures of one case: what the primitive shows, what it should show, and where it is wrong.
#pragma once

#include "measure/ray_error.h"
#include "report/images.h"
#include "scene/hits.h"
#include "scene/rays.h"
#include "strands/curves.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace strandlab {

/// The picture of a case, one ray per pixel, rows from the top.
struct CasePicture {
    std::string folder, scene, label;  // the files are called FOLDER/SCENE_LABEL.png: names of files already
    uint32_t width = 0, height = 0;
    const Rays& rays;
    const Hits& hits;  // with normals
    const Curves& curves;
    /// What the common reference hits; empty: no reference picture and no error map.
    std::span<const ReferenceHit> reference = {};
    glm::dvec3 to_light{0, 1, 0};  // unit
    /// Transforms of the instances that hits name; empty: one instance, not moved.
    std::span<const glm::mat4x3> world_from_object = {};
};

/// Files that a row names under "images"; empty where there is none.
struct CaseImages {
    std::string rendered, reference, error_map;
};

/// Writes the pictures as PNG files: SCENE_LABEL.png, SCENE_reference.png (the same for all primitives) and
/// SCENE_LABEL_errors.png. Throws as write_image.
CaseImages write_case_images(const CasePicture& picture);

/// Layer R, G, B (linear) of the outcome of each ray: grey for right hits, lighter for larger |dt| / r, on a
/// logarithmic scale from 1e-5 to 0.5; a colour for each kind of wrong answer; nearly black where both miss.
Image error_map(const ComparisonInput& input, uint32_t width, uint32_t height);

/// The hits of a reference as those of a trace.
Hits hits_of(std::span<const ReferenceHit> reference);

}  // namespace strandlab
