#include "trace/embree_reference.h"

#include "base/error.h"

#include <algorithm>

#if STRANDLAB_EMBREE
#include "base/parallel.h"

#if STRANDLAB_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <atomic>
#include <cassert>
#include <cmath>
#endif

namespace strandlab {

EmbreeDefinition embree_definition(const Surface& surface) {
    if (surface.pieces.empty())
        return {.geometry = "triangles",
                .limits = "single precision only",
                .same_sweep = true,
                .same_ends = true,
                .min_radius_ratio = 0};
    const bool spheres = surface.sweep == Surface::Sweep::sphere;
    const bool straight = std::all_of(surface.pieces.begin(), surface.pieces.end(),
                                      [](const SurfacePiece& piece) { return piece.straight; });
    if (spheres && straight)
        return {.geometry = "round linear curves: round cones with round ends",
                .limits = "thin or distant strands, and any fine comparison of round cones",
                .same_sweep = true,
                .same_ends = surface.caps == Caps::round,
                .min_radius_ratio = 1e-2};
    return {.geometry = spheres ? "round Bezier curves: discs swept where the surface sweeps spheres"
                                : "round Bezier curves: swept discs",
            .limits = "strand ends unless open, tapered spheres, thin strands or strands far from the origin",
            .same_sweep = !spheres,
            .same_ends = !spheres && surface.caps == Caps::open,
            .min_radius_ratio = 1e-3};
}

#if STRANDLAB_EMBREE

bool embree_available() { return true; }

namespace {

/// Which items of the surface the primitives of one Embree geometry stand for.
enum class Kind : uint32_t { linear, bezier, triangle };

void reject_back_faces(const RTCFilterFunctionNArguments* args) {
    assert(args->N == 1);
    const auto* ray = reinterpret_cast<const RTCRay*>(args->ray);
    const auto* hit = reinterpret_cast<const RTCHit*>(args->hit);
    const float facing = hit->Ng_x * ray->dir_x + hit->Ng_y * ray->dir_y + hit->Ng_z * ray->dir_z;
    if (!(facing <= 0)) args->valid[0] = 0;
}

/// The pieces of a surface that become one kind of curve, with their vertices.
struct CurveBuffers {
    std::vector<glm::vec4> vertices;
    std::vector<uint32_t> indices;  // first vertex of each
    std::vector<uint32_t> pieces;   // in the surface
};

bool is_linear(const Surface& surface, const SurfacePiece& piece) {
    return piece.straight && surface.sweep == Surface::Sweep::sphere;
}

/// Joints that two pieces share are one vertex: Embree takes consecutive first vertices for neighbours.
CurveBuffers linear_buffers(const Surface& surface) {
    CurveBuffers buffers;
    const SurfacePiece* previous = nullptr;
    for (size_t i = 0; i < surface.pieces.size(); ++i) {
        const SurfacePiece& piece = surface.pieces[i];
        if (!is_linear(surface, piece)) {
            previous = nullptr;
            continue;
        }
        const bool joined = previous && !previous->ends_strand && !piece.begins_strand &&
                            previous->control[3] == piece.control[0];
        if (!joined) buffers.vertices.push_back(piece.control[0]);
        buffers.indices.push_back(static_cast<uint32_t>(buffers.vertices.size() - 1));
        buffers.vertices.push_back(piece.control[3]);
        buffers.pieces.push_back(static_cast<uint32_t>(i));
        previous = &piece;
    }
    return buffers;
}

CurveBuffers bezier_buffers(const Surface& surface) {
    CurveBuffers buffers;
    for (size_t i = 0; i < surface.pieces.size(); ++i) {
        const SurfacePiece& piece = surface.pieces[i];
        if (is_linear(surface, piece)) continue;
        buffers.indices.push_back(static_cast<uint32_t>(buffers.vertices.size()));
        buffers.pieces.push_back(static_cast<uint32_t>(i));
        for (int k = 0; k < 4; ++k) {
            const float share = float(k) / 3;
            buffers.vertices.push_back(piece.straight
                                           ? piece.control[0] * (1 - share) + piece.control[3] * share
                                           : piece.control[k]);
        }
    }
    return buffers;
}

glm::dvec4 centre_and_radius(const SurfacePiece& piece, double s) {
    const glm::dvec4 a(piece.control[0]), d(piece.control[3]);
    if (piece.straight) return a * (1 - s) + d * s;
    const glm::dvec4 b(piece.control[1]), c(piece.control[2]);
    const double v = 1 - s;
    return v * v * (v * a + 3 * s * b) + s * s * (3 * v * c + s * d);
}

RTCRayHit query_of(const Ray& ray) {
    RTCRayHit query{};
    query.ray.org_x = ray.origin.x, query.ray.org_y = ray.origin.y, query.ray.org_z = ray.origin.z;
    query.ray.dir_x = ray.direction.x, query.ray.dir_y = ray.direction.y, query.ray.dir_z = ray.direction.z;
    query.ray.tnear = ray.tmin;
    query.ray.tfar = ray.tmax;
    query.ray.mask = 0xFFFFFFFFu;
    query.hit.geomID = query.hit.primID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return query;
}

}  // namespace

struct EmbreeScene::State {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::atomic<ptrdiff_t> bytes{0};
    // Copies: the scene outlives the surface that it was built from.
    std::vector<SurfacePiece> pieces;
    std::vector<SurfaceTriangle> triangles;
    std::vector<uint32_t> linear_pieces, bezier_pieces;

    State() {
        device = rtcNewDevice(nullptr);
        if (!device)
            fail(ExitCode::device_lost, "Embree: no device (error {}); does this processor have SSE2?",
                 int(rtcGetDeviceError(nullptr)));
        rtcSetDeviceMemoryMonitorFunction(device, count_memory, this);
    }
    ~State() {
        if (scene) rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    static bool count_memory(void* state, ssize_t bytes, bool) {
        static_cast<State*>(state)->bytes += bytes;
        return true;
    }

    void check(const char* action) const {
        const RTCError error = rtcGetDeviceError(device);
        if (error == RTC_ERROR_NONE) return;
        fail(ExitCode::device_lost, "Embree: {} failed ({})", action,
             error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory: trace fewer strands"
                                              : fmt::format("error {}", int(error)));
    }

    template <class T>
    void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& items) const {
        void* target = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), items.size());
        check("a vertex or index buffer");
        std::copy(items.begin(), items.end(), static_cast<T*>(target));
    }

    void attach(RTCGeometry geometry, Kind kind) const {
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, static_cast<uint32_t>(kind));
        rtcReleaseGeometry(geometry);
        check("the geometry");
    }

    void add_curves(Kind kind, CurveBuffers&& buffers, std::vector<uint32_t>& kept) const {
        kept = std::move(buffers.pieces);
        if (kept.empty()) return;
        const RTCGeometry geometry =
            rtcNewGeometry(device, kind == Kind::linear ? RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE
                                                        : RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE);
        fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, buffers.vertices);
        fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, buffers.indices);
        rtcSetGeometryIntersectFilterFunction(geometry, reject_back_faces);
        attach(geometry, kind);
    }

    void add_triangles() const {
        if (triangles.empty()) return;
        std::vector<glm::vec3> vertices;
        std::vector<glm::uvec3> indices;
        vertices.reserve(3 * triangles.size());
        indices.reserve(triangles.size());
        for (const SurfaceTriangle& triangle : triangles) {
            const auto first = static_cast<uint32_t>(vertices.size());
            indices.emplace_back(first, first + 1, first + 2);
            vertices.insert(vertices.end(), triangle.vertex.begin(), triangle.vertex.end());
        }
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, vertices);
        fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, indices);
        attach(geometry, Kind::triangle);
    }

    RTCRayHit nearest(const Ray& ray) const {
        RTCRayHit query = query_of(ray);
        if (!is_valid(ray)) return query;
#if STRANDLAB_EMBREE_MAJOR >= 4
        rtcIntersect1(scene, &query);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene, &context, &query);
#endif
        return query;
    }

    const SurfacePiece& piece_of(const RTCHit& hit) const {
        return pieces[(Kind(hit.geomID) == Kind::linear ? linear_pieces : bezier_pieces)[hit.primID]];
    }

    /// Ray parameter, curve and u of what was met.
    Hit locate(const RTCRayHit& query) const {
        const RTCHit& hit = query.hit;
        if (hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
        if (Kind(hit.geomID) == Kind::triangle) {
            const SurfaceTriangle& triangle = triangles[hit.primID];
            const float u =
                (1 - hit.u - hit.v) * triangle.u[0] + hit.u * triangle.u[1] + hit.v * triangle.u[2];
            return {query.ray.tfar, u, triangle.curve, 0};
        }
        const SurfacePiece& piece = piece_of(hit);
        return {query.ray.tfar, piece.u0 + (piece.u1 - piece.u0) * hit.u, piece.curve, 0};
    }

    ReferenceHit describe(const Ray& ray, const RTCRayHit& query) const;
};

ReferenceHit EmbreeScene::State::describe(const Ray& ray, const RTCRayHit& query) const {
    const Hit located = locate(query);
    if (!located.is_hit()) return {};
    const RTCHit& hit = query.hit;
    ReferenceHit result{.t = located.t, .u = located.u, .curve = located.curve};
    const glm::dvec3 normal(hit.Ng_x, hit.Ng_y, hit.Ng_z);
    const double size = glm::length(normal);
    if (size > 0) result.normal = normal / size;
    if (Kind(hit.geomID) == Kind::triangle) {
        const SurfaceTriangle& triangle = triangles[hit.primID];
        const double weights[3] = {1.0 - hit.u - hit.v, hit.u, hit.v};
        glm::dvec3 offset(0);
        for (int k = 0; k < 3; ++k)
            offset += weights[k] * (glm::dvec3(triangle.vertex[k]) - glm::dvec3(triangle.centre[k]));
        result.radius = glm::length(offset);
        if (glm::dot(result.normal, glm::dvec3(ray.direction)) > 0) result.normal = -result.normal;
    } else {
        const SurfacePiece& piece = piece_of(hit);
        result.radius = centre_and_radius(piece, hit.u).w;
        result.on_cap = Kind(hit.geomID) == Kind::linear &&
                        ((piece.begins_strand && hit.u <= 0) || (piece.ends_strand && hit.u >= 1));
    }
    return result;
}

EmbreeScene::EmbreeScene(const Surface& surface) : state_(std::make_unique<State>()) {
    State& state = *state_;
    if (surface.pieces.size() > 0x3FFFFFFFu || surface.triangles.size() > 0x55555555u)
        fail(ExitCode::usage,
             "Embree: {} pieces and {} triangles are beyond its 32-bit indices: trace fewer strands",
             surface.pieces.size(), surface.triangles.size());
    state.pieces = surface.pieces;
    state.triangles = surface.triangles;
    state.scene = rtcNewScene(state.device);
    rtcSetSceneFlags(state.scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(state.scene, RTC_BUILD_QUALITY_HIGH);
    state.add_curves(Kind::linear, linear_buffers(surface), state.linear_pieces);
    state.add_curves(Kind::bezier, bezier_buffers(surface), state.bezier_pieces);
    state.add_triangles();
    rtcCommitScene(state.scene);
    state.check("the build");
}

void EmbreeScene::trace(std::span<const Ray> rays, std::span<Hit> hits) const {
    assert(rays.size() == hits.size());
    parallel_for(rays.size(), [&](size_t i) { hits[i] = state_->locate(state_->nearest(rays[i])); });
}

void EmbreeScene::trace(std::span<const Ray> rays, std::span<ReferenceHit> hits) const {
    assert(rays.size() == hits.size());
    parallel_for(rays.size(),
                 [&](size_t i) { hits[i] = state_->describe(rays[i], state_->nearest(rays[i])); });
}

size_t EmbreeScene::bytes() const { return static_cast<size_t>(std::max<ptrdiff_t>(state_->bytes, 0)); }

std::string embree_version() {
    return fmt::format("{}.{}.{}", RTC_VERSION_MAJOR, RTC_VERSION_MINOR, RTC_VERSION_PATCH);
}

#else

bool embree_available() { return false; }
std::string embree_version() { return {}; }

struct EmbreeScene::State {};

EmbreeScene::EmbreeScene(const Surface&) {
    fail(ExitCode::usage,
         "Embree is not built in: install libembree-dev and configure with -DSTRANDLAB_EMBREE=ON");
}

// No scene can exist.
void EmbreeScene::trace(std::span<const Ray>, std::span<Hit>) const {}
void EmbreeScene::trace(std::span<const Ray>, std::span<ReferenceHit>) const {}
size_t EmbreeScene::bytes() const { return 0; }

#endif

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

}  // namespace strandlab
