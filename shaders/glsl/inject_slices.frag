// What a line adds to the six sides of a cell.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/stages/slices.h"

layout(location = 0) flat in vec4 keptDirection;
layout(location = 1) flat in vec4 flux;
layout(location = 0) out vec4 side0;
layout(location = 1) out vec4 side1;
layout(location = 2) out vec4 side2;
layout(location = 3) out vec4 side3;
layout(location = 4) out vec4 side4;
layout(location = 5) out vec4 side5;

void main() {
    ClvCoefficients sides = clvDepositCoefficients(kClvStorageCube, keptDirection.xyz);
    side0 = clvLineOnSide(sides, 0u, flux.xyz, flux.w);
    side1 = clvLineOnSide(sides, 1u, flux.xyz, flux.w);
    side2 = clvLineOnSide(sides, 2u, flux.xyz, flux.w);
    side3 = clvLineOnSide(sides, 3u, flux.xyz, flux.w);
    side4 = clvLineOnSide(sides, 4u, flux.xyz, flux.w);
    side5 = clvLineOnSide(sides, 5u, flux.xyz, flux.w);
}
