#include "bindings/embree/path_tracer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "bindings/embree/direct_light.h"
#include "clv/math/sampling.h"
#include "clv/math/sobol.h"

namespace clv {
namespace {

// Paths that advance together, bounce by bounce: their rays fill packets, and all that they need stays in the cache.
constexpr std::size_t kPaths = 256;
// Below 1, so that every path ends; this close to it, because weights may only grow by albedo / chance a bounce: their variance
// is finite while albedo^2 < chance.
constexpr float kLargestSurvivalChance = 0.999f;

// A point where a path met a surface.
struct Vertex {
    glm::vec3 position;
    glm::vec3 normal;  // unit length, on the side that the path came from
    glm::vec3 weight;  // irradiance at the receiver for a unit of irradiance here
    glm::vec3 albedo;
    std::uint32_t sample;
};

// Up to kPaths paths from one receiver.
class PathBundle {
public:
    PathBundle(const EmbreeScene& scene, std::uint32_t seed) : scene_(scene), seed_(seed) {}

    // The sum over samples [first, first + count) of their estimates of the irradiance, W/m^2.
    glm::dvec3 gather(const ReferencePoint& point, std::uint32_t first, std::size_t count, bool allBounces) {
        start(point, first, count);
        glm::dvec3 sum(0.0);
        for (std::uint32_t bounce = 1; count_ > 0; ++bounce) {
            meetSurfaces();
            for (const NamedLight& light : scene_.scene().lights) sum += directLight(light.light);
            if (!allBounces) break;
            scatter(bounce);
        }
        return sum;
    }

private:
    void start(const ReferencePoint& point, std::uint32_t first, std::size_t count) {
        count_ = count;
        for (std::size_t i = 0; i < count; ++i) {
            const auto sample = static_cast<std::uint32_t>(first + i);
            vertices_[i] = {.position = point.position, .normal = point.normal, .weight = glm::vec3(1.0f),
                            .albedo = glm::vec3(1.0f), .sample = sample};
            sendOn(i, vec2(clvSobolUnit(sample, 0u, seed_), clvSobolUnit(sample, 1u, seed_)));
        }
    }

    // The density of a cosine-weighted direction and the 1/pi of Lambert's law cancel against the cosine: the weight stays.
    void sendOn(std::size_t i, const vec2& u) {
        const Vertex& vertex = vertices_[i];
        rays_[i] = {.origin = vertex.position + vertex.normal * scene_.surfaceOffset(), .maxDistance = kClvFar,
                    .direction = clvCosineFromSquare(u, vertex.normal), .dynamicity = 0.0f, .flux = vertex.weight, .pad0 = 0.0f};
    }

    // Moves every path to its next vertex and drops those that leave the scene.
    void meetSurfaces() {
        scene_.trace(std::span(rays_).first(count_), std::span(hits_).first(count_));
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (hits_[i].distance >= kClvFar) continue;
            vertices_[kept++] = {.position = rays_[i].origin + rays_[i].direction * hits_[i].distance, .normal = hits_[i].normal,
                                 .weight = rays_[i].flux * hits_[i].albedo, .albedo = hits_[i].albedo, .sample = vertices_[i].sample};
        }
        count_ = kept;
    }

    // What one light adds at all vertices, shadows seen to.
    glm::dvec3 directLight(const ClvLight& light) {
        std::size_t asked = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Vertex& vertex = vertices_[i];
            const DirectLight arriving = directLightAt(light, vertex.position);
            const float cosine = glm::dot(arriving.towardsLight, vertex.normal);
            const glm::vec3 share = vertex.weight * arriving.irradiance * cosine;
            if (!(cosine > 0.0f) || share == glm::vec3(0.0f)) continue;
            const float offset = scene_.surfaceOffset();
            rays_[asked] = shadowRay(light, vertex.position + vertex.normal * offset, offset);
            rays_[asked++].flux = share;
        }
        scene_.killOccluded(std::span(rays_).first(asked));
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < asked; ++i) {
            if (rays_[i].maxDistance > 0.0f) sum += glm::dvec3(rays_[i].flux);
        }
        return sum;
    }

    // Russian roulette, and a new direction for those that survive.
    void scatter(std::uint32_t bounce) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            Vertex vertex = vertices_[i];
            const std::uint32_t stream = clvHashCombine(clvHashCombine(seed_, vertex.sample), bounce);
            const float chance = std::min(kLargestSurvivalChance, std::max({vertex.albedo.x, vertex.albedo.y, vertex.albedo.z}));
            if (clvUnitFloat(clvHashCombine(stream, 0u)) >= chance) continue;
            vertex.weight /= chance;
            vertices_[kept] = vertex;
            sendOn(kept++, vec2(clvUnitFloat(clvHashCombine(stream, 1u)), clvUnitFloat(clvHashCombine(stream, 2u))));
        }
        count_ = kept;
    }

    const EmbreeScene& scene_;
    std::uint32_t seed_;
    std::size_t count_ = 0;
    std::array<Vertex, kPaths> vertices_;
    std::array<ClvRay, kPaths> rays_;
    std::array<ClvHit, kPaths> hits_;
};

ReferenceResult estimate(const EmbreeScene& scene, const ReferencePoint& point, std::uint32_t pointSeed, const ReferenceOptions& options) {
    const std::uint64_t batches = std::min(kReferenceBatches, options.samplesPerPoint);
    glm::dvec3 sum(0.0), sumOfSquares(0.0);
    for (std::uint64_t batch = 0; batch < batches; ++batch) {
        const std::uint64_t size = (batch + 1) * options.samplesPerPoint / batches - batch * options.samplesPerPoint / batches;
        PathBundle paths(scene, clvHashCombine(pointSeed, static_cast<std::uint32_t>(batch)));
        glm::dvec3 batchSum(0.0);
        for (std::uint64_t first = 0; first < size; first += kPaths) {
            batchSum += paths.gather(point, static_cast<std::uint32_t>(first), std::min<std::uint64_t>(kPaths, size - first), options.allBounces);
        }
        const glm::dvec3 mean = batchSum / double(size);
        sum += mean;
        sumOfSquares += mean * mean;
    }
    constexpr float kUnknown = std::numeric_limits<float>::infinity(), kLargest = std::numeric_limits<float>::max();
    const glm::dvec3 mean = sum / double(batches);
    if (!(std::max({mean.x, mean.y, mean.z}) <= kLargest)) return {.irradiance = glm::min(mean, double(kLargest)), .standardError = glm::vec3(kUnknown)};
    if (batches < 2) return {.irradiance = mean, .standardError = glm::vec3(kUnknown)};
    // Clamped, because rounding can push the variance of equal means below zero.
    const glm::dvec3 variance = glm::max(glm::dvec3(0.0), sumOfSquares / double(batches) - mean * mean) / double(batches - 1);
    return {.irradiance = mean, .standardError = glm::sqrt(variance)};
}

}  // namespace

void referenceIrradiance(const EmbreeScene& scene, std::span<const ReferencePoint> points, const ReferenceOptions& options,
                         const ParallelFor& parallelFor, std::span<ReferenceResult> out) {
    assert(points.size() == out.size());
    assert(options.samplesPerPoint > 0);
    parallelFor(points.size(), [&](std::size_t i) {
        out[i] = estimate(scene, points[i], clvHashCombine(options.seed, static_cast<std::uint32_t>(i)), options);
    });
}

glm::vec3 directIrradiance(const EmbreeScene& scene, const glm::vec3& position, const glm::vec3& normal) {
    glm::vec3 sum(0.0f);
    for (const NamedLight& light : scene.scene().lights) {
        const DirectLight arriving = directLightAt(light.light, position);
        const float cosine = glm::dot(arriving.towardsLight, normal);
        const ClvRay ray = shadowRay(light.light, position + normal * scene.surfaceOffset(), scene.surfaceOffset());
        if (cosine > 0.0f && !scene.occluded(ray.origin, ray.direction, ray.maxDistance)) sum += arriving.irradiance * cosine;
    }
    return sum;
}

}  // namespace clv
