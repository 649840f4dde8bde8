#include "bindings/cli/light_walk.h"

#include <algorithm>
#include <cmath>

#include "bindings/embree/surface_order.h"
#include "clv/math/hash.h"
#include "clv/stages/rays.h"
#include "clv/stages/rsm.h"

namespace clv {
namespace {

constexpr double kLeastLoss = 5e-4;        // share of a channel's power from bounce to bounce below which its sum has no stable limit
constexpr double kFewestRays = 32.0;       // of a bounce, where there are as many
constexpr double kFewestSteps = 16.0;      // that the rays suffice for, else
constexpr double kForDimPlaces = 0.0625;   // of all rays: what is left for places whose light goes on when that of bright ones is gone
constexpr double kReserved = 128.0;        // one ray in so many spreads what is left, and as many stand for it
constexpr double kNegligible = 1e-5;       // share of all light at which the rest is extrapolated
constexpr double kLeastLater = 0.02, kMostLater = 0.95;  // share of the rays left to later bounces by the first call, which does not know how much light they have

double total(const glm::dvec3& v) { return v.x + v.y + v.z; }

// Power of each channel in the later half of the bounces, and what is left of it a bounce later.
struct Fall {
    glm::dvec3 before{0.0}, after{0.0};
};
Fall fallOf(std::span<const glm::dvec3> power) {
    Fall fall;
    for (std::size_t k = (power.size() - 1) / 2; k + 1 < power.size(); ++k) fall.before += power[k], fall.after += power[k + 1];
    return fall;
}

}  // namespace

void addLit(std::span<const ClvRay> rays, std::span<const ClvHit> hits, float share, LitPlaces& lit) {
    for (std::size_t k = 0; k < rays.size(); ++k) {
        lit.sent += glm::dvec3(rays[k].flux) * double(share);
        const ClvRsmTexel texel = clvRsmTexelFromHit(rays[k], hits[k], share);
        if (clvTexelWeight(texel) > 0.0f) lit.texels.push_back(texel);
    }
}

glm::dvec3 fluxOf(std::span<const ClvRsmTexel> texels) {
    glm::dvec3 sum(0.0);
    for (const ClvRsmTexel& texel : texels) sum += glm::dvec3(texel.flux);
    return sum;
}

// The light of the places that the last bounce lit, sent on with `count` rays.
void LightWalk::step(std::size_t count, std::uint32_t seed) {
    sortAlongSurfaces(lit_.texels, bounds_);
    lit_.texels.resize((lit_.texels.size() + kEmitterWidth - 1) / kEmitterWidth * kEmitterWidth, ClvRsmTexel{});
    lighting_.emit(lit_.texels);
    const std::size_t first = rays_.size();
    bounceEnds_.push_back(first + count);
    rays_.resize(first + count);
    hits_.resize(count);
    const auto drawn = std::span(rays_).subspan(first);
    lighting_.draw(clvHashCombine(seed, uint(first)), drawn, hits_);
    lit_ = {};
    addLit(drawn, hits_, 1.0f / float(count), lit_);
    power_.push_back(fluxOf(lit_.texels));
}

// By all rays that brought and followed this channel: some of the few of later bounces alone lose nothing by chance.
bool LightWalk::losesNothing(int c) const {
    double before = 0.0, after = 0.0;
    for (std::size_t k = 0; k + 1 < power_.size(); ++k) before += power_[k][c], after += power_[k + 1][c];
    return before > 0.0 && after > (1.0 - kLeastLoss) * before && kept_[c] > 1.0 - kLeastLoss;
}

// After the last bounce that is given without a limit, channels that lose nothing end.
void LightWalk::endLimitless() {
    if (int(bounceEnds_.size()) + 1 != kLastWithoutLimit) return;
    const Fall fall = fallOf(power_);
    for (int c = 0; c < 3; ++c) {
        if (!losesNothing(c)) continue;
        limitless_ = true, endlessPace_[c] = fall.after[c] / fall.before[c];
        for (ClvRsmTexel& texel : lit_.texels) texel.flux[c] = 0.0f;
        power_.back()[c] = 0.0;
    }
}

// What the last bounce lit stands for all later bounces. Of a channel whose few rays lost nothing by chance half of a ray counts as lost.
void LightWalk::extrapolate() {
    const Fall fall = fallOf(power_);
    const int given = int(bounceEnds_.size()) + 1;
    for (int c = 0; c < 3; ++c) {
        if (!(power_.back()[c] > 0.0)) continue;
        const bool endless = losesNothing(c);
        if (endless) limitless_ = true, endlessPace_[c] = fall.after[c] / fall.before[c];
        const double lost = std::max(fall.before[c] - fall.after[c], 0.0) + 0.5 * total(fall.before) / double(rays_.size());
        const double later = endless ? double(std::max(kLastWithoutLimit - given, 0)) : fall.before[c] / std::max(lost, kLeastLoss * fall.before[c]);
        for (ClvRsmTexel& texel : lit_.texels) texel.flux[c] *= float(later);
    }
}

std::vector<ClvRay> LightWalk::follow(const LitPlaces& lit, std::size_t count, std::uint32_t seed) {
    lit_ = lit;
    rays_.clear(), bounceEnds_.clear();
    power_ = {fluxOf(lit_.texels)};
    kept_ = power_[0] / glm::max(lit.sent, glm::dvec3(1e-300));
    const double fewest = std::clamp(double(count) / kFewestSteps, 1.0, kFewestRays);
    const double reserve = std::max(fewest, double(count) / kReserved);  // rays of each of the last two steps
    const double budget = double(count) - 2.0 * reserve;
    const double expected = first_ > 0.0 ? total(power_[0]) * all_ / first_ : 0.0;  // W of all bounces
    double sum = 0.0;
    bool little = false;
    while (total(power_.back()) > 0.0) {
        const double now = total(power_.back()), left = budget - double(rays_.size());
        const Fall fall = fallOf(power_);
        const double share = power_.size() > 1 ? total(fall.after) / total(fall.before) : expected > 0.0 ? 1.0 - now / expected : 0.5;
        const double later = std::clamp(share, kLeastLater, kMostLater);
        little = power_.size() > 2 && now < kNegligible * (1.0 - std::min(share, 1.0 - kLeastLoss)) * sum;
        const double byPace = (left - budget * kForDimPlaces) * (1.0 - later);
        const double wanted = std::max(expected > 0.0 ? std::min(budget * (1.0 - kForDimPlaces) * now / expected, byPace) : byPace, fewest);
        if (wanted > left || little) break;
        sum += now;
        step(std::size_t(wanted), seed);
        endLimitless();
    }
    // What is left falls in a geometric series, from many places: few would be bright spots.
    if (total(power_.back()) > 0.0) {
        sum += total(power_.back());
        step(std::size_t(little ? fewest : reserve), seed);
        extrapolate();
        if (const double rest = total(fluxOf(lit_.texels)); rest > 0.0) {
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
    const Fall fall = fallOf(power_);
    for (int c = 0; c < 3; ++c) pace_[c] = endlessPace_[c] > 0.0 ? endlessPace_[c] : fall.before[c] > 0.0 ? fall.after[c] / fall.before[c] : 0.0;
    return std::move(rays_);
}

}  // namespace clv
