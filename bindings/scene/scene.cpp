#include "bindings/scene/scene.h"

#include "clv/stages/texture.h"

namespace clv {
namespace {

// One texture, its first texel at index 0.
struct TextureReader {
    const Texture& texture;
    vec4 clvReadTextureTexel(uint index) const { return vec4(texture.texels[index], 1.0f); }
};

}  // namespace

glm::vec3 Scene::albedo(std::uint32_t triangle, float u, float v) const {
    const Material& material = materials[materialOf[triangle]];
    if (material.texture < 0) return material.albedo;
    const glm::uvec3& corners = triangles[triangle];
    const glm::vec2 uv = uvs[corners.x] * (1.0f - u - v) + uvs[corners.y] * u + uvs[corners.z] * v;
    const Texture& texture = textures[material.texture];
    return material.albedo * clvReadTexture(TextureReader{texture}, 0, uint(texture.width), uint(texture.height), uv);
}

}  // namespace clv
