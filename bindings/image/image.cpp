#include "bindings/image/image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace clv {
namespace {

constexpr int kChannels = 3;

void writePixels(const std::string& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc memoryFormat, const void* pixels) {
    auto output = OIIO::ImageOutput::create(file);
    if (!output) throw ImageError(fmt::format("{}: no writer for this kind of picture: {}", file, OIIO::geterror()));
    const bool written = output->open(file, spec) && output->write_image(memoryFormat, pixels);
    // Closing flushes: a full disk may show only here.
    if (!written || !output->close()) throw ImageError(fmt::format("{}: cannot be written: {}", file, output->geterror()));
}

}  // namespace

float srgbFromLinear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linearFromSrgb(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

void writeExr(const Image& image, const std::string& file, ExrPrecision precision) {
    const OIIO::TypeDesc stored = precision == ExrPrecision::kHalf ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT;
    OIIO::ImageSpec spec(image.width, image.height, kChannels, stored);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    writePixels(file, spec, OIIO::TypeDesc::FLOAT, image.pixels.data());
}

void writePng(const Image& image, const std::string& file) {
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * kChannels);
    for (const glm::vec3& pixel : image.pixels)
        for (int channel = 0; channel < kChannels; ++channel) {
            const float linear = pixel[channel];
            // A value that is not a number shows as black: no comparison with it holds.
            const float clamped = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
            bytes.push_back(std::uint8_t(std::lround(255.0f * srgbFromLinear(clamped))));
        }
    OIIO::ImageSpec spec(image.width, image.height, kChannels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    writePixels(file, spec, OIIO::TypeDesc::UINT8, bytes.data());
}

Image readImage(const std::string& file) {
    // Asked first: without it the message speaks of formats when the file is just not there.
    if (!std::filesystem::exists(file)) throw ImageError(fmt::format("{}: no such picture", file));
    auto input = OIIO::ImageInput::open(file);
    if (!input) throw ImageError(fmt::format("{}: cannot be read: {}", file, OIIO::geterror()));
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels < kChannels)
        throw ImageError(fmt::format("{}: expected {} channels, found {}", file, kChannels, spec.nchannels));
    Image image(spec.width, spec.height);
    if (!input->read_image(0, 0, 0, kChannels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
        throw ImageError(fmt::format("{}: cannot be read: {}", file, input->geterror()));
    if (input->format_name() == std::string("png"))
        for (glm::vec3& pixel : image.pixels)
            for (int channel = 0; channel < kChannels; ++channel) pixel[channel] = linearFromSrgb(pixel[channel]);
    return image;
}

}  // namespace clv
