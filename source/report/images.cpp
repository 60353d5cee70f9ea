#include "report/images.h"

#include "base/error.h"
#include "base/file.h"
#include "base/parallel.h"
#include "report/images_module.h"
#include "report/load_images_module.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

namespace strandlab {
namespace {

namespace fs = std::filesystem;

/// png or exr, by the ending of the path.
std::string format_of(const std::string& path) {
    std::string ending = fs::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    if (ending == ".png" || ending == ".exr") return ending.substr(1);
    fail(ExitCode::usage, "{}: the image format '{}' is not known; end the name in .png or .exr", path,
         ending);
}

/// A picture for the module, with the memory that it points to.
struct Packed {
    uint32_t width = 0, height = 0;
    std::vector<std::string> names;
    std::vector<ChannelType> types;
    std::vector<unsigned char> pixels;

    std::string encoded(const ImagesModule& module, const std::string& path, const std::string& format) const;
};

std::string one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text.empty() ? "unknown reason" : text;
}

/// What the module's encode calls back.
struct Bytes {
    std::string text;
    std::exception_ptr error;  // C++ may not throw through the module, so an exception waits here
};

void receive_bytes(void* context, const void* bytes, size_t size) {
    auto& receiver = *static_cast<Bytes*>(context);
    try {
        receiver.text.assign(static_cast<const char*>(bytes), size);
    } catch (...) {
        receiver.error = std::current_exception();
    }
}

std::string Packed::encoded(const ImagesModule& module, const std::string& path,
                            const std::string& format) const {
    std::vector<const char*> pointers;
    for (const std::string& name : names) pointers.push_back(name.c_str());
    const PackedPicture picture{width,           height,       static_cast<uint32_t>(names.size()),
                                pointers.data(), types.data(), pixels.data()};
    Bytes bytes;
    std::array<char, 512> message{};
    if (!module.encode(format.c_str(), &picture, receive_bytes, &bytes, message.data(), message.size()))
        fail(ExitCode::bad_input, "{}: cannot be made: {}", path, one_line(message.data()));
    if (bytes.error) std::rethrow_exception(bytes.error);
    return std::move(bytes.text);
}

Packed preview(const std::string& path, const Image& image) {
    const Layer* layer = image.with_channel("R");
    if (!layer || !layer->is_float() || layer->channels != std::vector<std::string>{"R", "G", "B"})
        fail(ExitCode::usage, "{}: a PNG needs a colour layer R, G, B; write an .exr instead", path);
    Packed packed{
        image.width, image.height, layer->channels, std::vector<ChannelType>(3, ChannelType::byte), {}};
    packed.pixels.resize(layer->floats().size());
    std::transform(layer->floats().begin(), layer->floats().end(), packed.pixels.begin(), to_srgb);
    return packed;
}

Packed all_layers(const Image& image) {
    Packed packed{image.width, image.height, {}, {}, {}};
    for (const Layer& layer : image.layers) {
        packed.names.insert(packed.names.end(), layer.channels.begin(), layer.channels.end());
        packed.types.insert(packed.types.end(), layer.channels.size(),
                            layer.is_float() ? ChannelType::float32 : ChannelType::uint32);
    }
    const size_t pixel_bytes = 4 * packed.names.size();
    packed.pixels.resize(size_t(image.width) * image.height * pixel_bytes);
    size_t offset = 0;
    for (const Layer& layer : image.layers) {
        const size_t layer_bytes = 4 * layer.channels.size();
        std::visit(
            [&](const auto& values) {
                assert(values.size() * 4 == size_t(image.width) * image.height * layer_bytes);
                const auto* from = reinterpret_cast<const unsigned char*>(values.data());
                parallel_for(size_t(image.width) * image.height, [&](size_t pixel) {
                    std::memcpy(packed.pixels.data() + pixel * pixel_bytes + offset,
                                from + pixel * layer_bytes, layer_bytes);
                });
            },
            layer.values);
        offset += layer_bytes;
    }
    return packed;
}

std::string layer_name(std::string_view channel) {
    const size_t dot = channel.rfind('.');
    return std::string(dot == std::string_view::npos ? "" : channel.substr(0, dot));
}

size_t size_of(ChannelType type) { return type == ChannelType::byte ? 1 : 4; }

float as_float(ChannelType type, const unsigned char* from) {
    if (type == ChannelType::byte) return static_cast<float>(*from) / 255.0f;
    float value;
    std::memcpy(&value, from, 4);
    return value;
}

/// Appends channels [first, last) of the packed pixels as one layer.
void add_layer(Image& image, const PackedPicture& picture, uint32_t first, uint32_t last) {
    size_t pixel_bytes = 0, offset = 0;
    for (uint32_t c = 0; c < picture.channels; ++c) {
        if (c == first) offset = pixel_bytes;
        pixel_bytes += size_of(picture.types[c]);
    }
    const ChannelType type = picture.types[first];
    const size_t count = last - first, pixels = size_t(image.width) * image.height;
    const auto* bytes = static_cast<const unsigned char*>(picture.pixels) + offset;
    std::vector<std::string> names(picture.names + first, picture.names + last);
    if (type == ChannelType::uint32) {
        std::vector<uint32_t>& values = image.add_integers(std::move(names));
        for (size_t p = 0; p < pixels; ++p)
            std::memcpy(&values[p * count], bytes + p * pixel_bytes, 4 * count);
        return;
    }
    std::vector<float>& values = image.add_floats(std::move(names));
    for (size_t p = 0; p < pixels; ++p)
        for (size_t c = 0; c < count; ++c)
            values[p * count + c] = as_float(type, bytes + p * pixel_bytes + c * size_of(type));
}

/// What the module's read calls back.
struct Receiver {
    Image image;
    std::exception_ptr error;
};

void receive(void* context, const PackedPicture* picture) {
    auto& receiver = *static_cast<Receiver*>(context);
    try {
        receiver.image.width = picture->width;
        receiver.image.height = picture->height;
        for (uint32_t first = 0, last = 0; first < picture->channels; first = last) {
            while (last < picture->channels && picture->types[last] == picture->types[first] &&
                   layer_name(picture->names[last]) == layer_name(picture->names[first]))
                ++last;
            add_layer(receiver.image, *picture, first, last);
        }
    } catch (...) {
        receiver.error = std::current_exception();
    }
}

}  // namespace

std::vector<float>& Image::add_floats(std::vector<std::string> channels) {
    const size_t count = size_t(width) * height * channels.size();
    return layers.emplace_back(Layer{std::move(channels), std::vector<float>(count)}).floats();
}

std::vector<uint32_t>& Image::add_integers(std::vector<std::string> channels) {
    const size_t count = size_t(width) * height * channels.size();
    return layers.emplace_back(Layer{std::move(channels), std::vector<uint32_t>(count)}).integers();
}

const Layer* Image::with_channel(std::string_view channel) const {
    for (const Layer& layer : layers)
        if (std::find(layer.channels.begin(), layer.channels.end(), channel) != layer.channels.end())
            return &layer;
    return nullptr;
}

uint8_t to_srgb(float linear) {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    const float encoded =
        linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
    return static_cast<uint8_t>(encoded * 255 + 0.5f);
}

void check_image_path(const std::string& path) {
    format_of(path);
    load_images_module(path);
    const fs::path folder = fs::path(path).parent_path();
    std::error_code ignored;
    if (!folder.empty() && !fs::is_directory(folder, ignored))
        fail(ExitCode::bad_input, "{}: there is no folder {}; create it first", path, folder.string());
    if (fs::is_directory(path, ignored))
        fail(ExitCode::bad_input, "{}: is a folder; name a file in it", path);
}

void write_image(const std::string& path, const Image& image) {
    check_image_path(path);
    if (image.width == 0 || image.height == 0 || image.layers.empty())
        fail(ExitCode::usage, "{}: the image is empty ({}x{} pixels)", path, image.width, image.height);
    const std::string format = format_of(path);
    const Packed packed = format == "png" ? preview(path, image) : all_layers(image);
    write_file(path, packed.encoded(load_images_module(path), path, format));
}

Image read_image(const std::string& path) {
    format_of(path);
    const ImagesModule& module = load_images_module(path);
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) fail(ExitCode::bad_input, "{}: there is no such file", path);
    Receiver receiver;
    std::array<char, 512> message{};
    if (!module.read(path.c_str(), receive, &receiver, message.data(), message.size()))
        fail(ExitCode::bad_input, "{}: cannot be read as an image: {}", path, one_line(message.data()));
    if (receiver.error) std::rethrow_exception(receiver.error);
    return std::move(receiver.image);
}

}  // namespace strandlab
