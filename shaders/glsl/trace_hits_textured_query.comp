// Cuts rays by ray queries and says what they met, in a scene with textures.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#include "clv/data/frame.h"
#include "clv/stages/trace.h"
#include "query.glsl"
#include "textured_surface.glsl"
#include "scene.glsl"
#include "work_group.glsl"
#include "trace_hits.glsl"
