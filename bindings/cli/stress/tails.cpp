// Light that arrives by few of many rays: how noisy it is, whether the noise falls as it should, and what Russian roulette and clamping would do.
#include <algorithm>
#include <array>
#include <cmath>

#include "bindings/cli/stress/stress_case.h"
#include "bindings/cli/stress/walk_rays.h"
#include "bindings/embree/path_tracer.h"
#include "bindings/embree/rsm.h"
#include "bindings/scene/scene_builder.h"
#include "bindings/scene/shapes.h"
#include "clv/cpu/build_level.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/inject.h"
#include "clv/cpu/partial_volume.h"
#include "clv/cpu/rays.h"
#include "clv/math/sampling.h"
#include "clv/plan/cascade_placement.h"

namespace clv {
namespace {

constexpr int kRuns = 32;  // of other seeds

struct TailScene {
    std::function<void(SceneBuilder&, std::uint32_t material)> fill;
    ClvLight lamp;
    glm::dvec3 lampAt;
    glm::vec3 pointsLo, pointsHi;  // m: receivers lie on the surfaces in here
    int resolution;
    std::size_t rays;              // a run
    double mostBias;               // %
    float hole = 0.0f;             // m: the light comes through a hole that is a cube of this side around the origin, along the x axis
};

double meanOf(const glm::vec3& v) { return (double(v.x) + double(v.y) + double(v.z)) / 3.0; }

// Points spread over the surfaces inside a box.
std::vector<ReferencePoint> pointsIn(const Scene& scene, const glm::vec3& lo, const glm::vec3& hi, std::uint32_t seed) {
    std::vector<ReferencePoint> points;
    Random random(seed);
    for (int tries = 0; points.size() < 100 && tries < 100000; ++tries) {
        const glm::uvec3& t = scene.triangles[std::size_t(random.below(int(scene.triangles.size())))];
        const glm::vec3 a = scene.positions[t.x], b = scene.positions[t.y], c = scene.positions[t.z];
        float u = random.unit(), v = random.unit();
        if (u + v > 1.0f) u = 1.0f - u, v = 1.0f - v;
        const glm::vec3 p = a + u * (b - a) + v * (c - a);
        if (glm::all(glm::greaterThanEqual(p, lo)) && glm::all(glm::lessThanEqual(p, hi))) points.push_back({p, glm::normalize(glm::cross(b - a, c - a))});
    }
    return points;
}

// One scene, its level and its map: estimates at points from rays of any seed.
class Estimator {
public:
    Estimator(const TailScene& tail, const StressSettings& settings)
        : scene_(sceneOf(tail)), embree_(scene_), points_(pointsIn(scene_, tail.pointsLo, tail.pointsHi, settings.seed)), texels_(std::size_t(kMap) * kMap) {
        const glm::vec3 extent = scene_.bounds.extent();
        ClvVolume volume{};
        volume.cellSize = std::max({extent.x, extent.y, extent.z}) / (float(tail.resolution) - 0.6f);
        volume.origin = scene_.bounds.lo - 0.3f * volume.cellSize;
        for (int axis = 0; axis < 3; ++axis) volume.resolution[axis] = std::max(1, int(std::ceil(extent[axis] / volume.cellSize + 0.6f)));
        volume.storage = kClvStorageCube9;
        level_ = buildLevel(volume, embree_.probe(), {}, settings.parallelFor);
        partial_.resize(level_.slots.size(), layout_, false);
        weights_.resize(points_.size());
        for (std::size_t k = 0; k < points_.size(); ++k) lookupWeights(level_, {points_[k].position, 0.0f, points_[k].normal, 0.0f}, {}, weights_[k]);
        renderRsm(embree_, scene_.lights[0].light, kMap, 0, settings.seed, settings.parallelFor, texels_);
        sampler_.build(texels_, kMap, settings.parallelFor);
    }

    std::size_t count() const { return points_.size(); }
    std::vector<ClvRay> rays(std::size_t count, std::uint32_t seed) const {
        std::vector<ClvRay> rays(count);
        makeRays(sampler_, 0, clvHash(seed), embree_.surfaceOffset(), rays);
        embree_.trace(rays);
        return rays;
    }
    // Rays through the far end of the hole, one for each texel before it, of the flux that the texel sends there; and many for each texel in
    // it or beyond: the same light in mean, with little noise.
    std::vector<ClvRay> raysThroughHole(float side, std::uint32_t seed) const {
        constexpr int kMany = 64;
        Random random(seed);
        std::vector<ClvRay> rays;
        for (const ClvRsmTexel& texel : texels_) {
            if (texel.valid == 0u) continue;
            ClvRay ray{};
            ray.origin = texel.position + embree_.surfaceOffset() * texel.normal, ray.maxDistance = kClvFar;
            if (texel.position.x > -0.51f * side) {
                ray.flux = texel.flux / float(kMany);
                for (int k = 0; k < kMany; ++k) {
                    ray.direction = clvCosineFromSquare(vec2(random.unit(), random.unit()), texel.normal);
                    rays.push_back(ray);
                }
                continue;
            }
            const vec3 way = 0.5f * side * vec3(1.0f, random.signedUnit(), random.signedUnit()) - ray.origin;
            const float square = dot(way, way), cosine = dot(way, texel.normal) / std::sqrt(square), across = way.x / std::sqrt(square);
            ray.direction = way / std::sqrt(square);
            ray.flux = texel.flux * (std::max(cosine, 0.0f) * across * side * side / (square * kClvPi));
            if (cosine > 0.0f) rays.push_back(ray);
        }
        embree_.trace(rays);
        return rays;
    }
    std::vector<double> estimate(std::span<const ClvRay> rays, std::size_t count) {
        partial_.clear();
        inject(level_, layout_, kClvInjectTrackLength, rays, partial_.target());
        std::vector<double> e;
        for (std::size_t k = 0; k < points_.size(); ++k) {
            e.push_back(meanOf(readIrradiance(layout_, partial_.deposits, weights_[k], layout_.read(points_[k].normal))) / double(count));
        }
        return e;
    }
    // Every texel's light at every point, with a shadow ray: what the rays are a sample of, without a grid and without noise. Path tracing
    // would find the small bright spots too rarely.
    double meanTruth(const StressSettings& settings) const {
        std::vector<double> truth(points_.size());
        settings.parallelFor(points_.size(), [&](std::size_t k) {
            const float offset = embree_.surfaceOffset();
            const glm::vec3 at = points_[k].position + offset * points_[k].normal;
            for (const ClvRsmTexel& texel : texels_) {
                if (texel.valid == 0u) continue;
                const glm::vec3 from = texel.position + offset * texel.normal, way = from - at;
                const float square = glm::dot(way, way), distance = std::sqrt(square);
                const float in = glm::dot(way, points_[k].normal), out = -glm::dot(way, texel.normal);
                if (!(in > 0.0f && out > 0.0f) || embree_.occluded(at, way / distance, distance)) continue;
                truth[k] += meanOf(texel.flux) * double(in) * double(out) / (double(square) * double(square) * double(kClvPi));
            }
        });
        double sum = 0.0;
        for (double e : truth) sum += e / double(truth.size());
        return sum;
    }

private:
    static constexpr int kMap = 256;
    static Scene sceneOf(const TailScene& tail) {
        SceneBuilder builder("tail");
        const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(0.5f), -1});
        builder.beginNode("all");
        tail.fill(builder, grey);
        builder.addLight("lamp", tail.lamp, tail.lampAt);
        return std::move(builder).finish("tail");
    }

    Scene scene_;
    EmbreeScene embree_;
    std::vector<ReferencePoint> points_;
    std::vector<ClvRsmTexel> texels_;
    Level level_;
    DepositLayout layout_;
    PartialVolume partial_;
    std::vector<SlotWeights> weights_;
    TexelSampler sampler_;
};

// Runs of one size: the mean at all points, and the spread of the runs at each.
struct Spread {
    double mean = 0.0, noise = 0.0;  // noise: of a run, root mean square over the points, over the mean
    double clampedMean = 0.0, clampedNoise = 0.0;  // the same where a run counts for at most twice the mean at its point
    double largest = 0.0;            // of a run, over the mean at its point
    double standardError = 0.0;      // of the mean over runs and points, over it
};
Spread spreadOf(const std::vector<std::vector<double>>& runs) {
    const std::size_t points = runs[0].size();
    Spread spread;
    for (std::size_t k = 0; k < points; ++k) {
        double mean = 0.0, squares = 0.0, clamped = 0.0, clampedSquares = 0.0;
        for (const auto& run : runs) mean += run[k] / double(runs.size());
        for (const auto& run : runs) {
            const double cut = std::min(run[k], 2.0 * mean);
            squares += (run[k] - mean) * (run[k] - mean) / double(runs.size() - 1);
            clamped += cut / double(runs.size()), clampedSquares += cut * cut / double(runs.size());
            if (mean > 0.0) spread.largest = largerOf(spread.largest, run[k] / mean);
        }
        spread.mean += mean / double(points), spread.noise += squares / double(points);
        spread.clampedMean += clamped / double(points), spread.clampedNoise += (clampedSquares - clamped * clamped) / double(points);
    }
    double squares = 0.0;
    for (const auto& run : runs) {
        double mean = 0.0;
        for (double e : run) mean += e / double(points);
        squares += (mean - spread.mean) * (mean - spread.mean) / double(runs.size() - 1);
    }
    spread.standardError = std::sqrt(squares / double(runs.size())) / spread.mean;
    spread.noise = std::sqrt(spread.noise) / spread.mean;
    spread.clampedNoise = std::sqrt(std::max(0.0, spread.clampedNoise)) / spread.mean;
    return spread;
}

std::vector<StressFigure> heavyTail(const TailScene& tail, const StressSettings& settings) {
    Estimator estimator(tail, settings);
    const auto runsOf = [&](std::size_t rays) {
        std::vector<std::vector<double>> runs;
        for (int run = 0; run < kRuns; ++run) runs.push_back(estimator.estimate(estimator.rays(rays, settings.seed * 1000u + std::uint32_t(run)), rays));
        return spreadOf(runs);
    };
    const std::size_t rays = settings.exhaustive ? 16 * tail.rays : tail.rays;
    const Spread few = runsOf(rays), many = runsOf(4 * rays);
    const double truth = estimator.meanTruth(settings);
    std::vector<StressFigure> figures = {
            {"points", double(estimator.count())},
            {"noise of a run, % of the mean", 100.0 * few.noise},
            {"with four times the rays, over that", many.noise / few.noise, 0.7},
            {"the largest of 32 runs, over their mean", few.largest},
            {"standard error of the mean over runs and points, %", 100.0 * many.standardError},
            {"bias against the sum over all texels, beyond three of these, %", largerOf(0.0, 100.0 * std::abs(many.mean / truth - 1.0) - 300.0 * many.standardError), tail.mostBias},
            {"what clamping at twice the mean would take away, %", 100.0 * (1.0 - few.clampedMean / few.mean)},
            {"noise that it would leave, % of the mean", 100.0 * few.clampedNoise}};
    if (tail.hole > 0.0f) {
        std::vector<std::vector<double>> runs;
        for (std::uint32_t run = 0; run < 8; ++run) runs.push_back(estimator.estimate(estimator.raysThroughHole(tail.hole, settings.seed * 1000u + run), 1));
        const Spread through = spreadOf(runs);
        figures.push_back({"bias of rays that are sent through the hole, %", 100.0 * std::abs(through.mean / truth - 1.0), tail.mostBias});
        figures.push_back({"standard error of that, %", 100.0 * through.standardError});
    }
    return figures;
}

// A ray a texel, of flux spread over six orders of magnitude, as an engine might send: what roulette at the mean flux does to it.
std::vector<StressFigure> roulette(const StressSettings& settings) {
    TailScene tail = {[](SceneBuilder& b, std::uint32_t m) {
                          BlockGrid grid{{-1.0, 1.0}, {-1.0, 1.0}, {-1.0, 1.0}, [](const glm::ivec3&) { return false; }, true};
                          addBlocks(b, grid, [=](const glm::ivec3&, const glm::ivec3&) { return m; });
                      }, makePointLight(glm::vec3(1.0f)), {0.2, 0.1, -0.3}, glm::vec3(-2.0f), glm::vec3(2.0f), 16, 0, 0.0};
    Estimator estimator(tail, settings);
    const std::size_t count = 16384;
    std::vector<std::vector<double>> all, survivors;
    double alive = 0.0;
    for (int run = 0; run < kRuns; ++run) {
        std::vector<ClvRay> rays = estimator.rays(count, settings.seed * 1000u + std::uint32_t(run));
        Random random(settings.seed + std::uint32_t(run));
        double mean = 0.0;
        for (ClvRay& ray : rays) ray.flux *= std::pow(10.0f, -6.0f * random.unit()), mean += double(ray.flux.x) / double(count);
        all.push_back(estimator.estimate(rays, count));
        for (ClvRay& ray : rays) {
            const float factor = clvRoulette(ray.flux, float(mean), random.unit());
            ray.flux *= factor;
            if (factor == 0.0f) ray.maxDistance = 0.0f;
            alive += double(factor > 0.0f) / double(count * kRuns);
        }
        survivors.push_back(estimator.estimate(rays, count));
    }
    const Spread before = spreadOf(all), after = spreadOf(survivors);
    // Both estimates are of the same rays, so that their noise is too: what roulette adds is in the difference of the two.
    double mean = 0.0, squares = 0.0;
    std::array<double, kRuns> difference{};
    for (std::size_t run = 0; run < kRuns; ++run) {
        for (std::size_t k = 0; k < all[run].size(); ++k) difference[run] += (survivors[run][k] - all[run][k]) / double(all[run].size());
        mean += difference[run] / double(kRuns);
    }
    for (double one : difference) squares += (one - mean) * (one - mean) / double(kRuns - 1);
    const double standardError = std::sqrt(squares / double(kRuns));
    return {{"rays that survive, %", 100.0 * alive, 50.0},
            {"noise over that of all rays", after.noise / before.noise, 1.1},
            {"mean off by, %", 100.0 * std::abs(mean) / before.mean},
            {"standard error of that, %", 100.0 * standardError / before.mean, 0.2},
            {"mean off by, in standard errors of the difference", std::abs(mean) / standardError, 4.0}};
}

}  // namespace

std::vector<StressCase> tailCases() {
    const auto room = [](SceneBuilder& b, std::uint32_t m) {
        BlockGrid grid{{-1.0, 1.0}, {-1.0, 1.0}, {-1.0, 1.0}, [](const glm::ivec3&) { return false; }, true};
        addBlocks(b, grid, [=](const glm::ivec3&, const glm::ivec3&) { return m; });
    };
    const auto steppedFloor = [](SceneBuilder& b, std::uint32_t m) {
        b.addQuad({-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}, m);
        addBox(b, {3, 0.5, 0}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}, m);
    };
    // Two rooms of 2 x 2 x 2 m, and a hole of 10 x 10 cm through the wall of 10 cm between them.
    const auto rooms = [](SceneBuilder& b, std::uint32_t m) {
        BlockGrid grid{{-2.05, -0.05, 0.05, 2.05}, {-1.0, -0.05, 0.05, 1.0}, {-1.0, -0.05, 0.05, 1.0},
                       [](const glm::ivec3& k) { return k.x == 1 && (k.y != 1 || k.z != 1); }, true};
        addBlocks(b, grid, [=](const glm::ivec3&, const glm::ivec3&) { return m; });
    };
    const std::string claim = "noise falls with rays as where nothing is rare, and no bias is left but the grid's";
    const std::vector<std::pair<std::string, TailScene>> tails = {
        {"a lamp 1 mm from a wall", {room, makePointLight(glm::vec3(1.0f)), {0.999, 0.1, 0.2}, glm::vec3(-2.0f), glm::vec3(2.0f), 32, 4096, 2.0}},
        {"a map at a grazing angle of one degree", {steppedFloor, makeDirectionalLight({1.0, -0.0175, 0.0}, glm::vec3(1.0f)), {0.0, 0.0, 0.0}, glm::vec3(1.0f, -1.0f, -1.0f), glm::vec3(4.0f, 2.0f, 1.0f), 48, 4096, 10.0}},
        {"a hole of 10 cm between two rooms", {rooms, makePointLight(glm::vec3(1.0f)), {-1.0, 0.3, 0.2}, glm::vec3(0.06f, -2.0f, -2.0f), glm::vec3(3.0f, 2.0f, 2.0f), 32, 65536, 5.0, 0.1f}}};
    std::vector<StressCase> cases;
    for (const auto& [name, tail] : tails) cases.push_back({"tails", name, claim, [tail](const StressSettings& s) { return heavyTail(tail, s); }});
    cases.push_back({"tails", "roulette among rays of six orders of magnitude", "it keeps the mean, and spares half of the rays for a tenth more noise at most", roulette});
    return cases;
}

}  // namespace clv
