// Scenes of rooms with real walls: two rooms and a corridor.
#include "bindings/scene/builtin_scenes.h"

#include <cmath>

#include <glm/gtc/constants.hpp>

#include "bindings/scene/scene_builder.h"
#include "bindings/scene/shapes.h"

namespace clv {
namespace {

constexpr double kWall = 0.05;  // m, thickness of walls, floors and ceilings

}  // namespace

Scene makeTwoRooms() {
    SceneBuilder builder("two_rooms");
    const std::uint32_t plaster = builder.addMaterial({"plaster", {0.74f, 0.70f, 0.63f}, -1});
    const std::uint32_t orange = builder.addMaterial({"orange wall", {0.71f, 0.38f, 0.17f}, -1});
    const std::uint32_t blue = builder.addMaterial({"blue wall", {0.31f, 0.43f, 0.66f}, -1});
    const std::uint32_t boards = builder.addMaterial({"boards", {0.48f, 0.33f, 0.21f}, -1});
    const std::uint32_t paint = builder.addMaterial({"door paint", {0.66f, 0.64f, 0.58f}, -1});
    const std::uint32_t render = builder.addMaterial({"outside", {0.42f, 0.41f, 0.39f}, -1});

    // Blocks along x: wall, lit room, partition, dark room, wall. Along y: floor slab, door height, above the door, ceiling slab.
    // Along z: wall, room, doorway, room, wall. Odd measures, so that no grid of cells falls on a wall.
    const double partition = 5.217;
    BlockGrid house;
    house.xs = {0.061 - kWall, 0.061, partition, partition + kWall, 10.143, 10.143 + kWall};
    house.ys = {0.037 - kWall, 0.037, 2.093, 2.951, 2.951 + kWall};
    house.zs = {-2.487 - kWall, -2.487, 0.613, 1.527, 2.518, 2.518 + kWall};
    house.isSolid = [](const glm::ivec3& block) {
        const bool shell = block.x == 0 || block.x == 4 || block.y == 0 || block.y == 3 || block.z == 0 || block.z == 4;
        const bool doorway = block.y == 1 && block.z == 2;
        return shell || (block.x == 2 && !doorway);
    };
    builder.beginNode("house");
    addBlocks(builder, house, [&](const glm::ivec3& open, const glm::ivec3& solid) {
        const bool isInside = open.x >= 1 && open.x <= 3 && open.y >= 1 && open.y <= 2 && open.z >= 1 && open.z <= 3;
        if (!isInside) return render;
        if (solid.y < open.y) return boards;
        if (solid.x == 0) return orange;
        if (solid.x == 4) return blue;
        return plaster;
    });

    // The leaf hangs at the low-z jamb, opens into the dark room and clears jamb, lintel and floor by about a centimetre.
    const double ajar = glm::radians(31.7), leafWidth = 0.893, leafHeight = 2.034, leafThickness = 0.04, gap = 0.012;
    const glm::dvec3 hinge(partition + kWall + gap, house.ys[1] + gap, house.zs[2] + gap);
    const glm::dvec3 along(std::sin(ajar), 0.0, std::cos(ajar)), up(0, 1, 0);
    const glm::dvec3 across = glm::cross(up, along);
    builder.beginNode("door");
    addBox(builder, hinge + 0.5 * (leafWidth * along + leafHeight * up + leafThickness * across), 0.5 * leafThickness * across,
           0.5 * leafHeight * up, 0.5 * leafWidth * along, paint);

    builder.addLight("lamp", makePointLight({16.0f, 14.2f, 11.8f}), {2.263, 2.317, -0.871});

    const glm::dvec3 lit(0.45, 1.55, 2.1), dark(9.7, 1.6, -2.0), outside(-3.9, 5.6, -7.7);
    builder.addCamera(cameraLookingAt("lit room", lit, {5.2, 1.1, 0.2}, 1.0f), lit);
    builder.addCamera(cameraLookingAt("dark room", dark, {5.3, 1.1, 0.9}, 1.0f), dark);
    builder.addCamera(cameraLookingAt("outside", outside, {5.1, 1.4, 0.0}, 0.7f), outside);
    return std::move(builder).finish("two_rooms");
}

Scene makeCorridor() {
    SceneBuilder builder("corridor");
    const std::uint32_t white = builder.addMaterial({"white wall", {0.78f, 0.76f, 0.72f}, -1});
    const std::uint32_t ochre = builder.addMaterial({"ochre wall", {0.69f, 0.52f, 0.23f}, -1});
    const std::uint32_t teal = builder.addMaterial({"teal wall", {0.24f, 0.54f, 0.52f}, -1});
    const std::uint32_t tiles = builder.addMaterial({"tiles", {0.52f, 0.50f, 0.47f}, -1});
    const std::uint32_t render = builder.addMaterial({"outside", {0.42f, 0.41f, 0.39f}, -1});

    // Seen from above the open blocks form a Z: out along x, across along z, and on along x.
    BlockGrid halls;
    const double wall = 0.12;
    halls.xs = {-wall, 0.0, 6.31, 8.17, 14.43, 14.43 + wall};
    halls.ys = {-wall, 0.0, 2.63, 2.63 + wall};
    halls.zs = {-wall, 0.0, 1.91, 6.07, 7.94, 7.94 + wall};
    auto isOpen = [](const glm::ivec3& block) {
        if (block.y != 1) return false;
        const bool first = block.z == 1 && (block.x == 1 || block.x == 2);
        const bool second = block.z == 2 && block.x == 2;
        const bool third = block.z == 3 && (block.x == 2 || block.x == 3);
        return first || second || third;
    };
    halls.isSolid = [&](const glm::ivec3& block) { return !isOpen(block); };
    builder.beginNode("halls");
    addBlocks(builder, halls, [&](const glm::ivec3& open, const glm::ivec3& solid) {
        if (!isOpen(open)) return render;
        if (solid.y < open.y) return tiles;
        if (solid.y > open.y) return white;
        return open.z == 1 ? white : open.z == 2 ? ochre : teal;
    });

    builder.addLight("lamp", makePointLight({24.0f, 22.0f, 19.0f}), {0.83, 2.21, 0.97});

    const glm::dvec3 start(0.4, 1.6, 0.5), middle(7.2, 1.6, 1.0), end(13.9, 1.6, 7.4);
    builder.addCamera(cameraLookingAt("start", start, {7.0, 1.2, 1.2}, 1.0f), start);
    builder.addCamera(cameraLookingAt("middle", middle, {7.3, 1.2, 7.0}, 1.0f), middle);
    builder.addCamera(cameraLookingAt("end", end, {7.5, 1.2, 6.8}, 1.0f), end);
    return std::move(builder).finish("corridor");
}

}  // namespace clv
