// Body of the merges: moves the history towards this frame's estimate, four numbers a thread, and clears the sums for the next frame. The
// entry point includes before: float_sums.hlsli or fixed_sums.hlsli, and still_weight.hlsli or moving_weight.hlsli.
[[vk::constant_id(CLV_SPEC_STRIDE)]] const uint stride = 32u;
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_HISTORY)]] RWStructuredBuffer<float4> history;

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    uint vectors = stride / 4u;
    if (i >= frame.halves * level.slotCount * vectors) return;
    history[i] = clvMergeStep(history[i], takeMean(i, level.scale, level.fixedScale), mergeWeight(i, vectors, level.weight));
}
