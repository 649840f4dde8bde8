#include "bindings/scene/texture_codec.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace clv {
namespace {

constexpr int kWidestTexture = 1 << 15;  // texels; what claims to be wider is damaged

// IEC 61966-2-1.
float linearFromSrgb(float s) { return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f); }
float srgbFromLinear(float l) { return l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1.0f / 2.4f) - 0.055f; }

// OpenImageIO picks the reader by the name; images inside a GLB have none that says the format.
std::string nameOfFormat(const std::vector<std::uint8_t>& bytes, const std::string& name) {
    auto begins = [&](std::initializer_list<std::uint8_t> magic) {
        return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
    };
    if (begins({0x89, 'P', 'N', 'G'})) return "image.png";
    if (begins({0xff, 0xd8, 0xff})) return "image.jpg";
    return name;
}

}  // namespace

Texture decodeTexture(const std::vector<std::uint8_t>& bytes, const std::string& name, const std::string& place) {
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(bytes.data()), bytes.size());
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;  // alpha plays no part: base colour must not be multiplied by it
    OIIO::Filesystem::IOProxy* proxy = &memory;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto input = OIIO::ImageInput::open(nameOfFormat(bytes, name), &config, &memory);
    if (!input) throw InputError(fmt::format("{}: '{}': expected an image ({})", place, name, OIIO::geterror()));
    const OIIO::ImageSpec& spec = input->spec();
    const bool sizeIsGood = spec.width > 0 && spec.height > 0 && spec.width <= kWidestTexture && spec.height <= kWidestTexture;
    if (!sizeIsGood || spec.nchannels < 1)
        throw InputError(fmt::format("{}: '{}': expected an image of 1 to {} texels a side", place, name, kWidestTexture));

    const int channels = spec.nchannels;
    std::vector<float> values(std::size_t(spec.width) * spec.height * channels);
    if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, values.data()))
        throw InputError(fmt::format("{}: '{}': expected a whole image ({})", place, name, input->geterror()));

    const bool isLinear = spec.format.is_floating_point();
    const bool isGrey = channels < 3;
    Texture texture{name, spec.width, spec.height, {}};
    texture.texels.resize(std::size_t(spec.width) * spec.height);
    for (std::size_t i = 0; i < texture.texels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const float value = values[i * channels + (isGrey ? 0 : channel)];
            // Not a number compares false: the clamp below turns it into 0.
            const float linear = isLinear ? value : linearFromSrgb(value);
            texture.texels[i][channel] = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
        }
    return texture;
}

std::vector<std::uint8_t> encodePng(const Texture& texture) {
    std::vector<std::uint16_t> values;
    values.reserve(3 * texture.texels.size());
    for (const glm::vec3& texel : texture.texels)
        for (int channel = 0; channel < 3; ++channel)
            values.push_back(std::uint16_t(std::lround(65535.0f * std::clamp(srgbFromLinear(texel[channel]), 0.0f, 1.0f))));

    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("image.png", &memory);
    const OIIO::ImageSpec spec(texture.width, texture.height, 3, OIIO::TypeDesc::UINT16);
    const bool done = output && output->open("image.png", spec) &&
                      output->write_image(OIIO::TypeDesc::UINT16, values.data()) && output->close();
    if (!done) throw std::runtime_error("OpenImageIO cannot write PNG: " + (output ? output->geterror() : OIIO::geterror()));
    return bytes;
}

}  // namespace clv
