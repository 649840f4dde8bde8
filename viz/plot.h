// Numbers along a line, and how often values occur.
#pragma once
#include <string>
#include <vector>

#include "viz/view.h"

namespace clv {

struct Plot {
    std::string title, xTitle, yTitle;
    std::vector<glm::dvec2> points;
    bool bars = false;              // else a line
};

// The quantity of the cells that a line from `from` to `to` (m, relative to the anchor) passes, over the distance from its start, m;
// not a number where no cell is open.
Plot probe(const BakedVolume& volume, Quantity quantity, ShownCascade only, const vec3& from, const vec3& to);
// How many of the cells that are shown have which value: bars over the range of the values.
Plot histogram(const BakedVolume& volume, Quantity quantity, ShownCascade only, const ParallelFor& parallelFor);

}  // namespace clv
