// Damaged glTF files: always one InputError, never a crash, never an empty scene.
#include <array>
#include <cstring>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "scene/gltf_files.h"

namespace clv {
namespace {

struct Damage {
    const char* name;
    std::function<void(TestGltf&)> apply;
    const char* place;  // part of the error
};

template <class Number>
void overwrite(TestGltf& gltf, std::size_t offset, Number value) {
    std::memcpy(gltf.binary.data() + offset, &value, sizeof value);
}

json& light(TestGltf& gltf) {
    gltf.document["nodes"].push_back({{"name", "bulb"}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    gltf.document["scenes"][0]["nodes"] = {0, 1};
    json& lights = gltf.document["extensions"]["KHR_lights_punctual"]["lights"];
    lights = {{{"type", "spot"}, {"spot", json::object()}}};
    return lights[0];
}

json& camera(TestGltf& gltf) {
    gltf.document["nodes"][0]["camera"] = 0;
    gltf.document["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}}}}};
    return gltf.document["cameras"][0]["perspective"];
}

// Replaces two of the triangle's positions.
void list(TestGltf& gltf, std::array<std::uint16_t, 2> indices) {
    padBytes(gltf.binary, 4, 0);
    const std::size_t begin = gltf.binary.size();
    const float values[6] = {};
    appendBytes(gltf.binary, indices.data(), sizeof indices);
    appendBytes(gltf.binary, values, sizeof values);
    gltf.document["buffers"][0]["byteLength"] = gltf.binary.size();
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", 4}});
    gltf.document["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin + 4}, {"byteLength", 24}});
    gltf.document["accessors"][0]["sparse"] = {{"count", 2}, {"indices", {{"bufferView", 3}, {"componentType", 5123}}}, {"values", {{"bufferView", 4}}}};
}

json& primitive(TestGltf& gltf) { return gltf.document["meshes"][0]["primitives"][0]; }
json& pbr(TestGltf& gltf) { return gltf.document["materials"][0]["pbrMetallicRoughness"]; }

const Damage kDamages[] = {
    {"noVersion", [](TestGltf& g) { g.document["asset"].erase("version"); }, "asset: expected a member 'version'"},
    {"versionOne", [](TestGltf& g) { g.document["asset"]["version"] = "1.0"; }, "asset.version"},
    {"versionThreeNeeded", [](TestGltf& g) { g.document["asset"]["minVersion"] = "3.0"; }, "asset.minVersion: expected at most 2.0, not 3.0"},
    {"versionNewerNeeded", [](TestGltf& g) { g.document["asset"].update({{"version", "2.1"}, {"minVersion", "2.1"}}); }, "asset.minVersion: expected at most 2.0"},
    {"documentIsAnArray", [](TestGltf& g) { g.document = json::array(); }, "expected an object"},
    {"bufferTooLong", [](TestGltf& g) { g.document["buffers"][0]["byteLength"] = 67000; }, "buffers[0]: expected 67000 bytes"},
    {"bufferFileMissing", [](TestGltf& g) { g.document["buffers"][0]["uri"] = "gone.bin"; }, "gone.bin"},
    {"bufferNameTooLong", [](TestGltf& g) { g.document["buffers"][0]["uri"] = std::string(300, 'b'); }, "buffers[0].uri: expected a file"},
    {"bufferNotBase64", [](TestGltf& g) { g.document["buffers"][0]["uri"] = "data:x;base64,#"; }, "buffers[0].uri: expected base64"},
    {"viewBeyondBuffer", [](TestGltf& g) { g.document["bufferViews"][1]["byteOffset"] = 60; }, "bufferViews[1]"},
    {"viewOffsetOverflows", [](TestGltf& g) { g.document["bufferViews"][1]["byteOffset"] = 18446744073709551610ull; }, "bufferViews[1].byteOffset"},
    {"viewOffsetNegative", [](TestGltf& g) { g.document["bufferViews"][1]["byteOffset"] = -4; }, "bufferViews[1].byteOffset"},
    {"viewOfNoBuffer", [](TestGltf& g) { g.document["bufferViews"][0]["buffer"] = 1; }, "bufferViews[0].buffer"},
    {"strideZero", [](TestGltf& g) { g.document["bufferViews"][0]["byteStride"] = 0; }, "bufferViews[0].byteStride"},
    {"strideBelowTheElement", [](TestGltf& g) { g.document["bufferViews"][0]["byteStride"] = 8; }, "bufferViews[0].byteStride: expected at least 12 bytes, those of an element of accessors[0]"},
    {"strideOfIndices", [](TestGltf& g) { g.document["bufferViews"][2].update({{"byteLength", 10}, {"byteStride", 4}}), g.binary.resize(g.binary.size() + 4), g.document["buffers"][0]["byteLength"] = g.binary.size(); },
     "accessors[2]: expected indices without a stride"},
    {"listedTwice", [](TestGltf& g) { list(g, {1, 1}); }, "accessors[0].sparse.indices: expected indices that rise, below 3, not 1 after 1"},
    {"listedBackwards", [](TestGltf& g) { list(g, {2, 0}); }, "accessors[0].sparse.indices: expected indices that rise, below 3, not 0 after 2"},
    {"listedBeyondTheElements", [](TestGltf& g) { list(g, {0, 3}); }, "accessors[0].sparse.indices: expected indices that rise, below 3, not 3 after 0"},
    {"listedByFloats", [](TestGltf& g) { list(g, {0, 1}), g.document["accessors"][0]["sparse"]["indices"]["componentType"] = 5122; }, "accessors[0].sparse.indices.componentType: expected 5121, 5123 or 5125"},
    {"accessorBeyondView", [](TestGltf& g) { g.document["accessors"][0]["count"] = 4; }, "accessors[0]"},
    {"accessorCountZero", [](TestGltf& g) { g.document["accessors"][2]["count"] = 0; }, "accessors[2].count"},
    {"accessorOfNoView", [](TestGltf& g) { g.document["accessors"][0]["bufferView"] = 3; }, "accessors[0].bufferView"},
    {"accessorWithoutView", [](TestGltf& g) { g.document["accessors"][0].erase("bufferView"); }, "accessors[0]"},
    {"accessorTypeUnknown", [](TestGltf& g) { g.document["accessors"][0]["type"] = "VEC9"; }, "accessors[0].type"},
    {"positionsOfShorts", [](TestGltf& g) { g.document["accessors"][0]["componentType"] = 5122; }, "accessors[0]: expected VEC3 of 32-bit floats"},
    {"indicesOfFloats", [](TestGltf& g) { g.document["accessors"][2].update({{"bufferView", 0}, {"componentType", 5126}}); }, "accessors[2]"},
    {"indicesNotInThrees", [](TestGltf& g) { g.document["accessors"][2]["count"] = 2; }, "meshes[0].primitives[0].indices"},
    {"indexBeyondVertices", [](TestGltf& g) { overwrite(g, 62, std::uint16_t(3)); }, "meshes[0].primitives[0].indices"},
    {"attributeOfNoAccessor", [](TestGltf& g) { primitive(g)["attributes"]["POSITION"] = 17; }, "attributes.POSITION"},
    {"uvsTooFew", [](TestGltf& g) { g.document["accessors"][1]["count"] = 2; }, "accessors[1].count"},
    {"noPositions", [](TestGltf& g) { primitive(g)["attributes"].erase("POSITION"); }, "'POSITION'"},
    {"modeUnknown", [](TestGltf& g) { primitive(g)["mode"] = 7; }, "primitives[0].mode"},
    {"noPrimitives", [](TestGltf& g) { g.document["meshes"][0].erase("primitives"); }, "meshes[0]: expected a member 'primitives'"},
    {"noTriangles", [](TestGltf& g) { primitive(g)["mode"] = 0; }, "no triangles"},
    {"noNodes", [](TestGltf& g) { g.document["scenes"][0]["nodes"] = json::array(); }, "no triangles"},
    {"noMeshes", [](TestGltf& g) { g.document.erase("meshes"); }, "nodes[0].mesh"},
    {"sceneMissing", [](TestGltf& g) { g.document["scene"] = 1; }, "scene: expected"},
    {"positionNotANumber", [](TestGltf& g) { overwrite(g, 12, std::numeric_limits<float>::quiet_NaN()); }, "mesh 'sheet' to have a finite position at vertex 1"},
    {"positionInfinite", [](TestGltf& g) { overwrite(g, 24, std::numeric_limits<float>::infinity()); }, "vertex 2"},
    {"transformOverflows", [](TestGltf& g) { g.document["nodes"][0]["scale"] = {1e300, 1, 1}; }, "node 'leaf', vertex 1: expected coordinates of at most 1e+12 m"},
    {"sceneFarOut", [](TestGltf& g) { g.document["nodes"][0]["translation"] = {0, 1.1e12, 0}; }, "vertex 0: expected coordinates of at most 1e+12 m"},
    {"sceneTooWide", [](TestGltf& g) { g.document["nodes"][0]["scale"] = {1, 1.1e9, 1}; }, "expected a scene of at most 1e+09 m, found 1.1e+09"},
    {"allDegenerate", [](TestGltf& g) { g.document["nodes"][0]["scale"] = {0, 1, 1}; }, "zero area"},
    {"nodeIsItsOwnParent", [](TestGltf& g) { g.document["nodes"][0]["children"] = {0}; }, "nodes[0]: expected at most"},
    {"nodeHasTwoParents", [](TestGltf& g) { g.document["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}}; }, "nodes[0].children[1]"},
    {"nodeIsARootTwice", [](TestGltf& g) { g.document["scenes"][0]["nodes"] = {0, 0}; }, "scenes[0].nodes[1]: expected a node that is not listed before; node 0 is"},
    {"nodeIsARootAndAChild", [](TestGltf& g) {
         g.document["nodes"].push_back({{"children", {0}}});
         g.document["scenes"][0]["nodes"] = {1, 0};
     }, "scenes[0].nodes[1]: expected a node without a parent; node 0 has one"},
    {"childMissing", [](TestGltf& g) { g.document["nodes"][0]["children"] = {5}; }, "nodes[0].children[0]"},
    {"matrixTooShort", [](TestGltf& g) { g.document["nodes"][0]["matrix"] = {1, 2, 3}; }, "nodes[0].matrix: expected 16 numbers"},
    {"matrixProjects", [](TestGltf& g) { g.document["nodes"][0]["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}; }, "nodes[0].matrix: expected a last row of 0, 0, 0, 1"},
    {"rotationTooLong", [](TestGltf& g) { g.document["nodes"][0]["rotation"] = {1e200, 0, 0, 0}; }, "nodes[0].rotation: expected a quaternion"},
    {"rotationZero", [](TestGltf& g) { g.document["nodes"][0]["rotation"] = {0, 0, 0, 0}; }, "nodes[0].rotation"},
    {"translationOfText", [](TestGltf& g) { g.document["nodes"][0]["translation"] = {"a", 0, 0}; }, "nodes[0].translation[0]: expected a number"},
    {"albedoAboveOne", [](TestGltf& g) { pbr(g)["baseColorFactor"] = {0.5, 1.5, 0.5, 1}; }, "'paint'"},
    {"albedoNegative", [](TestGltf& g) { pbr(g)["baseColorFactor"] = {-0.1, 0.5, 0.5, 1}; }, "'paint'"},
    {"materialMissing", [](TestGltf& g) { primitive(g)["material"] = 1; }, "primitives[0].material"},
    {"textureMissing", [](TestGltf& g) { pbr(g)["baseColorTexture"] = {{"index", 0}}; }, "baseColorTexture.index"},
    {"imageDamaged", [](TestGltf& g) {
         g.document["images"] = {{{"bufferView", 0}}};
         g.document["textures"] = {{{"source", 0}}};
         pbr(g)["baseColorTexture"] = {{"index", 0}};
     }, "images[0]"},
    {"requiredCompression", [](TestGltf& g) { g.document["extensionsRequired"] = {"EXT_meshopt_compression"}; }, "EXT_meshopt_compression"},
    {"requiredUnknown", [](TestGltf& g) { g.document["extensionsRequired"] = {"KHR_lights_punctual", "ACME_shine"}; },
     "extensionsRequired[1]: expected KHR_lights_punctual or KHR_draco_mesh_compression, not ACME_shine"},
    {"dracoDamaged", [](TestGltf& g) {
         primitive(g)["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}};
     }, "meshes"},
    {"lightNegative", [](TestGltf& g) { light(g)["intensity"] = -1; }, "lights[0].intensity"},
    {"lightColorNegative", [](TestGltf& g) { light(g)["color"] = {1, -1, 1}; }, "light 'bulb'"},
    {"lightOverflows", [](TestGltf& g) { light(g)["intensity"] = 1e200; }, "light 'bulb'"},
    {"lightTypeUnknown", [](TestGltf& g) { light(g)["type"] = "area"; }, "lights[0].type"},
    {"lightMissing", [](TestGltf& g) { light(g); g.document["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 2; }, "KHR_lights_punctual.light"},
    {"coneInsideOut", [](TestGltf& g) { light(g)["spot"] = {{"innerConeAngle", 0.9}, {"outerConeAngle", 0.4}}; }, "light 'bulb': cone angles"},
    {"coneTooWide", [](TestGltf& g) { light(g)["spot"] = {{"outerConeAngle", 1.6}}; }, "light 'bulb': cone angles"},
    {"coneNegative", [](TestGltf& g) { light(g)["spot"] = {{"innerConeAngle", -0.1}}; }, "light 'bulb': cone angles"},
    {"spotMissing", [](TestGltf& g) { light(g).erase("spot"); }, "lights[0]: expected a member 'spot'"},
    {"lightSquashed", [](TestGltf& g) { light(g); g.document["nodes"][1]["scale"] = {1, 1, 0}; }, "nodes[1]"},
    {"lightFarOut", [](TestGltf& g) { light(g); g.document["nodes"][1]["translation"] = {1e200, 0, 0}; }, "light 'bulb': expected coordinates of at most 1e+12 m"},
    {"cameraFarOut", [](TestGltf& g) {
         camera(g);
         g.document["nodes"].push_back({{"name", "eye"}, {"camera", 0}, {"translation", {0, 1e200, 0}}});
         g.document["scenes"][0]["nodes"] = {0, 1};
     }, "camera 'eye': expected coordinates of at most 1e+12 m"},
    {"cameraTooWide", [](TestGltf& g) { camera(g)["yfov"] = 3.2; }, "perspective.yfov"},
    {"cameraEndless", [](TestGltf& g) { camera(g)["aspectRatio"] = 1e308; }, "perspective.aspectRatio: expected a positive number that fits a float"},
    {"cameraFlat", [](TestGltf& g) { camera(g)["aspectRatio"] = 0; }, "perspective.aspectRatio"},
};

class DamagedGltf : public GltfFiles, public ::testing::WithParamInterface<Damage> {};

TEST_P(DamagedGltf, isOneLineThatNamesFileAndPlace) {
    TestGltf gltf = triangleGltf();
    GetParam().apply(gltf);
    const std::string error = errorOf(gltf);
    EXPECT_EQ(error.rfind(file("test.glb"), 0), 0u) << "the line begins with the file: " << error;
    EXPECT_NE(error.find(GetParam().place), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

INSTANTIATE_TEST_SUITE_P(Damages, DamagedGltf, ::testing::ValuesIn(kDamages), [](const auto& info) { return info.param.name; });

class BadGltf : public GltfFiles {};

TEST_F(BadGltf, theUndamagedFileLoads) { EXPECT_EQ(errorOf(triangleGltf()), ""); }

TEST_F(BadGltf, aGlbCutAnywhereIsAnError) {
    const std::string whole = read(writeGltf(triangleGltf()));
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(errorOf(write("cut.glb", whole.substr(0, length))), "") << length << " of " << whole.size() << " bytes";
}

// Cuts the binary chunk and mends the two lengths of the container, so that only the byte ranges can tell.
TEST_F(BadGltf, aShorterBinaryChunkIsAnError) {
    const TestGltf whole = triangleGltf();
    for (std::size_t length = 0; length <= whole.binary.size() - 4; ++length) {
        TestGltf cut = whole;
        cut.binary.resize(length);
        EXPECT_NE(errorOf(cut).find("buffers[0]"), std::string::npos) << length;
    }
}

TEST_F(BadGltf, aGltfCutAnywhereIsAnError) {
    TestGltf gltf = triangleGltf();
    write("data.bin", std::string(gltf.binary.begin(), gltf.binary.end()));
    gltf.document["buffers"][0]["uri"] = "data.bin";
    const std::string whole = gltf.document.dump(1);
    for (std::size_t length = 0; length < whole.size(); ++length)
        EXPECT_NE(errorOf(write("cut.gltf", whole.substr(0, length))), "") << length << " of " << whole.size() << " bytes";
}

// Every byte of a GLB replaced in turn: whatever comes of it is a scene with triangles or an InputError.
TEST_F(BadGltf, aFlippedByteNeverCrashesNorEmptiesTheScene) {
    const std::string whole = read(writeGltf(triangleGltf()));
    int errors = 0;
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (const char flip : {char(0x01), char(0x10), char(0x80)}) {
            std::string damaged = whole;
            damaged[i] = char(damaged[i] ^ flip);
            const std::string path = write("flipped.glb", damaged);
            try {
                EXPECT_FALSE(loadScene(path).triangles.empty());
            } catch (const InputError&) {
                ++errors;
            }
        }
    EXPECT_GT(errors, int(whole.size())) << "most flips are found";
}

// Every value of the document replaced by one of another kind.
TEST_F(BadGltf, aValueOfAnotherKindNeverCrashes) {
    const TestGltf whole = triangleGltf();
    const json replacements[] = {nullptr, -1, 0, 1e30, 99999999999ull, "text", json::array(), json::object(), true};
    const json flat = whole.document.flatten();
    std::size_t errors = 0, tried = 0;
    for (const auto& item : flat.items())
        for (const json& replacement : replacements) {
            TestGltf damaged = whole;
            damaged.document[json::json_pointer(item.key())] = replacement;
            ++tried;
            const std::string path = writeGltf(damaged);
            try {
                EXPECT_FALSE(loadScene(path).triangles.empty());
            } catch (const InputError&) {
                ++errors;
            }
        }
    EXPECT_GT(errors, tried / 2);
}

TEST_F(BadGltf, aKeyTwiceIsNamed) {
    const std::string text = R"({"asset": {"version": "2.0"}, "nodes": [{"name": "a"}, {"name": "b", "mesh": 0, "name": "c"}]})";
    EXPECT_EQ(errorOf(write("twice.gltf", text)), file("twice.gltf") + ": expected 'name' once in its object");
}

TEST_F(BadGltf, aMissingFileIsNamed) { EXPECT_EQ(errorOf(file("nowhere.glb")), file("nowhere.glb") + ": no such file"); }

TEST_F(BadGltf, aFolderIsNoFile) {
    std::filesystem::create_directory(file("hall.glb"));
    EXPECT_EQ(errorOf(file("hall.glb")), file("hall.glb") + ": expected a file, not a folder");
}

TEST_F(BadGltf, anotherExtensionIsAnErrorThatListsWhatIsExpected) {
    const std::string error = errorOf(write("scene.fbx", "x"));
    for (const char* expected : {"scene.fbx", ".glb", ".gltf", ".obj", "cornell"}) EXPECT_NE(error.find(expected), std::string::npos) << error;
}

}  // namespace
}  // namespace clv
