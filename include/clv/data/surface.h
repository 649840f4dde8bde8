// What a hit on a triangle needs to know beside its place, as texel buffers hold it, in the order of the scene's triangles.
#ifndef CLV_DATA_SURFACE_H
#define CLV_DATA_SURFACE_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

// Rows of four floats: unit normal by the right-hand rule, then albedo (linear RGB, [0, 1]), which multiplies the texture.
CLV_CONST uint kClvSurfaceRows = 2u;

// Rows of four integers, in scenes with textures: the bits of the first and the second corner's texture coordinates; those of the
// third's, the index of the texture's first texel, and its width in the lower and its height in the upper 16 bits. A triangle
// without a texture has width 0. Texels of all textures lie in one buffer, row by row, row 0 at v = 0.
CLV_CONST uint kClvTextureRows = 2u;

CLV_NAMESPACE_END
#endif
