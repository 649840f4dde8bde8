#include "bindings/cli/camera_view.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bindings/cli/metrics.h"
#include "clv/math/constants.h"

namespace clv {

const Camera& chooseCamera(const Scene& scene, const std::string& nameOrIndex) {
    const auto named = std::ranges::find(scene.cameras, nameOrIndex, &Camera::name);
    if (named != scene.cameras.end()) return *named;
    std::size_t index = 0;
    const char* end = nameOrIndex.data() + nameOrIndex.size();
    const auto [rest, error] = std::from_chars(nameOrIndex.data(), end, index);
    if (error == std::errc() && rest == end && index < scene.cameras.size()) return scene.cameras[index];
    if (scene.cameras.empty()) throw InputError(fmt::format("{}: no cameras; expected one to look through", scene.name));
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) names.push_back(camera.name);
    throw InputError(fmt::format("--camera {}: expected an index below {} or one of: {}", nameOrIndex, names.size(), fmt::join(names, ", ")));
}

std::vector<VisibleSurface> visibleSurfaces(const EmbreeScene& scene, const Camera& camera, int width, int height,
                                            const ParallelFor& parallelFor) {
    const float tangent = std::tan(0.5f * camera.yfov);
    const glm::vec3 up = tangent * camera.up;
    const glm::vec3 right = tangent * float(width) / float(height) * glm::cross(camera.forward, camera.up);
    std::vector<std::vector<VisibleSurface>> rows{std::size_t(height)};
    parallelFor(rows.size(), [&](std::size_t y) {
        for (int x = 0; x < width; ++x) {
            const float across = 2.0f * (float(x) + 0.5f) / float(width) - 1.0f;
            const float upwards = 1.0f - 2.0f * (float(y) + 0.5f) / float(height);
            const glm::vec3 direction = glm::normalize(camera.forward + across * right + upwards * up);
            const ClvHit hit = scene.hit(camera.position, direction, kClvFar);
            if (hit.distance >= kClvFar) continue;
            const ReferencePoint point{camera.position + hit.distance * direction, hit.normal};
            rows[y].push_back({y * std::size_t(width) + std::size_t(x), point, hit.albedo});
        }
    });
    std::vector<VisibleSurface> surfaces;
    for (const auto& row : rows) surfaces.insert(surfaces.end(), row.begin(), row.end());
    return surfaces;
}

std::vector<ReferencePoint> pointsOf(std::span<const VisibleSurface> surfaces) {
    std::vector<ReferencePoint> points;
    points.reserve(surfaces.size());
    for (const VisibleSurface& surface : surfaces) points.push_back(surface.point);
    return points;
}

Image radianceImage(int width, int height, std::span<const VisibleSurface> surfaces, std::span<const glm::vec3> irradiance) {
    Image image(width, height);
    for (std::size_t i = 0; i < surfaces.size(); ++i) image.pixels[surfaces[i].pixel] = surfaces[i].albedo * irradiance[i] * kClvInvPi;
    return image;
}

std::vector<float> blockErrors(int width, int height, int block, std::span<const VisibleSurface> surfaces,
                               std::span<const glm::vec3> estimate, std::span<const glm::vec3> truth) {
    const auto pixelsAcross = std::size_t(width), blockSide = std::size_t(block);
    const std::size_t across = (pixelsAcross + blockSide - 1) / blockSide;

    struct Block {
        std::size_t index;
        float count = 0.0f;
    };
    // Blocks that see nothing are left out: they would count as dark ones.
    std::map<std::size_t, Block> blocks;
    std::vector<glm::vec3> blockEstimate, blockTruth;
    std::vector<std::size_t> blockOf;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const std::size_t x = surfaces[i].pixel % pixelsAcross, y = surfaces[i].pixel / pixelsAcross;
        Block& b = blocks.try_emplace(y / blockSide * across + x / blockSide, Block{blocks.size()}).first->second;
        blockOf.push_back(b.index);
        blockEstimate.resize(blocks.size());
        blockTruth.resize(blocks.size());
        b.count += 1.0f;
        blockEstimate[b.index] += (estimate[i] - blockEstimate[b.index]) / b.count;
        blockTruth[b.index] += (truth[i] - blockTruth[b.index]) / b.count;
    }
    const std::vector<float> errors = pointErrors(blockEstimate, blockTruth);
    std::vector<float> map(pixelsAcross * std::size_t(height), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < surfaces.size(); ++i) map[surfaces[i].pixel] = errors[blockOf[i]];
    return map;
}

}  // namespace clv
