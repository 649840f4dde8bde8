// A texel of a reflective shadow map (Dachsbacher and Stamminger 2005): one lit surface sample, a small light of its own.
#ifndef CLV_DATA_RSM_TEXEL_H
#define CLV_DATA_RSM_TEXEL_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

struct ClvRsmTexel {   // 48 bytes, the same in C++, GLSL and HLSL
    vec3 position;     // m, relative to the anchor
    float dynamicity;  // [0, 1], of the light that lit it
    vec3 normal;       // unit length, on the side that the light comes from
    uint valid;        // 0: the light met no surface there, and the texel sends no rays
    vec3 flux;         // W, linear RGB, reflected (incident flux times albedo)
    float pad0;
};

CLV_NAMESPACE_END
#endif
