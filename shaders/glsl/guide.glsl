// The guide, and what it prefers.
layout(std140, binding = CLV_BIND_GUIDE) uniform GuideBlock { ClvVolume guideGrid; };
layout(std430, binding = CLV_BIND_GUIDE_CELLS) readonly buffer GuideCells { uint guideCells[]; };
layout(std430, binding = CLV_BIND_GUIDE_WEIGHTS) readonly buffer GuideWeights { float guideWeights[]; };

uint clvReadGuideCell(uint cell) { return guideCells[cell]; }
float clvReadGuideWeight(uint i) { return guideWeights[i]; }
#include "clv/stages/ray_guide.h"
