// Small valid files of every format, as bytes: seeds of the fuzzers and of the mutation test.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab::samples {

template <class T>
void put(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
}

inline void put_point(std::string& bytes, int i) {
    for (const float x : {0.1f * float(i), 0.02f * float(i * i), -0.3f}) put(bytes, x);
}

/// A .hair file; flags as in its header: 1 segments, 4 thickness, 8 transparency, 16 colour.
inline std::string hair(uint32_t flags, std::vector<uint16_t> segments, float default_thickness = 0) {
    uint32_t points = 0;
    for (const uint16_t n : segments) points += uint32_t(n) + 1;
    std::string bytes = "HAIR";
    for (const uint32_t word :
         {uint32_t(segments.size()), points, flags | 2u, uint32_t(segments.empty() ? 0 : segments[0])})
        put(bytes, word);
    put(bytes, default_thickness);
    bytes.resize(128, '\0');
    if (flags & 1)
        for (const uint16_t n : segments) put(bytes, n);
    for (uint32_t i = 0; i < points; ++i) put_point(bytes, int(i));
    if (flags & 4)
        for (uint32_t i = 0; i < points; ++i) put(bytes, 0.02f - 0.001f * float(i));
    if (flags & 8) bytes.append(size_t(points) * 4, '\0');
    if (flags & 16) bytes.append(size_t(points) * 12, '\0');
    return bytes;
}

/// A .tfx file, with strand coordinates when asked for.
inline std::string tfx(uint32_t strands, uint32_t points_per_strand, bool coordinates) {
    std::string bytes;
    put(bytes, 4.0f);
    const uint32_t count = strands * points_per_strand;
    for (const uint32_t word : {strands, points_per_strand, 160u, coordinates ? 160u + count * 16 : 0u})
        put(bytes, word);
    bytes.resize(160, '\0');
    for (uint32_t i = 0; i < count; ++i) {
        put_point(bytes, int(i));
        put(bytes, i % points_per_strand == 0 ? 0.0f : 1.0f);
    }
    if (coordinates) bytes.append(size_t(strands) * 8, '\0');
    return bytes;
}

/// A .data file with these numbers of points.
inline std::string data(std::vector<int32_t> counts) {
    std::string bytes;
    put(bytes, int32_t(counts.size()));
    int i = 0;
    for (const int32_t n : counts) {
        put(bytes, n);
        for (int32_t k = 0; k < n; ++k) put_point(bytes, i++);
    }
    return bytes;
}

/// An .npy file of any header dictionary and data.
inline std::string npy(std::string_view dictionary, std::string_view contents, int version = 1) {
    std::string header(dictionary);
    header += "\n";
    std::string bytes = "\x93NUMPY";
    bytes += static_cast<char>(version);
    bytes += '\0';
    if (version == 1)
        put(bytes, static_cast<uint16_t>(header.size()));
    else
        put(bytes, static_cast<uint32_t>(header.size()));
    return bytes + header + std::string(contents);
}

/// Curves [n, 4, 4]: two and two share an end point.
inline std::string npy_curves(int n, int version = 1) {
    std::string contents;
    for (int i = 0; i < n * 4; ++i) {
        put_point(contents, i / 4 + i % 4 + (i / 8) * 10 + (i % 8 >= 4 ? 2 : 0));
        put(contents, 0.01f);
    }
    return npy("{'descr': '<f4', 'fortran_order': False, 'shape': (" + std::to_string(n) + ", 4, 4), }",
               contents, version);
}

inline std::string npy_strands(std::vector<int32_t> rows) {
    std::string contents;
    for (const int32_t x : rows) put(contents, x);
    return npy(
        "{'descr': '<i4', 'fortran_order': False, 'shape': (" + std::to_string(rows.size() / 2) + ", 2), }",
        contents);
}

struct Sample {
    std::string extension, bytes;
};

inline std::vector<Sample> all() {
    return {
        {".hair", hair(5, {3, 1, 5})}, {".hair", hair(4, {3, 3})}, {".hair", hair(29, {2, 0, 4}, 0.1f)},
        {".hair", hair(0, {4}, 0.5f)}, {".tfx", tfx(2, 4, true)},  {".tfx", tfx(1, 8, false)},
        {".data", data({3, 1, 0, 5})}, {".data", data({})},        {".npy", npy_curves(4)},
        {".npy", npy_curves(2, 2)},    {".npy", npy_curves(0, 3)}, {".npy", npy_strands({0, 2, 2, 2})},
    };
}

/// Hair meshes as the writer writes them: a quad and two triangles over 2 x 2 cm, three points a column.
inline std::vector<std::string> hair_meshes() {
    const std::string header = "strandlab hairmesh 1\n# A patch.\n# Two lines.\nname patch\nunit mm\n";
    const std::string layers =
        "layer 0\n0 0 0\n20 0 0\n20 0 -20\n0 0 -20\n"
        "layer 1\n0 30.5 2\n20 30 2\n22 30 -20\n0 31 -22\n"
        "layer 2\n0 60 4\n21 60 3\n22 59 -18\n1 60 -24\n";
    const std::string uv = "uv\n0 0\n20 0\n20 20\n0 20\n";
    const std::string with_w =
        "layer 0\n0 0 0 0\n20 0 0 0\n20 0 -20 0\n0 0 -20 0\n"
        "layer 1\n0 30.5 2 31\n20 30 2 31\n22 30 -20 31\n0 31 -22 31\n";
    return {
        header +
            "vertices 4\nlayers 2\nfaces 1\nstyle points=9 clump=0.5 curl=0.002 noise=0.001 frizz=0.001\n" +
            uv + "faces\nq 0 1 2 3\n" + layers,
        header + "vertices 4\nlayers 2\nfaces 2\nframes layer\nstyle points=0\n" + uv +
            "faces\nt 0 1 2\nt 0 2 3\n" + layers,
        header + "vertices 4\nlayers 1\nfaces 1\n" + uv + "faces\nq 0 1 2 3\n" + with_w,
    };
}

inline std::span<const std::byte> as_bytes(std::string_view text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

}  // namespace strandlab::samples
