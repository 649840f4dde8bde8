#include "bindings/scene/surface_rows.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace clv {
namespace {

constexpr int kLongestSide = 0xffff;

// The index of each texture's first texel.
std::vector<std::uint32_t> firstTexels(const Scene& scene) {
    std::vector<std::uint32_t> first;
    std::uint64_t texels = 0;
    for (const Texture& texture : scene.textures) {
        if (std::max(texture.width, texture.height) > kLongestSide) {
            throw InputError(scene.name + ": texture " + texture.name + ": expected at most " + std::to_string(kLongestSide) + " texels a side");
        }
        first.push_back(std::uint32_t(texels));
        texels += texture.texels.size();
    }
    if (texels > std::numeric_limits<std::uint32_t>::max()) throw InputError(scene.name + ": expected textures of less than 2^32 texels together");
    return first;
}

void addTextures(const Scene& scene, SurfaceRows& rows) {
    const std::vector<std::uint32_t> first = firstTexels(scene);
    for (const Texture& texture : scene.textures) {
        for (const vec3& texel : texture.texels) rows.textureTexels.push_back(vec4(texel, 1.0f));
    }
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        const int index = scene.materials[scene.materialOf[t]].texture;
        if (index < 0) {
            rows.textureRows.insert(rows.textureRows.end(), kClvTextureRows, uvec4(0));
            continue;
        }
        const Texture& texture = scene.textures[index];
        const glm::uvec3& c = scene.triangles[t];
        const auto bits = [&](std::uint32_t corner) { return uvec2(clvBitsFromFloat(scene.uvs[corner].x), clvBitsFromFloat(scene.uvs[corner].y)); };
        rows.textureRows.push_back(uvec4(bits(c.x), bits(c.y)));
        rows.textureRows.push_back(uvec4(bits(c.z), first[index], std::uint32_t(texture.width) | std::uint32_t(texture.height) << 16));
    }
}

}  // namespace

SurfaceRows surfaceRowsOf(const Scene& scene) {
    SurfaceRows rows;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        const glm::uvec3& c = scene.triangles[t];
        const vec3& a = scene.positions[c.x];
        const vec3 normal = cross(scene.positions[c.y] - a, scene.positions[c.z] - a);
        // A triangle without area is never met.
        rows.surfaces.push_back(vec4(normal == vec3(0.0f) ? normal : normalize(normal), 0.0f));
        rows.surfaces.push_back(vec4(scene.materials[scene.materialOf[t]].albedo, 0.0f));
    }
    const bool textured = std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& material) { return material.texture >= 0; });
    if (textured) addTextures(scene, rows);
    return rows;
}

}  // namespace clv
