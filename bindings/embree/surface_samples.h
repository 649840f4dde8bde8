// Points spread over all surfaces, on each side that light can reach: where a volume's light is read to send it on.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "bindings/embree/surface_patches.h"
#include "clv/cpu/parallel.h"
#include "clv/data/rsm_texel.h"
#include "clv/stages/evaluate.h"

namespace clv {

struct SurfaceSamples {
    std::vector<ClvReceiver> receivers;
    std::vector<glm::vec3> albedo;       // linear RGB, a receiver each
    std::vector<float> area;             // m^2 that each receiver stands for
    std::vector<float> sight;            // m; three quarters of what is before each receiver are nearer; kClvFar where less of it is surfaces
};

// m^2, each triangle once.
double surfaceArea(const Scene& scene);

// `count` points, in proportion to area, stratified along the order of the triangles; each gives none, one or two receivers. Where there are
// `views`, half of the points are in proportion to them instead, along the patches that patchesWhereSeen() gives. A side is left out when it
// sees more backs than fronts, as the inside of a solid does, or nothing at all; where there are no solids (EmbreeScene::solids), only then.
// Neighbours among the receivers face the same way and are near each other, so that a well-spread sequence that picks receivers is spread
// in space, too.
SurfaceSamples sampleSurfaces(const EmbreeScene& scene, std::size_t count, std::uint32_t seed, const ParallelFor& parallelFor,
                              std::span<const SurfaceView> views = {});

// In the order of those receivers: by which way they face, then by place.
void sortAlongSurfaces(std::vector<ClvRsmTexel>& texels, const Bounds& bounds);

}  // namespace clv
