#include "bindings/cli/light_walk.h"

#include <algorithm>
#include <cmath>

#include "bindings/embree/surface_samples.h"
#include "clv/math/hash.h"
#include "clv/stages/rays.h"
#include "clv/stages/rsm.h"

namespace clv {
namespace {

constexpr std::size_t kFewestRays = 32;      // of a bounce: with fewer what is left is extrapolated
constexpr double kNegligible = 1e-3;         // share of all the walk's light at which the rest is extrapolated

double total(const glm::dvec3& v) { return v.x + v.y + v.z; }

// By which the power of each channel falls from bounce to bounce, over the later half of them.
glm::dvec3 paceOf(std::span<const glm::dvec3> power) {
    glm::dvec3 before(0.0), after(0.0), pace(0.0);
    for (std::size_t k = (power.size() - 1) / 2; k + 1 < power.size(); ++k) before += power[k], after += power[k + 1];
    for (int c = 0; c < 3; ++c) pace[c] = before[c] > 0.0 ? std::min(after[c] / before[c], kLargestRatio) : 0.0;
    return pace;
}

void fillRow(std::vector<ClvRsmTexel>& emitters) {
    emitters.resize((emitters.size() + kEmitterWidth - 1) / kEmitterWidth * kEmitterWidth, ClvRsmTexel{});
}

}  // namespace

glm::dvec3 fluxOf(std::span<const ClvRsmTexel> emitters) {
    glm::dvec3 sum(0.0);
    for (const ClvRsmTexel& texel : emitters) sum += glm::dvec3(texel.flux);
    return sum;
}

WalkedLight walkOn(Lighting& lighting, std::span<const ClvRsmTexel> first, std::uint64_t rays, std::uint32_t seed, const Bounds& bounds) {
    WalkedLight walked;
    walked.emitters.assign(first.begin(), first.end());
    std::vector<ClvRsmTexel> lit(first.begin(), first.end());
    std::vector<ClvRay> drawn;
    std::vector<ClvHit> hits;
    std::vector<glm::dvec3> power = {fluxOf(lit)};
    double sum = total(power[0]);
    // A share of the rays begins the walk, and as many end it: the places of the last bounce stand for all after it.
    const std::size_t many = std::clamp<std::size_t>(std::size_t(rays / 16), kFewestRays, kMostWalked);
    std::size_t count = many;
    for (bool last = false; total(power.back()) > 0.0;) {
        lighting.emit(lit);
        drawn.resize(count), hits.resize(count);
        lighting.pilots(clvHashCombine(seed, uint(power.size())), drawn, hits);
        walked.rays += count;
        lit.clear();
        for (std::size_t k = 0; k < count; ++k) {
            const ClvRsmTexel texel = clvRsmTexelFromHit(drawn[k], hits[k], 1.0f / float(count));
            if (clvTexelWeight(texel) > 0.0f) lit.push_back(texel);
        }
        sortAlongSurfaces(lit, bounds);
        power.push_back(fluxOf(lit));
        const glm::dvec3 pace = paceOf(power);
        if (last) {
            // What is left falls in a geometric series.
            for (ClvRsmTexel& texel : lit) texel.flux /= vec3(1.0 - pace);
        }
        walked.emitters.insert(walked.emitters.end(), lit.begin(), lit.end());
        const double before = total(power[power.size() - 2]), now = total(power.back());
        if (last || !(now > 0.0)) break;
        sum += now;
        // As many fewer as there is less light, and no more than leave as many to all later bounces.
        const double ratio = total(power.back() * pace) / now, left = double(rays) - double(walked.rays + many);
        count = std::size_t(std::max(std::min(double(count) * now / before, left * (1.0 - ratio)), 0.0));
        last = count < kFewestRays || now < kNegligible * (1.0 - ratio) * sum;
        if (last) count = many;
        fillRow(lit);
    }
    walked.bounces = int(power.size()) - 1;
    sortAlongSurfaces(walked.emitters, bounds);
    fillRow(walked.emitters);
    return walked;
}

}  // namespace clv
