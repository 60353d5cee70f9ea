#include "strands/hair_mesh/level_of_detail.h"

#include "base/sine.h"
#include "strands/generator_parts.h"
#include "strands/hair_mesh/strand_kernel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strandlab {
namespace {

/// Twice the area of a face's root, in the mesh's units.
double doubled_root_area(const HairMesh& mesh, const HairMeshFace& face) {
    const auto at = [&](uint32_t k) { return mesh.positions[face.vertex[k]]; };
    double area = glm::length(glm::cross(at(1) - at(0), at(2) - at(0)));
    if (!face.is_triangle()) area += glm::length(glm::cross(at(2) - at(0), at(3) - at(0)));
    return area;
}

/// Whole numbers in proportion to the weights whose sum is exact; ties go to the lower index.
std::vector<uint32_t> apportioned(const std::vector<double>& weights, uint64_t total) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<uint32_t> counts(weights.size());
    std::vector<double> remainders(weights.size());
    uint64_t given = 0;
    for (size_t i = 0; i < weights.size(); ++i) {
        const double share = double(total) * (weights[i] / sum);
        counts[i] = static_cast<uint32_t>(share);
        remainders[i] = share - counts[i];
        given += counts[i];
    }
    std::vector<size_t> order(weights.size());
    std::iota(order.begin(), order.end(), size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return remainders[a] > remainders[b]; });
    for (size_t i = 0; given < total; i = (i + 1) % order.size(), ++given) ++counts[order[i]];
    return counts;
}

/// ceil(log2(x)) for x in (0, 2^31], at least 0: without the library's logarithm, whose last bit differs.
uint32_t ceil_log2(double x) {
    uint32_t e = 0;
    while (std::ldexp(1.0, static_cast<int>(e)) < x) ++e;
    return e;
}

/// log2 for x > 0 within 1e-12, by squaring: the same bits everywhere.
double log2_of(double x) {
    int exponent = 0;
    double m = 2 * std::frexp(x, &exponent), bit = 1, result = exponent - 1;  // m in [1, 2)
    for (int i = 0; i < 48; ++i) {
        m *= m;
        bit *= 0.5;
        if (m < 2) continue;
        m *= 0.5;
        result += bit;
    }
    return result;
}

}  // namespace

LevelOfDetail level_of_detail(const Parameters& parameters) {
    LevelOfDetail lod;
    lod.strands = parameters.number("lod");
    lod.points = parameters.number("lod_points");
    if (lod.points == 0) lod.points = lod.strands;
    lod.window = parameters.number("lod_window");
    return lod;
}

double detail_at(double size, double distance, double fov_degrees, double height_pixels, double factor) {
    const SinCos half = sin_cos(fov_degrees * (tau / 720));
    const double detail = factor * size * height_pixels * half.cos / (2 * distance * half.sin);
    return detail < 1 ? std::max(detail, 1e-6) : 1;
}

double bundle_size(const HairMesh& mesh) {
    double sum = 0;
    for (const HairMeshFace& face : mesh.faces)
        sum += mesh.unit() * std::sqrt(0.5 * doubled_root_area(mesh, face));
    return sum / double(mesh.faces.size());
}

std::vector<BundleCount> bundle_counts(const HairMesh& mesh, uint64_t strands, uint32_t seed, double lod) {
    std::vector<double> areas;
    for (const HairMeshFace& face : mesh.faces) areas.push_back(doubled_root_area(mesh, face));
    const std::vector<uint32_t> full = apportioned(areas, strands);
    std::vector<BundleCount> counts(full.size());
    for (uint32_t f = 0; f < full.size(); ++f) {
        const uint32_t key = HairStrandKernel::combine(seed, f);
        const double delta = HairStrandKernel::random_of(key, 15u), n = full[f];
        counts[f].full = full[f];
        if (full[f] == 0) continue;
        counts[f].kept = std::clamp(static_cast<uint32_t>(lod * n + delta), 1u, full[f]);
        counts[f].thickness = static_cast<float>(std::min(1 / lod, n));
    }
    return counts;
}

PointLevel point_level(uint32_t pieces, const LevelOfDetail& lod) {
    if (lod.points >= 1) return {pieces, 0};
    const double wanted = lod.points * pieces;
    if (wanted <= 1) return {1, 0};
    const double exponent = log2_of(wanted);
    const uint32_t e = ceil_log2(wanted);
    const double next = std::max(0.0, std::ceil(exponent - lod.window));
    PointLevel level{1u << e, 0};
    if (double(e) > next) level.morph = std::clamp(1 - (exponent - next) / lod.window, 0.0, 1.0);
    return level;
}

}  // namespace strandlab
