// Time of the trace stage on a Vulkan device, from its timestamps, beside the same walk on one thread of the host and Embree's
// rtcIntersect1 in the same run. The CPU column is the time that all threads of the process took: on a device that runs on the CPU,
// what the work costs there. CLV_DEVICE chooses the device by name.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <map>
#include <memory>

#include "benchmarks/native_tracer.h"
#include "benchmarks/stages/smaller_triangles.h"
#include "bindings/embree/bvh.h"
#include "bindings/embree/rsm.h"
#include "bindings/scene/surface_rows.h"
#include "bindings/vulkan/vulkan_frame.h"
#include "clv/plan/light_frame.h"
#include "clv/stages/trace_bvh.h"

namespace clv {
namespace {

constexpr std::size_t kRays = 65536;
constexpr std::uint32_t kRsmSide = 128, kSeed = 1;
constexpr std::size_t kMostTriangles = 100'000;

struct TreeReader {
    const Bvh& bvh;
    vec4 clvReadBvhBoxes(uint row) const { return bvh.boxes[row]; }
    uvec4 clvReadBvhChildren(uint node) const { return bvh.children[node]; }
    vec4 clvReadTriangle(uint row) const { return bvh.triangles[row]; }
};

// A built-in scene on the device; its rays as the rays pass makes them, before they are cut.
struct Case {
    Case(const std::string& name, int cuts) : scene(withSmallerTriangles(makeBuiltinScene(name), cuts)), bvh(buildBvh(scene)) {
        const char* wanted = std::getenv("CLV_DEVICE");
        device = std::make_unique<VulkanDevice>(VulkanOptions{.device = wanted ? wanted : ""});
        std::vector<ClvLight> lights;
        for (const NamedLight& light : scene.lights) lights.push_back(light.light);
        LightFrameSettings settings;
        settings.lights = lights.size(), settings.rsmSide = kRsmSide, settings.rays = kRays;
        settings.triangles = scene.triangles.size(), settings.bvhNodes = bvh.children.size();
        frame = std::make_unique<VulkanFrame>(*device, lightFrame(settings));
        ClvFrame constants{};
        constants.boundsLo = scene.bounds.lo, constants.boundsHi = scene.bounds.hi;
        constants.rayCount = kRays, constants.halves = 1, constants.seed = kSeed;
        constants.rsmSide = kRsmSide, constants.texelRows = uint(lights.size()) * kRsmSide;
        constants.originOffset = EmbreeScene(scene).surfaceOffset();
        frame->upload("frame", constants);
        frame->upload("lights", std::span<const ClvLight>(lights));
        frame->upload("bvh boxes", std::span<const vec4>(bvh.boxes));
        frame->upload("bvh children", std::span<const uvec4>(bvh.children));
        frame->upload("triangles", std::span<const vec4>(bvh.triangles));
        frame->upload("surfaces", std::span<const vec4>(surfaceRowsOf(scene).surfaces));
        frame->run("rsm");
        frame->run("light");  // shaders are compiled at their first run
        rays.resize(kRays);
        frame->download("rays", std::span(rays));
        for (ClvRay& ray : rays) ray.maxDistance = ray.maxDistance > 0.0f ? kClvFar : 0.0f;

        frame = std::make_unique<VulkanFrame>(*device, traceAlone());
        frame->upload("frame", constants);
        frame->upload("bvh boxes", std::span<const vec4>(bvh.boxes));
        frame->upload("bvh children", std::span<const uvec4>(bvh.children));
        frame->upload("triangles", std::span<const vec4>(bvh.triangles));
        frame->upload("rays", std::span<const ClvRay>(rays));
        frame->run("trace");
    }

    // The trace pass with rays that the host writes.
    Frame traceAlone() const {
        Frame alone;
        alone.buffers = {{"frame", CLV_BIND_FRAME, sizeof(ClvFrame), FrameSource::host},
                         {"rays", CLV_BIND_RAYS, kRays * sizeof(ClvRay), FrameSource::host},
                         {"bvh boxes", CLV_BIND_BVH_BOXES, bvh.boxes.size() * sizeof(vec4), FrameSource::host},
                         {"bvh children", CLV_BIND_BVH_CHILDREN, bvh.children.size() * sizeof(uvec4), FrameSource::host},
                         {"triangles", CLV_BIND_TRIANGLES, bvh.triangles.size() * sizeof(vec4), FrameSource::host}};
        const auto texel = [](std::uint32_t buffer, FrameFormat format) { return FrameUse{buffer, FrameBinding::texel, FrameAccess::read, format}; };
        FramePass pass{.name = "trace", .shader = "trace", .constants = {}, .uses = {}, .groups = groupsFor(kRays), .barriers = {}};
        pass.uses = {{0, FrameBinding::uniform}, {1, FrameBinding::storage, FrameAccess::readWrite}, texel(2, FrameFormat::rgba32Float),
                     texel(3, FrameFormat::rgba32Uint), texel(4, FrameFormat::rgba32Float)};
        alone.steps = {{"trace", {pass}}};
        return alone;
    }

    Scene scene;
    Bvh bvh;
    std::unique_ptr<VulkanDevice> device;
    std::unique_ptr<VulkanFrame> frame;
    std::vector<ClvRay> rays;
};

const Case& caseOf(const std::string& name, int cuts) {
    static std::map<std::pair<std::string, int>, std::unique_ptr<Case>> cases;
    auto& made = cases[{name, cuts}];
    if (!made) made = std::make_unique<Case>(name, cuts);
    return *made;
}

void countRays(benchmark::State& state) {
    state.counters["s/ray"] = benchmark::Counter(double(kRays), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

// The CPU column has the copy of the rays to the device in it.
void onDevice(benchmark::State& state, const Case& c) {
    for (auto _ : state) {
        state.PauseTiming();
        c.frame->upload("rays", std::span<const ClvRay>(c.rays));
        state.ResumeTiming();
        c.frame->run("trace");
        state.SetIterationTime(1e-3 * c.frame->times("trace").front().second);
    }
    state.SetLabel(c.device->info().name);
    countRays(state);
}

void onHost(benchmark::State& state, const Case& c) {
    for (auto _ : state) {
        for (const ClvRay& ray : c.rays) benchmark::DoNotOptimize(clvTraceBvh(TreeReader{c.bvh}, ray.origin, ray.direction, ray.maxDistance));
    }
    state.SetLabel("one thread");
    countRays(state);
}

void withEmbree(benchmark::State& state, const Case& c) {
    const NativeTracer tracer(c.scene);
    for (auto _ : state) {
        for (const ClvRay& ray : c.rays) benchmark::DoNotOptimize(tracer.trace(ray));
    }
    state.SetLabel("one thread");
    countRays(state);
}

[[maybe_unused]] const bool kRegistered = [] {
    for (const std::string scene : {"cornell", "two_rooms", "atrium"}) {
        std::size_t triangles = makeBuiltinScene(scene).triangles.size();
        for (int cuts = 0; triangles <= kMostTriangles; ++cuts, triangles *= 4) {
            auto add = [&](const std::string& way, auto&& body) {
                const std::string name = "gpu_trace/" + scene + "/triangles:" + std::to_string(triangles) + "/" + way;
                return benchmark::RegisterBenchmark(name.c_str(), [scene, cuts, body](benchmark::State& state) { body(state, caseOf(scene, cuts)); })
                    ->Unit(benchmark::kMillisecond)
                    ->MeasureProcessCPUTime();
            };
            add("embree", withEmbree);
            add("host", onHost);
            add("device", onDevice)->UseManualTime();
        }
    }
    return true;
}();

}  // namespace
}  // namespace clv
