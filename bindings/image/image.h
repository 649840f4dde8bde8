// Pictures: linear RGB in memory, EXR and PNG on disk.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace clv {

// A picture file that cannot be read or written: what() is one line that names the file.
struct ImageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Image {
    int width = 0, height = 0;
    std::vector<glm::vec3> pixels;  // linear RGB; width * height, row 0 at the top

    Image() = default;
    Image(int width_, int height_, const glm::vec3& fill = glm::vec3(0.0f))
        : width(width_), height(height_), pixels(std::size_t(width_) * std::size_t(height_), fill) {}

    glm::vec3& at(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    const glm::vec3& at(int x, int y) const { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

enum class ExrPrecision { kHalf, kFloat };

// Writes the values as they are. Both writers put the bytes straight under the given name. Throw ImageError.
void writeExr(const Image& image, const std::string& file, ExrPrecision precision = ExrPrecision::kHalf);
// Clamps to [0, 1], encodes as sRGB and rounds to 8 bits; tone mapping comes before (tone_map.h).
void writePng(const Image& image, const std::string& file);

// The first three channels of a picture file, linear: PNG values are decoded from sRGB. Throws ImageError.
Image readImage(const std::string& file);

// IEC 61966-2-1, one channel, [0, 1] to [0, 1].
float srgbFromLinear(float linear);
float linearFromSrgb(float encoded);

}  // namespace clv
