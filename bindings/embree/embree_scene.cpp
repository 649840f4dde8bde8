#include "bindings/embree/embree_scene.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <stdexcept>

#include <embree3/rtcore.h>

#include "bindings/embree/tight_frame.h"
#include "bindings/scene/scene_facts.h"

namespace clv {
namespace {

// Rays in one packet: the widest that Embree has. It splits packets where the processor is narrower.
constexpr std::size_t kPacket = 16;
constexpr std::uint32_t kNone = RTC_INVALID_GEOMETRY_ID;
// Surfaces at distance 0 do not count: a lamp in the corner of a room would light nothing else.
constexpr float kNearest = std::numeric_limits<float>::min();

ClvHit noHit() { return {.normal = glm::vec3(0.0f), .distance = kClvFar, .albedo = glm::vec3(0.0f), .primitive = kNone}; }

RTCIntersectContext incoherentContext() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    return context;
}

// The lanes of a packet that hold a ray which is alive, as Embree wants them: -1 or 0.
struct alignas(64) Lanes {
    int valid[kPacket];
};

// Spreads up to kPacket rays over the lanes of a packet, seen from `frame`.
Lanes fillPacket(std::span<const ClvRay> rays, RTCRay16& packet, const TightFrame& frame = {}) {
    Lanes lanes;
    for (std::size_t k = 0; k < kPacket; ++k) {
        const ClvRay& ray = rays[std::min(k, rays.size() - 1)];
        const glm::vec3 origin = frame.point(ray.origin), direction = frame.direction(ray.direction);
        lanes.valid[k] = k < rays.size() && ray.maxDistance > 0.0f ? -1 : 0;
        packet.org_x[k] = origin.x;
        packet.org_y[k] = origin.y;
        packet.org_z[k] = origin.z;
        packet.dir_x[k] = direction.x;
        packet.dir_y[k] = direction.y;
        packet.dir_z[k] = direction.z;
        packet.tnear[k] = kNearest;
        packet.tfar[k] = ray.maxDistance;
        packet.time[k] = 0.0f;
        packet.mask[k] = ~0u;
        packet.id[k] = 0;
        packet.flags[k] = 0;
    }
    return lanes;
}

RTCRay singleRay(const glm::vec3& origin, const glm::vec3& direction, float maxDistance) {
    return {.org_x = origin.x, .org_y = origin.y, .org_z = origin.z, .tnear = kNearest,
            .dir_x = direction.x, .dir_y = direction.y, .dir_z = direction.z, .time = 0.0f,
            .tfar = maxDistance, .mask = ~0u, .id = 0, .flags = 0};
}

// Calls body(first, count) for every packet of a span of `size` rays.
template <typename Body>
void forEachPacket(std::size_t size, const Body& body) {
    for (std::size_t first = 0; first < size; first += kPacket) body(first, std::min(kPacket, size - first));
}

struct Crossing {
    float distance;
    std::uint32_t primitive;
    auto operator<=>(const Crossing&) const = default;
};

// What lineHits hands to its filter.
struct CrossingContext {
    RTCIntersectContext embree;
    std::vector<Crossing>* crossings;
};

// Notes the crossing and lets the ray pass.
void collectCrossing(const RTCFilterFunctionNArguments* arguments) {
    assert(arguments->N == 1);
    const auto& context = *reinterpret_cast<const CrossingContext*>(arguments->context);
    const float distance = RTCRayN_tfar(arguments->ray, arguments->N, 0);
    if (distance > 0.0f) context.crossings->push_back({distance, RTCHitN_primID(arguments->hit, arguments->N, 0)});
    arguments->valid[0] = 0;
}

}  // namespace

struct EmbreeScene::Impl {
    const Scene& scene;
    RTCDevice device;
    const TightFrame fastFrame;  // that of `fast`; the others keep the scene's own
    RTCScene fast;        // for the trace stage: some 30 % faster, lets about one ray in a million through an edge
    RTCScene watertight;  // for everything that judges
    std::vector<glm::vec3> normals;  // unit length, a triangle each, right-hand rule

    explicit Impl(const Scene& source) : scene(source), device(rtcNewDevice(nullptr)), fastFrame(findTightFrame(source)) {
        if (!device) throw std::runtime_error("Embree cannot start on this processor");
        fast = makeScene(fastFrame, RTC_SCENE_FLAG_NONE);
        watertight = makeScene({}, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));

        normals.reserve(scene.triangles.size());
        for (const glm::uvec3& t : scene.triangles) {
            const glm::vec3& a = scene.positions[t.x];
            normals.push_back(glm::normalize(glm::cross(scene.positions[t.y] - a, scene.positions[t.z] - a)));
        }
    }

    ~Impl() {
        rtcReleaseScene(watertight);
        rtcReleaseScene(fast);
        rtcReleaseDevice(device);
    }

    RTCGeometry makeGeometry(const TightFrame& frame) const {
        const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        // Copies, because Embree reads whole 16-byte words past the last vertex of a shared buffer.
        auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                         sizeof(glm::vec3), scene.positions.size()));
        std::transform(scene.positions.begin(), scene.positions.end(), vertices, [&](const glm::vec3& p) { return frame.point(p); });
        auto* indices = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                         sizeof(glm::uvec3), scene.triangles.size()));
        std::copy(scene.triangles.begin(), scene.triangles.end(), indices);
        rtcCommitGeometry(geometry);
        return geometry;
    }

    RTCScene makeScene(const TightFrame& frame, RTCSceneFlags flags) const {
        const RTCGeometry geometry = makeGeometry(frame);
        const RTCScene result = rtcNewScene(device);
        rtcSetSceneFlags(result, flags);
        rtcSetSceneBuildQuality(result, RTC_BUILD_QUALITY_HIGH);
        rtcAttachGeometry(result, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(result);
        return result;
    }

    ClvHit hitAt(const glm::vec3& direction, float distance, std::uint32_t primitive, float u, float v) const {
        const glm::vec3& front = normals[primitive];
        return {.normal = glm::dot(front, direction) > 0.0f ? -front : front,
                .distance = distance,
                .albedo = scene.albedo(primitive, u, v),
                .primitive = primitive};
    }

    // Rays are seen from `frame`, that of `tree`.
    void trace(RTCScene tree, const TightFrame& frame, std::span<ClvRay> rays, std::span<ClvHit> hits) const {
        assert(rays.size() == hits.size());
        RTCIntersectContext context = incoherentContext();
        forEachPacket(rays.size(), [&](std::size_t first, std::size_t count) {
            RTCRayHit16 packet;
            const Lanes lanes = fillPacket(rays.subspan(first, count), packet.ray, frame);
            std::fill_n(packet.hit.geomID, kPacket, kNone);
            rtcIntersect16(lanes.valid, tree, &context, &packet);
            for (std::size_t k = 0; k < count; ++k) {
                ClvRay& ray = rays[first + k];
                const bool met = lanes.valid[k] && packet.hit.geomID[k] != kNone;
                if (met) ray.maxDistance = packet.ray.tfar[k];
                hits[first + k] = met ? hitAt(ray.direction, ray.maxDistance, packet.hit.primID[k], packet.hit.u[k], packet.hit.v[k]) : noHit();
            }
        });
    }

    void killOccluded(RTCScene tree, const TightFrame& frame, std::span<ClvRay> rays) const {
        RTCIntersectContext context = incoherentContext();
        forEachPacket(rays.size(), [&](std::size_t first, std::size_t count) {
            RTCRay16 packet;
            const Lanes lanes = fillPacket(rays.subspan(first, count), packet, frame);
            rtcOccluded16(lanes.valid, tree, &context, &packet);
            for (std::size_t k = 0; k < count; ++k) {
                // Embree marks a ray that met something by an endless negative reach.
                if (lanes.valid[k] && packet.tfar[k] < 0.0f) rays[first + k].maxDistance = 0.0f;
            }
        });
    }
};

EmbreeScene::EmbreeScene(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
EmbreeScene::~EmbreeScene() = default;

const Scene& EmbreeScene::scene() const { return impl_->scene; }
float EmbreeScene::surfaceOffset() const { return clv::surfaceOffset(impl_->scene.bounds); }

void EmbreeScene::trace(std::span<ClvRay> rays) const {
    RTCIntersectContext context = incoherentContext();
    forEachPacket(rays.size(), [&](std::size_t first, std::size_t count) {
        RTCRayHit16 packet;
        const Lanes lanes = fillPacket(rays.subspan(first, count), packet.ray, impl_->fastFrame);
        std::fill_n(packet.hit.geomID, kPacket, kNone);
        rtcIntersect16(lanes.valid, impl_->fast, &context, &packet);
        for (std::size_t k = 0; k < count; ++k) {
            if (lanes.valid[k]) rays[first + k].maxDistance = packet.ray.tfar[k];
        }
    });
}

void EmbreeScene::trace(std::span<ClvRay> rays, std::span<ClvHit> hits) const { impl_->trace(impl_->watertight, {}, rays, hits); }
void EmbreeScene::traceFast(std::span<ClvRay> rays, std::span<ClvHit> hits) const { impl_->trace(impl_->fast, impl_->fastFrame, rays, hits); }

void EmbreeScene::killOccluded(std::span<ClvRay> rays) const { impl_->killOccluded(impl_->watertight, {}, rays); }
void EmbreeScene::killOccludedFast(std::span<ClvRay> rays) const { impl_->killOccluded(impl_->fast, impl_->fastFrame, rays); }

ClvHit EmbreeScene::hit(const glm::vec3& origin, const glm::vec3& direction, float maxDistance) const {
    RTCIntersectContext context = incoherentContext();
    RTCRayHit query{.ray = singleRay(origin, direction, maxDistance), .hit = {}};
    query.hit.geomID = kNone;
    rtcIntersect1(impl_->watertight, &context, &query);
    if (query.hit.geomID == kNone) return noHit();
    return impl_->hitAt(direction, query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v);
}

bool EmbreeScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float maxDistance) const {
    RTCIntersectContext context = incoherentContext();
    RTCRay query = singleRay(origin, direction, maxDistance);
    rtcOccluded1(impl_->watertight, &context, &query);
    return query.tfar < 0.0f;
}

void EmbreeScene::lineHits(const glm::vec3& origin, const glm::vec3& direction, float maxDistance, std::vector<LineHit>& hits) const {
    // Kept between calls so that a steady state allocates nothing.
    thread_local std::vector<Crossing> crossings;
    crossings.clear();
    CrossingContext context{incoherentContext(), &crossings};
    context.embree.filter = collectCrossing;
    RTCRay query = singleRay(origin, direction, maxDistance);
    rtcOccluded1(impl_->watertight, &context.embree, &query);

    std::sort(crossings.begin(), crossings.end());
    // A triangle that the builder has split may be met once in each part, at the same distance.
    crossings.erase(std::unique(crossings.begin(), crossings.end()), crossings.end());
    hits.clear();
    for (const Crossing& crossing : crossings) {
        const glm::vec3& normal = impl_->normals[crossing.primitive];
        hits.push_back({.distance = crossing.distance, .front = glm::dot(normal, direction) < 0.0f, .normal = normal});
    }
}

}  // namespace clv
