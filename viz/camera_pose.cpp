#include "viz/camera_pose.h"

#include <algorithm>
#include <cmath>

#include <CLI/StringTools.hpp>
#include <CLI/TypeTools.hpp>
#include <fmt/format.h>

#include "bindings/cli/camera_view.h"

namespace clv {
namespace {

// Empty where the text is not a list of numbers.
std::vector<double> numbersIn(const std::string& text) {
    std::vector<double> numbers;
    for (const std::string& part : CLI::detail::split(text, ',')) {
        double number = 0.0;
        if (!CLI::detail::lexical_cast(part, number) || !std::isfinite(number)) return {};
        numbers.push_back(number);
    }
    return numbers;
}

}  // namespace

Bounds boundsOf(const ClvVolume& grid) {
    return {grid.origin, grid.origin + grid.cellSize * glm::vec3(grid.resolution)};
}

Bounds litBounds(const BakedVolume& volume) {
    const Bounds cascade = boundsOf(volume.cascades.back().level.volume);
    if (!volume.mark || volume.cascades.size() == 1) return cascade;
    const Bounds common{glm::max(cascade.lo, volume.mark->bounds.lo), glm::min(cascade.hi, volume.mark->bounds.hi)};
    return glm::all(glm::lessThan(common.lo, common.hi)) ? common : cascade;
}

CameraPose overview(const Bounds& bounds, float aspect) {
    CameraPose pose;
    pose.target = bounds.center();
    // So far that the sphere around the volume touches the sides of the picture.
    const float half = std::atan(std::tan(0.5f * pose.yfov) * std::min(1.0f, aspect));
    const float distance = 0.5f * glm::length(bounds.extent()) / std::sin(half);
    pose.position = pose.target + distance * glm::normalize(glm::vec3(0.5f, 0.45f, 1.0f));
    return pose;
}

CameraPose poseOf(const Camera& camera) {
    return {camera.position, camera.position + camera.forward, camera.up, camera.yfov};
}

Camera cameraOf(const CameraPose& pose) {
    return {.name = "view", .position = pose.position, .forward = glm::normalize(pose.target - pose.position), .up = pose.up, .yfov = pose.yfov};
}

CameraPose parsePose(const std::string& text, const BakedVolume& volume, const Scene* scene) {
    const std::vector<double> n = numbersIn(text);
    if (n.size() != 6 && n.size() != 7) {
        if (scene) return poseOf(chooseCamera(*scene, text));
        throw InputError(fmt::format("--camera {}: expected px,py,pz,tx,ty,tz[,yfov], or a camera of the scene, which is not there", text));
    }
    CameraPose pose;
    pose.position = glm::vec3(glm::dvec3(n[0], n[1], n[2]) - volume.anchor);
    pose.target = glm::vec3(glm::dvec3(n[3], n[4], n[5]) - volume.anchor);
    if (n.size() == 7) pose.yfov = float(n[6]);
    const glm::vec3 along = pose.target - pose.position;
    if (!(glm::length(along) > 0.0f) || !(pose.yfov > 0.0f && pose.yfov < 3.14f))
        throw InputError(fmt::format("--camera {}: expected two different places, and an angle in (0, 3.14)", text));
    if (std::abs(glm::normalize(along).y) > 0.999f) pose.up = glm::vec3(0.0f, 0.0f, -1.0f);
    return pose;
}

void place(vtkCamera& camera, const CameraPose& pose) {
    camera.SetPosition(pose.position.x, pose.position.y, pose.position.z);
    camera.SetFocalPoint(pose.target.x, pose.target.y, pose.target.z);
    camera.SetViewUp(pose.up.x, pose.up.y, pose.up.z);
    camera.SetViewAngle(glm::degrees(pose.yfov));
}

}  // namespace clv
