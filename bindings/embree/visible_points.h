// Surface points that the scene's cameras see: where errors are measured, the resolution is judged, and pictures are lit.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "bindings/embree/path_tracer.h"
#include "clv/stages/evaluate.h"

namespace clv {

// `count` points, shared evenly between the cameras, spread over each picture by a low-discrepancy sequence; fewer when the
// cameras look past the scene. Normals face the camera.
std::vector<ClvReceiver> visiblePoints(const EmbreeScene& scene, std::size_t count, std::uint32_t seed);

struct VisibleSurface {
    std::size_t pixel;      // row by row from the top
    ReferencePoint point;   // the normal faces the camera
    glm::vec3 albedo;       // linear RGB, [0, 1]
};

// The surface at the centre of each pixel, in the order of the pixels; those that look past the scene have none.
// The camera's vertical angle counts, the width follows from the size of the picture.
std::vector<VisibleSurface> visibleSurfaces(const EmbreeScene& scene, const Camera& camera, int width, int height,
                                            const ParallelFor& parallelFor);

// The points alone, in the same order.
std::vector<ReferencePoint> pointsOf(std::span<const VisibleSurface> surfaces);

}  // namespace clv
