// Sizes at their ends: maps of one texel and of 8192 x 8192, scenes of ten million triangles.
#include <algorithm>
#include <chrono>
#include <cmath>

#include <sys/resource.h>

#include "bindings/cli/stress/whole_run.h"
#include "bindings/embree/rsm.h"
#include "clv/cpu/rays.h"
#include "clv/math/hash.h"

namespace clv {
namespace {

double secondsSince(std::chrono::steady_clock::time_point start) { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

StressFigure mostMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return {"most memory of the process so far, GiB", double(usage.ru_maxrss) / 1048576.0};
}

// A lamp of 1 W/sr in a closed room: its map must hold what the walls send on, whatever its size, and rays must be drawn from it.
std::vector<StressFigure> map(int side, const StressSettings& settings) {
    SceneBuilder builder("room");
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(float(kAlbedo)), -1});
    builder.beginNode("room");
    addRoom(builder, grey);
    builder.addLight("lamp", makePointLight(glm::vec3(1.0f)), {0.2, 0.1, -0.3});
    const Scene scene = std::move(builder).finish("room");
    const EmbreeScene embree(scene);
    const auto start = std::chrono::steady_clock::now();
    std::vector<ClvRsmTexel> texels(std::size_t(side) * std::size_t(side));
    renderRsm(embree, scene.lights[0].light, side, 0, settings.seed, settings.parallelFor, texels);
    TexelSampler sampler;
    sampler.build(texels, side, settings.parallelFor);
    std::vector<ClvRay> rays(100'000);
    makeRays(sampler, 0, settings.seed, 1e-4f, rays);
    double bad = 0.0, flux = 0.0;
    for (const ClvRay& ray : rays) {
        bad += !clvIsFinite(ray.origin) || !clvIsFinite(ray.direction) || !clvIsFinite(ray.flux);
        flux += double(ray.flux.x) / double(rays.size());
    }
    const double exact = kAlbedo * kLampPower;
    return {{"rays that are not finite", bad, 0.0},
            {"flux of the map, off by", std::abs(sampler.totalFlux() / (3.0 * exact) - 1.0), 1e-6},
            {"flux of its rays, off by", std::abs(flux / exact - 1.0), 1e-6},
            {"s", secondsSince(start)},
            mostMemory()};
}

// Hills of 2 * steps^2 triangles, 100 m across, wide enough for cells of 0.7 m, under a sun.
std::vector<StressFigure> hills(int steps, const StressSettings& settings) {
    SceneBuilder builder("hills");
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(float(kAlbedo)), -1});
    builder.beginNode("hills");
    for (int row = 0; row <= steps; ++row) {
        for (int column = 0; column <= steps; ++column) {
            const double x = 100.0 * column / steps - 50.0, z = 100.0 * row / steps - 50.0;
            builder.addVertex({x, 4.0 * std::sin(0.31 * x) * std::cos(0.23 * z), z});
        }
    }
    const auto corner = [&](int row, int column) { return std::uint32_t(row) * std::uint32_t(steps + 1) + std::uint32_t(column); };
    for (int row = 0; row < steps; ++row) {
        for (int column = 0; column < steps; ++column) {
            builder.addTriangle(corner(row, column), corner(row + 1, column), corner(row, column + 1), grey);
            builder.addTriangle(corner(row, column + 1), corner(row + 1, column), corner(row + 1, column + 1), grey);
        }
    }
    builder.addLight("sun", makeDirectionalLight({0.5, -1.0, 0.2}, glm::vec3(1.0f)), {0.0, 0.0, 0.0});
    const Scene scene = std::move(builder).finish("hills");
    std::vector<ReferencePoint> points;
    const std::size_t stride = scene.triangles.size() / 1000;
    for (std::size_t k = 0; k < 1000; ++k) {
        const std::size_t t = k * stride + clvHash(uint(k)) % stride;  // in no step with the rows
        const glm::vec3 a = scene.positions[scene.triangles[t].x], b = scene.positions[scene.triangles[t].y], c = scene.positions[scene.triangles[t].z];
        points.push_back({(a + b + c) / 3.0f, glm::normalize(glm::cross(b - a, c - a))});
    }
    LightOptions options;
    options.rays = 1 << 20, options.resolution = 64;
    const auto start = std::chrono::steady_clock::now();
    const std::vector<glm::vec3> irradiance = wholeRun(scene, points, options, settings).irradiance;
    const StressFigure seconds{"s", secondsSince(start)};
    const EmbreeScene embree(scene);
    std::vector<ReferenceResult> truth(points.size());
    referenceIrradiance(embree, points, {.samplesPerPoint = 256, .seed = settings.seed}, settings.parallelFor, truth);
    double expected = 0.0, variance = 0.0;
    for (const ReferenceResult& e : truth) {
        expected += double(e.irradiance.x) / double(points.size());
        variance += std::pow(double(e.standardError.x) / double(points.size()), 2.0);
    }
    return {{"triangles", double(scene.triangles.size())},
            {"mean off that of path tracing, %", largerOf(0.0, percentOff(meanOf(irradiance), expected) - 300.0 * std::sqrt(variance) / expected), 3.0},
            seconds,
            mostMemory()};
}

}  // namespace

std::vector<StressCase> extremeCases() {
    return {{"extreme", "a map of one texel", "its rays are finite and carry what it holds", [](const StressSettings& s) { return map(1, s); }},
            {"extreme", "a map of 8192 x 8192 texels", "it holds what the walls send on (512 x 512 unless exhaustive)", [](const StressSettings& s) { return map(s.exhaustive ? 8192 : 512, s); }},
            {"extreme", "hills of ten million triangles", "the light is that of path tracing (20,000 unless exhaustive)", [](const StressSettings& s) { return hills(s.exhaustive ? 2237 : 100, s); }}};
}

}  // namespace clv
