// Cuts rays and says what they met, in a scene with textures.
#include "clv/data/frame.h"
#include "clv/stages/trace.h"
#include "textured_scene.hlsli"
#include "trace_hits.hlsli"
