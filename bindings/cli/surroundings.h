// What points see around them, and from how near.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "bindings/embree/path_tracer.h"
#include "clv/cpu/parallel.h"
#include "clv/stages/evaluate.h"

namespace clv {

std::vector<ClvReceiver> receiversOf(std::span<const ReferencePoint> points);

// m. A quarter of the points see half of what they see from nearer than this; kClvFar where they see nothing.
float nearSight(const EmbreeScene& scene, std::span<const ClvReceiver> points, const ParallelFor& parallelFor);

// How many looks fall on each triangle: of the points, and of places that they see.
std::vector<std::uint32_t> viewsOf(const EmbreeScene& scene, std::span<const ClvReceiver> points, const ParallelFor& parallelFor);

}  // namespace clv
