// A picture of the scene with its indirect light.
#ifndef CLV_DATA_PICTURE_H
#define CLV_DATA_PICTURE_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

struct ClvPicture {          // 32 bytes
    vec3 ambient;            // W/m^2, of the static ambient term
    float ambientThreshold;  // W/m^2, > 0: surfaces with as much light get none of it
    uint width;              // pixels
    uint height;
    uint pad0;
    uint pad1;
};

CLV_NAMESPACE_END
#endif
