// The Cornell box as measured by the Cornell University Program of Computer Graphics ("Cornell Box Data", 1998).
#include "bindings/scene/builtin_scenes.h"

#include <cmath>

#include "bindings/scene/scene_builder.h"

namespace clv {
namespace {

constexpr double kMetresPerUnit = 1e-3;  // the data are in mm

void addWall(SceneBuilder& builder, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
             std::uint32_t material) {
    builder.addQuad(kMetresPerUnit * a, kMetresPerUnit * b, kMetresPerUnit * c, kMetresPerUnit * d, material);
}

// A block that stands on the floor: its top, counter-clockwise seen from above, and its four sides.
void addBlock(SceneBuilder& builder, const std::string& name, const glm::dvec2 (&corners)[4], double height, std::uint32_t material) {
    builder.beginNode(name);
    auto top = [&](int i) { return glm::dvec3(corners[i % 4].x, height, corners[i % 4].y); };
    auto bottom = [&](int i) { return glm::dvec3(corners[i % 4].x, 0.0, corners[i % 4].y); };
    addWall(builder, top(0), top(1), top(2), top(3), material);
    for (int i = 0; i < 4; ++i) addWall(builder, bottom(i), bottom(i + 1), top(i + 1), top(i), material);
}

}  // namespace

Scene makeCornell() {
    SceneBuilder builder("cornell");
    // Means of the measured reflectances over 600-700, 500-600 and 400-500 nm.
    const std::uint32_t white = builder.addMaterial({"white", {0.734f, 0.736f, 0.700f}, -1});
    const std::uint32_t red = builder.addMaterial({"red", {0.576f, 0.091f, 0.056f}, -1});
    const std::uint32_t green = builder.addMaterial({"green", {0.133f, 0.343f, 0.120f}, -1});

    builder.beginNode("walls");
    addWall(builder, {552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}, white);                       // floor
    addWall(builder, {556.0, 548.8, 0}, {556.0, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0}, white);       // ceiling
    addWall(builder, {549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556.0, 548.8, 559.2}, white);       // back
    addWall(builder, {0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}, green);                       // right
    addWall(builder, {552.8, 0, 0}, {549.6, 0, 559.2}, {556.0, 548.8, 559.2}, {556.0, 548.8, 0}, red);         // left
    addBlock(builder, "short block", {{130, 65}, {82, 225}, {240, 272}, {290, 114}}, 165, white);
    addBlock(builder, "tall block", {{423, 247}, {265, 296}, {314, 456}, {472, 406}}, 330, white);

    // The lamp of the box hangs in the middle of the ceiling and shines down; here it is a point just below.
    const glm::dvec3 lamp = kMetresPerUnit * glm::dvec3(278.0, 540.0, 279.5);
    builder.addLight("lamp", makeSpotLight({0, -1, 0}, {3.0f, 2.6f, 2.0f}, 0.0f, 0.5f * kClvPi), lamp);

    // Focal length 35 mm, film 25 mm x 25 mm.
    const float yfov = 2.0f * std::atan(0.0125f / 0.035f);
    Camera front = cameraLookingAt("front", {0.278, 0.273, -0.8}, {0.278, 0.273, 0.0}, yfov);
    front.aspect = 1.0f;
    builder.addCamera(front, {0.278, 0.273, -0.8});
    const glm::dvec3 inside(0.1, 0.42, 0.05);
    builder.addCamera(cameraLookingAt("inside", inside, {0.38, 0.15, 0.45}, 1.2f), inside);
    return std::move(builder).finish("cornell");
}

}  // namespace clv
