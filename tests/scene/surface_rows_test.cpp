#include "bindings/scene/surface_rows.h"

#include <gtest/gtest.h>

#include "clv/stages/surface.h"
#include "clv/stages/texture.h"
#include "support/chi_square.h"

using namespace clv;
using namespace clv::test;

namespace {

// Two triangles over the square [0, 1]^2 at z = 0; the second is painted.
Scene paintedScene() {
    Scene scene;
    scene.name = "painted";
    scene.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    scene.uvs = {{0.0f, 0.0f}, {3.0f, 0.25f}, {2.5f, -1.5f}, {-0.75f, 1.0f}};
    scene.triangles = {{0, 1, 2}, {0, 3, 2}};
    scene.materials = {{"plain", glm::vec3(0.1f, 0.2f, 0.3f), -1}, {"painted", glm::vec3(0.5f, 0.25f, 1.0f), 1}};
    scene.materialOf = {0, 1};
    Texture unused{.name = "unused", .width = 2, .height = 2, .texels = std::vector<glm::vec3>(4, glm::vec3(9.0f))};
    Texture picture{.name = "picture", .width = 3, .height = 5, .texels = {}};
    for (uint i = 0; i < 15; ++i) picture.texels.push_back(glm::vec3(randomUnit(1, i), randomUnit(2, i), randomUnit(3, i)));
    scene.textures = {unused, picture};
    return scene;
}

struct RowReader {
    const SurfaceRows& rows;
    vec4 clvReadSurface(uint row) const { return rows.surfaces.at(row); }
    uvec4 clvReadTextureRow(uint row) const { return rows.textureRows.at(row); }
    vec4 clvReadTextureTexel(uint i) const { return rows.textureTexels.at(i); }
};

TEST(SurfaceRows, holdNormalAndAlbedoOfEachTriangle) {
    const SurfaceRows rows = surfaceRowsOf(paintedScene());
    const ClvHit fromAbove = clvHitOnSurface(RowReader{rows}, 0, 2.0f, vec3(0, 0, -1)), fromBelow = clvHitOnSurface(RowReader{rows}, 0, 3.0f, vec3(0, 0, 1));
    EXPECT_EQ(fromAbove.normal, vec3(0, 0, 1));
    EXPECT_EQ(fromBelow.normal, vec3(0, 0, -1));
    EXPECT_EQ(fromAbove.albedo, vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(fromAbove.distance, 2.0f);
    EXPECT_EQ(fromAbove.primitive, 0u);
    EXPECT_EQ(clvHitOnSurface(RowReader{rows}, 1, 1.0f, vec3(0, 0, -1)).albedo, vec3(0.5f, 0.25f, 1.0f));
}

TEST(SurfaceRows, ofNoTriangleAreNoHit) {
    const SurfaceRows rows;
    const ClvHit hit = clvHitOnSurface(RowReader{rows}, kClvNoPrimitive, 5.0f, vec3(0, 0, 1));
    EXPECT_EQ(hit.distance, kClvFar);
    EXPECT_EQ(hit.primitive, kClvNoPrimitive);
    EXPECT_EQ(hit.normal, vec3(0.0f));
}

TEST(SurfaceRows, giveTheTextureThatTheSceneGives) {
    const Scene scene = paintedScene();
    const SurfaceRows rows = surfaceRowsOf(scene);
    for (uint i = 0; i < 1000; ++i) {
        const float u = randomUnit(5, 2 * i), v = (1.0f - u) * randomUnit(5, 2 * i + 1);
        for (uint t = 0; t < 2; ++t) {
            const vec3 albedo = clvHitOnSurface(RowReader{rows}, t, 1.0f, vec3(0, 0, 1)).albedo;
            EXPECT_EQ(albedo * clvTextureOn(RowReader{rows}, t, u, v), scene.albedo(t, u, v));
        }
    }
}

TEST(SurfaceRows, withoutTexturedMaterialsHaveNoTextures) {
    Scene scene = paintedScene();
    scene.materials[1].texture = -1;
    const SurfaceRows rows = surfaceRowsOf(scene);
    EXPECT_EQ(rows.surfaces.size(), 2 * kClvSurfaceRows);
    EXPECT_TRUE(rows.textureRows.empty());
    EXPECT_TRUE(rows.textureTexels.empty());
}

TEST(SurfaceRows, ofATriangleWithoutAreaAreFinite) {
    Scene scene = paintedScene();
    scene.positions[2] = scene.positions[1];
    const SurfaceRows rows = surfaceRowsOf(scene);
    EXPECT_EQ(vec3(rows.surfaces[0]), vec3(0.0f));
}

TEST(SurfaceRows, refuseATextureTooWideForThem) {
    Scene scene = paintedScene();
    scene.textures[1] = {.name = "wide", .width = 70000, .height = 1, .texels = std::vector<glm::vec3>(70000)};
    try {
        surfaceRowsOf(scene);
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()), "painted: texture wide: expected at most 65535 texels a side");
    }
}

// A texture of 4 x 2 texels whose red is its column and whose green is its row.
struct Chequer {
    vec4 clvReadTextureTexel(uint i) const { return vec4(float(i % 4), float(i / 4), 0.0f, 0.0f); }
};

TEST(Texture, centresAreTheirTexelsAndPlacesBetweenTheirMeans) {
    for (int x = 0; x < 4; ++x) {
        for (int y = 0; y < 2; ++y) {
            EXPECT_EQ(clvReadTexture(Chequer{}, 0, 4, 2, vec2((float(x) + 0.5f) / 4.0f, (float(y) + 0.5f) / 2.0f)), vec3(x, y, 0));
        }
    }
    EXPECT_EQ(clvReadTexture(Chequer{}, 0, 4, 2, vec2(0.5f, 0.5f)), vec3(1.5f, 0.5f, 0.0f));
    EXPECT_EQ(clvReadTexture(Chequer{}, 0, 4, 2, vec2(0.3125f, 0.25f)), vec3(0.75f, 0.0f, 0.0f));
}

TEST(Texture, repeatsOnAllSides) {
    for (const vec2& tile : {vec2(1, 0), vec2(-1, 0), vec2(0, 3), vec2(-7, -2)}) {
        EXPECT_EQ(clvReadTexture(Chequer{}, 0, 4, 2, vec2(0.3125f, 0.25f) + tile), vec3(0.75f, 0.0f, 0.0f));
    }
    // Halfway between the last column and the first.
    EXPECT_EQ(clvReadTexture(Chequer{}, 0, 4, 2, vec2(0.0f, 0.25f)), vec3(1.5f, 0.0f, 0.0f));
    EXPECT_EQ(clvReadTexture(Chequer{}, 0, 4, 2, vec2(1.0f, 0.25f)), vec3(1.5f, 0.0f, 0.0f));
    EXPECT_EQ(clvReadTexture(Chequer{}, 0, 4, 2, vec2(-1e-9f, 0.25f)), vec3(1.5f, 0.0f, 0.0f));
}

TEST(Texture, ofOneTexelIsThatEverywhere) {
    EXPECT_EQ(clvReadTexture(Chequer{}, 6, 1, 1, vec2(0.9f, -0.3f)), vec3(2, 1, 0));
}

}  // namespace
