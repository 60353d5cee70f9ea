#include "primitives/pieces.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace strandlab {
namespace {

uint32_t pieces_within(const Curve& curve, double tolerance) {
    const CurveD c = to_double(curve);
    const double bend = std::max(glm::length(glm::dvec3(second_derivative_at(c, 0))),
                                 glm::length(glm::dvec3(second_derivative_at(c, 1))));
    const double thickest = std::max({c[0].w, c[1].w, c[2].w, c[3].w});
    // A tip of radius 0 asks for infinitely many pieces; a twentieth of the thickest part will do.
    const double radius = std::max(std::min({c[0].w, c[1].w, c[2].w, c[3].w}), 0.05 * thickest);
    const double count = std::ceil(std::sqrt(bend / (8 * tolerance * radius)));
    return static_cast<uint32_t>(std::clamp(count, 1.0, double(Leaf::max_pieces)));  // NaN (0/0): 1
}

}  // namespace

std::vector<ParameterInfo> straight_piece_parameters(uint32_t default_segments) {
    return {{.name = "segments",
             .help = "straight pieces per curve, equally spaced in u",
             .default_value = std::to_string(default_segments),
             .low = 1,
             .high = Leaf::max_pieces,
             .integer = true},
            {.name = "tolerance",
             .help = "when above 0: as many pieces per curve as keep the chord within this many radii of it",
             .default_value = "0",
             .low = 0,
             .high = 1e6}};
}

std::vector<uint32_t> straight_pieces(const Curves& curves, const Parameters& parameters) {
    const double tolerance = parameters.number("tolerance");
    std::vector<uint32_t> pieces(curves.curves.size(), parameters.integer("segments"));
    if (tolerance > 0)
        parallel_for(pieces.size(),
                     [&](size_t i) { pieces[i] = pieces_within(curves.curves[i], tolerance); });
    return pieces;
}

std::vector<size_t> leaf_offsets(const std::vector<uint32_t>& pieces) {
    std::vector<size_t> offsets(pieces.size() + 1, 0);
    for (size_t i = 0; i < pieces.size(); ++i) offsets[i + 1] = offsets[i] + pieces[i];
    return offsets;
}

void fill_leaves(const Curves& curves, uint32_t curve, uint32_t pieces, Leaf* leaves) {
    const StrandRange strand = curves.strands[curves.strand_of(curve)];
    for (uint32_t i = 0; i < pieces; ++i) {
        uint32_t flags = 0;
        if (i == 0 && curve == strand.first) flags |= Leaf::begins_strand;
        if (i + 1 == pieces && curve + 1 == strand.first + strand.count) flags |= Leaf::ends_strand;
        leaves[i] = {curve, Leaf::pack_interval(i, pieces, flags)};
    }
}

void make_leaves(const Curves& curves, const std::vector<uint32_t>& pieces, bool needs_flags,
                 Geometry& geometry) {
    const std::vector<size_t> offsets = leaf_offsets(pieces);
    geometry.leaves.resize(offsets.back());
    parallel_for(pieces.size(), [&](size_t i) {
        fill_leaves(curves, static_cast<uint32_t>(i), pieces[i], geometry.leaves.data() + offsets[i]);
    });
    const bool uniform = !pieces.empty() && std::all_of(pieces.begin(), pieces.end(),
                                                        [&](uint32_t n) { return n == pieces[0]; });
    geometry.uniform_pieces = uniform && !needs_flags ? pieces[0] : 0;
}

Surface straight_surface(const Curves& curves, const std::vector<uint32_t>& pieces, Caps caps) {
    const std::vector<size_t> offsets = leaf_offsets(pieces);
    Surface surface;
    surface.caps = caps;
    surface.pieces.resize(offsets.back());
    parallel_for(pieces.size(), [&](size_t c) {
        const auto curve = static_cast<uint32_t>(c);
        const uint32_t n = pieces[c];
        for (uint32_t i = 0; i < n; ++i) {
            SurfacePiece& piece = surface.pieces[offsets[c] + i];
            piece.control[0] = joint(curves.curves[c], i, n);
            piece.control[3] = joint(curves.curves[c], i + 1, n);
            piece.curve = curve;
            piece.u0 = float(i) / float(n);
            piece.u1 = float(i + 1) / float(n);
            piece.straight = true;
            piece.begins_strand = i == 0 && curves.begins_strand(curve);
            piece.ends_strand = i + 1 == n && curves.ends_strand(curve);
        }
    });
    return surface;
}

glm::vec4 joint(const Curve& curve, uint32_t i, uint32_t n) {
    if (i == 0) return curve[0];
    if (i == n) return curve[3];
    return glm::vec4(point_at(to_double(curve), double(i) / n));
}

}  // namespace strandlab
