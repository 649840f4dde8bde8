#include "bindings/cli/light_walk.h"

#include <algorithm>
#include <cmath>

#include "bindings/embree/surface_order.h"
#include "clv/math/hash.h"
#include "clv/stages/rays.h"
#include "clv/stages/rsm.h"

namespace clv {
namespace {

constexpr double kFewestRays = 32.0, kFewestShare = 16.0;  // of a bounce, and one in so many where there are no more
constexpr double kReserved = 128.0;                // one ray in so many spreads what is left, and as many stand for it
constexpr double kNegligible = 1e-5;               // share of all light at which the rest is extrapolated
constexpr double kLeastLater = 0.02, kMostLater = 0.95;  // share of the rays left to later bounces by the first call, which does not know how much light they have

double total(const glm::dvec3& v) { return v.x + v.y + v.z; }

glm::dvec3 fluxOf(std::span<const ClvRsmTexel> emitters) {
    glm::dvec3 sum(0.0);
    for (const ClvRsmTexel& texel : emitters) sum += glm::dvec3(texel.flux);
    return sum;
}

// By which the power of each channel falls from bounce to bounce, over the later half of them.
glm::dvec3 paceOf(std::span<const glm::dvec3> power) {
    glm::dvec3 before(0.0), after(0.0), pace(0.0);
    for (std::size_t k = (power.size() - 1) / 2; k + 1 < power.size(); ++k) before += power[k], after += power[k + 1];
    for (int c = 0; c < 3; ++c) pace[c] = before[c] > 0.0 ? after[c] / before[c] : 0.0;
    return pace;
}

}  // namespace

void addLit(std::span<const ClvRay> rays, std::span<const ClvHit> hits, float share, std::vector<ClvRsmTexel>& lit) {
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const ClvRsmTexel texel = clvRsmTexelFromHit(rays[k], hits[k], share);
        if (clvTexelWeight(texel) > 0.0f) lit.push_back(texel);
    }
}

// The light of the places that the last bounce lit, sent on with `count` rays.
void LightWalk::step(std::size_t count, std::uint32_t seed) {
    sortAlongSurfaces(lit_, bounds_);
    lit_.resize((lit_.size() + kEmitterWidth - 1) / kEmitterWidth * kEmitterWidth, ClvRsmTexel{});
    lighting_.emit(lit_);
    const std::size_t first = rays_.size();
    bounceEnds_.push_back(first + count);
    rays_.resize(first + count);
    hits_.resize(count);
    const auto drawn = std::span(rays_).subspan(first);
    lighting_.draw(clvHashCombine(seed, uint(first)), drawn, hits_);
    lit_.clear();
    addLit(drawn, hits_, 1.0f / float(count), lit_);
    power_.push_back(fluxOf(lit_));
}

// Light of channels that do not lose any is given up after some bounces.
void LightWalk::heedLimit() {
    if (int(bounceEnds_.size()) + 1 != kLastWithoutLimit) return;
    const glm::dvec3 pace = paceOf(power_);
    pace_ = glm::max(pace_, pace);
    for (int c = 0; c < 3; ++c) {
        if (pace[c] < kLargestRatio) continue;
        limitless_ = true;
        for (ClvRsmTexel& texel : lit_) texel.flux[c] = 0.0f;
    }
    power_.back() = fluxOf(lit_);
}

std::vector<ClvRay> LightWalk::follow(std::span<const ClvRsmTexel> lit, std::size_t count, std::uint32_t seed) {
    lit_.assign(lit.begin(), lit.end());
    rays_.clear(), bounceEnds_.clear();
    power_ = {fluxOf(lit_)};
    const double fewest = std::clamp(double(count) / kFewestShare, 1.0, kFewestRays);
    const double reserve = std::max(fewest, double(count) / kReserved);  // rays of each of the last two steps
    const double budget = double(count) - 2.0 * reserve;
    const double expected = first_ > 0.0 ? total(power_[0]) * all_ / first_ : 0.0;  // W of all bounces
    double sum = 0.0;
    bool little = false;
    while (total(power_.back()) > 0.0) {
        const double now = total(power_.back()), left = budget - double(rays_.size());
        const glm::dvec3 pace = power_.size() > 1 ? paceOf(power_) : glm::dvec3(0.5);
        const double later = std::clamp(total(power_.back() * pace) / now, kLeastLater, kMostLater);
        little = power_.size() > 2 && now < kNegligible * (1.0 - std::min(later, kLargestRatio)) * sum;
        const double wanted = std::max(expected > 0.0 ? std::min(budget * now / expected, left * (1.0 - later)) : left * (1.0 - later), fewest);
        if (wanted > left || little) break;
        sum += now;
        step(std::size_t(wanted), seed);
        heedLimit();
    }
    // What is left falls in a geometric series, from many places: few would be bright spots.
    if (total(power_.back()) > 0.0) {
        sum += total(power_.back());
        step(std::size_t(little ? fewest : reserve), seed);
        const glm::dvec3 pace = glm::min(paceOf(power_), kLargestRatio);
        for (ClvRsmTexel& texel : lit_) texel.flux /= vec3(1.0 - pace);
        if (const double rest = total(fluxOf(lit_)); rest > 0.0) {
            sum += rest;
            step(std::size_t(little ? fewest : std::max(double(count) - double(rays_.size()), fewest)), seed);
            power_.pop_back();
        }
    }
    // The mean of all rays is the sum of the bounces.
    for (std::size_t k = 0, first = 0; k < bounceEnds_.size(); first = bounceEnds_[k++]) {
        const float scale = float(double(rays_.size()) / double(bounceEnds_[k] - first));
        for (ClvRay& ray : std::span(rays_).subspan(first, bounceEnds_[k] - first)) ray.flux *= scale;
    }
    first_ += double(count) * total(power_[0]), all_ += double(count) * sum;
    bounces_ = std::max(bounces_, int(bounceEnds_.size()) + 1);
    pace_ = glm::max(pace_, paceOf(power_));
    return std::move(rays_);
}

}  // namespace clv
