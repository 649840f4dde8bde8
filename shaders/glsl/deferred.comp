// A picture's indirect light, in a scene without textures.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "clv/data/frame.h"
#include "clv/data/picture.h"
#include "clv/stages/map_face.h"
#include "triangles.glsl"
#include "surface.glsl"
#include "deferred.glsl"
