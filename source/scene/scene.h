// A scene: models and their instances, before any primitive has touched them.
#pragma once

#include "scene/obj_file.h"
#include "strands/curves.h"
#include "strands/strands.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace strandlab {

/// One instance of a model; the upper 3x3 part of the transform must be invertible.
struct SceneInstance {
    uint32_t model = 0;
    glm::mat4x3 world_from_object{1.0f};
};

/// Models with their instances. Curve ids of a scene count through its models: curve c of model m is
/// first_curve(m) + c, whichever instance is hit.
struct Scene {
    std::string name;
    std::vector<Curves> models;
    std::vector<SceneInstance> instances;
    std::vector<Triangle> occluder;  // an opaque body in world space: rays end at it (trace/occluder.h)

    uint32_t first_curve(uint32_t model) const;
    size_t curve_count() const;   // of all models
    size_t strand_count() const;  // of all models
    /// True for one model, not moved.
    bool is_plain() const;
};

/// A scene of one model, not moved.
Scene scene_of(std::string name, Curves curves);

/// All curves of all models after each other, in object space: what scene-wide curve ids index.
Curves all_curves(const Scene& scene);

/// The (x, y, z, radius) control points of all instances in world space; radii scale with the largest
/// stretch of the transform. For framing a camera: a scene with very many gives the corners of its instances'
/// boxes.
std::vector<glm::vec4> world_points(const Scene& scene);

/// Largest coordinate that an origin within `extent` of the world's origin has in the object space of any
/// instance: what that model's boxes are padded for.
float object_extent(const Scene& scene, float extent);

/// Content hash of models and instances.
uint64_t hash(const Scene& scene);

/// A model file, a generator ("generate:..."), or a scene file (.json):
///
///     {"models": [{"file": "a.hair", "radius": 4e-5, "radius_tip": 1e-5, "unit_scale": 0.01}, ...],
///      "instances": [{"model": 0, "transform": [12 numbers, three rows of four]}, ...],
///      "occluder": "head.obj"}
///
/// Paths are relative to the scene file; without "instances" every model stands once, not moved. The occluder
/// ends rays and is not moved. Per-model
/// values override the options. Warnings (what was passed over) go to the log. Errors: bad_input.
Scene load_scene(const std::string& path, const CurveOptions& options, const std::string& strands_path = {});

}  // namespace strandlab
