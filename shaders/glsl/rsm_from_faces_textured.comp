// The reflective shadow maps of all lights, from what was drawn, in a scene with textures.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "clv/data/frame.h"
#include "clv/stages/map_face.h"
#include "clv/stages/rsm.h"
#include "triangles.glsl"
#include "textured_surface.glsl"
#include "drawn_texel.glsl"
#include "work_group.glsl"
#include "rsm.glsl"
