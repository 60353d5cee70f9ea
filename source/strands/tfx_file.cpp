#include "base/error.h"
#include "strands/files.h"

#include <algorithm>

namespace strandlab {
namespace {

struct Header {
    float version;
    uint32_t strands, points_per_strand;
    uint32_t position, strand_uv, vertex_uv, strand_thickness,
        vertex_colour;  // offsets in the file, 0 = absent
    uint32_t reserved[32];
};
static_assert(sizeof(Header) == 160);

/// Throws unless an array lies behind the header and inside the file; returns its end.
uint64_t require_array(const ByteSource& source, uint32_t offset, uint64_t count, uint64_t item_bytes,
                       std::string_view what) {
    if (offset == 0) return 0;
    if (offset < sizeof(Header))
        fail(ExitCode::bad_input, "{}: offset {} of the {} lies inside the header of {} bytes", source.name(),
             offset, what, sizeof(Header));
    source.require(offset, count, item_bytes, what);
    return offset + count * item_bytes;
}

}  // namespace

Strands load_tfx(const ByteSource& source, ImportReport&) {
    const auto header = source.value<Header>(0, "header");
    if (header.version != 4.0f)
        fail(ExitCode::bad_input, "{}: version {:g} at offset 0 is not 4: not a TressFX 4 file",
             source.name(), header.version);
    const uint64_t count = uint64_t(header.strands) * header.points_per_strand;
    if (header.points_per_strand == 0 || header.position == 0)
        fail(ExitCode::bad_input, "{}: {} points per strand at offset {}: need at least 1 and an offset",
             source.name(), header.points_per_strand, header.position);
    const uint64_t end =
        std::max({require_array(source, header.position, count, 16, "positions"),
                  require_array(source, header.strand_uv, header.strands, 8, "strand coordinates"),
                  require_array(source, header.vertex_uv, count, 8, "vertex coordinates"),
                  require_array(source, header.strand_thickness, header.strands, 4, "thickness")});
    if (header.vertex_colour == 0 && end != source.size())
        fail(ExitCode::bad_input, "{}: {} strands of {} points end at offset {}, the file has {} bytes",
             source.name(), header.strands, header.points_per_strand, end, source.size());
    Strands strands;
    strands.points = read_points(source, header.position, count, 4);
    strands.first_point.resize(size_t(header.strands) + 1);
    for (size_t s = 0; s <= header.strands; ++s)
        strands.first_point[s] = static_cast<uint32_t>(s * header.points_per_strand);
    return strands;
}

}  // namespace strandlab
