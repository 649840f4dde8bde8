// This frame's sums as integers.
[[vk::binding(CLV_BIND_DEPOSITS)]] RWStructuredBuffer<int4> deposits;

// Of four numbers; clears them.
float4 takeMean(uint i, float scale, float fixedScale) {
    float4 mean = float4(deposits[i]) * (scale / fixedScale);
    deposits[i] = int4(0, 0, 0, 0);
    return mean;
}
