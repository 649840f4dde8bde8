// The atrium: a court between two storeys of arcades, open to the sky, with coloured drapes.
#include "bindings/scene/builtin_scenes.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "bindings/scene/scene_builder.h"
#include "bindings/scene/shapes.h"

namespace clv {
namespace {

// All in m, the court's centre at x = z = 0.
constexpr double kOuterX = 15.0, kOuterZ = 6.5;   // outer faces of the outer walls
constexpr double kCourtX = 10.9, kCourtZ = 3.6;   // arcade faces towards the court
constexpr double kOuterWall = 0.42, kArcade = 0.46;  // thicknesses
constexpr double kSpringing = 3.9;                // height of the springing of the arches above their floor
constexpr double kPier = 0.2;                     // half the width of the masonry between two arches
constexpr int kArchSegments = 12, kColumnSides = 10;

struct Storey {
    double floor, ceiling;  // m
};
constexpr Storey kStoreys[2] = {{0.0, 5.9}, {6.25, 12.1}};
constexpr double kGround = -0.35, kTop = 12.75;  // lower face of the ground slab, upper face of the walls

struct Materials {
    std::uint32_t stone, plaster, paving;
};

// Ground slab, outer walls, gallery floors and roofs, and the four corner piers of the arcades.
void addMasonry(SceneBuilder& builder, const Materials& materials) {
    BlockGrid blocks;
    auto mirrored = [](double outer, double wall, double court, double arcade) {
        return std::vector<double>{-outer, -outer + wall, -court - arcade, -court, court, court + arcade, outer - wall, outer};
    };
    blocks.xs = mirrored(kOuterX, kOuterWall, kCourtX, kArcade);
    blocks.zs = mirrored(kOuterZ, kOuterWall, kCourtZ, kArcade);
    blocks.ys = {kGround, kStoreys[0].floor, kStoreys[0].ceiling, kStoreys[1].floor, kStoreys[1].ceiling, kTop};
    blocks.isSolid = [](const glm::ivec3& block) {
        if (block.y == 0) return true;
        const bool isCourt = block.x == 3 && block.z == 3;
        if (isCourt) return false;
        const bool isOuterWall = block.x == 0 || block.x == 6 || block.z == 0 || block.z == 6;
        const bool isCornerPier = (block.x == 2 || block.x == 4) && (block.z == 2 || block.z == 4);
        const bool isSlab = block.y == 2 || block.y == 4;
        return isOuterWall || isCornerPier || isSlab;
    };
    builder.beginNode("masonry");
    addBlocks(builder, blocks, [&](const glm::ivec3& open, const glm::ivec3& solid) {
        if (solid.y < open.y) return materials.paving;
        const bool isGalleryWall = solid.x == 0 || solid.x == 6 || solid.z == 0 || solid.z == 6;
        return isGalleryWall ? materials.plaster : materials.stone;
    });
}

// A frame on the floor line of a row of arches: x along the row, y up, z = x cross y towards the front.
struct RowFrame {
    glm::dvec3 origin, along;
    glm::dvec3 at(double x, double y, double z) const { return origin + x * along + glm::dvec3(0, y, 0) + z * glm::cross(along, glm::dvec3(0, 1, 0)); }
};

// The wall above the columns of a row: front and back from the arches up to `height`, and the inner faces of the arches. Its ends
// meet the corner piers, its top the slab.
void addArches(SceneBuilder& builder, const RowFrame& frame, double length, int bays, double height, std::uint32_t material) {
    const double bay = length / bays, radius = 0.5 * bay - kPier, half = 0.5 * kArcade;
    // The lower edge, from left to right: up to the first arch, then around each arch.
    std::vector<glm::dvec2> edge = {{0.0, kSpringing}};
    for (int i = 0; i < bays; ++i)
        for (int k = 0; k <= kArchSegments; ++k) {
            const double angle = glm::pi<double>() * (1.0 - double(k) / kArchSegments);
            edge.push_back({(i + 0.5) * bay + radius * std::cos(angle), kSpringing + radius * std::sin(angle)});
        }
    edge.push_back({length, kSpringing});
    for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
        const glm::dvec2 p = edge[i], q = edge[i + 1];
        builder.addQuad(frame.at(p.x, p.y, half), frame.at(q.x, q.y, half), frame.at(q.x, height, half), frame.at(p.x, height, half),
                        material);
        builder.addQuad(frame.at(q.x, q.y, -half), frame.at(p.x, p.y, -half), frame.at(p.x, height, -half),
                        frame.at(q.x, height, -half), material);
        builder.addQuad(frame.at(p.x, p.y, -half), frame.at(q.x, q.y, -half), frame.at(q.x, q.y, half), frame.at(p.x, p.y, half),
                        material);
    }
}

// A round column from the floor up to the springing: foot, shaft, and a capital flush with the wall that it bears.
void addColumn(SceneBuilder& builder, const glm::dvec3& foot, std::uint32_t material) {
    const glm::dvec2 profile[] = {{0.29, 0.0}, {0.29, 0.2}, {0.24, 0.3}, {0.2, kSpringing - 0.5}, {kPier, kSpringing - 0.15},
                                  {kPier, kSpringing}, {0.0, kSpringing}};  // radius, height
    auto at = [&](const glm::dvec2& ring, int side) {
        const double angle = glm::two_pi<double>() * (side % kColumnSides) / kColumnSides;
        return foot + glm::dvec3(ring.x * std::cos(angle), ring.y, -ring.x * std::sin(angle));
    };
    for (std::size_t i = 0; i + 1 < std::size(profile); ++i)
        for (int side = 0; side < kColumnSides; ++side) {
            const glm::dvec3 a = at(profile[i], side), b = at(profile[i], side + 1), c = at(profile[i + 1], side + 1),
                             d = at(profile[i + 1], side);
            if (profile[i + 1].x > 0.0) {
                builder.addQuad(a, b, c, d, material);
            } else {
                const std::uint32_t first = builder.addVertex(a);
                builder.addVertex(b);
                builder.addVertex(c);
                builder.addTriangle(first, first + 1, first + 2, material);
            }
        }
}

void addArcadeRow(SceneBuilder& builder, const std::string& name, const RowFrame& frame, double length, int bays, double height,
                  std::uint32_t material) {
    builder.beginNode(name + " arches");
    addArches(builder, frame, length, bays, height, material);
    builder.beginNode(name + " columns");
    for (int i = 1; i < bays; ++i) addColumn(builder, frame.at(length * i / bays, 0.0, 0.0), material);
}

void addArcades(SceneBuilder& builder, std::uint32_t material) {
    const double middleX = kCourtX + 0.5 * kArcade, middleZ = kCourtZ + 0.5 * kArcade;
    const char* names[2] = {"ground", "upper"};
    for (int i = 0; i < 2; ++i) {
        const double floor = kStoreys[i].floor, height = kStoreys[i].ceiling - floor;
        const std::string name = names[i];
        addArcadeRow(builder, name + " north", {{-kCourtX, floor, -middleZ}, {1, 0, 0}}, 2 * kCourtX, 8, height, material);
        addArcadeRow(builder, name + " south", {{kCourtX, floor, middleZ}, {-1, 0, 0}}, 2 * kCourtX, 8, height, material);
        addArcadeRow(builder, name + " east", {{middleX, floor, -kCourtZ}, {0, 0, 1}}, 2 * kCourtZ, 2, height, material);
        addArcadeRow(builder, name + " west", {{-middleX, floor, kCourtZ}, {0, 0, -1}}, 2 * kCourtZ, 2, height, material);
    }
}

// A single sheet that hangs from `topLeft`, `width` along x or z, with folds that deepen towards the hem.
void addDrape(SceneBuilder& builder, const std::string& name, const glm::dvec3& topLeft, const glm::dvec3& along, double width,
              double drop, std::uint32_t material) {
    constexpr int kAcross = 18, kDown = 6;
    constexpr double kFolds = 3.5, kDepth = 0.14;  // waves across the width; m, amplitude at the hem
    const glm::dvec3 out = glm::cross(along, glm::dvec3(0, 1, 0));
    builder.beginNode(name);
    std::uint32_t first = 0;
    for (int row = 0; row <= kDown; ++row)
        for (int column = 0; column <= kAcross; ++column) {
            const double u = double(column) / kAcross, v = double(row) / kDown;
            const double fold = kDepth * (0.3 + 0.7 * v) * std::sin(glm::two_pi<double>() * kFolds * u + 1.3 * v);
            const std::uint32_t index = builder.addVertex(topLeft + width * u * along - glm::dvec3(0, drop * v, 0) + fold * out);
            if (row == 0 && column == 0) first = index;
        }
    for (int row = 0; row < kDown; ++row)
        for (int column = 0; column < kAcross; ++column) {
            const std::uint32_t a = first + row * (kAcross + 1) + column, below = a + kAcross + 1;
            builder.addTriangle(below, below + 1, a + 1, material);
            builder.addTriangle(below, a + 1, a, material);
        }
}

void addDrapes(SceneBuilder& builder) {
    const std::uint32_t colours[] = {builder.addMaterial({"red cloth", {0.56f, 0.07f, 0.05f}, -1}),
                                     builder.addMaterial({"green cloth", {0.11f, 0.37f, 0.13f}, -1}),
                                     builder.addMaterial({"blue cloth", {0.07f, 0.14f, 0.47f}, -1}),
                                     builder.addMaterial({"yellow cloth", {0.66f, 0.47f, 0.10f}, -1})};
    const double bay = 2 * kCourtX / 8, offset = 0.35;  // m, clear of the columns
    // In front of every second arch of the ground floor.
    for (int i = 0; i < 4; ++i) {
        const double x = -kCourtX + (2 * i + 0.5) * bay;
        addDrape(builder, "north drape " + std::to_string(i), {x - 0.8, 5.6, -kCourtZ + offset}, {1, 0, 0}, 1.6, 3.7, colours[i]);
        addDrape(builder, "south drape " + std::to_string(i), {x + bay + 0.8, 5.6, kCourtZ - offset}, {-1, 0, 0}, 1.6, 3.7,
                 colours[(i + 2) % 4]);
    }
    // Two banners across the court.
    addDrape(builder, "west banner", {-4.3, 11.2, -1.7}, {0, 0, 1}, 3.4, 4.6, colours[0]);
    addDrape(builder, "east banner", {5.1, 11.2, 1.7}, {0, 0, -1}, 3.4, 4.6, colours[2]);
}

void addAtriumCamera(SceneBuilder& builder, const std::string& name, const glm::dvec3& position, const glm::dvec3& target, float yfov) {
    builder.addCamera(cameraLookingAt(name, position, target, yfov), position);
}

}  // namespace

Scene makeAtrium() {
    SceneBuilder builder("atrium");
    Materials materials;
    materials.stone = builder.addMaterial({"stone", {0.57f, 0.52f, 0.44f}, -1});
    materials.plaster = builder.addMaterial({"plaster", {0.66f, 0.58f, 0.46f}, -1});
    materials.paving = builder.addMaterial({"paving", {0.43f, 0.40f, 0.36f}, -1});
    addMasonry(builder, materials);
    addArcades(builder, materials.stone);
    addDrapes(builder);

    // A slanting sun that lights the floor of the court.
    builder.addLight("sun", makeDirectionalLight({0.2f, -1.0f, -0.1f}, {10.0f, 9.5f, 8.6f}), {0, 20, 0});

    addAtriumCamera(builder, "court", {-9.6, 1.7, 1.3}, {8.0, 3.4, -1.2}, 1.0f);
    addAtriumCamera(builder, "ground arcade", {-12.6, 1.8, -5.0}, {2.0, 2.2, -3.4}, 1.0f);
    addAtriumCamera(builder, "upper arcade", {9.2, 7.9, 4.9}, {-4.0, 6.3, -2.2}, 1.0f);
    addAtriumCamera(builder, "from the roof", {0.4, 12.2, 2.8}, {-6.0, 1.0, -2.8}, 1.0f);
    return std::move(builder).finish("atrium");
}

Scene makeAtriumTurned() {
    Scene scene = makeAtrium();
    scene.name = "atrium_turned";
    const glm::dmat4 aboutY = glm::rotate(glm::dmat4(1.0), glm::radians(30.0), glm::dvec3(0, 1, 0));
    const glm::dmat4 aboutX = glm::rotate(glm::dmat4(1.0), glm::radians(20.0), glm::dvec3(1, 0, 0));
    turnScene(scene, glm::dmat3(aboutX * aboutY));
    return scene;
}

}  // namespace clv
