// What is wrong with where points lie.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "bindings/cli/surroundings.h"
#include "clv/cpu/parallel.h"
#include "clv/stages/evaluate.h"

namespace clv {

struct PointHeed {
    std::vector<std::string> warnings;
    bool sheets = false;  // so many face backs that are lit that nothing is to count as solid
};

// Warns of points outside of the scene's bounds, where no light is stored, and of points that face into what counts as solid.
// looks: of these points. sheets: nothing counts as solid anyway.
PointHeed heedPoints(const EmbreeScene& scene, std::span<const ClvReceiver> points, std::span<const Look> looks, bool sheets,
                      const ParallelFor& parallelFor);

}  // namespace clv
