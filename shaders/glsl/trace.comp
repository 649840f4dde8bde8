// Cuts rays by a walk through the tree.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/data/ray.h"
#include "bvh.glsl"
#include "work_group.glsl"
#include "trace.glsl"
