// The bytes of an input file (or of memory, in tests), read by offset and never beyond the end.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace strandlab {

static_assert(std::endian::native == std::endian::little,
              "files are read and written as little-endian memory");

/// Input of the file readers. Reading checks every offset and length against the size first, so that a
/// hostile header can neither read elsewhere nor allocate more than the file could fill. All errors are
/// Error (bad_input) and name the file. Reading from several threads at once is safe.
class ByteSource {
  public:
    /// Opens a file; throws with the system's reason. A pipe is read to its end first (1 GiB at most).
    static ByteSource from_file(const std::string& path);
    /// Bytes that the caller keeps alive; name stands for the file name in messages.
    static ByteSource from_memory(std::string name, std::span<const std::byte> bytes);

    const std::string& name() const { return name_; }
    uint64_t size() const { return size_; }

    /// Throws unless [offset, offset + count * item_bytes) lies in the file; what names the part.
    void require(uint64_t offset, uint64_t count, uint64_t item_bytes, std::string_view what) const;

    /// Copies bytes; a long stretch is read by several threads.
    void read(uint64_t offset, void* to, size_t bytes, std::string_view what) const;

    /// One value, any alignment.
    template <class T>
    T value(uint64_t offset, std::string_view what) const {
        static_assert(std::is_trivially_copyable_v<T>);
        T item;
        read(offset, &item, sizeof(T), what);
        return item;
    }

    /// count values, any alignment.
    template <class T>
    std::vector<T> array(uint64_t offset, uint64_t count, std::string_view what) const {
        static_assert(std::is_trivially_copyable_v<T>);
        require(offset, count, sizeof(T), what);
        std::vector<T> items(count);
        read(offset, items.data(), count * sizeof(T), what);
        return items;
    }

  private:
    void read_some(uint64_t offset, void* to, size_t bytes) const;

    std::string name_;
    uint64_t size_ = 0;
    std::shared_ptr<const int> descriptor_;              // closed with the last copy; null when in memory
    std::shared_ptr<const std::vector<std::byte>> own_;  // what came through a pipe
    const std::byte* memory_ = nullptr;
};

}  // namespace strandlab
