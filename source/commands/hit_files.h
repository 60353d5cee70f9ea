// Rays and hits as other programs exchange them: .npy files.
#pragma once

#include "scene/hits.h"
#include "scene/rays.h"

#include <string>

namespace strandlab {

/// Rays of an .npy file, float32 [M,8]: ox, oy, oz, tmin, dx, dy, dz, tmax. Invalid rays are counted in a
/// warning and miss.
Rays load_ray_file(const std::string& path);

/// Writes rays as FOLDER/NAME.npy in that form, into a folder that is made when missing.
void write_rays(const std::string& folder, const std::string& name, const Rays& rays);

/// Writes t.npy float32 [M] (+inf is a miss), curve.npy int32 [M] (-1), u.npy float32 [M] and, where
/// there are normals, normal.npy float32 [M,3], into a folder that is made when missing.
void write_hits(const std::string& folder, const Hits& hits);

/// Reads what write_hits wrote; u.npy and normal.npy may be missing. Numbers that are neither a hit nor a
/// miss (NaN) are kept: the comparison counts them. Throws Error (bad_input) for other lengths than `rays`.
Hits read_hits(const std::string& folder, size_t rays);

}  // namespace strandlab
