// Cuts rays and says what they met, in a scene with textures.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/trace.h"
#include "bvh.glsl"
#include "textured_surface.glsl"
#include "scene.glsl"
#include "work_group.glsl"
#include "trace_hits.glsl"
