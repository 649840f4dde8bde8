// Whole runs of the light pipeline in scenes that are built for one case.
#pragma once
#include <cmath>
#include <span>
#include <vector>

#include "bindings/cli/pipeline.h"
#include "bindings/cli/stress/stress_case.h"
#include "bindings/scene/scene_builder.h"
#include "bindings/scene/shapes.h"

namespace clv {

struct WholeRun {
    std::vector<glm::vec3> irradiance;  // W/m^2, a point each
    PipelineReport report;
};

inline WholeRun wholeRun(const Scene& scene, std::span<const ReferencePoint> points, const LightOptions& options, const StressSettings& settings) {
    WholeRun run;
    run.irradiance.resize(points.size());
    run.report = lightPoints(scene, options, settings.seed, settings.parallelFor, points, run.irradiance);
    return run;
}

// A fixed grid of about 16^3 cells.
inline LightOptions smallRun(std::uint64_t rays, bool allBounces) {
    LightOptions options;
    options.rays = rays, options.resolution = 16, options.allBounces = allBounces;
    return options;
}

// A closed cube, seen from inside.
inline void addRoom(SceneBuilder& builder, std::uint32_t material, double half = 1.0, const glm::dvec3& center = glm::dvec3(0.0)) {
    const BlockGrid grid{{center.x - half, center.x + half}, {center.y - half, center.y + half}, {center.z - half, center.z + half}, [](const glm::ivec3&) { return false; }, true};
    addBlocks(builder, grid, [=](const glm::ivec3&, const glm::ivec3&) { return material; });
}

// Evenly over the six walls of such a room.
inline std::vector<ReferencePoint> pointsOnWalls(double half = 1.0, const glm::dvec3& center = glm::dvec3(0.0)) {
    std::vector<ReferencePoint> points;
    constexpr int kSteps = 16;
    const auto along = [](int step) { return (double(step) + 0.5) * 2.0 / kSteps - 1.0; };
    for (int axis = 0; axis < 3; ++axis) {
        for (int k = 0; k < 2 * kSteps * kSteps; ++k) {
            glm::dvec3 p(0.0), n(0.0);
            p[axis] = k % 2 == 0 ? -1.0 : 1.0, n[axis] = -p[axis];
            p[(axis + 1) % 3] = along(k / 2 % kSteps), p[(axis + 2) % 3] = along(k / 2 / kSteps);
            points.push_back({glm::vec3(center + half * p), glm::vec3(n)});
        }
    }
    return points;
}

inline constexpr double kAlbedo = 0.5;  // of grey surfaces

// W a channel, of a point lamp of 1 W/sr.
inline constexpr double kLampPower = 4.0 * 3.14159265358979;

// Over all points and channels.
inline double meanOf(std::span<const glm::vec3> irradiance) {
    double sum = 0.0;
    for (const glm::vec3& e : irradiance) sum += double(e.x) + double(e.y) + double(e.z);
    return sum / (3.0 * double(irradiance.size()));
}

inline double percentOff(double value, double exact) { return 100.0 * std::abs(value / exact - 1.0); }

}  // namespace clv
