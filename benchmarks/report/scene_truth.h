// The path-traced truth of a scene: at points that its cameras see, where errors are measured, and in a small picture.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "bindings/embree/visible_points.h"

namespace clv {

struct TruthSettings {
    std::size_t points = 3000;
    int pictureWidth = 128;        // pixels; the height follows from the first camera
    std::uint64_t samples = 65536;  // paths a point
};

struct SceneTruth {
    std::vector<ReferencePoint> receivers;  // the points, and then the surfaces of the picture
    std::size_t points = 0;
    int width = 0, height = 0;
    std::vector<VisibleSurface> surfaces;   // of the picture
    std::vector<glm::vec3> irradiance;      // W/m^2 after one bounce, a receiver each
    double error = 0.0;                     // standard error at the points, relative to their mean

    // The parts of something that has a value for each receiver.
    std::span<const glm::vec3> atPoints(std::span<const glm::vec3> all) const { return all.first(points); }
    std::span<const glm::vec3> inPicture(std::span<const glm::vec3> all) const { return all.subspan(points); }
};

// Standard error of path-traced results, relative to their mean.
double truthError(std::span<const ReferenceResult> results);

// Kept in a file of `folder`, which must exist, and read from there the next time.
// `onProgress` is told the share of it that is done, from any thread.
SceneTruth findTruth(const EmbreeScene& scene, const TruthSettings& settings, const std::filesystem::path& folder, const ParallelFor& parallelFor,
                     const std::function<void(double)>& onProgress = [](double) {});

}  // namespace clv
