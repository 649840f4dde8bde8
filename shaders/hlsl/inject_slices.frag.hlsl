// What a line adds to the six sides of a cell.
#include "clv/stages/slices.h"

struct Fragment {
    float4 position : SV_Position;
    [[vk::location(0)]] nointerpolation float4 keptDirection : DIRECTION;
    [[vk::location(1)]] nointerpolation float4 flux : FLUX;
};

struct Sides {
    float4 side0 : SV_Target0;
    float4 side1 : SV_Target1;
    float4 side2 : SV_Target2;
    float4 side3 : SV_Target3;
    float4 side4 : SV_Target4;
    float4 side5 : SV_Target5;
};

Sides main(Fragment fragment) {
    ClvCoefficients sides = clvDepositCoefficients(kClvStorageCube, fragment.keptDirection.xyz);
    Sides sum;
    sum.side0 = clvLineOnSide(sides, 0u, fragment.flux.xyz, fragment.flux.w);
    sum.side1 = clvLineOnSide(sides, 1u, fragment.flux.xyz, fragment.flux.w);
    sum.side2 = clvLineOnSide(sides, 2u, fragment.flux.xyz, fragment.flux.w);
    sum.side3 = clvLineOnSide(sides, 3u, fragment.flux.xyz, fragment.flux.w);
    sum.side4 = clvLineOnSide(sides, 4u, fragment.flux.xyz, fragment.flux.w);
    sum.side5 = clvLineOnSide(sides, 5u, fragment.flux.xyz, fragment.flux.w);
    return sum;
}
