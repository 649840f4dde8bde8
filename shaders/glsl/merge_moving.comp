// Merges sums of floats into a history of moving light.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/merge.h"
#include "float_sums.glsl"
#include "moving_weight.glsl"
#include "merge.glsl"
