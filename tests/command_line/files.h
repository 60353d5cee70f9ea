// Bytes of model files, well-formed until a test changes a number of them.
#pragma once

#include "base/npy.h"
#include "scene/rays.h"
#include "strands/curves.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace strandlab::testing_tools {

/// Memory of plain values, after each other.
template <class... Values>
std::string bytes_of(const Values&... values) {
    std::string bytes;
    (bytes.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
    return bytes;
}

/// The bytes with a value put over those at an offset.
template <class T>
std::string with(std::string bytes, size_t offset, const T& value) {
    std::memcpy(&bytes.at(offset), &value, sizeof(value));
    return bytes;
}

/// A .hair file with these numbers of points for its strands; point i of strand s is (s, 0.1 i, 0).
inline std::string hair_file(const std::vector<uint16_t>& points, float thickness = 0.02f) {
    std::string segments, positions, thicknesses;
    uint32_t count = 0;
    for (size_t s = 0; s < points.size(); ++s) {
        segments += bytes_of(static_cast<uint16_t>(points[s] - 1));
        for (int i = 0; i < points[s]; ++i, ++count) {
            positions += bytes_of(static_cast<float>(s), 0.1f * static_cast<float>(i), 0.0f);
            thicknesses += bytes_of(thickness);
        }
    }
    constexpr uint32_t has_segments = 1, has_points = 2, has_thickness = 4;
    std::string header = "HAIR" + bytes_of(static_cast<uint32_t>(points.size()), count,
                                           has_segments | has_points | has_thickness, uint32_t(0), 0.0f);
    header.resize(128, '\0');
    return header + segments + positions + thicknesses;
}

/// A .tfx file of strands of 4 points.
inline std::string tfx_file(uint32_t strands) {
    std::string bytes = bytes_of(4.0f, strands, uint32_t(4), uint32_t(160));
    bytes.resize(160, '\0');
    for (uint32_t s = 0; s < strands; ++s)
        for (int i = 0; i < 4; ++i)
            bytes += bytes_of(static_cast<float>(s), 0.1f * static_cast<float>(i), 0.0f, 1.0f);
    return bytes;
}

/// A .data file with these numbers of points for its strands.
inline std::string data_file(const std::vector<int32_t>& points) {
    std::string bytes = bytes_of(static_cast<int32_t>(points.size()));
    for (const int32_t n : points) {
        bytes += bytes_of(n);
        for (int i = 0; i < n; ++i) bytes += bytes_of(0.0f, 0.1f * static_cast<float>(i), 0.0f);
    }
    return bytes;
}

/// An .npy file from its header's dictionary and its data.
inline std::string npy_file(const std::string& dictionary, const std::string& data) {
    std::string header = dictionary;
    header.resize(117, ' ');
    header += '\n';
    return "\x93NUMPY" + std::string("\x01\x00", 2) + bytes_of(static_cast<uint16_t>(header.size())) +
           header + data;
}

inline std::string npy_floats(const std::string& shape, const std::vector<float>& values) {
    return npy_file("{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + ", }",
                    {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float)});
}

/// A straight curve of one radius.
inline Curve line_curve(const glm::vec3& a, const glm::vec3& b, float radius) {
    Curve curve;
    for (int i = 0; i < 4; ++i) curve[i] = glm::vec4(a + (b - a) * (static_cast<float>(i) / 3.0f), radius);
    return curve;
}

inline void write_curves(const std::string& path, const std::vector<Curve>& curves) {
    write_npy<Curve>(path, {"<f4", {4, 4}}, curves);
}

inline void write_rays(const std::string& path, const std::vector<Ray>& rays) {
    static_assert(sizeof(Ray) == 8 * sizeof(float));
    write_npy<Ray>(path, {"<f4", {8}}, rays);
}

/// A ray down the z axis from z = 5.
inline Ray ray_at(float x, float y = 0) {
    Ray ray;
    ray.origin = {x, y, 5};
    ray.direction = {0, 0, -1};
    return ray;
}

}  // namespace strandlab::testing_tools
