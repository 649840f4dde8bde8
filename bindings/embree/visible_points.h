// Surface points that the scene's cameras see: where errors are measured, and where the resolution is judged.
#pragma once
#include <cstdint>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "clv/stages/evaluate.h"

namespace clv {

// `count` points, shared evenly between the cameras, spread over each picture by a low-discrepancy sequence; fewer when the
// cameras look past the scene. Normals face the camera.
std::vector<ClvReceiver> visiblePoints(const EmbreeScene& scene, std::size_t count, std::uint32_t seed);

}  // namespace clv
