// What points see around them, and from how near.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "bindings/embree/path_tracer.h"
#include "bindings/embree/seen_faces.h"
#include "clv/cpu/parallel.h"
#include "clv/stages/evaluate.h"

namespace clv {

std::vector<ClvReceiver> receiversOf(std::span<const ReferencePoint> points);

// What one of the points sees.
struct Look {
    ClvReceiver point;
    std::uint32_t seed = 0;   // of its rays: see seenFaces()
    SeenFaces faces;
    float middle = kClvFar;   // m: half of what it sees is nearer; kClvFar where it sees nothing
};

// Of a thousand of the points, or of all where there are fewer.
std::vector<Look> lookAround(const EmbreeScene& scene, std::span<const ClvReceiver> points, const ParallelFor& parallelFor);

// m. A tenth of the points see half of what they see from nearer than this; kClvFar where they see nothing.
float nearSight(std::span<const Look> looks);

}  // namespace clv
