// Textures as a scene's materials have them: repeating, filtered bilinearly, texel centres at half-integers.
//
// A shader defines, before it includes this: uvec4 clvReadTextureRow(uint row) and vec4 clvReadTextureTexel(uint index).
#ifndef CLV_STAGES_TEXTURE_H
#define CLV_STAGES_TEXTURE_H
#include "../data/surface.h"
CLV_NAMESPACE_BEGIN

// Linear RGB of the texture whose texels begin at index `first`, at the finite coordinates uv. Width and height: >= 1.
CLV_READER_FN vec3 clvReadTexture(CLV_READER uint first, uint width, uint height, vec2 uv) {
    // Never below -0.5 nor above the last centre: fract is in [0, 1].
    float x = fract(uv.x) * float(width) - 0.5f;
    float y = fract(uv.y) * float(height) - 0.5f;
    float left = floor(x);
    float top = floor(y);
    uint x0 = left < 0.0f ? width - 1u : uint(left);
    uint y0 = top < 0.0f ? height - 1u : uint(top);
    uint x1 = x0 + 1u == width ? 0u : x0 + 1u;
    uint y1 = y0 + 1u == height ? 0u : y0 + 1u;
    vec4 upper = mix(CLV_READ clvReadTextureTexel(first + y0 * width + x0), CLV_READ clvReadTextureTexel(first + y0 * width + x1), x - left);
    vec4 lower = mix(CLV_READ clvReadTextureTexel(first + y1 * width + x0), CLV_READ clvReadTextureTexel(first + y1 * width + x1), x - left);
    vec4 texel = mix(upper, lower, y - top);
    return vec3(texel.x, texel.y, texel.z);
}

// What the texture of a triangle multiplies its albedo by; barycentrics (u, v) belong to the second and the third corner.
CLV_READER_FN vec3 clvTextureOn(CLV_READER uint primitive, float u, float v) {
    uvec4 row0 = CLV_READ clvReadTextureRow(primitive * kClvTextureRows);
    uvec4 row1 = CLV_READ clvReadTextureRow(primitive * kClvTextureRows + 1u);
    uint width = row1.w & 0xffffu;
    if (width == 0u) return vec3(1.0f, 1.0f, 1.0f);
    vec2 corner0 = vec2(clvFloatFromBits(row0.x), clvFloatFromBits(row0.y));
    vec2 corner1 = vec2(clvFloatFromBits(row0.z), clvFloatFromBits(row0.w));
    vec2 corner2 = vec2(clvFloatFromBits(row1.x), clvFloatFromBits(row1.y));
    return clvReadTexture(CLV_PASS_READER row1.z, width, row1.w >> 16, corner0 * (1.0f - u - v) + corner1 * u + corner2 * v);
}

CLV_NAMESPACE_END
#endif
