// The contract of a primitive: it describes, a builder builds. It returns data and holds no device
// handle. Adding one: tools/new_primitive NAME, fill in what it made, one line in registry.cpp.
#pragma once

#include "base/parameters.h"
#include "primitives/leaf_budget.h"
#include "scene/caps.h"
#include "scene/geometry.h"
#include "scene/rays.h"
#include "scene/spawn.h"
#include "scene/surface.h"
#include "strands/curves.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab {

/// Names of the embedded SPIR-V modules of a primitive (file names below shaders/). Triangles have no
/// intersection shader; an empty any_hit means the geometry is opaque.
struct PrimitiveShaders {
    std::string intersection;
    std::string closest_hit;
    std::string any_hit;
};

/// What a leaf's own intersector found, in the object space of the ray.
template <class Real>
struct LeafHit {
    Real t{}, u{};  // ray parameter; parameter on the whole curve
    glm::vec<3, Real> normal{};
};

/// The C++ versions of the text that the GPU runs: whether the ray meets leaf i of the geometry with
/// tmin <= t < tmax. Built from shaders/primitives/NAME.h with float and with double.
struct CpuIntersectors {
    bool (*single)(const Geometry&, size_t leaf, const Ray&, float tmax, LeafHit<float>&) = nullptr;
    bool (*precise)(const Geometry&, size_t leaf, const Ray&, double tmax, LeafHit<double>&) = nullptr;

    /// What the closest-hit shader does to the nearest hit alone, after traversal: moves it. None for
    /// most primitives; then the hit stays as it is.
    void (*finish_single)(const Geometry&, size_t leaf, const Ray&, LeafHit<float>&) = nullptr;
    void (*finish_precise)(const Geometry&, size_t leaf, const Ray&, LeafHit<double>&) = nullptr;

    /// single, which adds the iterations of its search (cones or capsules tried, steps of refinement). None
    /// for closed forms.
    bool (*counted)(const Geometry&, size_t leaf, const Ray&, float tmax, LeafHit<float>&,
                    uint32_t& iterations) = nullptr;
};

/// What a primitive promises on decisive rays of ordinary hair, against its own surface: what `validate`
/// holds it to.
struct Tolerance {
    double wrong = 1e-4;         // share of rays with a wrong hit, miss, strand or place
    double distance_p99 = 1e-3;  // |dt| in radii; 1.5 times the p99 of ulp(t) / r where that is more
    std::string reason = {};     // why it is looser than that, or not judged
    bool judged = true;          // false: errors are shown, and nothing is promised
};

/// What a caller asks of a primitive besides its parameters.
struct BuildOptions {
    Parameters parameters;
    Caps caps = Caps::round;  // one of the primitive's own
    /// Where set, and the primitive has the parameter "splits": how many leaves there may be instead of that.
    LeafBudget leaf_budget = {};
};

/// A primitive. All members but the functions are plain descriptions.
struct Primitive {
    std::string name;     // one word: folders, options and reports use it
    std::string summary;  // one line
    std::vector<ParameterInfo> parameters;
    std::vector<Caps>
        caps;  // cap modes that it can do; the first is its own, used unless another is asked for
    bool diagnostic = false;  // a measuring aid, not a primitive to choose: left out of default runs

    /// The surface that the records of build decode to: what its intersector error is measured against.
    Surface (*surface)(const Curves&, const BuildOptions&) = nullptr;
    /// Boxes or triangles, records, and the curve and parameter interval of every leaf.
    Geometry (*build)(const Curves&, const BuildOptions&) = nullptr;
    PrimitiveShaders shaders;
    CpuIntersectors cpu;
    /// Where rays that leave its hits start; `stress --self-intersection` holds it to that.
    SpawnOffset spawn = common_spawn_offset;
    /// What it promises with these options; none: the defaults of Tolerance.
    Tolerance (*tolerance)(const BuildOptions&) = nullptr;
};

/// All primitives, in the order in which reports list them.
std::span<const Primitive> primitives();

/// The primitive of that name, or an Error (usage) that suggests the nearest name.
const Primitive& primitive_named(std::string_view name);

/// A primitive with its options, as "lss:segments=8" on the command line selects it.
struct PrimitiveChoice {
    const Primitive* primitive = nullptr;
    BuildOptions options;

    /// "lss:segments=8", defaults left out.
    std::string label() const;
};

/// Parses NAME[:key=value,...]. caps is empty when the user asked for none: then the primitive's own
/// mode is used if the default (round) is beyond it. Asked for explicitly and not possible: Error (usage).
PrimitiveChoice parse_primitive(std::string_view text, std::string_view caps = {});

}  // namespace strandlab
