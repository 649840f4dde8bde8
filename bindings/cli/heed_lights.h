// What is wrong with where the light of a scene falls.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "bindings/embree/path_tracer.h"
#include "clv/cpu/parallel.h"

namespace clv {

struct LightHeed {
    std::vector<std::string> warnings;
    bool insideOut = false;  // all faces are to be turned around
    bool sheets = false;     // nothing is to count as solid
};

// What lies behind the backs of surfaces counts as solid. A scene whose light falls on backs is inside out. cellSize: m, of the cells that
// take the light. rays: that carry it; 0: nobody knows.
LightHeed heedLights(const EmbreeScene& scene, float cellSize, double rays, const ParallelFor& parallelFor);

// Warns of lamps so near to a surface that few of as many paths, all points together, meet the spot which they light most.
std::vector<std::string> heedNearLights(const EmbreeScene& scene, std::span<const ReferencePoint> points, double paths, const ParallelFor& parallelFor);

}  // namespace clv
