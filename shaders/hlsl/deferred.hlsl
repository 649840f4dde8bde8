// A picture's indirect light, in a scene without textures.
#include "clv/data/frame.h"
#include "clv/data/picture.h"
#include "clv/stages/map_face.h"
#include "triangles.hlsli"
#include "surface.hlsli"
#include "deferred.hlsli"
