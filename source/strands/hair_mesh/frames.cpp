#include "strands/hair_mesh/frames.h"

#include "strands/bezier.h"
#include "strands/generator_parts.h"

#include <cmath>

namespace strandlab {
namespace {

constexpr int steps_per_layer = 8;  // of the transport along a column

/// Direction of a vector; the other one where it has none.
glm::dvec3 direction_or(const glm::dvec3& vector, const glm::dvec3& otherwise) {
    const double size = glm::length(vector);
    return size > 1e-12 ? vector / size : otherwise;
}

/// Eq. 1 on one layer: means at all vertices, not normalised.
std::vector<SurfaceDirections> vertex_directions(const HairMesh& mesh, uint32_t layer) {
    std::vector<SurfaceDirections> sums(mesh.vertex_count);
    for (const HairMeshFace& face : mesh.faces)
        for (uint32_t k = 0; k < face.corners; ++k) {
            const uint32_t n = face.corners;
            const uint32_t corner[3] = {face.vertex[k], face.vertex[(k + 1) % n],
                                        face.vertex[(k + n - 1) % n]};
            std::array<glm::dvec3, 3> points;
            std::array<glm::dvec2, 3> uv;
            for (int c = 0; c < 3; ++c) {
                points[c] = mesh.positions[mesh.index(layer, corner[c])];
                uv[c] = mesh.uv[corner[c]];
            }
            const glm::dvec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
            const double area = 0.5 * (a.x * b.y - a.y * b.x);
            const SurfaceDirections own = surface_directions(points, uv);
            sums[corner[0]].u += area * own.u;
            sums[corner[0]].v += area * own.v;
        }
    return sums;
}

/// Turns a vector by the smallest rotation that takes unit vector a to unit vector b.
glm::dvec3 turned(const glm::dvec3& vector, const glm::dvec3& a, const glm::dvec3& b) {
    const double cosine = glm::dot(a, b);
    if (cosine < -1 + 1e-9)
        return vector - 2 * glm::dot(vector, a) * a;  // opposite: no rotation is the smallest
    const glm::dvec3 axis = glm::cross(a, b);
    return vector * cosine + glm::cross(axis, vector) + axis * (glm::dot(axis, vector) / (1 + cosine));
}

glm::dvec3 mirrored(const glm::dvec3& vector, const glm::dvec3& normal, double squared) {
    return squared > 0 ? vector - 2 * glm::dot(normal, vector) / squared * normal : vector;
}

CurveD piece_of(const HairMeshColumns& columns, uint32_t vertex, uint32_t layer) {
    const glm::dvec3* b = &columns.controls[vertex * columns.control_count() + 3 * size_t(layer)];
    return {glm::dvec4(b[0], 0), glm::dvec4(b[1], 0), glm::dvec4(b[2], 0), glm::dvec4(b[3], 0)};
}

/// Carries u up a column from its root and derives v.
void transport(HairMeshColumns& columns, uint32_t vertex, glm::dvec3 u) {
    glm::dvec3* us = &columns.u[size_t(vertex) * (columns.layers + 1)];
    glm::dvec3* vs = &columns.v[size_t(vertex) * (columns.layers + 1)];
    glm::dvec3 tangent = tangent_at(piece_of(columns, vertex, 0), 0);
    us[0] = u;
    vs[0] = glm::cross(tangent, u);
    for (uint32_t layer = 0; layer < columns.layers; ++layer) {
        const CurveD piece = piece_of(columns, vertex, layer);
        for (int i = 0; i < steps_per_layer; ++i) {
            const double a = double(i) / steps_per_layer, b = double(i + 1) / steps_per_layer;
            const glm::dvec3 chord(point_at(piece, b) - point_at(piece, a)), next = tangent_at(piece, b);
            const double chord_squared = glm::dot(chord, chord);
            const glm::dvec3 u_left = mirrored(u, chord, chord_squared),
                             t_left = mirrored(tangent, chord, chord_squared), rest = next - t_left;
            u = mirrored(u_left, rest, glm::dot(rest, rest));
            u = direction_or(u - glm::dot(u, next) * next, any_orthogonal(next));
            tangent = next;
        }
        us[layer + 1] = u;
        vs[layer + 1] = glm::cross(tangent, u);
    }
}

void set_root_frames(const HairMesh& mesh, HairMeshColumns& columns) {
    const std::vector<SurfaceDirections> roots = vertex_directions(mesh, 0);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        const glm::dvec3 tangent = tangent_at(piece_of(columns, i, 0), 0);
        const glm::dvec3 normal = direction_or(glm::cross(roots[i].u, roots[i].v), tangent);
        glm::dvec3 u = direction_or(roots[i].u, any_orthogonal(normal));
        u = turned(u, normal, tangent);
        transport(columns, i, direction_or(u - glm::dot(u, tangent) * tangent, any_orthogonal(tangent)));
    }
}

void set_layer_frames(const HairMesh& mesh, HairMeshColumns& columns) {
    for (uint32_t layer = 0; layer <= mesh.layer_count; ++layer) {
        const std::vector<SurfaceDirections> directions = vertex_directions(mesh, layer);
        for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
            const size_t at = size_t(i) * (mesh.layer_count + 1) + layer;
            const bool root = layer == 0;
            columns.u[at] = direction_or(directions[i].u, root ? glm::dvec3(1, 0, 0) : columns.u[at - 1]);
            columns.v[at] = direction_or(directions[i].v, root ? glm::dvec3(0, 1, 0) : columns.v[at - 1]);
        }
    }
}

}  // namespace

SurfaceDirections surface_directions(const std::array<glm::dvec3, 3>& points,
                                     const std::array<glm::dvec2, 3>& uv) {
    const glm::dvec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
    const double determinant = a.x * b.y - a.y * b.x;
    const glm::dvec3 p = points[1] - points[0], q = points[2] - points[0];
    return {(b.y * p - a.y * q) / determinant, (a.x * q - b.x * p) / determinant};
}

void set_frames(const HairMesh& mesh, HairMeshColumns& columns) {
    columns.u.resize(size_t(mesh.vertex_count) * (mesh.layer_count + 1));
    columns.v.resize(columns.u.size());
    if (mesh.frames == FrameRule::root)
        set_root_frames(mesh, columns);
    else
        set_layer_frames(mesh, columns);
}

}  // namespace strandlab
