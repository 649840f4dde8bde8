// Points spread evenly over all surfaces, on each side that light can reach.
#pragma once
#include <cstdint>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "clv/cpu/parallel.h"
#include "clv/stages/evaluate.h"

namespace clv {

struct SurfaceSamples {
    std::vector<ClvReceiver> receivers;
    float area = 0.0f;  // m^2 that each of them stands for
};

// `count` points, in proportion to area, stratified along the order of the triangles; each gives none, one or two receivers. A side is left out when it
// sees more backs than fronts, as the inside of a solid does, or nothing at all; where there are no solids (EmbreeScene::solids), only then.
SurfaceSamples sampleSurfaces(const EmbreeScene& scene, std::size_t count, std::uint32_t seed, const ParallelFor& parallelFor);

}  // namespace clv
