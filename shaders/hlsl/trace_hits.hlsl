// Cuts rays and says what they met, in a scene without textures.
#include "clv/data/frame.h"
#include "clv/stages/trace.h"
#include "bvh.hlsli"
#include "surface.hlsli"
#include "scene.hlsli"
#include "trace_hits.hlsli"
