// Light that surfaces send on, followed from bounce to bounce.
#pragma once
#include <vector>

#include "bindings/cli/lighting.h"
#include "bindings/scene/scene.h"

namespace clv {

// Where no light is lost there is no limit: this is the last bounce that is then given. The first one is that which brings light to the surfaces
// that LightWalk::follow() starts from.
inline constexpr int kLastWithoutLimit = 24;

// Adds what the surfaces that rays hit send on, with that share of the flux. No texel for rays that hit nothing, or black.
void addLit(std::span<const ClvRay> rays, std::span<const ClvHit> hits, float share, LitPlaces& lit);

// W a channel.
glm::dvec3 fluxOf(std::span<const ClvRsmTexel> texels);

// From where rays hit new ones start, as many fewer as there is less light: all carry about the same. So each part of a scene, and each
// channel, goes at its own pace, as the light of rooms that are shut off from each other does; no volume, and no error of it, is between.
// Where few are left, the last ones stand for all later bounces, as a geometric series.
class LightWalk {
public:
    // The lighting has room for as many emitters as are followed at once, and keeps hits.
    LightWalk(Lighting& lighting, const Bounds& bounds) : lighting_(lighting), bounds_(bounds) {}

    // Follows what surfaces send on, with about `count` rays, at least one a bounce. Their mean is the light of all later bounces; none where
    // there is no light.
    std::vector<ClvRay> follow(const LitPlaces& lit, std::size_t count, std::uint32_t seed);

    // Of all calls: the most bounces, the first one included.
    int bounces() const { return bounces_; }
    // Of the last call, by how much the power of each channel falls from bounce to bounce.
    const glm::dvec3& pace() const { return pace_; }
    // Whether a channel lost no light; its bounces after the last one are left out.
    bool limitless() const { return limitless_; }

private:
    void step(std::size_t count, std::uint32_t seed);
    bool losesNothing(int channel) const;
    void endLimitless();
    void extrapolate();

    Lighting& lighting_;
    Bounds bounds_;
    std::vector<ClvRay> rays_;             // so far
    std::vector<ClvHit> hits_;             // of the last bounce
    std::vector<std::size_t> bounceEnds_;  // among the rays
    LitPlaces lit_;                        // by the last bounce
    std::vector<glm::dvec3> power_;        // W a channel that surfaces send on after each bounce
    glm::dvec3 kept_{0.0};
    double first_ = 0.0, all_ = 0.0;       // W of the first bounces so far, and of all that followed, times rays
    glm::dvec3 pace_{0.0}, endlessPace_{0.0};  // the latter of channels that lose nothing
    int bounces_ = 1;
    bool limitless_ = false;
};

}  // namespace clv
