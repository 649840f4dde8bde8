// Each ray adds to the slots that it crosses, by additions of floats that are tried until nobody else came in between.
#include "inject_rays.hlsli"

[[vk::binding(CLV_BIND_DEPOSITS)]] RWStructuredBuffer<uint> deposits;  // bits of floats

void addDeposit(uint index, float value) {
    if (value == 0.0) return;
    uint expected;
    uint found = deposits[index];
    do {
        expected = found;
        InterlockedCompareExchange(deposits[index], expected, asuint(asfloat(expected) + value), found);
    } while (found != expected);
}
