#include "bindings/scene/scene.h"

#include <cmath>

namespace clv {
namespace {

const glm::vec3& texelAt(const Texture& texture, int x, int y) {
    auto repeat = [](int i, int size) { return ((i % size) + size) % size; };
    return texture.texels[std::size_t(repeat(y, texture.height)) * texture.width + repeat(x, texture.width)];
}

// Bilinear, texel centres at half-integers.
glm::vec3 sample(const Texture& texture, const glm::vec2& uv) {
    const glm::vec2 size(texture.width, texture.height);
    const glm::vec2 place = glm::fract(uv) * size - 0.5f;
    const glm::vec2 cell = glm::floor(place), weight = place - cell;
    const int x = int(cell.x), y = int(cell.y);
    return glm::mix(glm::mix(texelAt(texture, x, y), texelAt(texture, x + 1, y), weight.x),
                    glm::mix(texelAt(texture, x, y + 1), texelAt(texture, x + 1, y + 1), weight.x), weight.y);
}

}  // namespace

glm::vec3 Scene::albedo(std::uint32_t triangle, float u, float v) const {
    const Material& material = materials[materialOf[triangle]];
    if (material.texture < 0) return material.albedo;
    const glm::uvec3& corners = triangles[triangle];
    const glm::vec2 uv = (1.0f - u - v) * uvs[corners.x] + u * uvs[corners.y] + v * uvs[corners.z];
    return material.albedo * sample(textures[material.texture], uv);
}

}  // namespace clv
