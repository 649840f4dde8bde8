#include "benchmarks/baselines/ddgi.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

#include "benchmarks/baselines/ddgi_probes.h"
#include "benchmarks/baselines/hit_shading.h"
#include "benchmarks/baselines/octahedral_maps.h"
#include "clv/math/sampling.h"
#include "clv/math/sobol.h"

namespace clv {
namespace {

// Texels of a probe's maps (Majercik et al. 2019).
using IrradianceMaps = OctahedralMaps<8, 3>;
using DistanceMaps = OctahedralMaps<16, 2>;  // mean and mean square, m and m^2
// Power of the cosine that weighs a ray's distance: distances are kept sharper than light (Majercik et al. 2019).
constexpr float kDistanceSharpness = 50.0f;
// Distances are cut at so many diagonals of the grid's cells: what lies further is never asked for (Majercik et al. 2019).
constexpr float kLongestDistance = 1.5f;
// Rays that measure distances once.
constexpr std::size_t kDistanceRays = 1024;

// A turn uniform over all turns (Shoemake 1992).
mat3 randomRotation(std::uint32_t seed, std::uint32_t frame) {
    const std::uint32_t stream = clvHashCombine(seed, frame);
    const float u = clvUnitFloat(clvHashCombine(stream, 0u));
    const float a = 2.0f * kClvPi * clvUnitFloat(clvHashCombine(stream, 1u)), b = 2.0f * kClvPi * clvUnitFloat(clvHashCombine(stream, 2u));
    const float r = std::sqrt(1.0f - u), s = std::sqrt(u);
    return glm::mat3_cast(glm::quat(s * std::cos(b), r * std::sin(a), r * std::cos(a), s * std::sin(b)));
}

// What one ray of a probe found.
struct RayLight {
    vec3 radiance;   // W/(m^2 sr)
    float distance;  // m
};

// weight(ray, texel), texels running fastest, divided by its sum over rays. All probes send the same rays, and share this.
template <class Maps, class Weight>
std::vector<float> texelWeights(std::span<const vec3> directions, const Weight& weight) {
    std::vector<float> weights(directions.size() * Maps::kTexels);
    for (int t = 0; t < Maps::kTexels; ++t) {
        const vec3 texel = Maps::direction(t);
        double sum = 0.0;
        for (std::size_t r = 0; r < directions.size(); ++r) sum += weights[r * Maps::kTexels + t] = weight(std::max(0.0f, dot(texel, directions[r])));
        for (std::size_t r = 0; r < directions.size(); ++r) weights[r * Maps::kTexels + t] *= sum > 0.0 ? float(1.0 / sum) : 0.0f;
    }
    return weights;
}

// Moves a probe's map towards this frame's, of which value(ray, channel) are the rays' shares: `share` of the way, in the encoded space.
template <class Maps, int Channels, class Value, class Encode>
void blend(Maps& maps, std::size_t probe, std::size_t rays, const std::vector<float>& weights, float share, const Value& value, const Encode& encode) {
    alignas(64) float sum[Channels][Maps::kTexels] = {};
    for (std::size_t r = 0; r < rays; ++r) {
        const float* __restrict weight = weights.data() + r * Maps::kTexels;
        for (int c = 0; c < Channels; ++c) {
            const float v = value(r, c);
            for (int t = 0; t < Maps::kTexels; ++t) sum[c][t] += weight[t] * v;
        }
    }
    for (int t = 0; t < Maps::kTexels; ++t) {
        float* texel = maps.texel(probe, t);
        for (int c = 0; c < Channels; ++c) texel[c] += share * (encode(sum[c][t]) - texel[c]);
    }
    maps.fillBorder(probe);
}

class Ddgi : public Method {
public:
    explicit Ddgi(const DdgiSettings& settings) : settings_(settings) {}

    std::string name() const override { return "ddgi"; }
    MethodSettings settings() const override {
        return {{"resolution", std::to_string(settings_.resolution)},
                {"grid_shift", gridShiftText(settings_.gridShift)},
                {"readers", readersName(settings_.readers)},
                {"hysteresis", fmt::format("{:g}", settings_.hysteresis)},
                {"encoding", fmt::format("{:g}", settings_.encoding)},
                {"distances", settings_.distancesOnce ? "once" : "each frame"},
                {"rays", settings_.turnedRays ? "turned" : "sequence"},
                {"weights", keepsWeights() ? "kept" : "at each reading"}};
    }

    void prepare(const MethodWorld& world, std::span<const ReferencePoint> receivers) override {
        world_.emplace(world);
        receivers_.assign(receivers.begin(), receivers.end());
        probes_.place(world, settings_.resolution, settings_.gridShift, settings_.readers, receivers);
        distance_.clear(probes_.positions().size());
        if (settings_.distancesOnce) measureDistances();
        cages_.resize(keepsWeights() ? receivers_.size() : 0);
        forReceivers(cages_.size(), [&](std::size_t i) { cages_[i] = weighedCage(receivers_[i]); });
        restart(1);
    }

    void restart(std::uint32_t seed) override {
        seed_ = seed;
        frames_ = aimed_ = 0;
        traced_ = 0;
        irradiance_.clear(probes_.positions().size());
        if (!settings_.distancesOnce) distance_.clear(probes_.positions().size());
    }

    void frame(std::size_t rays) override {
        const std::size_t probes = probes_.positions().size();
        if (probes == 0) return;
        aimRays(std::max<std::size_t>(1, rays / probes));
        light_.resize(probes * directions_.size());
        traceRays();
        const float share = std::max(1.0f - settings_.hysteresis, 1.0f / float(++frames_));
        const auto weights = texelWeights<IrradianceMaps>(directions_, [](float cosine) { return cosine; });
        forProbes([&](std::size_t probe) { blendIrradiance(probe, weights, share); });
        if (!settings_.distancesOnce) blendDistances(share);
    }

    void irradiance(std::span<glm::vec3> out) override {
        forReceivers(out.size(), [&](std::size_t i) {
            out[i] = frames_ > 0 ? lookUp(receivers_[i].normal, keepsWeights() ? cages_[i] : weighedCage(receivers_[i])) : vec3(0.0f);
        });
    }

    std::size_t bytes() const override {
        return irradiance_.bytes() + distance_.bytes() + probes_.bytes() + light_.size() * sizeof(RayLight) + cages_.size() * sizeof(ProbeCage);
    }
    std::uint64_t raysTraced() const override { return traced_; }

private:
    bool keepsWeights() const { return settings_.keptWeights && settings_.distancesOnce; }

    template <class Body>
    void forReceivers(std::size_t count, const Body& body) const {
        forPieces(*world_, count, 256, body);
    }

    template <class Body>
    void forProbes(const Body& body) {
        forPieces(*world_, probes_.positions().size(), 64, body);
    }

    // The directions of the next frame's rays, the same from every probe.
    void aimRays(std::size_t count) {
        const mat3 turn = randomRotation(seed_, frames_);
        directions_.resize(count);
        for (std::size_t k = 0; k < count; ++k) {
            const std::uint32_t index = aimed_ + std::uint32_t(k);
            directions_[k] = settings_.turnedRays ? turn * fibonacciDirection(k, count)
                                                  : clvSphereFromSquare(vec2(clvSobolUnit(index, 0u, seed_), clvSobolUnit(index, 1u, seed_)));
        }
        aimed_ += std::uint32_t(count);
    }

    // Rays of all probes, one probe's after the other's.
    ClvRay probeRay(std::size_t k) const {
        return {.origin = probes_.positions()[k / directions_.size()], .maxDistance = kClvFar, .direction = directions_[k % directions_.size()],
                .dynamicity = 0.0f, .flux = vec3(0.0f), .pad0 = 0.0f};
    }
    float cutDistance(float distance) const { return std::min(distance, kLongestDistance * std::sqrt(3.0f) * probes_.spacing()); }

    void traceRays() {
        world_->parallelFor((light_.size() + kShadedRays - 1) / kShadedRays, [&](std::size_t block) {
            const std::size_t first = block * kShadedRays, count = std::min(kShadedRays, light_.size() - first);
            std::array<ClvRay, kShadedRays> rays;
            std::array<ClvHit, kShadedRays> hits;
            std::array<vec3, kShadedRays> radiance;
            for (std::size_t k = 0; k < count; ++k) rays[k] = probeRay(first + k);
            traced_ += traceAndShade(world_->scene, std::span(rays).first(count), std::span(hits).first(count), std::span(radiance).first(count));
            for (std::size_t k = 0; k < count; ++k) light_[first + k] = {radiance[k], cutDistance(hits[k].distance)};
        });
    }

    void measureDistances() {
        const std::size_t probes = probes_.positions().size();
        for (std::size_t k = 0; k < kDistanceRays; ++k) directions_.push_back(fibonacciDirection(k, kDistanceRays));
        const auto weights = distanceWeights();
        world_->parallelFor(probes, [&](std::size_t probe) {
            std::vector<ClvRay> rays(kDistanceRays);
            for (std::size_t k = 0; k < kDistanceRays; ++k) rays[k] = probeRay(probe * kDistanceRays + k);
            world_->scene.trace(rays);
            blendDistance(probe, weights, 1.0f, [&](std::size_t r) { return cutDistance(rays[r].maxDistance); });
        });
    }
    void blendDistances(float share) {
        const auto weights = distanceWeights();
        const std::size_t rays = directions_.size();
        forProbes([&](std::size_t probe) { blendDistance(probe, weights, share, [&](std::size_t r) { return light_[probe * rays + r].distance; }); });
    }
    std::vector<float> distanceWeights() const {
        return texelWeights<DistanceMaps>(directions_, [](float cosine) { return std::pow(cosine, kDistanceSharpness); });
    }
    template <class Distance>
    void blendDistance(std::size_t probe, const std::vector<float>& weights, float share, const Distance& distance) {
        const auto moment = [&](std::size_t r, int order) { return order == 0 ? distance(r) : distance(r) * distance(r); };
        blend<DistanceMaps, 2>(distance_, probe, directions_.size(), weights, share, moment, [](float x) { return x; });
    }

    // Irradiance is pi times the mean of radiance, weighed by the cosine (Majercik et al. 2019).
    void blendIrradiance(std::size_t probe, const std::vector<float>& weights, float share) {
        const RayLight* light = light_.data() + probe * directions_.size();
        const auto value = [&](std::size_t r, int c) { return light[r].radiance[c] * kClvPi; };
        const float power = 1.0f / settings_.encoding;
        const auto encode = [&](float e) { return power == 1.0f ? e : std::pow(e, power); };
        blend<IrradianceMaps, 3>(irradiance_, probe, directions_.size(), weights, share, value, encode);
    }

    // The probes that a receiver reads; weights sum to 1, or are all 0 where no probe stands.
    ProbeCage weighedCage(const ReferencePoint& receiver) const {
        const vec3 point = probes_.biased(receiver.position, receiver.normal);
        ProbeCage cage = probes_.cageAround(point);
        float total = 0.0f;
        for (int k = 0; k < 8; ++k) {
            cage.weight[k] = cage.probe[k] == kNoProbe ? 0.0f : cage.weight[k] * visibility(cage.probe[k], point, receiver);
            total += cage.weight[k];
        }
        for (float& weight : cage.weight) weight = total > 0.0f ? weight / total : 0.0f;
        return cage;
    }

    vec3 lookUp(const vec3& normal, const ProbeCage& cage) const {
        // Encoded irradiance is mixed as its square root, about as bright as it looks.
        const float decode = settings_.encoding == 1.0f ? 1.0f : 0.5f * settings_.encoding;
        const auto place = IrradianceMaps::place(normal);
        vec3 mean(0.0f);
        for (int k = 0; k < 8; ++k) {
            if (!(cage.weight[k] > 0.0f)) continue;
            const auto stored = irradiance_.read(cage.probe[k], place);
            const vec3 value(stored[0], stored[1], stored[2]);
            mean += cage.weight[k] * (decode == 1.0f ? value : glm::pow(value, vec3(decode)));
        }
        return decode == 1.0f ? mean : mean * mean;
    }

    // How much a probe tells of the light at a receiver (Majercik et al. 2019).
    float visibility(std::uint32_t probe, const vec3& point, const ReferencePoint& receiver) const {
        const vec3 position = probes_.positions()[probe];
        // Probes behind the surface tell little, but are not ruled out: small bumps would lose all of theirs.
        const float facing = 0.5f * (dot(normalize(position - receiver.position), receiver.normal) + 1.0f);
        float weight = facing * facing + 0.2f;
        // The chance, at most, that what the probe sees in this direction is as far as the point (Chebyshev), sharpened.
        const vec3 fromProbe = point - position;
        const float distance = length(fromProbe);
        const auto [mean, meanSquare] = distance_.read(probe, fromProbe / distance);
        if (distance > mean) {
            const float variance = std::abs(meanSquare - mean * mean), beyond = distance - mean;
            const float chance = variance / (variance + beyond * beyond);
            weight *= chance * chance * chance;
        }
        // Never 0, so that a point that no probe sees still has some light; small weights are crushed, as the eye would notice their light.
        weight = std::max(1e-6f, weight);
        constexpr float kCrushed = 0.2f;
        return weight < kCrushed ? weight * weight * weight / (kCrushed * kCrushed) : weight;
    }

    const DdgiSettings settings_;
    std::optional<MethodWorld> world_;
    std::vector<ReferencePoint> receivers_;
    DdgiProbes probes_;
    std::vector<ProbeCage> cages_;  // a receiver each, where weights are kept
    IrradianceMaps irradiance_;  // W/m^2, encoded
    DistanceMaps distance_;
    std::vector<vec3> directions_;  // of a frame's rays, from every probe
    std::vector<RayLight> light_;   // that they found
    std::uint32_t seed_ = 1, frames_ = 0;
    std::uint32_t aimed_ = 0;  // rays of each probe, so far
    std::atomic<std::uint64_t> traced_ = 0;
};

}  // namespace

std::unique_ptr<Method> makeDdgi(const DdgiSettings& settings) {
    return std::make_unique<Ddgi>(settings);
}

}  // namespace clv
