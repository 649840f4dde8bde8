// The reflective shadow maps of all lights, in a scene with textures.
#include "clv/data/frame.h"
#include "clv/stages/rsm.h"
#include "textured_scene.hlsli"
#include "rsm.hlsli"
