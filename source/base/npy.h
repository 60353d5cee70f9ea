// NumPy's .npy arrays (NEP 1; versions 1, 2 and 3): little-endian, C order, the first dimension counts items.
#pragma once

#include "base/byte_source.h"

#include <cassert>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace strandlab {

/// What one item of an array is: dtype "<f4", "<i4", "<u4" or "<f8", and the dimensions after the first.
/// Curves are {"<f4", {4, 4}}, rays {"<f4", {8}}, plain numbers {"<f4", {}}.
struct NpyItem {
    std::string dtype;
    std::vector<uint64_t> shape;

    uint64_t bytes() const;
};

/// The header of a file: what it holds, and where the data begin.
struct NpyHeader {
    std::string dtype;
    std::vector<uint64_t> shape;
    uint64_t data_offset = 0;
};

/// Reads a header strictly. Throws Error (bad_input) naming file, key or offset, and value: not .npy, an
/// unknown version, a missing, repeated or unknown key, Fortran order, a dimension that is no number.
NpyHeader read_npy_header(const ByteSource& source);

/// Reads the header and checks that the file holds (count, item.shape...) of item.dtype and has exactly
/// the length for it. Returns header; header.shape[0] is the count.
NpyHeader require_npy(const ByteSource& source, const NpyItem& item);

/// All items, Item being plain memory of item.bytes() bytes. Throws as require_npy does.
template <class Item>
std::vector<Item> read_npy(const ByteSource& source, const NpyItem& item) {
    assert(sizeof(Item) == item.bytes());
    const NpyHeader header = require_npy(source, item);
    return source.array<Item>(header.data_offset, header.shape[0], "data");
}

/// Writes count items of item.bytes() bytes as version 1, data aligned to 64 bytes; whole or not at all.
void write_npy(const std::string& path, const NpyItem& item, const void* data, uint64_t count);

template <class Item>
void write_npy(const std::string& path, const NpyItem& item, std::span<const Item> items) {
    static_assert(std::is_trivially_copyable_v<Item>);
    assert(sizeof(Item) == item.bytes());
    write_npy(path, item, items.data(), items.size());
}

}  // namespace strandlab
