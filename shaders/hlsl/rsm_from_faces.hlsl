// The reflective shadow maps of all lights, from what was drawn, in a scene without textures.
#include "clv/data/frame.h"
#include "clv/stages/map_face.h"
#include "clv/stages/rsm.h"
#include "triangles.hlsli"
#include "surface.hlsli"
#include "drawn_texel.hlsli"
#include "rsm.hlsli"
