// Reads {"lights":[{"name":...,"keys":[...]}],"camera":{"keys":[...]}} files.
#include <cmath>
#include <set>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/json_reader.h"
#include "bindings/scene/motion.h"
#include "bindings/scene/reach.h"
#include "bindings/scene/scene_builder.h"

namespace clv {
namespace {

constexpr std::size_t kMostFrames = 1000000;

void checkMembers(const JsonReader& reader, const std::set<std::string>& known) {
    for (const std::string& key : reader.keys()) {
        if (!known.contains(key)) reader.fail(fmt::format("no member '{}'", key));
    }
}

// The keys of one thing, their frames in order.
std::vector<std::pair<double, JsonReader>> framesOf(const JsonReader& thing, Motion& motion) {
    std::vector<std::pair<double, JsonReader>> frames;
    for (const JsonReader& key : thing["keys"].elements()) {
        const std::size_t frame = key["frame"].index(kMostFrames);
        if (!frames.empty() && !(double(frame) > frames.back().first)) key["frame"].fail(fmt::format("a frame after {}", frames.back().first));
        frames.emplace_back(double(frame), key);
        motion.lastFrame = std::max(motion.lastFrame, std::uint32_t(frame));
    }
    if (frames.empty()) thing["keys"].fail("at least one key");
    return frames;
}

glm::dvec3 finiteVector(const JsonReader& reader) {
    const glm::dvec3 v = reader.vector();
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(float(v[axis]))) reader.fail("numbers that fit a float");
    }
    return v;
}

glm::dvec3 positionOf(const std::string& file, const JsonReader& reader) {
    checkReach(reader.vector(), fmt::format("{}: {}", file, reader.place()));
    return reader.vector();
}

std::size_t lightNamed(const JsonReader& name, const Scene& scene) {
    std::vector<std::size_t> found;
    std::string names;
    for (std::size_t k = 0; k < scene.lights.size(); ++k) {
        if (scene.lights[k].name == name.text()) found.push_back(k);
        names += (names.empty() ? "" : ", ") + scene.lights[k].name;
    }
    if (found.empty()) name.fail(fmt::format("one of the scene's lights: {}", names));
    if (found.size() > 1) name.fail(fmt::format("a name that one light has alone, not {}", found.size()));
    return found.front();
}

LightMotion readLight(const std::string& file, const JsonReader& source, const Scene& scene, Motion& motion) {
    checkMembers(source, {"name", "keys"});
    LightMotion moving;
    moving.light = lightNamed(source["name"], scene);
    for (const auto& [frame, key] : framesOf(source, motion)) {
        checkMembers(key, {"frame", "position", "direction", "intensity"});
        ClvLight light = scene.lights[moving.light].light;
        if (key.has("position")) moving.position.keys.emplace_back(frame, positionOf(file, key["position"]));
        if (key.has("intensity")) {
            moving.intensity.keys.emplace_back(frame, key["intensity"].vector());
            light.intensity = glm::vec3(moving.intensity.keys.back().second);
        }
        if (key.has("direction")) {
            const glm::dvec3 direction = finiteVector(key["direction"]);
            if (!(glm::length(direction) > 0.0)) key["direction"].fail("a direction that is not zero");
            moving.direction.keys.emplace_back(frame, glm::normalize(direction));
        }
        checkLight(light, fmt::format("{}: {}", file, key.place()));
    }
    return moving;
}

CameraMotion readCamera(const std::string& file, const JsonReader& source, Motion& motion) {
    checkMembers(source, {"keys"});
    CameraMotion camera;
    for (const auto& [frame, key] : framesOf(source, motion)) {
        checkMembers(key, {"frame", "position", "target", "yfov"});
        if (key.has("position")) camera.position.keys.emplace_back(frame, positionOf(file, key["position"]));
        if (key.has("target")) camera.target.keys.emplace_back(frame, positionOf(file, key["target"]));
        if (key.has("yfov")) {
            const double yfov = key["yfov"].number();
            if (!(yfov >= 1e-6 && yfov < 3.14)) key["yfov"].fail("an angle of 1e-6 to 3.14 rad");
            camera.yfov.keys.emplace_back(frame, yfov);
        }
    }
    return camera;
}

}  // namespace

Motion loadMotion(const std::string& file, const Scene& scene) {
    const nlohmann::json json = parseJson(file, readFileBytes(file));
    const JsonReader root(file, json);
    if (root.has("objects")) root["objects"].fail("no objects: those that move are not available; lights and the camera are");
    checkMembers(root, {"fps", "lights", "camera"});
    Motion motion;
    motion.file = file;
    motion.fps = root.number("fps", motion.fps);
    if (!(motion.fps >= 1e-6 && motion.fps <= 1e6)) root["fps"].fail("a number from 1e-6 to 1e6");
    std::set<std::size_t> seen;
    for (const JsonReader& light : root.elements("lights")) {
        motion.lights.push_back(readLight(file, light, scene, motion));
        if (!seen.insert(motion.lights.back().light).second) light["name"].fail("a light that is not listed before");
    }
    if (root.has("camera")) motion.camera = readCamera(file, root["camera"], motion);
    if (motion.lights.empty() && !motion.camera) root.fail("lights or a camera that move");
    return motion;
}

}  // namespace clv
