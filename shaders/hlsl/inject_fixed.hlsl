// Each ray adds to the slots that it crosses, in integers: the same to the last bit from run to run.
#include "inject_rays.hlsli"

[[vk::binding(CLV_BIND_DEPOSITS)]] RWStructuredBuffer<uint> deposits;  // bits of integers, which wrap around at 2^32

void addDeposit(uint index, float value) {
    int units = clvFixedFromFloat(value, level.fixedScale);
    if (units != 0) InterlockedAdd(deposits[index], uint(units));
}
