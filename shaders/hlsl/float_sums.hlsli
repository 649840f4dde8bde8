// This frame's sums as floats.
[[vk::binding(CLV_BIND_DEPOSITS)]] RWStructuredBuffer<float4> deposits;

// Of four numbers; clears them.
float4 takeMean(uint i, float scale, float fixedScale) {
    float4 mean = deposits[i] * scale;
    deposits[i] = float4(0.0, 0.0, 0.0, 0.0);
    return mean;
}
