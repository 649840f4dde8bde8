// Light that surfaces send on, followed from bounce to bounce.
#pragma once
#include <vector>

#include "bindings/cli/lighting.h"
#include "bindings/scene/scene.h"

namespace clv {

// Above this ratio from bounce to bounce the sum has no stable limit.
inline constexpr double kLargestRatio = 0.9995;
// The last bounce that is followed where there is no limit; the first one is that which `lit` stands for in LightWalk::follow().
inline constexpr int kLastWithoutLimit = 24;

// Appends what the surfaces that rays hit send on: a texel each, with that share of the flux. None for rays that hit nothing, or black.
void addLit(std::span<const ClvRay> rays, std::span<const ClvHit> hits, float share, std::vector<ClvRsmTexel>& lit);

// From where rays hit new ones start, as many fewer as there is less light: all carry about the same. So each part of a scene, and each
// channel, goes at its own pace, as the light of rooms that are shut off from each other does; no volume, and no error of it, is between.
// Where few are left, the last ones stand for all later bounces, as a geometric series.
class LightWalk {
public:
    // The lighting has room for as many emitters as are followed at once, and keeps hits.
    LightWalk(Lighting& lighting, const Bounds& bounds) : lighting_(lighting), bounds_(bounds) {}

    // Follows what surfaces send on, with about `count` rays. Their mean is the light of all later bounces.
    std::vector<ClvRay> follow(std::span<const ClvRsmTexel> lit, std::size_t count, std::uint32_t seed);

    // Of all calls: the most bounces, the first one included; and by how much the power of a channel falls from bounce to bounce, about.
    int bounces() const { return bounces_; }
    const glm::dvec3& pace() const { return pace_; }
    // Whether a channel's power did not fall; its bounces after the last one are left out.
    bool limitless() const { return limitless_; }

private:
    void step(std::size_t count, std::uint32_t seed);
    void heedLimit();

    Lighting& lighting_;
    Bounds bounds_;
    std::vector<ClvRay> rays_;             // so far
    std::vector<ClvHit> hits_;             // of the last bounce
    std::vector<std::size_t> bounceEnds_;  // among the rays
    std::vector<ClvRsmTexel> lit_;         // by the last bounce
    std::vector<glm::dvec3> power_;        // W a channel that surfaces send on after each bounce
    double first_ = 0.0, all_ = 0.0;  // W of the first bounces so far, and of all that followed, times rays
    glm::dvec3 pace_{0.0};
    int bounces_ = 1;
    bool limitless_ = false;
};

}  // namespace clv
