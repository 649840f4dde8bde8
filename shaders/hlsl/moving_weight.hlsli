// The weight of this frame in a history of moving light: each slot stands for a number of frames.
[[vk::binding(CLV_BIND_SLOT_FRAMES)]] StructuredBuffer<float> slotFrames;
float mergeWeight(uint i, uint vectors, float weight) { return 1.0 / slotFrames[i / vectors]; }
