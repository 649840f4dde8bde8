// Points spread evenly over all surfaces, both sides of each: where a volume's light is read to send it on.
#pragma once
#include <cstdint>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "clv/stages/evaluate.h"

namespace clv {

struct SurfaceSamples {
    std::vector<ClvReceiver> receivers;  // two for each point: the front side, then the back
    std::vector<glm::vec3> albedo;       // linear RGB, a receiver each
    float area = 0.0f;                   // m^2 that each receiver stands for
};

// `count` points, in proportion to area, stratified along the order of the triangles.
SurfaceSamples sampleSurfaces(const Scene& scene, std::size_t count, std::uint32_t seed);

}  // namespace clv
