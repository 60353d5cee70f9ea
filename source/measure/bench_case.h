// One case of a benchmark: one primitive on one scene with one ray set, its time, memory and errors.
#pragma once

#include "measure/comparison.h"
#include "scene/scene.h"
#include "trace/scene_reference.h"
#include "trace/trace_device.h"

#include <functional>
#include <memory>
#include <vector>

namespace strandlab {

/// Rays whose errors are measured: indices into a ray set, ascending.
std::vector<uint32_t> error_sample(size_t ray_count, size_t wanted);

/// The rays at those indices.
std::vector<Ray> selected(const Rays& rays, const std::vector<uint32_t>& indices);

/// A ray set with what its errors are measured by: the sampled rays and the common reference's answer.
struct MeasuredRays {
    Rays rays;
    bool shadow = false;           // only hit or miss counts
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
};

/// What a case gave.
struct CaseResult {
    std::vector<double> trace_ms;
    size_t hits = 0;
    Comparison own;    // against the primitive's own surface: the intersector's error
    Comparison model;  // against the common reference: everything
};

/// A scene that is ready for one primitive, and what making it cost.
struct PreparedCase {
    PrimitiveChoice choice;
    std::unique_ptr<TracedScene> traced;
    std::vector<Surface> surfaces;  // its own
    double geometry_ms = 0;         // host: boxes and records
};

/// Builds the geometry and puts it on the device.
PreparedCase prepare_case(const CaseInput& input, const PrimitiveChoice& choice);

/// Traces a ray set and compares.
CaseResult run_case(const CaseInput& input, const PreparedCase& prepared, const MeasuredRays& rays);

/// Errors of given hits at the sampled rays, as run_case measures them.
Comparison compare_with(const Scene& scene, const Curves& curves, const MeasuredRays& rays,
                        const Hits& sample_hits, const Reference& reference, bool against_curves);

/// The hits at the sampled rays.
Hits selected(const Hits& hits, const std::vector<uint32_t>& indices);

}  // namespace strandlab
