#include "bindings/scene/scene_builder.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "bindings/scene/reach.h"
#include "bindings/scene/scene_facts.h"

namespace clv {
namespace {

constexpr double kFarScene = 1000.0;     // m: beyond it floats round coordinates to more than 0.1 mm
constexpr double kFarInExtents = 4.0;    // an anchor pays only when the centre lies several extents away,
constexpr double kVeryFar = 1024.0;      // and at any distance when it lies as many away

constexpr double kSliver = 1e-6;         // height over length of a triangle whose corners may as well lie on a line

constexpr float kFineDetail = 0.01f;     // of a triangle's size: what may be lost of it without a word

struct DoubleBounds {
    glm::dvec3 lo{std::numeric_limits<double>::max()}, hi{std::numeric_limits<double>::lowest()};
};

glm::dvec3 chooseAnchor(const DoubleBounds& bounds) {
    glm::dvec3 center = 0.5 * (bounds.lo + bounds.hi);
    double distance = glm::length(center), extent = glm::length(bounds.hi - bounds.lo);
    bool far = distance > kVeryFar * extent || (distance > kFarScene && distance > kFarInExtents * extent);
    return far ? glm::round(center) : glm::dvec3(0.0);
}

// Whether the triangle is one in double precision: its corners neither coincide nor lie on a line.
bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double longest = std::max({glm::dot(b - a, b - a), glm::dot(c - a, c - a), glm::dot(c - b, c - b)});
    return glm::length(glm::cross(b - a, c - a)) > kSliver * longest;
}

}  // namespace

std::uint32_t SceneBuilder::addMaterial(Material material) {
    scene_.materials.push_back(std::move(material));
    return std::uint32_t(scene_.materials.size() - 1);
}

int SceneBuilder::addTexture(Texture texture) {
    scene_.textures.push_back(std::move(texture));
    return int(scene_.textures.size() - 1);
}

void SceneBuilder::beginNode(std::string name) {
    node_ = std::uint32_t(scene_.nodeNames.size());
    scene_.nodeNames.push_back(std::move(name));
}

std::uint32_t SceneBuilder::addVertex(const glm::dvec3& position, const glm::vec2& uv) {
    positionsWorld_.push_back(position);
    scene_.uvs.push_back(uv);
    return std::uint32_t(positionsWorld_.size() - 1);
}

void SceneBuilder::addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material) {
    scene_.triangles.push_back({a, b, c});
    scene_.materialOf.push_back(material);
    scene_.nodeOf.push_back(node_);
}

void SceneBuilder::addQuad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
                           std::uint32_t material) {
    std::uint32_t first = addVertex(a);
    addVertex(b);
    addVertex(c);
    addVertex(d);
    addTriangle(first, first + 1, first + 2, material);
    addTriangle(first, first + 2, first + 3, material);
}

void SceneBuilder::addLight(std::string name, ClvLight light, const glm::dvec3& position) {
    scene_.lights.push_back({std::move(name), light});
    lightPositionsWorld_.push_back(position);
}

void SceneBuilder::addCamera(Camera camera, const glm::dvec3& position) {
    scene_.cameras.push_back(std::move(camera));
    cameraPositionsWorld_.push_back(position);
}

void SceneBuilder::ignore(const std::string& feature) {
    if (std::find(scene_.ignored.begin(), scene_.ignored.end(), feature) == scene_.ignored.end()) scene_.ignored.push_back(feature);
}

void SceneBuilder::checkVertices(const std::string& source) const {
    for (std::size_t t = 0; t < scene_.triangles.size(); ++t)
        for (int corner = 0; corner < 3; ++corner) {
            std::uint32_t vertex = scene_.triangles[t][corner];
            if (isWithinReach(positionsWorld_[vertex])) continue;
            checkReach(positionsWorld_[vertex], fmt::format("{}: node '{}', vertex {}", source, scene_.nodeNames[scene_.nodeOf[t]], vertex));
        }
}

void SceneBuilder::dropZeroAreaTriangles(const std::string& source) {
    std::size_t kept = 0, lost = 0;
    std::uint32_t firstLost = 0;  // node
    for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
        const glm::uvec3& corners = scene_.triangles[t];
        glm::vec3 a = scene_.positions[corners.x], b = scene_.positions[corners.y], c = scene_.positions[corners.z];
        glm::vec3 normal = glm::cross(b - a, c - a);
        // In float, as those who use the triangle compute it: a normal that underflows cannot be normalised.
        if (glm::dot(normal, normal) < FLT_MIN) {
            if (hasArea(positionsWorld_[corners.x], positionsWorld_[corners.y], positionsWorld_[corners.z]) && lost++ == 0) firstLost = scene_.nodeOf[t];
            continue;
        }
        scene_.triangles[kept] = corners;
        scene_.materialOf[kept] = scene_.materialOf[t];
        scene_.nodeOf[kept] = scene_.nodeOf[t];
        ++kept;
    }
    scene_.droppedTriangles = scene_.triangles.size() - kept;
    scene_.triangles.resize(kept);
    scene_.materialOf.resize(kept);
    scene_.nodeOf.resize(kept);
    if (lost > 0) warn(fmt::format("{}: {} of its triangles have no area in single precision and are left out, the first one of node '{}'", source, lost, scene_.nodeNames[firstLost]));
}

void SceneBuilder::warnOfLostDetail(const std::string& source) {
    std::vector<float> sizes;
    sizes.reserve(scene_.triangles.size());
    for (const glm::uvec3& corners : scene_.triangles) {
        const glm::vec3& a = scene_.positions[corners.x];
        sizes.push_back(std::sqrt(glm::length(glm::cross(scene_.positions[corners.y] - a, scene_.positions[corners.z] - a))));
    }
    const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    const float offset = surfaceOffset(scene_.bounds);
    if (offset <= kFineDetail * *middle) return;
    const glm::vec3 extent = scene_.bounds.extent();
    warn(fmt::format("{}: half of its triangles are smaller than {:.2g} m, but it is {:.2g} m wide: light within {:.1g} m of surfaces is not computed right; "
                     "leave out what lies far away", source, *middle, std::max({extent.x, extent.y, extent.z}), offset));
}

Scene SceneBuilder::finish(const std::string& source) && {
    if (scene_.triangles.empty()) throw InputError(source + ": no triangles; expected a scene with at least one");
    checkVertices(source);

    DoubleBounds bounds;
    for (const glm::uvec3& corners : scene_.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            bounds.lo = glm::min(bounds.lo, positionsWorld_[corners[corner]]);
            bounds.hi = glm::max(bounds.hi, positionsWorld_[corners[corner]]);
        }
    const glm::dvec3 extent = bounds.hi - bounds.lo;
    if (const double widest = std::max({extent.x, extent.y, extent.z}); widest > kWidestScene)
        throw InputError(fmt::format("{}: expected a scene of at most {:g} m, found {:g}", source, kWidestScene, widest));
    scene_.anchor = chooseAnchor(bounds);
    scene_.positions.reserve(positionsWorld_.size());
    for (const glm::dvec3& position : positionsWorld_) scene_.positions.push_back(glm::vec3(position - scene_.anchor));
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
        auto& [name, light] = scene_.lights[i];
        const std::string place = fmt::format("{}: light '{}'", source, name);
        checkReach(lightPositionsWorld_[i], place);
        light.position = glm::vec3(lightPositionsWorld_[i] - scene_.anchor);
        checkLight(light, place);
    }
    for (std::size_t i = 0; i < scene_.cameras.size(); ++i) {
        Camera& camera = scene_.cameras[i];
        checkReach(cameraPositionsWorld_[i], fmt::format("{}: camera '{}'", source, camera.name));
        camera.position = glm::vec3(cameraPositionsWorld_[i] - scene_.anchor);
    }
    scene_.bounds = {glm::vec3(bounds.lo - scene_.anchor), glm::vec3(bounds.hi - scene_.anchor)};

    dropZeroAreaTriangles(source);
    if (scene_.triangles.empty())
        throw InputError(fmt::format("{}: all {} triangles have zero area; expected at least one that has not", source,
                                     scene_.droppedTriangles));
    bool textured = std::any_of(scene_.materials.begin(), scene_.materials.end(), [](const Material& m) { return m.texture >= 0; });
    if (!textured) scene_.uvs.clear();
    warnOfLostDetail(source);
    return std::move(scene_);
}

Camera cameraLookingAt(std::string name, const glm::dvec3& position, const glm::dvec3& target, float yfov) {
    glm::dvec3 forward = glm::normalize(target - position);
    glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    Camera camera;
    camera.name = std::move(name);
    camera.forward = glm::vec3(forward);
    camera.up = glm::vec3(glm::cross(right, forward));
    camera.yfov = yfov;
    return camera;
}

ClvLight makePointLight(const glm::vec3& intensity) {
    ClvLight light{};
    light.type = kClvLightPoint;
    light.direction = {0, -1, 0};
    light.intensity = intensity;
    return light;
}

ClvLight makeSpotLight(const glm::vec3& direction, const glm::vec3& intensity, float innerConeAngle, float outerConeAngle) {
    ClvLight light{};
    light.type = kClvLightSpot;
    light.direction = glm::normalize(direction);
    light.intensity = intensity;
    light.innerConeAngle = innerConeAngle;
    light.outerConeAngle = outerConeAngle;
    return light;
}

ClvLight makeDirectionalLight(const glm::vec3& direction, const glm::vec3& irradiance) {
    ClvLight light{};
    light.type = kClvLightDirectional;
    light.direction = glm::normalize(direction);
    light.intensity = irradiance;
    return light;
}

void checkLight(const ClvLight& light, const std::string& place) {
    for (int channel = 0; channel < 3; ++channel)
        if (!(light.intensity[channel] >= 0.0f && std::isfinite(light.intensity[channel])))
            throw InputError(fmt::format("{}: intensity {} is not finite and >= 0", place, light.intensity[channel]));
    if (light.type != kClvLightPoint && !(std::abs(glm::length(light.direction) - 1.0f) < 1e-3f))
        throw InputError(place + ": expected a direction that is not zero");
    if (light.type != kClvLightSpot) return;
    bool coneIsGood = light.innerConeAngle >= 0.0f && light.innerConeAngle < light.outerConeAngle &&
                      light.outerConeAngle <= std::nextafter(0.5f * kClvPi, 2.0f);
    if (!coneIsGood)
        throw InputError(fmt::format("{}: cone angles {} and {} rad; expected 0 <= inner < outer <= pi/2", place, light.innerConeAngle,
                                     light.outerConeAngle));
}

}  // namespace clv
