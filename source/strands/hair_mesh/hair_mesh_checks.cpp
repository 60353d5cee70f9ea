// What a mesh must be for strands to grow in it.
#include "base/error.h"
#include "strands/hair_mesh/hair_mesh.h"

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

constexpr double smallest_step = 1e-6;   // m, between the layers of a column
constexpr double longest_column = 1e3;   // m
constexpr double smallest_area = 1e-12;  // m^2, of a root face's corner
constexpr double folded_cosine = -0.9;   // of the angle between the normals of neighbours

struct Checker {
    const HairMesh& mesh;
    const HairMeshLines& lines;

    template <class... Args>
    [[noreturn]] void reject(const std::vector<size_t>& where, size_t item,
                             fmt::format_string<Args...> format, Args&&... args) const {
        fail(ExitCode::bad_input, "{}: {}", lines.at(where, item),
             fmt::format(format, std::forward<Args>(args)...));
    }

    /// Corner k of a face: its vertex, the next and the one before.
    static std::array<uint32_t, 3> corner(const HairMeshFace& face, uint32_t k) {
        const uint32_t n = face.corners;
        return {face.vertex[k], face.vertex[(k + 1) % n], face.vertex[(k + n - 1) % n]};
    }

    double uv_area(const std::array<uint32_t, 3>& c) const {
        const glm::dvec2 a = mesh.uv[c[1]] - mesh.uv[c[0]], b = mesh.uv[c[2]] - mesh.uv[c[0]];
        return 0.5 * (a.x * b.y - a.y * b.x) * mesh.unit() * mesh.unit();
    }

    glm::dvec3 area_vector(const std::array<uint32_t, 3>& c) const {
        const glm::dvec3& p = mesh.positions[c[0]];
        return 0.5 * mesh.unit() * mesh.unit() *
               glm::cross(mesh.positions[c[1]] - p, mesh.positions[c[2]] - p);
    }

    glm::dvec3 normal(const HairMeshFace& face) const {
        glm::dvec3 sum(0);
        for (uint32_t k = 0; k < face.corners; ++k) sum += area_vector(corner(face, k));
        return glm::normalize(sum);
    }

    void check_face(size_t f) const {
        const HairMeshFace& face = mesh.faces[f];
        for (uint32_t a = 0; a < face.corners; ++a)
            for (uint32_t b = 0; b < a; ++b)
                if (face.vertex[a] == face.vertex[b])
                    reject(lines.faces, f, "face {} uses vertex {} twice", f, face.vertex[a]);
        for (uint32_t k = 0; k < face.corners; ++k) {
            const auto c = corner(face, k);
            if (!(glm::length(area_vector(c)) > smallest_area))
                reject(lines.faces, f, "face {} is degenerate at vertex {}: no area on the root layer", f,
                       c[0]);
            if (!(uv_area(c) > smallest_area))
                reject(lines.faces, f,
                       "face {} has the uv area {:g} m^2 at vertex {}: it must be above 0, counter-clockwise",
                       f, uv_area(c), c[0]);
        }
        for (uint32_t k = 0; k < face.corners; ++k)
            if (!(glm::dot(area_vector(corner(face, k)), normal(face)) > 0))
                reject(lines.faces, f, "face {} folds over itself at vertex {} of the root layer", f,
                       face.vertex[k]);
    }

    /// Edges from vertex to vertex, sorted, with their faces.
    struct Edge {
        uint32_t from, to;
        size_t face;
        auto key() const { return std::pair(from, to); }
    };

    std::vector<Edge> edges() const {
        std::vector<Edge> all;
        for (size_t f = 0; f < mesh.faces.size(); ++f)
            for (uint32_t k = 0; k < mesh.faces[f].corners; ++k) {
                const auto c = corner(mesh.faces[f], k);
                all.push_back({c[0], c[1], f});
            }
        std::sort(all.begin(), all.end(), [](const Edge& a, const Edge& b) {
            return std::pair(a.key(), a.face) < std::pair(b.key(), b.face);
        });
        return all;
    }

    void check_edges() const {
        const std::vector<Edge> all = edges();
        for (size_t i = 1; i < all.size(); ++i)
            if (all[i].key() == all[i - 1].key())
                reject(lines.faces, all[i].face,
                       "face {} runs from vertex {} to {} as face {} does: neighbours must run in opposite "
                       "directions, and no more than two may meet",
                       all[i].face, all[i].from, all[i].to, all[i - 1].face);
        for (const Edge& edge : all) {
            const Edge back{edge.to, edge.from, 0};
            const auto other = std::lower_bound(
                all.begin(), all.end(), back, [](const Edge& a, const Edge& b) { return a.key() < b.key(); });
            if (other == all.end() || other->key() != back.key() || edge.from > edge.to) continue;
            if (glm::dot(normal(mesh.faces[edge.face]), normal(mesh.faces[other->face])) < folded_cosine)
                reject(lines.faces, edge.face, "face {} folds back over its neighbour {}", edge.face,
                       other->face);
        }
    }

    void check_columns() const {
        const double step = smallest_step / mesh.unit(), longest = longest_column / mesh.unit();
        std::vector<double> lengths(mesh.vertex_count);
        for (uint32_t layer = 1; layer <= mesh.layer_count; ++layer)
            for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
                const size_t here = mesh.index(layer, i), before = mesh.index(layer - 1, i);
                if (!(glm::length(mesh.positions[here] - mesh.positions[before]) >= step))
                    reject(lines.positions, here,
                           "vertex {} of layer {} lies on that of layer {} (within 1e-6 m)", i, layer,
                           layer - 1);
                lengths[i] += glm::length(mesh.positions[here] - mesh.positions[before]);
                if (!(lengths[i] <= longest))
                    reject(lines.positions, here, "the column of vertex {} is longer than {:g} m at layer {}",
                           i, longest_column, layer);
                if (!mesh.w.empty() && !((mesh.w[here] - mesh.w[before]) >= step))
                    reject(lines.positions, here,
                           "w {:g} of vertex {} of layer {} is not above {:g}, that of layer {}",
                           mesh.w[here], i, layer, mesh.w[before], layer - 1);
            }
        for (uint32_t i = 0; !mesh.w.empty() && i < mesh.vertex_count; ++i)
            if (mesh.w[i] != 0)
                reject(lines.positions, i, "w {:g} of vertex {} is not 0 at the root", mesh.w[i], i);
    }

    void check_vertices() const {
        std::vector<char> used(mesh.vertex_count);
        for (const HairMeshFace& face : mesh.faces)
            for (uint32_t k = 0; k < face.corners; ++k) used[face.vertex[k]] = 1;
        for (uint32_t i = 0; i < mesh.vertex_count; ++i)
            if (!used[i]) reject(lines.uv, i, "vertex {} is in no face", i);
    }
};

}  // namespace

void check_hair_mesh(const HairMesh& mesh, const HairMeshLines& lines) {
    const Checker checker{mesh, lines};
    for (size_t f = 0; f < mesh.faces.size(); ++f) checker.check_face(f);
    checker.check_edges();
    checker.check_vertices();
    checker.check_columns();
}

}  // namespace strandlab
