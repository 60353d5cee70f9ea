// Images in layers, written as PNG (a preview) and as multilayer OpenEXR (everything).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace strandlab {

/// Some channels that belong together: values are interleaved, rows from the top, float or uint32. The
/// channels' names are those of the EXR file: "R", "normal.X", "id.strand".
struct Layer {
    std::vector<std::string> channels;
    std::variant<std::vector<float>, std::vector<uint32_t>> values;

    bool is_float() const { return values.index() == 0; }
    const std::vector<float>& floats() const { return std::get<0>(values); }
    const std::vector<uint32_t>& integers() const { return std::get<1>(values); }
    std::vector<float>& floats() { return std::get<0>(values); }
    std::vector<uint32_t>& integers() { return std::get<1>(values); }
};

/// A picture of width x height pixels. Each layer has width height channels.size() values.
struct Image {
    uint32_t width = 0, height = 0;
    std::vector<Layer> layers;

    /// Adds a layer of zeros and returns its values.
    std::vector<float>& add_floats(std::vector<std::string> channels);
    std::vector<uint32_t>& add_integers(std::vector<std::string> channels);
    /// The layer that has the channel, or nullptr.
    const Layer* with_channel(std::string_view channel) const;
};

/// A linear colour value in [0, 1] as the 8 bits of the sRGB transfer function (IEC 61966-2-1); NaN is 0.
uint8_t to_srgb(float linear);

/// Checks before any work is done that an image could be written there: throws Error (usage) for an
/// ending other than .png and .exr or when this build or installation has no images, and Error
/// (bad_input) when the folder does not exist.
void check_image_path(const std::string& path);

/// Writes the image as its ending says: .png holds the layer with channels R, G, B (linear) as 8-bit
/// sRGB, .exr all layers as they are. The file appears whole or not at all. Throws as check_image_path,
/// and Error (bad_input) when it cannot be written.
void write_image(const std::string& path, const Image& image);

/// Reads an image: channels of one type that share the part of their name before the last '.' form a
/// layer, in the file's order; bytes become floats in [0, 1] as stored. Throws as check_image_path, and
/// Error (bad_input) when it cannot be read.
Image read_image(const std::string& path);

}  // namespace strandlab
