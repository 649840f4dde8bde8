// Body of deferred and deferred_textured: the surface behind each pixel, found by the triangle that was drawn there, and the light that it
// sends back to the camera: indirect light from the volume, and the static ambient term.
layout(constant_id = CLV_SPEC_STORAGE) const uint storage = 0u;
layout(constant_id = CLV_SPEC_CHANNELS) const uint channels = 3u;
layout(constant_id = CLV_SPEC_STRIDE) const uint stride = 32u;
layout(constant_id = CLV_SPEC_TURNED) const uint turned = 0u;
layout(local_size_x = CLV_GROUP_SIZE) in;
layout(std140, binding = CLV_BIND_FRAME) uniform FrameBlock { ClvFrame frame; };
layout(std140, binding = CLV_BIND_LEVEL) uniform LevelBlock { ClvLevelFrame level; };
layout(std140, binding = CLV_BIND_PICTURE) uniform PictureBlock { ClvPicture picture; };
layout(std430, binding = CLV_BIND_MAP_FACES) readonly buffer Faces { ClvMapFace faces[]; };
layout(std430, binding = CLV_BIND_TABLE) readonly buffer Table { uint table[]; };
layout(std430, binding = CLV_BIND_SPLITS) readonly buffer Splits { ClvSplit splits[]; };
layout(std430, binding = CLV_BIND_SLOTS) readonly buffer Slots { ClvSlot slots[]; };
layout(binding = CLV_BIND_HISTORY) uniform samplerBuffer history;
layout(binding = CLV_BIND_FACE_TRIANGLES) uniform utexture2D seen;
layout(std430, binding = CLV_BIND_RADIANCE) writeonly buffer Radiance { vec4 radiance[]; };

uint clvReadTable(uint cell) { return table[cell]; }
ClvSplit clvReadSplit(uint i) { return splits[i]; }
ClvSlot clvReadSlot(uint i) { return slots[i]; }
vec4 clvReadHistory(uint row) { return texelFetch(history, int(row)); }
#include "clv/stages/deferred.h"

void main() {
    uint i = clvItem(gl_GlobalInvocationID);
    if (i >= picture.width * picture.height) return;
    uvec2 pixel = uvec2(i % picture.width, i / picture.width);
    uint triangle = texelFetch(seen, ivec2(pixel), 0).x;
    radiance[i] = vec4(0.0);
    if (triangle == 0u) return;
    ClvRay ray = clvPixelRay(faces[0], pixel, uvec2(picture.width, picture.height));
    ClvHit hit = surfaceHit(clvMeetTriangle(triangle - 1u, ray.origin, ray.direction, clvNoTriangle(ray.maxDistance)), ray.direction);
    if (hit.primitive == kClvNoPrimitive) return;
    ClvRecordFormat format;
    format.storage = storage;
    format.channels = channels;
    format.stride = stride;
    ClvReceiver receiver = clvReceiverOfHit(ray, hit);
    ClvCoefficients read = clvReadCoefficients(storage, clvKeptDirection(frame, turned, receiver.normal));
    vec3 irradiance = clvMeanIrradianceAt(level.volume, receiver, format, read, level.slotCount, frame.halves);
    radiance[i] = vec4(clvDeferredRadiance(hit.albedo, irradiance, picture), 1.0);
}
