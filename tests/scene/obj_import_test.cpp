#include <gtest/gtest.h>

#include "bindings/scene/texture_codec.h"
#include "scene/gltf_files.h"

namespace clv {
namespace obj_import_test {

class ObjImport : public GltfFiles {};

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(ObjImport, splitsAQuadIntoTrianglesThatFaceTheSameWay) {
    const Scene scene = loadScene(write("square.obj", kSquare + "f 1 2 3 4\n"));
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(areaVector(scene, 0) + areaVector(scene, 1), glm::dvec3(0, 0, 1));
    EXPECT_EQ(scene.name, "square");
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_EQ(scene.albedo(0, 0.2f, 0.2f), Material().albedo);
}

TEST_F(ObjImport, countsNegativeIndicesBackwards) {
    EXPECT_EQ(loadScene(write("square.obj", kSquare + "f -4 -3 -2\n")).triangles.size(), 1u);
}

TEST_F(ObjImport, readsFacesThatGoOnInTheNextLine) {
    EXPECT_EQ(loadScene(write("square.obj", kSquare + "f 1 2 \\\n3 4\n")).triangles.size(), 2u);
}

TEST_F(ObjImport, takesKdAsLinearAlbedoAndReadsItsTexture) {
    const std::vector<std::uint8_t> png = encodePng({"", 1, 2, {{1, 0, 0}, {0, 0, 1}}});
    write("map.png", std::string(png.begin(), png.end()));
    write("square.mtl", "newmtl plain\nKd 0.25 0.5 0.75\nnewmtl tiles\nKd 0.5 0.5 0.5\nmap_Kd map.png\n");
    const Scene scene = loadScene(write("square.obj", "mtllib square.mtl\n" + kSquare + "vt 0 0\nvt 1 0\nvt 1 1\n"
                                        "usemtl plain\nf 1 2 3\nusemtl tiles\nf 1/1 2/2 3/3\n"));
    ASSERT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.albedo(0, 0.3f, 0.3f), glm::vec3(0.25f, 0.5f, 0.75f));
    // v = 0.25 lies in the lower half of the picture, whose rows run downwards.
    EXPECT_LT(glm::distance(scene.albedo(1, 0.25f, 0.25f), glm::vec3(0, 0, 0.5f)), 1e-4f);
    EXPECT_LT(glm::distance(scene.albedo(1, 0.0f, 0.75f), glm::vec3(0.5f, 0, 0)), 1e-4f);
}

struct Damage {
    const char* name;
    std::string text;
    const char* place;
};

class DamagedObj : public GltfFiles, public ::testing::WithParamInterface<Damage> {};

TEST_P(DamagedObj, isOneLineThatNamesFileAndPlace) {
    write("bright.mtl", "newmtl bright\nKd 0.5 2 0.5\n");
    write("tiles.mtl", "newmtl tiles\nmap_Kd gone.png\n");
    const std::string error = errorOf(write("damaged.obj", GetParam().text));
    EXPECT_EQ(error.rfind(file("damaged.obj"), 0), 0u) << error;
    EXPECT_NE(error.find(GetParam().place), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
}

const Damage kDamages[] = {
    {"empty", "", "no faces"},
    {"verticesOnly", kSquare, "no faces"},
    {"vertexNotANumber", "v 0 0 nan\n" + kSquare + "f 1 2 3\n", ":1: expected a vertex"},
    {"vertexInfinite", kSquare + "v 0 1e999 0\nf 1 2 3\n", ":5: expected a vertex"},
    {"vertexFarOut", kSquare + "v 0 1e30 0\nf 1 2 5\n", "vertex 2: expected coordinates of at most 1e+12 m"},
    {"vertexOfTwoNumbers", "v 0 0\n" + kSquare + "f 1 2 3\n", ":1: expected a vertex"},
    {"vertexOfText", kSquare + "v a b c\nf 1 2 3\n", ":5: expected a vertex"},
    {"cornerBeyondVertices", kSquare + "f 1 2 5\n", ":5: expected corners among the 4 vertices"},
    {"cornerZero", kSquare + "f 0 1 2\n", ":5: expected corners"},
    {"cornerBeforeTheFirst", kSquare + "f -5 1 2\n", ":5: expected corners"},
    {"cornerOfText", kSquare + "f 1 2 x\n", ":5: expected corners"},
    {"cornerOnAnotherLine", kSquare + "f 1 \\\n2 9\n", ":5: expected corners"},
    {"faceOfTwoCorners", kSquare + "f 1 2\n", ":5: expected a face"},
    {"allDegenerate", kSquare + "f 1 1 2\n", "zero area"},
    {"libraryMissing", "mtllib gone.mtl\n" + kSquare + "f 1 2 3\n", ":1: expected a material library 'gone.mtl'"},
    {"albedoAboveOne", "mtllib bright.mtl\n" + kSquare + "usemtl bright\nf 1 2 3\n", "'bright'"},
    {"textureMissing", "mtllib tiles.mtl\n" + kSquare + "usemtl tiles\nf 1 2 3\n", "gone.png"},
};

INSTANTIATE_TEST_SUITE_P(Damages, DamagedObj, ::testing::ValuesIn(kDamages), [](const auto& info) { return info.param.name; });

TEST_F(ObjImport, aFileCutAnywhereIsAnErrorOrStillHasTriangles) {
    const std::string whole = kSquare + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n";
    const std::size_t firstWholeFace = whole.find("\nf 1//1 3") - 2;  // the shortest cut that leaves three corners
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::string path = write("cut.obj", whole.substr(0, length));
        if (length < firstWholeFace - 1) {
            EXPECT_NE(errorOf(path), "") << length;
            continue;
        }
        try {
            EXPECT_FALSE(loadScene(path).triangles.empty()) << length;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("cut.obj"), std::string::npos);
        }
    }
}

}  // namespace obj_import_test
}  // namespace clv
