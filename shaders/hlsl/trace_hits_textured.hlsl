// Cuts rays and says what they met, in a scene with textures.
#include "clv/data/frame.h"
#include "clv/stages/trace.h"
#include "bvh.hlsli"
#include "textured_surface.hlsli"
#include "scene.hlsli"
#include "trace_hits.hlsli"
