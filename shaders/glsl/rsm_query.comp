// The reflective shadow maps of all lights by ray queries, in a scene without textures.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_query : require
#include "clv/data/frame.h"
#include "clv/stages/rsm.h"
#include "query.glsl"
#include "surface.glsl"
#include "scene.glsl"
#include "traced_texel.glsl"
#include "work_group.glsl"
#include "rsm.glsl"
