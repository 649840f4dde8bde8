#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "scene/gltf_files.h"

namespace clv {
namespace {

// Twice around: 1 inside a closed surface whose faces look outwards, 0 outside, -1 inside one whose faces look inwards.
// Sum of signed solid angles (van Oosterom and Strackee 1983).
double windingNumber(const Scene& scene, const glm::dvec3& point, const std::string& nodePrefix) {
    double solidAngle = 0.0;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        if (scene.nodeNames[scene.nodeOf[t]].rfind(nodePrefix, 0) != 0) continue;
        const glm::dvec3 a = glm::dvec3(corner(scene, t, 0)) - point, b = glm::dvec3(corner(scene, t, 1)) - point,
                         c = glm::dvec3(corner(scene, t, 2)) - point;
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
        solidAngle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), denominator);
    }
    return solidAngle / (4.0 * glm::pi<double>());
}

// Edges, by the positions of their ends, that are not met once in each direction.
std::size_t openEdges(const Scene& scene, const std::string& nodePrefix) {
    using Key = std::array<float, 6>;
    std::map<Key, int> balance;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        if (scene.nodeNames[scene.nodeOf[t]].rfind(nodePrefix, 0) != 0) continue;
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 p = corner(scene, t, i), q = corner(scene, t, (i + 1) % 3);
            ++balance[{p.x, p.y, p.z, q.x, q.y, q.z}];
            --balance[{q.x, q.y, q.z, p.x, p.y, p.z}];
        }
    }
    std::size_t open = 0;
    for (const auto& [edge, count] : balance) open += count != 0;
    return open;
}

double totalArea(const Scene& scene) {
    double sum = 0.0;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) sum += glm::length(areaVector(scene, t));
    return sum;
}

class EveryBuiltinScene : public ::testing::TestWithParam<BuiltinScene> {};

TEST_P(EveryBuiltinScene, hasLightsCamerasAndCompleteTriangles) {
    const Scene scene = loadScene(GetParam().name);
    EXPECT_EQ(scene.name, GetParam().name);
    EXPECT_FALSE(GetParam().description.empty());
    EXPECT_FALSE(scene.lights.empty());
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_EQ(scene.droppedTriangles, 0u);
    EXPECT_TRUE(scene.ignored.empty());
    EXPECT_EQ(scene.anchor, glm::dvec3(0.0));
    ASSERT_EQ(scene.materialOf.size(), scene.triangles.size());
    ASSERT_EQ(scene.nodeOf.size(), scene.triangles.size());
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        EXPECT_LT(scene.materialOf[t], scene.materials.size());
        EXPECT_LT(scene.nodeOf[t], scene.nodeNames.size());
        for (int i = 0; i < 3; ++i) {
            const glm::vec3 p = corner(scene, t, i);
            EXPECT_TRUE(glm::all(glm::lessThanEqual(scene.bounds.lo, p)) && glm::all(glm::lessThanEqual(p, scene.bounds.hi)));
        }
    }
}

TEST_P(EveryBuiltinScene, hasUnitDirectionsAndPhysicalMaterials) {
    const Scene scene = makeBuiltinScene(GetParam().name);
    for (const Camera& camera : scene.cameras) {
        EXPECT_NEAR(glm::length(camera.forward), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::length(camera.up), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0.0f, 1e-5f);
    }
    for (const NamedLight& named : scene.lights) {
        EXPECT_NEAR(glm::length(named.light.direction), 1.0f, 1e-5f);
        EXPECT_TRUE(glm::all(glm::greaterThan(named.light.intensity, glm::vec3(0.0f)))) << named.name;
    }
    for (const Material& material : scene.materials) {
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(material.albedo, glm::vec3(0.0f)))) << material.name;
        EXPECT_TRUE(glm::all(glm::lessThanEqual(material.albedo, glm::vec3(1.0f)))) << material.name;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, EveryBuiltinScene, ::testing::ValuesIn(builtinScenes()),
                         [](const auto& info) { return info.param.name; });

TEST(BuiltinScenes, anUnknownNameIsAnErrorThatListsTheNames) {
    try {
        makeBuiltinScene("atrum");
        FAIL() << "expected an InputError";
    } catch (const InputError& error) {
        for (const BuiltinScene& scene : builtinScenes()) EXPECT_NE(std::string(error.what()).find(scene.name), std::string::npos);
    }
}

TEST(BuiltinScenes, theAtriumIsTheDefaultAndComesFirst) { EXPECT_EQ(builtinScenes().front().name, "atrium"); }

TEST(Cornell, hasTheMeasuredDimensions) {
    const Scene scene = makeBuiltinScene("cornell");
    EXPECT_EQ(scene.bounds.lo, glm::vec3(0.0f));
    EXPECT_NEAR(scene.bounds.hi.x, 0.5560f, 1e-6f);
    EXPECT_NEAR(scene.bounds.hi.y, 0.5488f, 1e-6f);
    EXPECT_NEAR(scene.bounds.hi.z, 0.5592f, 1e-6f);
    EXPECT_EQ(scene.triangles.size(), 2u * (5 + 5 + 5));
}

TEST(Cornell, wallsFaceTheInsideAndBlocksFaceAway) {
    const Scene scene = makeBuiltinScene("cornell");
    std::map<std::uint32_t, std::pair<glm::vec3, int>> sums;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t)
        for (int i = 0; i < 3; ++i) {
            sums[scene.nodeOf[t]].first += corner(scene, t, i);
            sums[scene.nodeOf[t]].second += 1;
        }
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        const auto& [sum, count] = sums[scene.nodeOf[t]];
        const glm::vec3 towardsCentre = sum / float(count) - corner(scene, t, 0);
        const bool facesCentre = glm::dot(areaVector(scene, t), glm::dvec3(towardsCentre)) > 0.0;
        EXPECT_EQ(facesCentre, scene.nodeNames[scene.nodeOf[t]] == "walls") << "triangle " << t;
    }
}

TEST(Cornell, theRedWallIsOnTheLeftOfTheFrontCamera) {
    const Scene scene = makeBuiltinScene("cornell");
    const Camera& camera = scene.cameras.front();
    const glm::vec3 left = glm::cross(camera.up, camera.forward);
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        const std::string& material = scene.materials[scene.materialOf[t]].name;
        const float side = glm::dot(corner(scene, t, 0) - camera.position, left);
        if (material == "white") continue;
        EXPECT_GT(material == "red" ? side : -side, 0.2f) << material;
    }
}

TEST(TwoRooms, theHouseIsClosedAndSolidOnlyInsideItsWalls) {
    const Scene scene = makeBuiltinScene("two_rooms");
    EXPECT_EQ(openEdges(scene, "house"), 0u);
    const glm::dvec3 partition(5.217 + 0.025, 1.3, -1.1);
    EXPECT_NEAR(windingNumber(scene, partition, "house"), 1.0, 1e-6);
    EXPECT_NEAR(windingNumber(scene, partition - glm::dvec3(0.026, 0, 0), "house"), 0.0, 1e-6);
    EXPECT_NEAR(windingNumber(scene, partition + glm::dvec3(0.026, 0, 0), "house"), 0.0, 1e-6);
    EXPECT_NEAR(windingNumber(scene, {-2.0, 1.0, 0.0}, "house"), 0.0, 1e-6);
}

TEST(TwoRooms, theDoorIsASolidThatTouchesNothing) {
    const Scene scene = makeBuiltinScene("two_rooms");
    EXPECT_EQ(openEdges(scene, "door"), 0u);
    glm::dvec3 middle(0.0);
    int corners = 0;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        if (scene.nodeNames[scene.nodeOf[t]] != "door") continue;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 p = corner(scene, t, i);
            EXPECT_NEAR(windingNumber(scene, p, "house"), 0.0, 1e-4) << "a corner of the door lies in a wall";
            middle += p;
            ++corners;
        }
    }
    EXPECT_NEAR(windingNumber(scene, middle / double(corners), "door"), 1.0, 1e-6);
}

TEST(TwoRooms, theLampHangsInOneRoomOnly) {
    const Scene scene = makeBuiltinScene("two_rooms");
    ASSERT_EQ(scene.lights.size(), 1u);
    EXPECT_LT(scene.lights[0].light.position.x, 5.2f);
    EXPECT_NEAR(windingNumber(scene, scene.lights[0].light.position, "house"), 0.0, 1e-6);
}

TEST(Corridor, isClosedWithTheLampInside) {
    const Scene scene = makeBuiltinScene("corridor");
    EXPECT_EQ(openEdges(scene, ""), 0u);
    const glm::dvec3 lamp = scene.lights[0].light.position;
    EXPECT_NEAR(windingNumber(scene, lamp, ""), 0.0, 1e-6);
    EXPECT_NEAR(windingNumber(scene, glm::dvec3(lamp.x, -0.06, lamp.z), ""), 1.0, 1e-6) << "the floor is solid";
}

TEST(FurnaceBox, isAClosedSurfaceSeenFromInsideWithOneAlbedo) {
    const Scene scene = makeBuiltinScene("furnace_box");
    EXPECT_EQ(openEdges(scene, ""), 0u);
    EXPECT_NEAR(windingNumber(scene, scene.lights[0].light.position, ""), -1.0, 1e-6);
    EXPECT_NEAR(windingNumber(scene, {-0.21, -0.18, 0.13}, ""), 0.0, 1e-6) << "inside the plank";
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].albedo, glm::vec3(0.5f));
}

TEST(WhiteSphere, hasTheAreaOfTheSphereAndFacesInside) {
    const Scene scene = makeBuiltinScene("white_sphere");
    EXPECT_NEAR(totalArea(scene), 4.0 * glm::pi<double>(), 1e-5);
    EXPECT_EQ(openEdges(scene, ""), 0u);
    EXPECT_NEAR(windingNumber(scene, scene.lights[0].light.position, ""), -1.0, 1e-6);
    for (const glm::vec3& position : scene.positions) EXPECT_NEAR(glm::length(position), 1.0f, 1e-3f);
}

TEST(WhiteSphere, receivesTheWholeFluxOfItsLamp) {
    const Scene scene = makeBuiltinScene("white_sphere");
    const ClvLight& lamp = scene.lights[0].light;
    double flux = 0.0;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        const glm::dvec3 centre = glm::dvec3(corner(scene, t, 0) + corner(scene, t, 1) + corner(scene, t, 2)) / 3.0;
        const glm::dvec3 towardsLamp = glm::dvec3(lamp.position) - centre;
        flux += lamp.intensity.r * glm::dot(areaVector(scene, t), towardsLamp) / std::pow(glm::length(towardsLamp), 3.0);
    }
    const double expected = 4.0 * glm::pi<double>() * lamp.intensity.r;
    EXPECT_NEAR(flux, expected, 1e-3 * expected);
}

TEST(Atrium, isAboutThirtyByThirteenMetresWithAFewThousandTriangles) {
    const Scene scene = makeBuiltinScene("atrium");
    EXPECT_NEAR(scene.bounds.extent().x, 30.0f, 1.0f);
    EXPECT_NEAR(scene.bounds.extent().y, 13.0f, 1.0f);
    EXPECT_NEAR(scene.bounds.extent().z, 13.0f, 1.0f);
    EXPECT_GT(scene.triangles.size(), 2000u);
    EXPECT_LT(scene.triangles.size(), 10000u);
    EXPECT_EQ(openEdges(scene, "masonry"), 0u);
}

TEST(Atrium, camerasStandInOpenSpace) {
    const Scene scene = makeBuiltinScene("atrium");
    EXPECT_NEAR(windingNumber(scene, {0.0, -0.1, 0.0}, "masonry"), 1.0, 1e-6) << "the ground is solid";
    for (const Camera& camera : scene.cameras)
        EXPECT_NEAR(windingNumber(scene, camera.position, "masonry"), 0.0, 1e-6) << camera.name;
}

// Columns and arches have no face where they rest on other stone, so that their winding numbers fall a little short of 1.
TEST(Atrium, columnsAndArchesFaceOutwards) {
    const Scene scene = makeBuiltinScene("atrium");
    for (const std::string side : {"ground north", "ground south", "ground east", "ground west", "upper north", "upper south", "upper east", "upper west"}) {
        glm::dvec3 lo(1e9), hi(-1e9);
        for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
            if (scene.nodeNames[scene.nodeOf[t]] != side + " arches") continue;
            for (int i = 0; i < 3; ++i) {
                lo = glm::min(lo, glm::dvec3(corner(scene, t, i)));
                hi = glm::max(hi, glm::dvec3(corner(scene, t, i)));
            }
        }
        // The middle of each row is a column, with arches to its left and right.
        const glm::dvec3 middle = 0.5 * (lo + hi);
        EXPECT_GT(windingNumber(scene, {middle.x, lo.y + 0.5, middle.z}, side), 0.8) << side;
        EXPECT_GT(windingNumber(scene, {middle.x, lo.y - 2.0, middle.z}, side), 0.9) << side;
        EXPECT_LT(windingNumber(scene, {middle.x + 1.0, lo.y - 2.0, middle.z + 1.0}, side), 0.1) << side;
    }
}

TEST(AtriumTurned, isTheAtriumTurnedByThirtyAndTwentyDegrees) {
    const Scene straight = makeBuiltinScene("atrium"), turned = makeBuiltinScene("atrium_turned");
    ASSERT_EQ(turned.positions.size(), straight.positions.size());
    EXPECT_EQ(turned.triangles, straight.triangles);
    const double y = glm::radians(30.0), x = glm::radians(20.0);
    auto turn = [&](const glm::dvec3& p) {
        const glm::dvec3 q(std::cos(y) * p.x + std::sin(y) * p.z, p.y, -std::sin(y) * p.x + std::cos(y) * p.z);
        return glm::vec3(q.x, std::cos(x) * q.y - std::sin(x) * q.z, std::sin(x) * q.y + std::cos(x) * q.z);
    };
    for (std::size_t i = 0; i < straight.positions.size(); ++i)
        EXPECT_LT(glm::distance(turned.positions[i], turn(straight.positions[i])), 1e-5f);
    EXPECT_LT(glm::distance(turned.lights[0].light.direction, turn(straight.lights[0].light.direction)), 1e-6f);
    EXPECT_LT(glm::distance(turned.cameras[0].position, turn(straight.cameras[0].position)), 1e-5f);
    EXPECT_LT(glm::distance(turned.cameras[0].forward, turn(straight.cameras[0].forward)), 1e-6f);
}

}  // namespace
}  // namespace clv
