// Level of detail of hair meshes: fewer strands, thicker, and fewer points on each.
#pragma once

#include "strands/bezier.h"
#include "strands/hair_mesh/hair_mesh.h"

#include <cstdint>
#include <vector>

namespace strandlab {

/// How much detail, 1 being all of it.
struct LevelOfDetail {
    double strands = 1;   // share of the strands
    double points = 1;    // share of the points of a strand
    double window = 0.5;  // part of an octave in which strands morph to half their points, in (0, 1]
};

/// Parameters lod, lod_points and lod_window.
LevelOfDetail level_of_detail(const Parameters& parameters);

/// Detail of hair of world size `size` (a bundle's for strands, a bend's for points) that stands `distance`
/// before a camera with this vertical field of view (degrees) and height in pixels: factor x size x pixels /
/// (2 distance tan(fov / 2)), at most 1 (Bhokare et al. 2024, Eq. 7, with the half angle).
double detail_at(double size, double distance, double fov_degrees, double height_pixels, double factor);

/// Size of a bundle at its root, metres: the mean over the faces of the root of their area.
double bundle_size(const HairMesh& mesh);

/// Strands of one bundle.
struct BundleCount {
    uint32_t full = 0;    // at full detail
    uint32_t kept = 0;    // of them; the first ones
    float thickness = 1;  // factor of the radii
};

/// Shares `strands` among the faces by area of the root layer, exactly (largest remainder), and keeps
/// max(1, floor(L N + delta)) of a face's N > 0, delta in [0, 1) being the face's own: counts change in few
/// faces at a time, and their mean is L N. The rest grows thicker by min(1 / L, N), so that the optical depth
/// stays.
std::vector<BundleCount> bundle_counts(const HairMesh& mesh, uint64_t strands, uint32_t seed, double lod);

/// Pieces of every strand and how far they have morphed to half as many.
struct PointLevel {
    uint32_t pieces = 1;
    double morph = 0;  // 0: not at all, towards 1: the strand with half the pieces
};

/// The level for `pieces` at full detail: these at L = 1, else 2^e with e = ceil(log2(L pieces)), morphing
/// where e is above ceil(log2(L pieces) - window) (Bhokare et al. 2024, Eq. 9, 10, 12). Continuous in L.
PointLevel point_level(uint32_t pieces, const LevelOfDetail& lod);

}  // namespace strandlab
