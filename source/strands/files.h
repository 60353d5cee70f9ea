// Readers and writers of the model formats, one per source file; models.h chooses among them.
#pragma once

#include "base/byte_source.h"
#include "strands/strands.h"

#include <string>

namespace strandlab {

/// How a model is written.
struct WriteOptions {
    uint32_t points_per_curve = 1;  // .hair: points that each curve adds to its strand's first
    std::string strands_path;       // .npy: where the strands go, int32 [S, 2]; none when empty
};

/// All readers: throw Error (bad_input) that names file, offset or index, and value. Nothing is allocated
/// that the file's length does not warrant.

/// HAIR files (Cem Yuksel, www.cemyuksel.com/research/hairmodels): header of 128 bytes, then the arrays
/// that its flags name. Thickness is a diameter; a default thickness above 0 counts as the file's own.
/// Transparency and colour are passed over.
Strands load_hair(const ByteSource& source, ImportReport& report);

/// TressFX 4 (.tfx): header of 160 bytes, then points as (x, y, z, w), w saying whether it is pinned. No
/// radii: the thickness array, where there is one, has no unit.
Strands load_tfx(const ByteSource& source, ImportReport& report);

/// USC hair salon (.data; Hu et al. 2015, "Single-view hair modeling using a hairstyle database"):
/// int32 number of strands, then each as int32 number of points and the points. No radii.
Strands load_data(const ByteSource& source, ImportReport& report);

/// Curves float32 [N, 4, 4], control points (x, y, z, radius). The strands are int32 [S, 2] (first curve,
/// number of curves), in order and without holes; without them (null), neighbouring curves that share
/// an end point bit for bit form a strand.
Curves load_npy_curves(const ByteSource& curves, const ByteSource* strands, ImportReport& report);

/// HAIR file with a thickness array; all curves are sampled evenly in their parameter. Throws where the
/// format's limit of 65,536 points a strand is passed.
void write_hair(const std::string& path, const Curves& curves, const WriteOptions& options);

/// The curves bit for bit, and the strands where asked for. Throws when there is no strands file and the
/// curves alone would not give the same strands again.
void write_npy_curves(const std::string& path, const Curves& curves, const WriteOptions& options);

/// count points of 3 or more floats each, as (x, y, z, -1); throws for what is not usable.
std::vector<glm::vec4> read_points(const ByteSource& source, uint64_t offset, uint64_t count,
                                   size_t floats_per_point);

}  // namespace strandlab
