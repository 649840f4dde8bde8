#include "bindings/scene/generated_scene.h"

#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "bindings/scene/scene_builder.h"
#include "bindings/scene/shapes.h"
#include "clv/math/hash.h"

namespace clv {
namespace {

// Numbers drawn one after the other.
class Draw {
public:
    explicit Draw(std::uint32_t seed) : seed_(seed) {}
    double between(double lo, double hi) { return lo + (hi - lo) * double(clvUnitFloat(clvHashCombine(seed_, count_++))); }
    bool chance(double probability) { return between(0.0, 1.0) < probability; }
    int from(int lo, int hi) { return lo + int(between(0.0, hi - lo + 1)); }  // both ends included

private:
    std::uint32_t seed_, count_ = 0;
};

// The house along one horizontal axis, four blocks a room: a wall, and a room in three parts, the middle one as wide as its doors.
// A last wall closes it.
struct Axis {
    static constexpr int kBlocks = 4;
    std::vector<double> planes;

    static bool isWall(int block) { return block % kBlocks == 0; }
    static bool isDoor(int block) { return block % kBlocks == 2; }
    int rooms() const { return int(planes.size()) / kBlocks; }
    bool isOutside(int block) const { return block == 0 || block == rooms() * kBlocks; }
    double lo(int room) const { return planes[room * kBlocks + 1]; }
    double hi(int room) const { return planes[(room + 1) * kBlocks]; }
};

Axis drawAxis(Draw& draw, int rooms, double size, double wall) {
    Axis axis;
    double at = draw.between(-size, size);
    for (int room = 0; room < rooms; ++room) {
        const double width = size * draw.between(0.6, 1.4), door = draw.between(0.2, 0.5), doorWidth = draw.between(0.15, 0.35);
        axis.planes.insert(axis.planes.end(), {at, at + wall, at + wall + door * width, at + wall + (door + doorWidth) * width});
        at += wall + width;
    }
    axis.planes.insert(axis.planes.end(), {at, at + wall});
    return axis;
}

// Furniture keeps out of it.
struct Ball {
    glm::dvec3 center;
    double radius;  // m
};

class House {
public:
    House(const std::string& name, std::uint32_t seed) : draw_(seed), builder_(name), sunFirst_(seed % 3 == 2), spotFirst_(seed % 3 == 1) {
        size_ = std::exp(draw_.between(std::log(2.0), std::log(12.0)));
        grey_ = draw_.chance(0.2);
        drawPlan();
        for (int k = 0; k < 6; ++k) materials_.push_back(builder_.addMaterial({fmt::format("material {}", k), drawAlbedo(), -1}));
    }

    Scene build() && {
        builder_.beginNode("house");
        addBlocks(builder_, grid_, [&](const glm::ivec3& open, const glm::ivec3& solid) {
            if (solid.y != open.y) return materials_[solid.y < open.y ? 0 : 1];
            return materials_[2 + (open.x / Axis::kBlocks + open.z / Axis::kBlocks) % 3];
        });
        for (const glm::ivec2& room : rooms()) addCamera(room);
        addLamp(sunFirst_ ? kClvLightDirectional : spotFirst_ ? kClvLightSpot : kClvLightPoint, {0, 0});
        if (draw_.chance(0.4)) {
            const auto all = rooms();
            const glm::ivec2 room = all[draw_.from(0, int(all.size()) - 1)];
            addLamp(draw_.chance(0.5) ? kClvLightPoint : kClvLightSpot, room);
        }
        builder_.beginNode("furniture");
        for (const glm::ivec2& room : rooms()) furnish(room);
        const bool turned = draw_.chance(1.0 / 3.0);
        const glm::dmat4 aboutY = glm::rotate(glm::dmat4(1.0), draw_.between(0.0, glm::pi<double>()), glm::dvec3(0, 1, 0));
        const glm::dmat4 aboutX = glm::rotate(glm::dmat4(1.0), draw_.between(0.1, 0.5), glm::dvec3(1, 0, 0));
        Scene scene = std::move(builder_).finish("generated scene");
        if (turned) turnScene(scene, glm::dmat3(aboutX * aboutY));
        return scene;
    }

private:
    std::vector<glm::ivec2> rooms() const {
        std::vector<glm::ivec2> all;
        for (int i = 0; i < x_.rooms(); ++i)
            for (int k = 0; k < z_.rooms(); ++k) all.push_back({i, k});
        return all;
    }
    glm::dvec3 lo(const glm::ivec2& room) const { return {x_.lo(room.x), grid_.ys[1], z_.lo(room.y)}; }
    glm::dvec3 hi(const glm::ivec2& room) const { return {x_.hi(room.x), grid_.ys[4], z_.hi(room.y)}; }
    // A place in a room, each coordinate a share of its extent.
    glm::dvec3 inRoom(const glm::ivec2& room, const glm::dvec3& share) const { return glm::mix(lo(room), hi(room), share); }
    glm::dvec3 drawShares(const glm::dvec3& least, const glm::dvec3& most) {
        const double x = draw_.between(least.x, most.x), y = draw_.between(least.y, most.y), z = draw_.between(least.z, most.z);
        return {x, y, z};
    }

    void drawPlan() {
        const double wall = size_ * draw_.between(0.005, 0.04);
        const int roomsX = draw_.from(1, 3), roomsZ = draw_.from(1, 2);
        x_ = drawAxis(draw_, roomsX, size_, wall);
        z_ = drawAxis(draw_, roomsZ, size_, wall);
        // Low enough for a sun as low as addLamp draws it to reach the floor of a room without a roof.
        const double height = size_ * draw_.between(0.35, 0.6), floor = draw_.between(-size_, size_);
        grid_ = {x_.planes, {floor - wall, floor, floor + 0.35 * height, floor + 0.75 * height, floor + height, floor + height + wall}, z_.planes, {}, false};
        const bool windows = draw_.chance(0.4);
        std::vector<bool> court;
        for (const glm::ivec2& room : rooms()) court.push_back(draw_.chance(0.15) || (sunFirst_ && room == glm::ivec2(0)));
        // Upwards: floor, below the sill, door and window, above them, roof.
        grid_.isSolid = [x = x_, z = z_, windows, court](const glm::ivec3& block) {
            const bool wallX = Axis::isWall(block.x), wallZ = Axis::isWall(block.z);
            if (block.y == 0 || (wallX && wallZ)) return true;
            if (!wallX && !wallZ) return block.y == 4 && !court[block.x / Axis::kBlocks * z.rooms() + block.z / Axis::kBlocks];
            const bool outer = wallX ? x.isOutside(block.x) : z.isOutside(block.z);
            if (!Axis::isDoor(wallX ? block.z : block.x)) return true;
            return outer ? !windows || block.y != 2 : block.y > 2;
        };
    }

    glm::vec3 drawAlbedo() {
        const double level = draw_.between(0.1, 0.9);
        const glm::dvec3 tint = drawShares(glm::dvec3(0.2), glm::dvec3(1.0));
        return grey_ ? glm::vec3(float(level)) : glm::vec3(level * tint);
    }

    void addCamera(const glm::ivec2& room) {
        const glm::dvec3 from = inRoom(room, {0.1, 0.8, 0.1}), to = inRoom(room, {0.75, 0.25, 0.75});
        builder_.addCamera(cameraLookingAt(fmt::format("room {} {}", room.x, room.y), from, to, 1.2f), from);
        keepFree_.push_back({from, 0.05 * size_});
    }

    void addLamp(uint type, const glm::ivec2& room) {
        const glm::vec3 colour = grey_ ? glm::vec3(1.0f) : glm::vec3(drawShares(glm::dvec3(0.5), glm::dvec3(1.0)));
        const glm::dvec3 place = inRoom(room, drawShares({0.3, 0.5, 0.3}, {0.7, 0.9, 0.7}));
        // No lower than 40 degrees above the horizon.
        const glm::dvec3 down = drawShares({-0.8, -1.0, -0.8}, {0.8, -1.0, 0.8});
        const float outer = float(draw_.between(0.4, 1.2)), inner = outer * float(draw_.between(0.0, 0.8));
        // About 1 W/m^2 across a room of this size.
        const float intensity = float(0.25 * size_ * size_);
        const ClvLight light = type == kClvLightDirectional ? makeDirectionalLight(down, 3.0f * colour)
                             : type == kClvLightSpot        ? makeSpotLight(down, 3.0f * intensity * colour, inner, outer)
                                                            : makePointLight(intensity * colour);
        builder_.addLight(fmt::format("lamp {}", builder_.lightCount()), light, place);
        keepFree_.push_back({place, 0.08 * size_});
    }

    void furnish(const glm::ivec2& room) {
        const int boxes = draw_.from(0, 4), columns = draw_.from(0, 3), drapes = draw_.from(0, 1);
        for (int k = 0; k < boxes; ++k) {
            const glm::dvec3 half = 0.5 * size_ * drawShares(glm::dvec3(0.04), glm::dvec3(0.2));
            addFurniture(room, half, draw_.chance(0.3));
        }
        const double height = hi(room).y - lo(room).y;
        for (int k = 0; k < columns; ++k) {
            const double half = size_ * draw_.between(0.015, 0.05);
            addFurniture(room, {half, 0.5 * height, half}, false);
        }
        for (int k = 0; k < drapes; ++k) addDrape(room);
    }

    // A place for something of this radius seen from above, or false if what was tried is taken.
    bool findPlace(const glm::ivec2& room, double radius, glm::dvec3& place) {
        const glm::dvec3 low = lo(room) + radius, high = hi(room) - radius;
        if (low.x > high.x || low.z > high.z) return false;
        for (int attempt = 0; attempt < 8; ++attempt) {
            place = glm::mix(low, high, drawShares(glm::dvec3(0.0), glm::dvec3(1.0)));
            bool isFree = true;
            for (const Ball& ball : keepFree_) isFree = isFree && std::hypot(place.x - ball.center.x, place.z - ball.center.z) > radius + ball.radius;
            if (!isFree) continue;
            keepFree_.push_back({place, radius});
            return true;
        }
        return false;
    }

    // A box: afloat and turned any way, or upright with its foot in the floor slab (and its head in the roof, if it is that tall).
    void addFurniture(const glm::ivec2& room, const glm::dvec3& half, bool afloat) {
        const double radius = afloat ? glm::length(half) : std::hypot(half.x, half.z);
        glm::dvec3 place;
        if (!findPlace(room, radius, place)) return;
        const double turn = draw_.between(0.0, glm::pi<double>()), tilt = afloat ? draw_.between(0.0, glm::pi<double>()) : 0.0;
        const glm::dmat3 axes(glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(0, 1, 0)) * glm::rotate(glm::dmat4(1.0), tilt, glm::dvec3(1, 0, 0)));
        const double slab = grid_.ys[1] - grid_.ys[0];
        const glm::dvec3 reach(half.x, half.y + (afloat ? 0.0 : 0.5 * slab), half.z);
        if (!afloat) place.y = grid_.ys[1] + half.y;
        addBox(builder_, place, reach.x * axes[0], reach.y * axes[1], reach.z * axes[2], materials_[5]);
    }

    // A sheet without thickness that hangs in mid-air.
    void addDrape(const glm::ivec2& room) {
        const double half = size_ * draw_.between(0.1, 0.25), turn = draw_.between(0.0, glm::pi<double>());
        glm::dvec3 place;
        if (!findPlace(room, half, place)) return;
        const glm::dvec3 along = half * glm::dvec3(std::cos(turn), 0.0, std::sin(turn));
        const double low = glm::mix(lo(room).y, hi(room).y, draw_.between(0.1, 0.3)), high = glm::mix(lo(room).y, hi(room).y, draw_.between(0.7, 0.9));
        const auto corner = [&](const glm::dvec3& offset, double y) { return glm::dvec3(place.x + offset.x, y, place.z + offset.z); };
        builder_.addQuad(corner(-along, low), corner(along, low), corner(along, high), corner(-along, high), materials_[5]);
    }

    Draw draw_;
    SceneBuilder builder_;
    bool sunFirst_, spotFirst_, grey_ = false;
    double size_ = 0.0;  // m, about that of a room
    Axis x_, z_;
    BlockGrid grid_;
    std::vector<std::uint32_t> materials_;  // floors, ceilings, three for walls, furniture
    std::vector<Ball> keepFree_;
};

}  // namespace

Scene makeGeneratedScene(std::uint32_t seed) { return House(fmt::format("generated_{}", seed), seed).build(); }

}  // namespace clv
