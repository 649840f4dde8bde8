#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
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

TEST_F(ObjImport, readsCornersWithIndicesLeftOut) {
    EXPECT_EQ(loadScene(write("square.obj", kSquare + "vn 0 0 1\nf 1/ 2// 3//1\nfo 1//-1 3 4\n")).triangles.size(), 2u);
}

TEST_F(ObjImport, readsFacesOfThousandsOfCorners) {
    constexpr int kCorners = 3000;
    std::string text, face = "f";
    for (int i = 0; i < kCorners; ++i) {
        const double angle = glm::two_pi<double>() * i / kCorners;
        text += fmt::format("v {} {} 0\n", std::cos(angle), std::sin(angle)), face += fmt::format(" {}", i + 1);
    }
    const Scene scene = loadScene(write("disc.obj", text + face + "\n"));
    glm::dvec3 area(0.0);
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) area += areaVector(scene, t);
    EXPECT_NEAR(area.z, glm::pi<double>(), 1e-4);
}

TEST_F(ObjImport, refusesFacesOfCornersWithoutEnd) {
    std::string face = "f";
    for (int i = 0; i <= 16384; ++i) face += fmt::format(" {}", i % 4 + 1);
    const std::string path = write("disc.obj", kSquare + face + "\n");
    EXPECT_EQ(errorOf(path), path + ":5: expected a face with at most 16384 corners");
}

TEST_F(ObjImport, saysWhatItIgnores) {
    const Scene scene = loadScene(write("square.obj", kSquare + "f 1 2 3\nl 1 2\np 1\ncurv 0 1 1 2\ns off\n"));
    EXPECT_EQ(scene.ignored, (std::vector<std::string>{"points and lines", "free-form curves and surfaces"}));
}

TEST_F(ObjImport, facesInNoGroupHaveANodeOfTheirOwn) {
    const Scene scene = loadScene(write("nodes.obj", kSquare + "f 1 2 3\no box\nf 1 3 4\ng\nf 2 3 4\no box\ng default\nf 1 2 4\n"));
    EXPECT_EQ(scene.nodeNames, (std::vector<std::string>{"default", "box"}));
    EXPECT_EQ(scene.nodeOf, (std::vector<std::uint32_t>{0, 1, 0, 0}));
}

TEST_F(ObjImport, anObjectOrGroupGoesOnWhereItsNameComesAgain) {
    for (const std::string keyword : {"o", "g"}) {
        const auto begin = [&](const char* name) { return keyword + " " + name + "\n"; };
        const Scene scene = loadScene(write("nodes.obj", kSquare + begin("left wing") + "f 1 2 3\n" + begin("left tail") + "f 1 3 4\n" +
                                                             begin("none") + begin("left wing") + "f 2 3 4\n"));
        EXPECT_EQ(scene.nodeNames, (std::vector<std::string>{"left wing", "left tail"})) << keyword;
        EXPECT_EQ(scene.nodeOf, (std::vector<std::uint32_t>{0, 1, 0})) << keyword;
    }
}

TEST_F(ObjImport, countsNegativeIndicesBackwards) {
    EXPECT_EQ(loadScene(write("square.obj", kSquare + "f -4 -3 -2\n")).triangles.size(), 1u);
}

TEST_F(ObjImport, readsFacesThatGoOnInTheNextLine) {
    EXPECT_EQ(loadScene(write("square.obj", kSquare + "f 1 2 \\\n3 4\n")).triangles.size(), 2u);
    EXPECT_EQ(loadScene(write("square.obj", kSquare + "f 1 2 3 4 \\")).triangles.size(), 2u);
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

// The albedo of a square's face with the material `half` of half.mtl, as this text says it.
class ObjMaterial : public GltfFiles {
protected:
    glm::vec3 albedoOf(const std::string& obj, const std::string& mtl = "newmtl half\nKd 0.5 0.5 0.5\n") const {
        write("half.mtl", mtl);
        return loadScene(write("square.obj", obj)).albedo(0, 0.3f, 0.3f);
    }
    const glm::vec3 half_{0.5f};
};

TEST_F(ObjMaterial, librariesMayStandInOneLineAndCommentsEndWithTheirs) {
    write("first.mtl", "newmtl dark\nKd 0 0 0\n");
    EXPECT_EQ(albedoOf("# from C:\\models\\\nmtllib first.mtl half.mtl\n" + kSquare + "usemtl half\nf 1 2 3\n"), half_);
    EXPECT_EQ(albedoOf("mtllib half.mtl\n" + kSquare + "usemtl half\nf 1 2 3\n", "newmtl unused\nmap_Kd missing.png\nnewmtl half\nKd 0.5 0.5 0.5\n"), half_);
}

TEST_F(ObjMaterial, isFoundBehindAByteOrderMarkAndBlanksAndWithAnyLineEnds) {
    const std::string whole = "mtllib half.mtl\n" + kSquare + "usemtl half\nf 1 2 3\n";
    const auto with = [](std::string text, const std::string& end, const std::string& indent = "") {
        for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size() + indent.size()) text.replace(at, 1, end + indent);
        return text;
    };
    EXPECT_EQ(albedoOf(whole), half_);
    EXPECT_EQ(albedoOf("\xef\xbb\xbf" + whole, "\xef\xbb\xbfnewmtl half\nKd 0.5 0.5 0.5\n"), half_);
    EXPECT_EQ(albedoOf(with(whole, " \t\n"), "newmtl half \nKd 0.5 0.5 0.5 \n"), half_);
    EXPECT_EQ(albedoOf(with(whole, "\n", "  ")), half_);
    EXPECT_EQ(albedoOf(with(whole, "\r\n")), half_);
    EXPECT_EQ(albedoOf(with(whole, "\r")), half_);
    EXPECT_EQ(albedoOf(whole, "newmtl half\n  Kd 0.5 0.5 0.5 # grey\n"), half_);
    EXPECT_EQ(albedoOf("mtllib half.mtl\n  v 0 0 0 # first\n\tv 1 0 0#second\nv 1 1 0\nusemtl half\n f 1 2 3 # face\n"), half_);
    EXPECT_EQ(albedoOf("mtllib half.mtl\nv 0 0 0 # first\nv 1 0 0\nv 1 1 0\nusemtl half\nf 1 2 3 # face 4\n"), half_);
}

TEST_F(ObjMaterial, numbersMayBeginWithTheirPoint) {
    EXPECT_EQ(albedoOf("mtllib half.mtl\n" + kSquare + "usemtl half\nf 1 2 3\n", "newmtl half\nKd .5 0.5 .5\n"), half_);
    const Scene scene = loadScene(write("points.obj", "v .5 -.25 0\nv 1 0 0\nv 1 +.75 .125\nf 1 2 3\n"));
    ASSERT_EQ(scene.positions.size(), 3u);
    EXPECT_EQ(scene.positions[0], glm::vec3(0.5f, -0.25f, 0.0f));
    EXPECT_EQ(scene.positions[2], glm::vec3(1.0f, 0.75f, 0.125f));
}

TEST_F(ObjMaterial, aTriangleFarFromSmallOnesIsWarnedOf) {
    const std::string far = "v 20000 0 0\nv 20001 0 0\nv 20001 1 0\n", last = "f 5 6 7\n", square = "mtllib half.mtl\n" + kSquare + "usemtl half\n";
    write("half.mtl", "newmtl half\nKd 0.5 0.5 0.5\n");
    EXPECT_TRUE(loadScene(write("square.obj", square + "f 1 2 3\nf 1 3 4\n")).warnings.empty());
    EXPECT_EQ(loadScene(write("square.obj", square + far + "f 1 2 3\nf 1 3 4\n" + last)).warnings,
              std::vector<std::string>{file("square.obj") + ": half of its triangles are smaller than 1 m, but it is 2e+04 m wide: light within 0.02 m of surfaces "
                                                            "is not computed right; leave out what lies far away"});
}

TEST_F(ObjMaterial, triangleTooSmallForFloatsIsWarnedOf) {
    const std::string square = "mtllib half.mtl\n" + kSquare + "v 2 0 0\nv 1e-12 0 0\nv 0 1e-12 0\nusemtl half\nf 1 2 3\nf 1 3 4\n";
    write("half.mtl", "newmtl half\nKd 0.5 0.5 0.5\n");
    EXPECT_TRUE(loadScene(write("square.obj", square + "f 1 1 2\nf 1 2 5\n")).warnings.empty()) << "they have none in double precision, either";
    const Scene scene = loadScene(write("square.obj", square + "f 1 2 5\no speck\nf 1 6 7\n"));
    EXPECT_EQ(scene.droppedTriangles, 2u);
    EXPECT_EQ(scene.warnings, std::vector<std::string>{file("square.obj") + ": 1 of its triangles have no area in single precision and are left out, the first one of node 'speck'"});
}

TEST_F(ObjMaterial, thatNoLibraryHasIsAWarningWithItsLine) {
    write("half.mtl", "newmtl half\nKd 0.5 0.5 0.5\n");
    const Scene scene = loadScene(write("square.obj", "mtllib half.mtl\n" + kSquare + "usemtl nope\nf 1 2 3\nusemtl half\nf 1 3 4\nusemtl nope\nf 1 2 4\n"));
    EXPECT_EQ(scene.warnings, std::vector<std::string>{file("square.obj") + ":6: no library has the material 'nope': its faces have an albedo of 0.8"});
    EXPECT_EQ(scene.albedo(0, 0.3f, 0.3f), glm::vec3(0.8f));
}

TEST_F(ObjMaterial, mayHaveAnyName) {
    for (const std::string name : {"DefaultMaterial", "default", "0", "-1", "a b # c", "\xc3\xa4"})
        EXPECT_EQ(albedoOf("mtllib half.mtl\n" + kSquare + "usemtl " + name + "\nf 1 2 3\n", "newmtl " + name + "\nKd 0.5 0.5 0.5\nnewmtl last\nKd 0 0 0\n"), half_) << name;
}

TEST_F(ObjMaterial, holdsFromItsLineOnWhateverElseLiesBetween) {
    write("half.mtl", "newmtl half\nKd 0.5 0.5 0.5\nnewmtl dark\nKd 0.1 0.1 0.1\n");
    write("more.mtl", "newmtl more\nKd 0.3 0.3 0.3\n");
    const Scene scene = loadScene(write("square.obj", "mtllib half.mtl\n" + kSquare + "f 1 2 3\nusemtl half\nf 1 2 3\no box\nf 1 2 3\nmtllib more.mtl\nf 1 2 3\n"
                                        "g side\nusemtl later\nusemtl dark\nf 1 2 3\nusemtl more\nf 1 2 3\n"));
    std::vector<float> albedos;
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) albedos.push_back(scene.albedo(t, 0.3f, 0.3f).x);
    EXPECT_EQ(albedos, (std::vector<float>{0.8f, 0.5f, 0.5f, 0.5f, 0.1f, 0.3f}));
    EXPECT_EQ(scene.nodeNames, (std::vector<std::string>{"default", "box", "side"}));
}

TEST_F(ObjMaterial, thatIsNotSaidIsAWarningWithItsLine) {
    write("half.mtl", "newmtl half\nNs 10\n\nnewmtl unused\n");
    const Scene scene = loadScene(write("square.obj", "mtllib half.mtl\n" + kSquare + "f 1 2 3\nf 1 3 4\nusemtl half\nf 1 2 3\n"));
    EXPECT_EQ(scene.warnings, (std::vector<std::string>{file("square.obj") + ":6: no usemtl above: faces without a material have an albedo of 0.8",
                                                        file("half.mtl") + ":1: no Kd or map_Kd: the material 'half' has an albedo of 0.8"}));
    for (std::uint32_t t = 0; t < 3; ++t) EXPECT_EQ(scene.albedo(t, 0.3f, 0.3f), glm::vec3(0.8f));
}

TEST_F(ObjMaterial, thatIsDefinedAgainIsAWarningWithItsLine) {
    write("half.mtl", "newmtl half\nKd 0.1 0.1 0.1\nnewmtl half\nKd 0.5 0.5 0.5\n");
    const Scene scene = loadScene(write("square.obj", "mtllib half.mtl\nmtllib half.mtl\n" + kSquare + "usemtl half\nf 1 2 3\n"));
    EXPECT_EQ(scene.warnings, std::vector<std::string>{file("half.mtl") + ":3: the material 'half' is defined above, too: what is said last counts"});
    EXPECT_EQ(scene.albedo(0, 0.3f, 0.3f), half_);
}

TEST_F(ObjMaterial, withAPictureAloneHasThePicturesAlbedo) {
    const std::vector<std::uint8_t> png = encodePng({"", 1, 1, {{0.5f, 0.5f, 0.5f}}});
    write("my map.png", std::string(png.begin(), png.end()));
    const glm::vec3 albedo = albedoOf("mtllib half.mtl\n" + kSquare + "vt 0 0\nusemtl half\nf 1/1 2/-1 3/1\n", "newmtl half\nmap_Kd my map.png\n");
    EXPECT_LT(glm::distance(albedo, half_), 3e-3f);
}

struct Damage {
    const char* name;
    std::string text;
    const char* place;
};

class DamagedObj : public GltfFiles, public ::testing::WithParamInterface<Damage> {};

TEST_P(DamagedObj, isOneLineThatNamesFileAndPlace) {
    write("bright.mtl", "newmtl bright\nKd 0.5 2 0.5\n");
    write("grey.mtl", "newmtl grey\nKd 0.5\n");
    write("early.mtl", "# first\nKd 0.5 0.5 0.5\nnewmtl early\n");
    write("nameless.mtl", "newmtl\nKd 0.5 0.5 0.5\n");
    write("moved.mtl", "newmtl moved\nmap_Kd -o 0.5 0 0 map.png\n");
    write("tiles.mtl", "newmtl tiles\nmap_Kd gone.png\n");
    const std::string error = errorOf(write("damaged.obj", GetParam().text));
    EXPECT_EQ(error.rfind(file(""), 0), 0u) << error;
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
    {"vertexHexadecimal", kSquare + "v 0x1p-1 0 0\nf 1 2 3\n", ":5: expected a vertex of 3, 4 or 6 finite numbers"},
    {"vertexOfTooManyDigits", kSquare + "v 123456789012345678901234 0 0\nf 1 2 5\n", ":5: expected a vertex of 3, 4 or 6 finite numbers"},
    {"vertexOfFiveNumbers", kSquare + "v 0 0 0 1 1\nf 1 2 5\n", ":5: expected a vertex of 3, 4 or 6 finite numbers"},
    {"vertexWithoutWeight", kSquare + "v 0 0 0 0\nf 1 2 5\n", ":5: expected a weight"},
    {"textureCoordinateHexadecimal", kSquare + "vt 0x1p-1 0\nf 1 2 3\n", ":5: expected texture coordinates"},
    {"controlCharacter", kSquare + "v 0 0\f0\nf 1 2 3\n", ":5: expected text"},
    {"albedoOfOneNumber", "mtllib grey.mtl\n" + kSquare + "usemtl grey\nf 1 2 3\n", "grey.mtl:2: expected an albedo of 3 numbers"},
    {"libraryNameTooLong", "mtllib " + std::string(300, 'm') + "\n" + kSquare + "f 1 2 3\n", ":1: expected a material library"},
    {"cornerBeyondVertices", kSquare + "f 1 2 5\n", ":5: expected corners among the 4 vertices"},
    {"cornerZero", kSquare + "f 0 1 2\n", ":5: expected corners"},
    {"cornerBeforeTheFirst", kSquare + "f -5 1 2\n", ":5: expected corners"},
    {"cornerOfText", kSquare + "f 1 2 x\n", ":5: expected corners"},
    {"cornerOnAnotherLine", kSquare + "f 1 \\\n2 9\n", ":5: expected corners"},
    {"faceOfTwoCorners", kSquare + "f 1 2\n", ":5: expected a face"},
    {"allDegenerate", kSquare + "f 1 1 2\n", "zero area"},
    {"libraryMissing", "mtllib gone.mtl\n" + kSquare + "f 1 2 3\n", ":1: expected a material library 'gone.mtl'"},
    {"albedoAboveOne", "mtllib bright.mtl\n" + kSquare + "usemtl bright\nf 1 2 3\n", "bright.mtl:2: expected an albedo of 3 numbers from 0 to 1, not 2"},
    {"albedoOfNoMaterial", "mtllib early.mtl\n" + kSquare + "f 1 2 3\n", "early.mtl:2: expected a newmtl above"},
    {"materialWithoutAName", "mtllib nameless.mtl\n" + kSquare + "f 1 2 3\n", "nameless.mtl:1: expected the name of a material"},
    {"useOfNoName", kSquare + "usemtl \nf 1 2 3\n", ":5: expected the name of a material"},
    {"libraryWithoutAName", "mtllib\n" + kSquare + "f 1 2 3\n", ":1: expected a material library"},
    {"pictureWithOptions", "mtllib moved.mtl\n" + kSquare + "usemtl moved\nf 1 2 3\n", "moved.mtl:2: expected the name of a picture without options, not '-o"},
    {"textureCoordinateMissing", kSquare + "vt 0 0\nvt 1 0\nf 1/1 2/2 3/3\n", ":7: expected corners among the 2 texture coordinates above, not '3/3'"},
    {"textureCoordinateBeforeTheFirst", kSquare + "vt 0 0\nvt 1 0\nf 1/1 2/2 3/-3\n", ":7: expected corners among the 2 texture coordinates above, not '3/-3'"},
    {"textureCoordinateZero", kSquare + "vt 0 0\nf 1/1 2/1 3/0\n", ":6: expected corners among"},
    {"textureCoordinatesAtSomeCorners", kSquare + "vt 0 0\nf 1/1 2 3/1\n", ":6: expected texture coordinates at all corners, or at none"},
    {"normalMissing", kSquare + "vn 0 0 1\nf 1//1 2//1 3//2\n", ":6: expected corners among the 1 normals above, not '3//2'"},
    {"cornerWithTextAfterIt", kSquare + "f 1/x 2 3\n", ":5: expected corners"},
    {"cornerOfFourIndices", kSquare + "vt 0 0\nvn 0 0 1\nf 1/1/1/1 2 3\n", ":7: expected corners such as"},
    {"outlineOfNoVertex", kSquare + "fo 1 2 99\n", ":5: expected corners among the 4 vertices"},

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
