// Texture images in and out, through OpenImageIO.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bindings/scene/scene.h"

namespace clv {

// Decodes an image held in memory. Integer formats are taken as sRGB and become linear, floating-point formats are linear already.
// `place` begins the line of an error. Throws InputError.
Texture decodeTexture(const std::vector<std::uint8_t>& bytes, const std::string& name, const std::string& place);

// A PNG of 16 bits a channel, sRGB.
std::vector<std::uint8_t> encodePng(const Texture& texture);

}  // namespace clv
