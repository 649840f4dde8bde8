// The reflective shadow maps of all lights, in a scene without textures.
#include "clv/data/frame.h"
#include "clv/stages/rsm.h"
#include "bvh.hlsli"
#include "surface.hlsli"
#include "scene.hlsli"
#include "traced_texel.hlsli"
#include "rsm.hlsli"
