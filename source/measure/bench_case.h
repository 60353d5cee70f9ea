// One case of a benchmark: one primitive on one scene with one ray set; what it needs, and its errors.
#pragma once

#include "measure/comparison.h"
#include "scene/scene.h"
#include "trace/culling.h"
#include "trace/scene_reference.h"
#include "trace/trace_device.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace strandlab {

/// Rays whose errors are measured: indices into a ray set, ascending.
std::vector<uint32_t> error_sample(size_t ray_count, size_t wanted);

/// The rays at those indices.
std::vector<Ray> selected(const Rays& rays, const std::vector<uint32_t>& indices);

/// A ray set with what its errors are measured by: the sampled rays and the common reference's answer.
struct MeasuredRays {
    Rays rays;
    std::string kind;     // name of the set before it was shuffled, or "file"
    bool shadow = false;  // only hit or miss counts
    bool shuffled = false;
    bool as_shadow = false;        // shadow because the request says so, not by the kind of set
    bool is_picture = false;       // row by row, every pixel one ray
    std::string camera;            // that it was made with; empty: none
    std::vector<uint32_t> sample;  // indices of the rays below
    std::vector<Ray> sample_rays;
    Reference common;  // empty: no model error is wanted
};

/// What a case needs besides its primitive.
struct CaseInput {
    const TraceDevice& device;
    const Scene& scene;
    const Curves& curves;  // all_curves(scene)
    uint32_t samples = 5;
    double warm_up_ms = 0;
    SceneOptions options;
    const CulledScene* culled = nullptr;  // what of the scene is built; none: all

    const Scene& built() const { return culled != nullptr ? culled->scene : scene; }
};

/// The geometry of all models for one primitive, on the host.
struct HostGeometry {
    PrimitiveChoice choice;
    std::vector<SceneModel> models;
    double milliseconds = 0;  // to make it

    /// Bytes on the device while it is being put there, at most: by the largest structures and scratch
    /// buffers a leaf seen on any device.
    uint64_t device_bytes() const;
};
HostGeometry make_geometry(const Scene& scene, const PrimitiveChoice& choice);

/// A scene that is ready for one primitive, and what making it cost.
struct PreparedCase {
    PrimitiveChoice choice;
    std::unique_ptr<TracedScene> traced;
    double geometry_ms = 0;  // host: boxes and records

    uint64_t resident_bytes() const { return traced->cost().builds.kept_bytes + traced->cost().record_bytes; }
};

/// Puts the geometry on the device.
PreparedCase prepare_case(const CaseInput& input, HostGeometry geometry);
/// Makes it first.
PreparedCase prepare_case(const CaseInput& input, const PrimitiveChoice& choice);

/// The surfaces of the scene's models that the records of a primitive decode to.
std::vector<Surface> own_surfaces(const Scene& scene, const PrimitiveChoice& choice);

/// Errors at the sampled rays; empty where none are wanted or the primitive has no surface to be wrong about.
struct CaseErrors {
    std::optional<Comparison> own;    // against the primitive's own surface: the intersector's error
    std::optional<Comparison> model;  // against the common reference: everything
};
CaseErrors errors_of(const CaseInput& input, const PrimitiveChoice& choice, const MeasuredRays& rays,
                     const Hits& sample_hits);

/// Errors of given hits at the sampled rays, as errors_of measures them. own: the reference on the surface
/// that was traced, where that is another one.
Comparison compare_with(const Scene& scene, const Curves& curves, const MeasuredRays& rays,
                        const Hits& sample_hits, const Reference& reference, bool against_curves,
                        const Reference* own = nullptr);

/// The hits at the sampled rays.
Hits selected(const Hits& hits, const std::vector<uint32_t>& indices);

}  // namespace strandlab
