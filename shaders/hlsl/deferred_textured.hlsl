// A picture's indirect light, in a scene with textures.
#include "clv/data/frame.h"
#include "clv/data/picture.h"
#include "clv/stages/map_face.h"
#include "triangles.hlsli"
#include "textured_surface.hlsli"
#include "deferred.hlsli"
