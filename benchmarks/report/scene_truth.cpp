#include "benchmarks/report/scene_truth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "benchmarks/report/checksum.h"
#include "benchmarks/report/kept_file.h"
#include "benchmarks/report/metrics.h"

namespace clv {
namespace {

namespace fs = std::filesystem;
constexpr std::uint32_t kPointSeed = 7;

// Of all that the truth depends on.
std::uint64_t checksumOf(const Scene& scene, std::span<const ReferencePoint> receivers, const TruthSettings& settings) {
    Checksum sum;
    sum.add(scene.positions), sum.add(scene.triangles), sum.add(scene.materialOf), sum.add(scene.uvs);
    for (const Material& material : scene.materials) sum.add(std::vector{material.albedo}), sum.add(std::vector{material.texture});
    for (const Texture& texture : scene.textures) sum.add(texture.texels), sum.add(std::vector{texture.width});
    for (const NamedLight& light : scene.lights) sum.add(std::vector{light.light});
    sum.add(std::as_bytes(receivers));
    sum.add(std::vector{settings.samples});
    return sum.value();
}

// Nothing where the file is missing or not what it should be: then the truth is found anew.
std::optional<nlohmann::json> readCache(const fs::path& file, std::size_t receivers) {
    std::ifstream input(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(input), {}};
    const nlohmann::json cache = nlohmann::json::from_cbor(bytes, true, false);
    const bool good = cache.is_object() && cache.contains("error") && cache.contains("irradiance") && cache.at("irradiance").size() == 3 * receivers;
    return good ? std::optional(cache) : std::nullopt;
}

void writeCache(const fs::path& file, const SceneTruth& truth) {
    nlohmann::json values = nlohmann::json::array();
    for (const glm::vec3& e : truth.irradiance) values.insert(values.end(), {e.x, e.y, e.z});
    std::string bytes;
    nlohmann::json::to_cbor({{"error", truth.error}, {"irradiance", values}}, bytes);
    keepFile(file, bytes);
}

}  // namespace

double truthError(std::span<const ReferenceResult> results) {
    double squares = 0.0;
    std::vector<glm::vec3> truth;
    for (const ReferenceResult& result : results) {
        squares += glm::dot(glm::dvec3(result.standardError), glm::dvec3(result.standardError));
        truth.push_back(result.irradiance);
    }
    return relativeTo(std::sqrt(squares / (3.0 * double(std::max<std::size_t>(1, results.size())))), meanIrradiance(truth));
}

SceneTruth findTruth(const EmbreeScene& scene, const TruthSettings& settings, const fs::path& folder, const ParallelFor& parallelFor,
                     const std::function<void(double)>& onProgress) {
    SceneTruth truth;
    for (const ClvReceiver& r : visiblePoints(scene, settings.points, kPointSeed)) truth.receivers.push_back({r.position, r.normal});
    truth.points = truth.receivers.size();
    if (truth.points == 0) throw InputError(fmt::format("{}: its cameras see nothing; expected points to measure at", scene.scene().name));
    const Camera& camera = scene.scene().cameras.front();
    truth.width = settings.pictureWidth;
    truth.height = std::max(1, int(std::lround(float(truth.width) / camera.aspect)));
    truth.surfaces = visibleSurfaces(scene, camera, truth.width, truth.height, parallelFor);
    for (const VisibleSurface& surface : truth.surfaces) truth.receivers.push_back(surface.point);

    const fs::path file = folder / fmt::format("{:016x}.truth", checksumOf(scene.scene(), truth.receivers, settings));
    if (const auto cache = readCache(file, truth.receivers.size())) {
        const auto& values = cache->at("irradiance");
        for (std::size_t i = 0; i < values.size(); i += 3) truth.irradiance.emplace_back(values[i].get<float>(), values[i + 1].get<float>(), values[i + 2].get<float>());
        truth.error = cache->at("error");
        return truth;
    }
    std::vector<ReferenceResult> results(truth.receivers.size());
    const ParallelFor watched = [&](std::size_t count, const std::function<void(std::size_t)>& body) {
        std::atomic<std::size_t> done = 0;
        parallelFor(count, [&](std::size_t i) {
            body(i);
            onProgress(double(++done) / double(count));
        });
    };
    referenceIrradiance(scene, truth.receivers, {.samplesPerPoint = settings.samples}, watched, results);
    for (const ReferenceResult& result : results) truth.irradiance.push_back(result.irradiance);
    truth.error = truthError(std::span(results).first(truth.points));
    writeCache(file, truth);
    return truth;
}

}  // namespace clv
