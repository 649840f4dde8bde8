#include <array>
#include <tuple>

#include <gtest/gtest.h>

#include "bindings/scene/glb_container.h"
#include "scene/gltf_files.h"

namespace clv {
namespace {

class WriteGlb : public GltfFiles {
protected:
    Scene writtenAndLoaded(const Scene& scene) const {
        writeGlb(scene, file("written.glb"));
        return loadScene(file("written.glb"));
    }
};

// Node, material, corners and an albedo of every triangle, sorted: the file groups triangles by node and material.
using TriangleRow = std::tuple<std::string, std::string, std::array<float, 9>, std::array<float, 3>>;

std::vector<TriangleRow> sortedTriangles(const Scene& scene) {
    std::vector<TriangleRow> rows;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        std::array<float, 9> corners;
        for (int i = 0; i < 9; ++i) corners[i] = corner(scene, t, i / 3)[i % 3];
        const glm::vec3 albedo = scene.albedo(t, 0.2f, 0.3f);
        rows.push_back({scene.nodeNames[scene.nodeOf[t]], scene.materials[scene.materialOf[t]].name, corners, {albedo.r, albedo.g, albedo.b}});
    }
    std::ranges::sort(rows);
    return rows;
}

void expectSameTriangles(const Scene& a, const Scene& b) {
    EXPECT_EQ(sortedTriangles(a), sortedTriangles(b));
    EXPECT_EQ(a.bounds.lo, b.bounds.lo);
    EXPECT_EQ(a.bounds.hi, b.bounds.hi);
    EXPECT_EQ(a.anchor, b.anchor);
}

void expectSameLightsAndCameras(const Scene& a, const Scene& b) {
    ASSERT_EQ(a.lights.size(), b.lights.size());
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        const ClvLight &p = a.lights[i].light, &q = b.lights[i].light;
        EXPECT_EQ(a.lights[i].name, b.lights[i].name);
        EXPECT_EQ(p.type, q.type);
        EXPECT_EQ(p.intensity, q.intensity);
        EXPECT_EQ(p.innerConeAngle, q.innerConeAngle);
        EXPECT_EQ(p.outerConeAngle, q.outerConeAngle);
        EXPECT_EQ(p.position, q.position);
        if (p.type == kClvLightPoint) continue;  // it has no direction
        EXPECT_LT(glm::distance(p.direction, q.direction), 1e-6f);
    }
    ASSERT_EQ(a.cameras.size(), b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        const Camera &p = a.cameras[i], &q = b.cameras[i];
        EXPECT_EQ(p.name, q.name);
        EXPECT_EQ(p.position, q.position);
        EXPECT_LT(glm::distance(p.forward, q.forward), 1e-6f);
        EXPECT_LT(glm::distance(p.up, q.up), 1e-6f);
        EXPECT_EQ(p.yfov, q.yfov);
        EXPECT_EQ(p.aspect, q.aspect);
    }
}

class WriteEveryBuiltinScene : public WriteGlb, public ::testing::WithParamInterface<BuiltinScene> {};

TEST_P(WriteEveryBuiltinScene, comesBackTheSame) {
    const Scene scene = makeBuiltinScene(GetParam().name), back = writtenAndLoaded(scene);
    expectSameTriangles(scene, back);
    expectSameLightsAndCameras(scene, back);
    EXPECT_TRUE(back.ignored.empty());
}

INSTANTIATE_TEST_SUITE_P(Scenes, WriteEveryBuiltinScene, ::testing::ValuesIn(builtinScenes()), [](const auto& info) { return info.param.name; });

Scene texturedSceneFarAway() {
    Scene scene;
    scene.anchor = {1000000, 50, -3000000};
    scene.positions = {{-1, 0.1f, 0}, {1, -0.2f, 0}, {0, 1, 0.3f}, {0, -1, 0.7f}};
    scene.uvs = {{0, 0}, {1, 0}, {0, 1}, {0.5f, 0.25f}};
    scene.triangles = {{0, 1, 2}, {1, 0, 3}};
    scene.materialOf = {1, 0};
    scene.nodeOf = {0, 0};
    scene.nodeNames = {"far"};
    scene.materials = {{"plain", {0.1f, 0.2f, 0.3f}, -1}, {"tiles", {1, 1, 1}, 0}};
    // Black and full channels survive the PNG exactly.
    scene.textures = {{"map", 2, 1, {{0, 1, 0}, {1, 0, 1}}}};
    scene.bounds = {{-1, -1, 0}, {1, 1, 0.7f}};
    ClvLight off{};
    off.type = kClvLightPoint;
    scene.lights = {{"off", off}};
    return scene;
}

TEST_F(WriteGlb, keepsTexturesAndTheAnchor) {
    const Scene scene = texturedSceneFarAway(), back = writtenAndLoaded(scene);
    expectSameTriangles(scene, back);
    expectSameLightsAndCameras(scene, back);
    ASSERT_EQ(back.textures.size(), 1u);
    EXPECT_EQ(back.textures[0].name, "map");
    EXPECT_EQ(back.textures[0].texels, scene.textures[0].texels);
}

TEST_F(WriteGlb, lightColoursStayWithinOne) {
    writeGlb(makeBuiltinScene("atrium"), file("written.glb"));
    const std::string bytes = read(file("written.glb"));
    const json document = unpackGlb("written.glb", {bytes.begin(), bytes.end()}).document;
    const json& light = document["extensions"]["KHR_lights_punctual"]["lights"][0];
    EXPECT_EQ(light["type"], "directional");
    EXPECT_EQ(light["intensity"].get<double>(), 10.0);
    for (const json& channel : light["color"]) {
        EXPECT_GE(channel.get<double>(), 0.0);
        EXPECT_LE(channel.get<double>(), 1.0);
    }
}

TEST_F(WriteGlb, replacesAnOldFileAndLeavesNothingElse) {
    write("written.glb", "old");
    writeGlb(makeBuiltinScene("cornell"), file("written.glb"));
    EXPECT_EQ(listing(), std::vector<std::string>{"written.glb"});
    EXPECT_EQ(loadScene(file("written.glb")).triangles.size(), 30u);
}

TEST_F(WriteGlb, aFolderThatDoesNotExistIsAnErrorThatNamesTheFile) {
    try {
        writeGlb(makeBuiltinScene("cornell"), file("nowhere/written.glb"));
        FAIL() << "expected an InputError";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("nowhere/written.glb"), std::string::npos);
    }
    EXPECT_TRUE(listing().empty());
}

}  // namespace
}  // namespace clv
