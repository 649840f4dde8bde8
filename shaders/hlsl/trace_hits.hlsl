// Cuts rays and says what they met, in a scene without textures.
#include "clv/data/frame.h"
#include "clv/stages/trace.h"
#include "scene.hlsli"
#include "trace_hits.hlsli"
