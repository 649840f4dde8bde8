// A picture's indirect light: what the surface behind each pixel sends to the camera.
//
// A shader defines, before it includes this, what stages/lookup.h asks for.
#ifndef CLV_STAGES_DEFERRED_H
#define CLV_STAGES_DEFERRED_H
#include "../data/hit.h"
#include "../data/picture.h"
#include "lookup.h"
#include "map_face.h"
CLV_NAMESPACE_BEGIN

// From the camera through the middle of a pixel.
CLV_FN ClvRay clvPixelRay(ClvMapFace camera, uvec2 pixel, uvec2 size) {
    ClvRay ray;
    ray.origin = camera.origin;
    ray.maxDistance = kClvFar;
    ray.direction = camera.forward;
    ray.dynamicity = 0.0f;
    ray.flux = vec3(0.0f, 0.0f, 0.0f);
    ray.pad0 = 0.0f;
    return clvFaceRay(camera, ray, pixel, size);
}

CLV_FN ClvReceiver clvReceiverOfHit(ClvRay ray, ClvHit hit) {
    ClvReceiver receiver;
    receiver.position = ray.origin + ray.direction * hit.distance;
    receiver.pad0 = 0.0f;
    receiver.normal = hit.normal;
    receiver.pad1 = 0.0f;
    return receiver;
}

// The mean of what the halves' records say, W/m^2.
CLV_READER_FN vec3 clvMeanIrradianceAt(CLV_READER ClvVolume volume, ClvReceiver receiver, ClvRecordFormat format, ClvCoefficients read, uint slotCount, uint halves) {
    vec3 sum = vec3(0.0f, 0.0f, 0.0f);
    for (uint k = 0u; k < halves; ++k) sum += clvIrradianceAt(CLV_PASS_READER volume, receiver, format, read, k * slotCount);
    return sum * (1.0f / float(halves));
}

// What a Lambertian surface under this irradiance and the ambient term sends out, W/(m^2 sr).
CLV_FN vec3 clvDeferredRadiance(vec3 albedo, vec3 irradiance, ClvPicture picture) {
    return albedo * (irradiance + clvAmbient(irradiance, picture.ambient, picture.ambientThreshold)) * kClvInvPi;
}

CLV_NAMESPACE_END
#endif
