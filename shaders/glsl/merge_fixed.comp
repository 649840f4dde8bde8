// Merges sums of integers into a history of still light.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
#include "fixed_sums.glsl"
#include "still_weight.glsl"
#include "merge.glsl"
