// A scene's surfaces as a shader reads them at a hit.
#pragma once
#include <vector>

#include "bindings/scene/scene.h"
#include "clv/data/surface.h"

namespace clv {

// Rows as data/surface.h says. Without textured materials the last two are empty.
struct SurfaceRows {
    std::vector<vec4> surfaces;
    std::vector<uvec4> textureRows;
    std::vector<vec4> textureTexels;
};

// Throws InputError when a texture is larger than 65,535 texels a side, or all of them are larger than an index of 32 bits.
SurfaceRows surfaceRowsOf(const Scene& scene);

}  // namespace clv
