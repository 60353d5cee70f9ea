#include "strands/hair_mesh/columns.h"

#include "strands/hair_mesh/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

std::vector<double> layer_knots(const HairMesh& mesh) {
    std::vector<double> knots(mesh.layer_count);
    for (uint32_t layer = 0; layer < mesh.layer_count; ++layer) {
        for (uint32_t i = 0; i < mesh.vertex_count; ++i)
            knots[layer] += std::sqrt(mesh.unit() * glm::length(mesh.positions[mesh.index(layer + 1, i)] -
                                                                mesh.positions[mesh.index(layer, i)]));
        knots[layer] /= mesh.vertex_count;
    }
    return knots;
}

/// The shorter of the blends of u and of v at the centre of a face.
double blend_length(const HairMeshFace& face, const HairMeshColumns& columns, uint32_t layer) {
    glm::dvec3 u(0), v(0);
    for (uint32_t k = 0; k < face.corners; ++k) {
        const size_t at = size_t(face.vertex[k]) * (columns.layers + 1) + layer;
        u += columns.u[at] / double(face.corners);
        v += columns.v[at] / double(face.corners);
    }
    return std::min(glm::length(u), glm::length(v));
}

}  // namespace

void catmull_rom_column(const std::vector<double>& knots, const glm::dvec3* points, glm::dvec3* out) {
    const size_t n = knots.size();
    std::vector<glm::dvec3> derivatives(n + 1);
    const auto slope = [&](size_t l) { return (points[l + 1] - points[l]) / knots[l]; };
    for (size_t l = 1; l < n; ++l)
        derivatives[l] = (knots[l] * slope(l - 1) + knots[l - 1] * slope(l)) / (knots[l - 1] + knots[l]);
    derivatives[0] = n == 1 ? slope(0) : 2.0 * slope(0) - derivatives[1];
    derivatives[n] = n == 1 ? slope(0) : 2.0 * slope(n - 1) - derivatives[n - 1];
    for (size_t l = 0; l < n; ++l) {
        out[3 * l] = points[l];
        out[3 * l + 1] = points[l] + knots[l] / 3 * derivatives[l];
        out[3 * l + 2] = points[l + 1] - knots[l] / 3 * derivatives[l + 1];
    }
    out[3 * n] = points[n];
}

HairMeshColumns make_columns(const HairMesh& mesh) {
    HairMeshColumns columns;
    const uint32_t layers = mesh.layer_count, points = layers + 1;
    columns.layers = layers;
    columns.vertices = mesh.vertex_count;
    columns.knots = layer_knots(mesh);
    columns.controls.resize(columns.control_count() * mesh.vertex_count);
    columns.w.resize(size_t(points) * mesh.vertex_count);
    std::vector<glm::dvec3> column(points);
    for (uint32_t i = 0; i < mesh.vertex_count; ++i) {
        double* w = &columns.w[size_t(i) * points];
        for (uint32_t l = 0; l < points; ++l) {
            column[l] = mesh.unit() * mesh.positions[mesh.index(l, i)];
            if (!mesh.w.empty())
                w[l] = mesh.unit() * mesh.w[mesh.index(l, i)];
            else
                w[l] = l == 0 ? 0 : w[l - 1] + glm::length(column[l] - column[l - 1]);
        }
        catmull_rom_column(columns.knots, column.data(), &columns.controls[i * columns.control_count()]);
    }
    set_frames(mesh, columns);
    return columns;
}

std::optional<std::string> divergence(const HairMesh& mesh, const HairMeshColumns& columns) {
    size_t faces = 0, worst_face = 0;
    uint32_t worst_layer = 0;
    double worst = 1;
    for (size_t f = 0; f < mesh.faces.size(); ++f) {
        double shortest = 1;
        for (uint32_t l = 0; l <= mesh.layer_count; ++l) {
            const double length = blend_length(mesh.faces[f], columns, l);
            shortest = std::min(shortest, length);
            if (!(length < worst)) continue;
            worst = length;
            worst_face = f;
            worst_layer = l;
        }
        faces += shortest < 0.5;
    }
    if (faces == 0) return std::nullopt;
    return fmt::format(
        "the columns of {} of {} faces diverge (face {} most, at layer {}): styling fades to {:.0f} % there; "
        "finer "
        "faces help",
        faces, mesh.faces.size(), worst_face, worst_layer, 100 * worst);
}

}  // namespace strandlab
