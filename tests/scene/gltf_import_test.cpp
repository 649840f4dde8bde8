#include <cmath>

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "bindings/scene/texture_codec.h"
#include "scene/gltf_files.h"

namespace clv {
namespace {

class GltfImport : public GltfFiles {};

json rotationAboutY(double angle) { return {0.0, std::sin(angle / 2), 0.0, std::cos(angle / 2)}; }

void expectNear(const glm::vec3& a, const glm::vec3& b) {
    EXPECT_LT(glm::distance(a, b), 1e-6f) << a.x << ' ' << a.y << ' ' << a.z << " is not " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST_F(GltfImport, readsATriangleWithItsNamesAndAlbedo) {
    const Scene scene = load(triangleGltf());
    ASSERT_EQ(scene.triangles.size(), 1u);
    expectNear(corner(scene, 0, 1), {1, 0, 0});
    EXPECT_EQ(scene.nodeNames, std::vector<std::string>{"leaf"});
    EXPECT_EQ(scene.materials[scene.materialOf[0]].name, "paint");
    expectNear(scene.albedo(0, 0.3f, 0.3f), {0.1f, 0.2f, 0.3f});
    EXPECT_EQ(scene.name, "test");
}

TEST_F(GltfImport, placesEveryInstanceThroughItsChainOfTransforms) {
    TestGltf gltf = triangleGltf();
    gltf.document["nodes"] = {{{"name", "group"}, {"translation", {10, 0, 0}}, {"rotation", rotationAboutY(glm::half_pi<double>())}, {"children", {1, 2}}},
                              {{"name", "a"}, {"mesh", 0}, {"scale", {2, 2, 2}}},
                              {{"name", "b"}, {"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}}}};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.triangles.size(), 2u);
    expectNear(corner(scene, 0, 1), {10, 0, -2});  // (2,0,0) turned onto -z
    expectNear(corner(scene, 1, 0), {15, 0, 0});   // (0,0,5) turned onto +x
    EXPECT_EQ(scene.nodeNames[scene.nodeOf[0]], "a");
    EXPECT_EQ(scene.nodeNames[scene.nodeOf[1]], "b");
}

TEST_F(GltfImport, aMirroredNodeKeepsItsFrontFaces) {
    TestGltf gltf = triangleGltf();
    const glm::dvec3 straight = areaVector(load(gltf), 0);
    gltf.document["nodes"][0]["scale"] = {-1, 1, 1};
    const glm::dvec3 mirrored = areaVector(load(gltf), 0);
    EXPECT_GT(straight.z, 0.0);
    EXPECT_GT(mirrored.z, 0.0) << "mirroring along x keeps the face towards +z";
}

TEST_F(GltfImport, keepsMillimetresFarFromTheOrigin) {
    TestGltf gltf = triangleGltf();
    gltf.document["nodes"][0]["translation"] = {1000000.4, 0, -2000000.3};
    gltf.document["nodes"][0]["scale"] = {3, 3, 3};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.anchor, glm::dvec3(1000002.0, 2.0, -2000000.0));
    for (const auto& [i, expected] : {std::pair(0, glm::dvec3(1000000.4, 0, -2000000.3)), {1, {1000003.4, 0, -2000000.3}}})
        EXPECT_LT(glm::distance(scene.anchor + glm::dvec3(corner(scene, 0, i)), expected), 1e-6);
}

TEST_F(GltfImport, keepsThousandthsOfAMillimetreInATinySceneALittleAway) {
    TestGltf gltf = triangleGltf();
    gltf.document["nodes"][0]["translation"] = {100.3, 0, 0};
    gltf.document["nodes"][0]["scale"] = {0.004, 0.004, 0.004};
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.anchor, glm::dvec3(100.0, 0.0, 0.0));
    EXPECT_LT(glm::distance(scene.anchor + glm::dvec3(corner(scene, 0, 1)), glm::dvec3(100.304, 0, 0)), 3e-8);
}

TEST_F(GltfImport, anOrdinarySceneHasNoAnchor) {
    TestGltf gltf = triangleGltf();
    gltf.document["nodes"][0]["translation"] = {500, 0, 0};
    EXPECT_EQ(load(gltf).anchor, glm::dvec3(0.0));
    gltf.document["nodes"][0] = {{"mesh", 0}, {"scale", {9000, 9000, 9000}}};
    EXPECT_EQ(load(gltf).anchor, glm::dvec3(0.0)) << "large, but not far away for its size";
}

TEST_F(GltfImport, readsEveryCameraOfOneDefinition) {
    TestGltf gltf = triangleGltf();
    gltf.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"aspectRatio", 1.5}, {"znear", 0.1}}}}};
    for (int i = 0; i < 3; ++i) {
        gltf.document["scenes"][0]["nodes"].push_back(i + 1);
        gltf.document["nodes"].push_back({{"name", "eye " + std::to_string(i)}, {"camera", 0}, {"translation", {i, 2, 3}},
                                          {"rotation", rotationAboutY(i * glm::half_pi<double>())}});
    }
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.cameras.size(), 3u);
    EXPECT_EQ(scene.cameras[2].name, "eye 2");
    EXPECT_FLOAT_EQ(scene.cameras[2].yfov, 0.7f);
    EXPECT_FLOAT_EQ(scene.cameras[2].aspect, 1.5f);
    expectNear(scene.cameras[2].position, {2, 2, 3});
    expectNear(scene.cameras[0].forward, {0, 0, -1});
    expectNear(scene.cameras[1].forward, {-1, 0, 0});
    expectNear(scene.cameras[2].forward, {0, 0, 1});
    expectNear(scene.cameras[1].up, {0, 1, 0});
}

TEST_F(GltfImport, readsPunctualLightsInRadiometricUnits) {
    TestGltf gltf = triangleGltf();
    gltf.document["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"name", "bulb"}, {"color", {1, 0.5, 0.25}}, {"intensity", 8}, {"range", 3}},
        {{"type", "spot"}, {"spot", json::object()}},
        {{"type", "directional"}, {"intensity", 0}}};
    for (int i = 0; i < 3; ++i) {
        gltf.document["scenes"][0]["nodes"].push_back(i + 1);
        gltf.document["nodes"].push_back({{"translation", {0, i, 0}}, {"rotation", rotationAboutY(glm::half_pi<double>())},
                                          {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    }
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.lights.size(), 3u);
    EXPECT_EQ(scene.lights[0].name, "bulb");
    EXPECT_EQ(scene.lights[0].light.type, kClvLightPoint);
    EXPECT_EQ(scene.lights[0].light.intensity, glm::vec3(8, 4, 2));
    EXPECT_EQ(scene.lights[1].light.type, kClvLightSpot);
    EXPECT_EQ(scene.lights[1].light.intensity, glm::vec3(1.0f));
    EXPECT_EQ(scene.lights[1].light.innerConeAngle, 0.0f);
    EXPECT_FLOAT_EQ(scene.lights[1].light.outerConeAngle, glm::quarter_pi<float>());
    expectNear(scene.lights[1].light.position, {0, 1, 0});
    expectNear(scene.lights[1].light.direction, {-1, 0, 0});
    EXPECT_EQ(scene.lights[2].light.type, kClvLightDirectional);
    EXPECT_EQ(scene.lights[2].light.intensity, glm::vec3(0.0f)) << "a lamp that is off is no error";
}

Texture twoByTwo() { return {"tiles", 2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0.5f}}}; }

void expectTwoByTwo(const Scene& scene) {
    ASSERT_EQ(scene.textures.size(), 1u);
    const glm::vec3 factor(0.1f, 0.2f, 0.3f);
    // Texel centres; barycentrics equal the texture coordinates. Row 0 lies at v = 0.
    EXPECT_LT(glm::distance(scene.albedo(0, 0.25f, 0.25f), factor * glm::vec3(1, 0, 0)), 1e-4f);
    EXPECT_LT(glm::distance(scene.albedo(0, 0.75f, 0.25f), factor * glm::vec3(0, 1, 0)), 1e-4f);
    EXPECT_LT(glm::distance(scene.albedo(0, 0.25f, 0.75f), factor * glm::vec3(0, 0, 1)), 1e-4f);
    EXPECT_LT(glm::distance(scene.albedo(0, 0.5f, 0.25f), factor * glm::vec3(0.5f, 0.5f, 0)), 1e-4f) << "bilinear between texels";
}

TestGltf texturedGltf(const json& image) {
    TestGltf gltf = triangleGltf();
    gltf.document["images"] = {image};
    gltf.document["textures"] = {{{"source", 0}}};
    gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    return gltf;
}

TEST_F(GltfImport, readsATextureOutOfTheBinaryChunk) {
    const std::vector<std::uint8_t> png = encodePng(twoByTwo());
    TestGltf gltf = texturedGltf({{"bufferView", 3}, {"mimeType", "image/png"}});
    padBytes(gltf.binary, 4, 0);
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", gltf.binary.size()}, {"byteLength", png.size()}});
    appendBytes(gltf.binary, png.data(), png.size());
    gltf.document["buffers"][0]["byteLength"] = gltf.binary.size();
    expectTwoByTwo(load(gltf));
}

TEST_F(GltfImport, readsATextureFileBesideIt) {
    const std::vector<std::uint8_t> png = encodePng(twoByTwo());
    write("two by two.png", std::string(png.begin(), png.end()));
    expectTwoByTwo(load(texturedGltf({{"uri", "two%20by%20two.png"}})));
}

// A PNG of one texel, 8 bits, sRGB value 188 in every channel: 0.5028865 linear (IEC 61966-2-1).
constexpr const char* kGreyPixel =
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGPYAwAAvgC90zIvywAAAABJRU5ErkJggg==";

TEST_F(GltfImport, readsATextureInADataUriAndMakesItLinear) {
    const Scene scene = load(texturedGltf({{"uri", kGreyPixel}}));
    ASSERT_EQ(scene.textures.size(), 1u);
    EXPECT_LT(glm::distance(scene.textures[0].texels[0], glm::vec3(0.5028865f)), 1e-4f);
}

TEST_F(GltfImport, readsTheTextureCoordinatesThatTheMaterialNames) {
    const std::vector<std::uint8_t> png = encodePng(twoByTwo());
    write("tiles.png", std::string(png.begin(), png.end()));
    TestGltf gltf = texturedGltf({{"uri", "tiles.png"}});
    gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = 1;
    json& attributes = gltf.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"];
    attributes.erase("TEXCOORD_0");
    expectTwoByTwo(load(gltf));
}

TEST_F(GltfImport, readsGltfWithBuffersInDataUris) {
    TestGltf gltf = triangleGltf();
    // Base64 of the 36 bytes of positions.
    gltf.document["buffers"] = {{{"byteLength", 36}, {"uri", "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}};
    gltf.document["bufferViews"].erase(2);
    gltf.document["bufferViews"].erase(1);
    gltf.document["accessors"].erase(2);
    gltf.document["accessors"].erase(1);
    gltf.document["meshes"][0]["primitives"] = {{{"attributes", {{"POSITION", 0}}}}};
    const Scene scene = loadScene(write("plain.gltf", gltf.document.dump()));
    ASSERT_EQ(scene.triangles.size(), 1u);
    expectNear(corner(scene, 0, 2), {0, 1, 0});
    EXPECT_EQ(scene.materials[scene.materialOf[0]].albedo, glm::vec3(1.0f)) << "glTF's default material is white";
}

TEST_F(GltfImport, readsGltfWithABufferFileBesideIt) {
    TestGltf gltf = triangleGltf();
    write("data.bin", std::string(gltf.binary.begin(), gltf.binary.end()));
    gltf.document["buffers"][0]["uri"] = "data.bin";
    EXPECT_EQ(loadScene(write("plain.gltf", gltf.document.dump())).triangles.size(), 1u);
}

TEST_F(GltfImport, readsStripsWithTheirFrontFacesAndSkipsLines) {
    TestGltf gltf = triangleGltf();
    const float square[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    gltf.binary.clear();
    appendBytes(gltf.binary, square, sizeof square);
    gltf.document["buffers"][0]["byteLength"] = gltf.binary.size();
    gltf.document["bufferViews"] = {{{"buffer", 0}, {"byteLength", sizeof square}}};
    gltf.document["accessors"] = {{{"bufferView", 0}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 4}}};
    const json attributes = {{"POSITION", 0}};
    gltf.document["meshes"][0]["primitives"] = {{{"attributes", attributes}, {"mode", 5}}, {{"attributes", attributes}, {"mode", 1}}};
    const Scene scene = load(gltf);
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_GT(areaVector(scene, 0).z, 0.0);
    EXPECT_GT(areaVector(scene, 1).z, 0.0);
    EXPECT_EQ(scene.ignored, std::vector<std::string>{"points and lines"});
}

TEST_F(GltfImport, readsSparseAccessors) {
    TestGltf gltf = triangleGltf();
    padBytes(gltf.binary, 4, 0);
    const std::uint16_t index = 1;
    const float moved[] = {7, 0, 0};
    const std::size_t begin = gltf.binary.size();
    appendBytes(gltf.binary, &index, sizeof index);
    padBytes(gltf.binary, 4, 0);
    appendBytes(gltf.binary, moved, sizeof moved);
    gltf.document["buffers"][0]["byteLength"] = gltf.binary.size();
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", 2}});
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin + 4}, {"byteLength", 12}});
    gltf.document["accessors"][0]["sparse"] = {{"count", 1}, {"indices", {{"bufferView", 3}, {"componentType", 5123}}}, {"values", {{"bufferView", 4}}}};
    expectNear(corner(load(gltf), 0, 1), {7, 0, 0});
}

TEST_F(GltfImport, positionsThatAreListedAloneAreZeroElsewhere) {
    TestGltf gltf = triangleGltf();
    padBytes(gltf.binary, 4, 0);
    const std::uint16_t indices[] = {0, 2};
    const float listed[] = {7, 0, 0, 0, 8, 0};
    const std::size_t begin = gltf.binary.size();
    appendBytes(gltf.binary, indices, sizeof indices);
    appendBytes(gltf.binary, listed, sizeof listed);
    gltf.document["buffers"][0]["byteLength"] = gltf.binary.size();
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", 4}});
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin + 4}, {"byteLength", 24}});
    gltf.document["accessors"][0]["sparse"] = {{"count", 2}, {"indices", {{"bufferView", 3}, {"componentType", 5123}}}, {"values", {{"bufferView", 4}}}};
    gltf.document["accessors"][0].erase("bufferView");
    const Scene scene = load(gltf);
    expectNear(corner(scene, 0, 0), {7, 0, 0});
    expectNear(corner(scene, 0, 1), {0, 0, 0});
    expectNear(corner(scene, 0, 2), {0, 8, 0});
}

TEST_F(GltfImport, listedIndicesLieBelowTheNumberOfVertices) {
    TestGltf gltf = triangleGltf();
    padBytes(gltf.binary, 4, 0);
    const std::uint16_t listed[] = {1, 9};
    const std::size_t begin = gltf.binary.size();
    appendBytes(gltf.binary, listed, sizeof listed);
    gltf.document["buffers"][0]["byteLength"] = gltf.binary.size();
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", 2}});
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin + 2}, {"byteLength", 2}});
    gltf.document["accessors"][2]["sparse"] = {{"count", 1}, {"indices", {{"bufferView", 3}, {"componentType", 5123}}}, {"values", {{"bufferView", 4}}}};
    EXPECT_TRUE(errorOf(gltf).starts_with(file("test.glb") + ": meshes")) << errorOf(gltf);
}

TEST_F(GltfImport, dropsAndCountsZeroAreaTriangles) {
    TestGltf gltf = triangleGltf();
    const std::uint16_t indices[] = {0, 1, 2, 1, 1, 2};
    gltf.binary.resize(60);
    appendBytes(gltf.binary, indices, sizeof indices);
    gltf.document["buffers"][0]["byteLength"] = gltf.binary.size();
    gltf.document["bufferViews"][2]["byteLength"] = sizeof indices;
    gltf.document["accessors"][2]["count"] = 6;
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.materialOf.size(), 1u);
    EXPECT_EQ(scene.nodeOf.size(), 1u);
    EXPECT_EQ(scene.droppedTriangles, 1u);
}

TEST_F(GltfImport, loadsOnlyTheDefaultScene) {
    TestGltf gltf = triangleGltf();
    gltf.document["nodes"].push_back({{"name", "other"}, {"mesh", 0}});
    gltf.document["scenes"].push_back({{"nodes", {1}}});
    gltf.document["scene"] = 1;
    const Scene scene = load(gltf);
    EXPECT_EQ(scene.nodeNames, std::vector<std::string>{"other"});
    EXPECT_EQ(scene.ignored, std::vector<std::string>{"scenes other than the default one"});
}

TEST_F(GltfImport, saysWhatItIgnores) {
    TestGltf gltf = triangleGltf();
    gltf.document["animations"] = {json::object()};
    gltf.document["skins"] = {json::object()};
    gltf.document["extensionsUsed"] = {"KHR_materials_transmission", "KHR_lights_punctual", "ACME_shine"};
    gltf.document["extensionsRequired"] = {"KHR_lights_punctual"};
    gltf.document["asset"]["minVersion"] = "2.0";
    gltf.document["materials"][0].update({{"emissiveFactor", {1, 0, 0}}, {"alphaMode", "BLEND"}, {"normalTexture", {{"index", 0}}}});
    gltf.document["meshes"][0]["primitives"][0]["targets"] = {json::object()};
    const std::vector<std::string> expected = {"extension KHR_materials_transmission", "extension ACME_shine", "animations", "skins", "normal maps",
                                               "emissive light", "transparency (every face is opaque)", "morph targets"};
    EXPECT_EQ(load(gltf).ignored, expected);
}

TEST_F(GltfImport, aPointLightNeedsNoDirection) {
    TestGltf gltf = triangleGltf();
    gltf.document["nodes"].push_back({{"scale", {0, 0, 0}}, {"translation", {1, 2, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf.document["scenes"][0]["nodes"] = {0, 1};
    gltf.document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    EXPECT_EQ(load(gltf).lights.at(0).light.position, glm::vec3(1, 2, 3));
}

TEST_F(GltfImport, aCameraWithoutADirectionIsLeftOutWithAWarning) {
    TestGltf gltf = triangleGltf();
    gltf.document["nodes"].push_back({{"scale", {1, 0, 0}}, {"camera", 0}});
    gltf.document["scenes"][0]["nodes"] = {0, 1};
    gltf.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}}}}};
    const Scene scene = load(gltf);
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_EQ(scene.warnings, std::vector<std::string>{file("test.glb") + ": nodes[1]: its camera has no direction and is left out"});
}

}  // namespace
}  // namespace clv
