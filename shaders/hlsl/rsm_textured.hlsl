// The reflective shadow maps of all lights, in a scene with textures.
#include "clv/data/frame.h"
#include "clv/stages/rsm.h"
#include "bvh.hlsli"
#include "textured_surface.hlsli"
#include "scene.hlsli"
#include "traced_texel.hlsli"
#include "rsm.hlsli"
