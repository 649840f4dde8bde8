// The reflective shadow maps of all lights, in a scene with textures.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "clv/data/frame.h"
#include "clv/stages/rsm.h"
#include "bvh.glsl"
#include "textured_surface.glsl"
#include "scene.glsl"
#include "traced_texel.glsl"
#include "work_group.glsl"
#include "rsm.glsl"
