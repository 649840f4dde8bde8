#include "viz/surface_shapes.h"

#include <algorithm>

#include <fmt/format.h>

#include "benchmarks/report/metrics.h"
#include "bindings/cli/progress.h"
#include "bindings/embree/path_tracer.h"
#include "clv/math/constants.h"
#include "viz/scene_mesh.h"
#include "viz/truth_error.h"

namespace clv {
namespace {

constexpr std::size_t kMeshParts = 60000;       // triangles that carry light
constexpr std::size_t kErrorParts = 6000;       // triangles that carry errors: each vertex is path traced
constexpr std::size_t kFewRays = 2000;          // where the view does not say how many

// body(i) for each vertex, many at a time.
template <class Body>
std::vector<vec3> perVertex(const SceneMesh& mesh, const ParallelFor& parallelFor, Body&& body) {
    constexpr std::size_t kPiece = 1024;
    std::vector<vec3> values(mesh.points.size());
    parallelFor((values.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
        for (std::size_t i = piece * kPiece; i < std::min(values.size(), (piece + 1) * kPiece); ++i) values[i] = body(i);
    });
    return values;
}

std::vector<vec3> readVolume(const BakedVolume& volume, const SceneMesh& mesh, const LookupOptions& lookup, const ParallelFor& parallelFor) {
    return perVertex(mesh, parallelFor, [&](std::size_t i) { return irradianceAt(volume, mesh.receivers[i], lookup); });
}

FlatTriangles shapeOf(const SceneMesh& mesh) {
    FlatTriangles shape;
    shape.points = mesh.points;
    shape.corners = mesh.triangles;
    return shape;
}

// Without direct light.
std::vector<ReferenceResult> pathTraced(const BakedVolume& volume, const World& world, const SceneMesh& mesh, std::uint64_t samples, const ParallelFor& parallelFor) {
    std::vector<ReferencePoint> points;
    for (const ClvReceiver& receiver : mesh.receivers) points.push_back({receiver.position, receiver.normal});
    std::vector<ReferenceResult> results(points.size());
    Progress progress("path tracing surfaces");
    referenceIrradiance(world.embree(), points, {.allBounces = volume.allBounces, .samplesPerPoint = samples}, Progress::watch(parallelFor, [&](double share) { progress.update(share); }), results);
    return results;
}

std::vector<vec3> irradianceOf(const std::vector<ReferenceResult>& results) {
    std::vector<vec3> irradiance;
    for (const ReferenceResult& result : results) irradiance.push_back(result.irradiance);
    return irradiance;
}

std::vector<float> standardErrorOf(const std::vector<ReferenceResult>& results) {
    std::vector<float> errors;
    for (const ReferenceResult& result : results) errors.push_back(glm::length(result.standardError));
    return errors;
}

// Colours of fluxes on the screen, brighter for more.
std::vector<glm::u8vec3> fluxColors(const std::vector<vec3>& flux, const Exposure& exposure) {
    std::vector<glm::u8vec3> colors;
    for (const vec3& f : flux) colors.push_back(screenColor(f, exposure));
    return colors;
}

}  // namespace

void drawMesh(const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    const SceneMesh mesh = meshOf(world.scene(), view.truth ? kErrorParts : kMeshParts, view.backs);
    const std::vector<vec3> indirect = !view.indirect ? std::vector<vec3>(mesh.points.size(), vec3(0.0f))
                                       : view.truth ? irradianceOf(pathTraced(volume, world, mesh, view.errorSamples, parallelFor))
                                                    : readVolume(volume, mesh, view.lookup, parallelFor);
    const std::vector<vec3> radiance = perVertex(mesh, parallelFor, [&](std::size_t i) {
        const ClvReceiver& receiver = mesh.receivers[i];
        const vec3 direct = view.direct ? directIrradiance(world.embree(), receiver.position, receiver.normal) : vec3(0.0f);
        return mesh.albedo[i] * (indirect[i] + direct) / kClvPi;
    });
    if (view.subject == Subject::mesh) drawing.caption = fmt::format("{}radiance of the surfaces under {}", view.truth ? "path tracing: " : "", view.indirect ? view.direct ? "direct and indirect light" : "indirect light" : view.direct ? "direct light" : "no light");
    drawing.mesh = shapeOf(mesh);
    drawing.exposure = view.fixedExposure.value_or(exposureFor(radiance, view.exposure));
    drawing.mesh.colors = fluxColors(radiance, *drawing.exposure);
}

void drawError(const BakedVolume& volume, const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    const SceneMesh mesh = meshOf(world.scene(), kErrorParts, view.backs);
    const std::vector<vec3> estimate = readVolume(volume, mesh, view.lookup, parallelFor);
    const std::vector<ReferenceResult> reference = pathTraced(volume, world, mesh, view.errorSamples, parallelFor);
    const std::vector<vec3> truth = irradianceOf(reference);
    const std::vector<float> errors = pointErrors(estimate, truth);
    drawing.caption = fmt::format("error of the volume at surfaces against path tracing, itself known to {:.1f} %", 100.0 * medianError(standardErrorOf(reference), truth));
    drawing.scale = scaleFor("error / truth", errors);
    if (view.range) drawing.scale->lo = view.range->x, drawing.scale->hi = view.range->y;
    drawing.mesh = shapeOf(mesh);
    for (const float error : errors) drawing.mesh.colors.push_back(drawing.scale->color(error));
}

void drawRays(const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    const std::vector<ClvRay> rays = world.rays(view.rays > 0 ? view.rays : kFewRays, 1, parallelFor);
    std::vector<vec3> flux;
    for (const ClvRay& ray : rays) flux.push_back(ray.flux);
    std::vector<glm::u8vec3> colors = fluxColors(flux, exposureFor(flux, view.exposure));
    if (view.rayColor == RayColor::dynamicity) {
        drawing.scale = ColorScale{.title = "dynamicity"};
        for (std::size_t i = 0; i < rays.size(); ++i) colors[i] = drawing.scale->color(rays[i].dynamicity);
    }
    for (std::size_t i = 0; i < rays.size(); ++i) drawing.lines.add(rays[i].origin, rays[i].origin + rays[i].maxDistance * rays[i].direction, colors[i]);
    if (view.subject == Subject::rays) drawing.caption = fmt::format("{} rays from lit surfaces, in the colour of their {}", rays.size(), view.rayColor == RayColor::flux ? "flux" : "dynamicity");
}

void drawTexels(const World& world, const View& view, const ParallelFor& parallelFor, Drawing& drawing) {
    std::vector<vec3> flux;
    for (const ClvRsmTexel& texel : world.texels(parallelFor)) {
        drawing.points.points.push_back(texel.position);
        flux.push_back(texel.flux);
    }
    drawing.points.colors = fluxColors(flux, exposureFor(flux, view.exposure));
    if (view.subject == Subject::texels) drawing.caption = fmt::format("{} lit texels of the lights' maps, in the colour of the flux that they reflect", flux.size());
}

}  // namespace clv
