// Reflective shadow maps, traced from the light by Embree.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "clv/cpu/parallel.h"
#include "clv/data/rsm_texel.h"

namespace clv {

// Renders light `light` into texels (resolution * resolution, row by row). Each texel is sampled at a point in it that follows
// from (texel, pass, seed), so that the mean over passes converges to the exact light, shadow edges included. How the map lies
// around the light: clv/stages/rsm.h.
void renderRsm(const EmbreeScene& scene, const ClvLight& light, int resolution, std::uint32_t pass, std::uint32_t seed,
               const ParallelFor& parallelFor, std::span<ClvRsmTexel> texels);

}  // namespace clv
