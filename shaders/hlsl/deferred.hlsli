// Body of deferred and deferred_textured: the surface behind each pixel, found by the triangle that was drawn there, and the light that it
// sends back to the camera: indirect light from the volume, and the static ambient term.
[[vk::constant_id(CLV_SPEC_STORAGE)]] const uint storage = 0u;
[[vk::constant_id(CLV_SPEC_CHANNELS)]] const uint channels = 3u;
[[vk::constant_id(CLV_SPEC_STRIDE)]] const uint stride = 32u;
[[vk::constant_id(CLV_SPEC_TURNED)]] const uint turned = 0u;
[[vk::binding(CLV_BIND_FRAME)]] cbuffer FrameBlock { ClvFrame frame; };
[[vk::binding(CLV_BIND_LEVEL)]] cbuffer LevelBlock { ClvLevelFrame level; };
[[vk::binding(CLV_BIND_PICTURE)]] cbuffer PictureBlock { ClvPicture picture; };
[[vk::binding(CLV_BIND_MAP_FACES)]] StructuredBuffer<ClvMapFace> faces;
[[vk::binding(CLV_BIND_TABLE)]] StructuredBuffer<uint> table;
[[vk::binding(CLV_BIND_SPLITS)]] StructuredBuffer<ClvSplit> splits;
[[vk::binding(CLV_BIND_SLOTS)]] StructuredBuffer<ClvSlot> slots;
[[vk::binding(CLV_BIND_HISTORY)]] Buffer<float4> history;
[[vk::binding(CLV_BIND_FACE_TRIANGLES)]] Texture2D<uint> seen;
[[vk::binding(CLV_BIND_RADIANCE)]] RWStructuredBuffer<float4> radiance;

uint clvReadTable(uint cell) { return table[cell]; }
ClvSplit clvReadSplit(uint i) { return splits[i]; }
ClvSlot clvReadSlot(uint i) { return slots[i]; }
float4 clvReadHistory(uint row) { return history.Load(int(row)); }
#include "clv/stages/deferred.h"

[numthreads(CLV_GROUP_SIZE, 1, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
    uint i = clvItem(thread);
    if (i >= picture.width * picture.height) return;
    uint2 pixel = uint2(i % picture.width, i / picture.width);
    uint triangleSeen = seen.Load(int3(pixel, 0)).x;
    radiance[i] = float4(0.0, 0.0, 0.0, 0.0);
    if (triangleSeen == 0u) return;
    ClvRay ray = clvPixelRay(faces[0], pixel, uint2(picture.width, picture.height));
    ClvHit hit = surfaceHit(clvMeetTriangle(triangleSeen - 1u, ray.origin, ray.direction, clvNoTriangle(ray.maxDistance)), ray.direction);
    if (hit.primitive == kClvNoPrimitive) return;
    ClvRecordFormat format;
    format.storage = storage;
    format.channels = channels;
    format.stride = stride;
    ClvReceiver receiver = clvReceiverOfHit(ray, hit);
    ClvCoefficients read = clvReadCoefficients(storage, clvKeptDirection(frame, turned, receiver.normal));
    float3 irradiance = clvMeanIrradianceAt(level.volume, receiver, format, read, level.slotCount, frame.halves);
    radiance[i] = float4(clvDeferredRadiance(hit.albedo, irradiance, picture), 1.0);
}
