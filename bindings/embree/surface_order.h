// An order of lit texels in which neighbours are near each other.
#pragma once
#include <vector>

#include "bindings/scene/scene.h"
#include "clv/data/rsm_texel.h"

namespace clv {

// By which way they face, then by place: a well-spread sequence that picks texels is then spread in space, too.
void sortAlongSurfaces(std::vector<ClvRsmTexel>& texels, const Bounds& bounds);

}  // namespace clv
