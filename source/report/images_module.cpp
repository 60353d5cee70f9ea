// The images module: the only code that knows OpenImageIO.
#include "report/images_module.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace strandlab {
namespace {

bool fail_with(char* message, size_t size, const std::string& why) {
    std::snprintf(message, size, "%s", why.c_str());
    return false;
}

OIIO::TypeDesc type_of(ChannelType type) {
    return type == ChannelType::byte     ? OIIO::TypeDesc::UINT8
           : type == ChannelType::uint32 ? OIIO::TypeDesc::UINT32
                                         : OIIO::TypeDesc::FLOAT;
}

OIIO::ImageSpec spec_of(const PackedPicture& picture) {
    OIIO::ImageSpec spec(static_cast<int>(picture.width), static_cast<int>(picture.height),
                         static_cast<int>(picture.channels), type_of(picture.types[0]));
    spec.channelnames.assign(picture.names, picture.names + picture.channels);
    bool mixed = false;
    for (uint32_t c = 0; c < picture.channels; ++c) {
        spec.channelformats.push_back(type_of(picture.types[c]));
        mixed = mixed || picture.types[c] != picture.types[0];
    }
    if (!mixed) spec.channelformats.clear();
    return spec;
}

bool encode(const char* format, const PackedPicture* picture,
            void (*receive)(void* context, const void* bytes, size_t size), void* context, char* message,
            size_t message_size) try {
    OIIO::Filesystem::IOVecOutput bytes;
    const auto file = OIIO::ImageOutput::create(format, &bytes);
    if (!file) return fail_with(message, message_size, OIIO::geterror());
    OIIO::ImageSpec spec = spec_of(*picture);
    if (std::string(format) == "exr") spec.attribute("compression", "zip");
    if (std::string(format) == "png") spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("Software", "strandlab");
    // Else the module writes the time, and the same picture is never the same file.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    // The type "unknown" stands for the channels' own types, packed.
    const bool written = file->open(std::string("image.") + format, spec) &&
                         file->write_image(OIIO::TypeDesc::UNKNOWN, picture->pixels) && file->close();
    if (!written) return fail_with(message, message_size, file->geterror());
    receive(context, bytes.buffer().data(), bytes.buffer().size());
    return true;
} catch (const std::exception& error) {
    return fail_with(message, message_size, error.what());
}

/// The module's name of a channel's type; types that the program does not write are read as float.
ChannelType read_type(OIIO::TypeDesc type) {
    return type == OIIO::TypeDesc::UINT8    ? ChannelType::byte
           : type == OIIO::TypeDesc::UINT32 ? ChannelType::uint32
                                            : ChannelType::float32;
}

bool read(const char* path, void (*receive)(void* context, const PackedPicture* picture), void* context,
          char* message, size_t size) try {
    auto file = OIIO::ImageInput::open(path);
    if (!file) return fail_with(message, size, OIIO::geterror());
    const OIIO::ImageSpec& spec = file->spec();
    std::vector<const char*> names;
    std::vector<ChannelType> types;
    bool native = true;
    for (int c = 0; c < spec.nchannels; ++c) {
        names.push_back(spec.channelnames[c].c_str());
        types.push_back(read_type(spec.channelformat(c)));
        native = native && type_of(types.back()) == spec.channelformat(c);
    }
    if (!native) types.assign(types.size(), ChannelType::float32);
    std::vector<unsigned char> pixels(native ? spec.image_bytes(true)
                                             : spec.image_pixels() * spec.nchannels * sizeof(float));
    const OIIO::TypeDesc type = native ? OIIO::TypeDesc::UNKNOWN : OIIO::TypeDesc::FLOAT;
    if (!file->read_image(0, 0, 0, spec.nchannels, type, pixels.data()))
        return fail_with(message, size, file->geterror());
    const PackedPicture picture{static_cast<uint32_t>(spec.width),
                                static_cast<uint32_t>(spec.height),
                                static_cast<uint32_t>(spec.nchannels),
                                names.data(),
                                types.data(),
                                pixels.data()};
    receive(context, &picture);
    return true;
} catch (const std::exception& error) {
    return fail_with(message, size, error.what());
}

constexpr ImagesModule module{images_module_version, encode, read};

}  // namespace
}  // namespace strandlab

extern "C" __attribute__((visibility("default"))) const strandlab::ImagesModule* strandlab_images_module() {
    return &strandlab::module;
}
