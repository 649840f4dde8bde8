// The guide, and what it prefers.
[[vk::binding(CLV_BIND_GUIDE)]] cbuffer GuideBlock { ClvVolume guideGrid; };
[[vk::binding(CLV_BIND_GUIDE_CELLS)]] StructuredBuffer<uint> guideCells;
[[vk::binding(CLV_BIND_GUIDE_WEIGHTS)]] StructuredBuffer<float> guideWeights;

uint clvReadGuideCell(uint cell) { return guideCells[cell]; }
float clvReadGuideWeight(uint i) { return guideWeights[i]; }
#include "clv/stages/ray_guide.h"
