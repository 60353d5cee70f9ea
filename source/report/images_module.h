// What the program and the images module (a shared object that is opened only when an image is asked
// for) agree on: plain C, no exceptions and no memory across the border.
#pragma once

#include <cstddef>
#include <cstdint>

namespace strandlab {

/// Types of a channel in a packed pixel.
enum class ChannelType : uint32_t { byte, uint32, float32 };

/// A picture as a file holds it: rows from the top, pixels packed, channels in order.
struct PackedPicture {
    uint32_t width, height, channels;
    const char* const* names;  // of the channels, as the file spells them
    const ChannelType* types;  // of the channels
    const void* pixels;
};

/// The functions of the module. A function that fails writes why into message and returns false.
struct ImagesModule {
    uint32_t version;  // images_module_version of the module's build
    /// Makes the bytes of a file of the format (png or exr) and hands them to receive, which must copy
    /// what it keeps. Writing them is the caller's: libraries pass over a full disk without a word.
    bool (*encode)(const char* format, const PackedPicture* picture,
                   void (*receive)(void* context, const void* bytes, size_t size), void* context,
                   char* message, size_t message_size);
    /// Reads a file and hands its picture to receive, which must copy what it keeps.
    bool (*read)(const char* path, void (*receive)(void* context, const PackedPicture* picture),
                 void* context, char* message, size_t message_size);
};

inline constexpr uint32_t images_module_version = 1;
/// Name of the module's only symbol, of type ImagesModuleEntry.
inline constexpr const char* images_module_symbol = "strandlab_images_module";
using ImagesModuleEntry = const ImagesModule* (*)();

}  // namespace strandlab
