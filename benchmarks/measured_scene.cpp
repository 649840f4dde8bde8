#include "benchmarks/measured_scene.h"

#include <cmath>

#include "bindings/embree/path_tracer.h"
#include "bindings/embree/visible_points.h"

namespace clv {

MeasuredScene measureScene(Scene scene, std::size_t points, std::uint64_t samples, const ParallelFor& parallelFor) {
    MeasuredScene measured{std::move(scene), {}, {}, 0.0};
    const EmbreeScene embree(measured.scene);
    for (const ClvReceiver& r : visiblePoints(embree, points, 7)) measured.points.push_back({r.position, r.normal});
    std::vector<ReferenceResult> truth(measured.points.size());
    ReferenceOptions options;
    options.samplesPerPoint = samples;
    referenceIrradiance(embree, measured.points, options, parallelFor, truth);
    double square = 0.0;
    for (const ReferenceResult& t : truth) {
        measured.truth.push_back(t.irradiance);
        square += glm::dot(t.standardError, t.standardError);
    }
    measured.truthError = relativeTo(std::sqrt(square / (3.0 * double(truth.size()))), meanIrradiance(measured.truth));
    return measured;
}

std::array<double, 3> cellShift(int k) {
    return {std::fmod(0.13 + 0.618034 * k, 1.0), std::fmod(0.57 + 0.414214 * k, 1.0), std::fmod(0.31 + 0.732051 * k, 1.0)};
}

MeasuredLight measureLight(const MeasuredScene& scene, const LightOptions& options, std::uint32_t seed, const ParallelFor& parallelFor) {
    MeasuredLight light;
    light.irradiance.resize(scene.points.size());
    light.report = lightPoints(scene.scene, options, seed, parallelFor, scene.points, light.irradiance);
    light.errors = summarizeErrors(light.irradiance, scene.truth);
    return light;
}

}  // namespace clv
