// What surfaces send on over all bounces from one on, found by a walk from bounce to bounce.
#pragma once
#include <vector>

#include "bindings/cli/lighting.h"
#include "bindings/scene/scene.h"

namespace clv {

// Above this ratio from bounce to bounce the sum has no stable limit.
inline constexpr double kLargestRatio = 0.9995;

struct WalkedLight {
    std::vector<ClvRsmTexel> emitters;  // flux: W, of all bounces together; rows of kEmitterWidth, neighbours near each other
    std::uint64_t rays = 0;             // that it took
    int bounces = 0;
};

// Places that a bounce of the walk may light; rows of kEmitterWidth.
inline constexpr std::size_t kMostWalked = 4096;

// W a channel.
glm::dvec3 fluxOf(std::span<const ClvRsmTexel> emitters);

// `first`: what surfaces send on after the first of these bounces. `rays`: at most as many, about. From the rays of one bounce follow the
// lit places of the next, each with its own colour, and from these as many fewer rays as there is less light: all carry about the
// same. So each part of a scene, and each channel, goes at its own pace, as the light of rooms that are shut off from each other does; no volume, and no error of it, is
// between. The lighting has room for first.size() and for kMostWalked emitters, keeps hits, and its sequence is the walk's alone.
WalkedLight walkOn(Lighting& lighting, std::span<const ClvRsmTexel> first, std::uint64_t rays, std::uint32_t seed, const Bounds& bounds);

}  // namespace clv
