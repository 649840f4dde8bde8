// Embree as plain as it gets: one ray at a time. What the trace stage is measured against.
#pragma once
#include <algorithm>

#include <embree3/rtcore.h>

#include "bindings/scene/scene.h"
#include "clv/data/ray.h"

namespace clv {

class NativeTracer {
public:
    explicit NativeTracer(const Scene& scene) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        std::copy(scene.positions.begin(), scene.positions.end(),
                  static_cast<vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(vec3), scene.positions.size())));
        std::copy(scene.triangles.begin(), scene.triangles.end(),
                  static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), scene.triangles.size())));
        rtcCommitGeometry(geometry);
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    ~NativeTracer() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    NativeTracer(const NativeTracer&) = delete;
    NativeTracer& operator=(const NativeTracer&) = delete;

    // Distance to what the ray meets first, m; its maxDistance where that is nothing.
    float trace(const ClvRay& ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit query{};
        query.ray.org_x = ray.origin.x, query.ray.org_y = ray.origin.y, query.ray.org_z = ray.origin.z;
        query.ray.dir_x = ray.direction.x, query.ray.dir_y = ray.direction.y, query.ray.dir_z = ray.direction.z;
        query.ray.tfar = ray.maxDistance;
        query.ray.mask = ~0u;
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &query);
        return query.ray.tfar;
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

}  // namespace clv
