// Surface points beside given ones: where few points are lit, more of their neighbourhood says how well a level does there.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "clv/stages/evaluate.h"

namespace clv {

// `count` points, shared evenly between the given ones, each on the surface of its own one or on one that carries on from it: within
// `radius`, m, along its plane, in sight of it, within a quarter of the radius from that plane, and turned from it by less than 40
// degrees. Fewer where the surfaces are too small for that many.
std::vector<ClvReceiver> nearbyPoints(const EmbreeScene& scene, std::span<const ClvReceiver> points, float radius, std::size_t count, std::uint32_t seed);

}  // namespace clv
