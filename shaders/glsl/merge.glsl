// Body of the merges: moves the history towards this frame's estimate, four numbers a thread, and clears the sums for the next frame. The
// entry point includes before: float_sums.glsl or fixed_sums.glsl, and still_weight.glsl or moving_weight.glsl.
layout(constant_id = CLV_SPEC_STRIDE) const uint stride = 32u;
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std430, binding = CLV_BIND_HISTORY) buffer History { vec4 history[]; };

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    uint vectors = stride / 4u;
    if (i >= frame.halves * level.slotCount * vectors) return;
    history[i] = clvMergeStep(history[i], takeMean(i, level.scale, level.fixedScale), mergeWeight(i, vectors, level.weight));
}
