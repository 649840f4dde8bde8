// What a receiver sees of the surfaces around it: their fronts or their backs.
#pragma once
#include <functional>

#include "bindings/embree/embree_scene.h"
#include "clv/stages/evaluate.h"

namespace clv {

inline constexpr int kSeenRays = 16;

struct SeenFaces {
    int fronts = 0, backs = 0;  // of kSeenRays rays, cosine-weighted over the receiver's hemisphere; the others leave the scene
};

// onHit: called with the position of each hit, m.
SeenFaces seenFaces(const EmbreeScene& scene, const ClvReceiver& receiver, std::uint32_t seed,
                    const std::function<void(const glm::vec3& position, const ClvHit& hit)>& onHit = {});

// Right-handed normal of a triangle, m^2, twice its area long: on its front.
glm::vec3 windingNormal(const Scene& scene, std::uint32_t triangle);

}  // namespace clv
