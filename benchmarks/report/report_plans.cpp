#include "benchmarks/report/report_plans.h"

#include "benchmarks/baselines/ddgi.h"
#include "benchmarks/baselines/light_propagation.h"
#include "benchmarks/baselines/light_volume.h"
#include "benchmarks/baselines/path_tracing.h"
#include "benchmarks/baselines/picture_reading.h"
#include "benchmarks/baselines/thesis.h"
#include "benchmarks/baselines/vulkan_volume.h"
#include "benchmarks/report/curves.h"
#include "clv/cpu/resolution.h"

namespace clv {
namespace {

constexpr std::uint64_t kThousand = 1 << 10, kMillion = 1 << 20;

// DDGI where nothing moves: the plain mean of linear irradiance, over rays of one sequence.
const DdgiSettings kDdgiMean{.hysteresis = 1.0f, .encoding = 1.0f, .turnedRays = false};

MethodCase lightVolume(const LightVolumeSettings& settings, std::vector<std::uint64_t> rays, std::vector<int> frames = {1}) {
    return {.make = [settings] { return makeLightVolume(settings); }, .rays = std::move(rays), .frames = std::move(frames)};
}

// A third of the cells at each point, at a higher error: what budgets of a few milliseconds buy.
LightVolumeSettings quickToRead(int resolution) { return {.resolution = resolution, .lookup = kClvLookupTrilinear, .guided = false}; }

// Two thirds of the numbers a cell, too.
LightVolumeSettings quickToFill(int resolution) {
    LightVolumeSettings settings = quickToRead(resolution);
    settings.storage = kClvStorageCube;
    return settings;
}

MethodCase ddgi(const DdgiSettings& settings, std::vector<std::uint64_t> rays, std::vector<int> frames) {
    return {.make = [settings] { return makeDdgi(settings); }, .rays = std::move(rays), .frames = std::move(frames)};
}

MethodCase thesis(const ThesisSettings& settings, std::vector<std::uint64_t> rays, std::vector<int> frames) {
    return {.make = [settings] { return makeThesis(settings); }, .rays = std::move(rays), .frames = std::move(frames)};
}

// Traces no rays, whatever it is asked for.
MethodCase propagation(const LightPropagationSettings& settings, std::vector<int> frames) {
    return {.make = [settings] { return makeLightPropagation(settings); }, .rays = {1}, .frames = std::move(frames)};
}

// The same for a picture, looked up at every fourth pixel across and down.
MethodCase asPicture(const MethodCase& one) {
    MethodCase picture = one;
    picture.make = [make = one.make] { return makePictureReading(make(), 4); };
    return picture;
}

void addVulkan(const std::string& device, std::initializer_list<int> resolutions, const std::vector<int>& frames, std::vector<MethodCase>& cases) {
    if (device.empty()) return;
    for (const int resolution : resolutions) {
        const VulkanVolumeSettings settings{.device = device, .resolution = resolution};
        cases.push_back({.make = [settings] { return makeVulkanVolume(settings); }, .rays = {64 * kThousand}, .frames = frames});
    }
}

}  // namespace

ReportPlan quickPlan(const std::string& vulkanDevice) {
    ReportPlan plan;
    plan.scenes = {"cornell", "atrium"};
    plan.cases = {
        lightVolume({}, {4 * kThousand, 16 * kThousand, 64 * kThousand, 256 * kThousand, kMillion}),
        lightVolume({.lookup = kClvLookupTrilinear, .guided = false}, {16 * kThousand, 64 * kThousand, 256 * kThousand}),
        lightVolume(quickToRead(8), {kThousand, 2 * kThousand, 4 * kThousand, 8 * kThousand, 16 * kThousand}),
        lightVolume(quickToRead(16), {4 * kThousand, 8 * kThousand, 10 * kThousand, 12 * kThousand, 16 * kThousand, 32 * kThousand}, {1, 4}),
        lightVolume(quickToFill(16), {8 * kThousand, 10 * kThousand, 12 * kThousand, 16 * kThousand, 24 * kThousand, 40 * kThousand}),
        lightVolume({.resolution = 8, .guided = false}, {2 * kThousand, 4 * kThousand, 8 * kThousand, 16 * kThousand}, {1, 4}),
        lightVolume({.resolution = 16, .guided = false}, {4 * kThousand, 16 * kThousand, 24 * kThousand, 32 * kThousand, 64 * kThousand}, {1, 4, 16}),
        lightVolume({.resolution = 32}, {16 * kThousand, 64 * kThousand}, {1, 4, 16}),
        lightVolume({.resolution = 64}, {64 * kThousand}, {1, 4, 16}),
        lightVolume({.resolution = 16, .readers = Readers::anywhere, .guided = false}, {64 * kThousand}, {1, 4, 16}),
        {.make = makePathTracing, .rays = {16 * kThousand, 64 * kThousand, 256 * kThousand, kMillion, 4 * kMillion}},
        thesis({.resolution = 16}, {16 * kThousand, 64 * kThousand}, {1, 4, 16}),
        thesis({.resolution = 32}, {64 * kThousand}, {1, 4, 16}),
        propagation({.resolution = 8, .iterations = 16}, {1, 4}),
        propagation({.resolution = 16, .iterations = 8}, {1, 4}),
        propagation({.resolution = 32}, {1, 4}),
        ddgi({.resolution = 8}, {64 * kThousand}, {1, 4, 16}),
        ddgi({.resolution = 16}, {64 * kThousand}, {1, 4, 16}),
        ddgi(kDdgiMean, {64 * kThousand}, {1, 4, 16}),
        ddgi({.resolution = 16, .readers = Readers::anywhere}, {256 * kThousand}, {1, 4}),
        asPicture(lightVolume({}, {64 * kThousand, 256 * kThousand})),
        asPicture(lightVolume({.resolution = 16, .guided = false}, {16 * kThousand, 64 * kThousand}, {1, 4, 16})),
        asPicture(lightVolume({.resolution = 32}, {64 * kThousand}, {1, 4, 16})),
        asPicture(ddgi({.resolution = 16}, {64 * kThousand}, {1, 4, 16})),
    };
    addVulkan(vulkanDevice, {16, 32}, {1, 4}, plan.cases);
    plan.truth = {.points = 1000, .pictureWidth = 64, .samples = 8192};
    plan.repeats = 4;
    return plan;
}

ReportPlan fullPlan(const std::string& vulkanDevice) {
    ReportPlan plan;
    plan.scenes = {"cornell", "two_rooms", "atrium", "atrium_turned"};
    const std::vector<std::uint64_t> rays = {4 * kThousand, 16 * kThousand, 64 * kThousand, 256 * kThousand, kMillion, 4 * kMillion};
    const std::vector<int> frames = {1, 4, 16, 64}, fewFrames = {1, 4}, merged = {4, 16, 64};
    plan.cases = {lightVolume({}, rays), lightVolume({.guided = false}, rays), lightVolume({.lookup = kClvLookupTrilinear, .guided = false}, rays)};
    for (const int resolution : {8, 16, 32}) plan.cases.push_back(lightVolume(quickToRead(resolution), {kThousand, 2 * kThousand, 4 * kThousand, 8 * kThousand, 12 * kThousand, 16 * kThousand, 32 * kThousand}, {1, 4}));
    for (const int resolution : {8, 16}) plan.cases.push_back(lightVolume(quickToFill(resolution), {4 * kThousand, 8 * kThousand, 12 * kThousand, 16 * kThousand, 24 * kThousand, 40 * kThousand}));
    for (const int resolution : {8, 16}) {
        LightVolumeSettings everywhere = quickToRead(resolution);
        everywhere.readers = Readers::anywhere;
        plan.cases.push_back(lightVolume(everywhere, {2 * kThousand, 8 * kThousand, 16 * kThousand, 32 * kThousand}, {1, 4}));
    }
    plan.cases.push_back(lightVolume({.resolution = 16, .readers = Readers::anywhere, .guided = false}, {16 * kThousand, 64 * kThousand}, frames));
    for (const int planned : {16, 64}) plan.cases.push_back(lightVolume({.plannedRays = planned * 64 * kThousand}, {64 * kThousand}, {planned}));
    for (const int resolution : kResolutions) plan.cases.push_back(lightVolume({.resolution = resolution}, rays));
    plan.cases.push_back(lightVolume({.resolution = 8, .guided = false}, {kThousand, 2 * kThousand, 4 * kThousand, 8 * kThousand, 16 * kThousand, 64 * kThousand}, fewFrames));
    plan.cases.push_back(lightVolume({.resolution = 8, .readers = Readers::anywhere, .guided = false}, {2 * kThousand, 4 * kThousand, 16 * kThousand, 64 * kThousand}, fewFrames));
    for (const int resolution : {16, 32, 64}) {
        plan.cases.push_back(lightVolume({.resolution = resolution}, {64 * kThousand}, merged));
        plan.cases.push_back(lightVolume({.resolution = resolution, .guided = false}, {64 * kThousand}, frames));
        plan.cases.push_back(lightVolume({.resolution = resolution, .readers = Readers::anywhere}, {64 * kThousand}, frames));
        plan.cases.push_back(asPicture(lightVolume({.resolution = resolution, .guided = false}, {16 * kThousand, 64 * kThousand}, frames)));
    }
    // As many rays as bring the floor out of the noise.
    for (const int resolution : {32, 64}) {
        plan.cases.push_back(lightVolume({.resolution = resolution}, {4 * kMillion}, {4, 16}));
        plan.cases.back().repeats = 2;
    }
    for (const unsigned lookup : {kClvLookupLinearFit, kClvLookupTrilinear}) {
        plan.cases.push_back(asPicture(lightVolume({.lookup = lookup, .guided = lookup == kClvLookupLinearFit}, {16 * kThousand, 64 * kThousand, 256 * kThousand, kMillion})));
    }
    for (const unsigned storage : {kClvStorageCube, kClvStorageSh1, kClvStorageSh2}) plan.cases.push_back(lightVolume({.resolution = 32, .storage = storage}, rays));
    plan.cases.push_back({.make = makePathTracing, .rays = {16 * kThousand, 64 * kThousand, 256 * kThousand, kMillion, 4 * kMillion, 16 * kMillion}});
    for (const Readers readers : {Readers::surfaces, Readers::anywhere}) {
        for (const int resolution : {8, 16, 32}) {
            for (DdgiSettings settings : {DdgiSettings(), kDdgiMean}) {
                settings.resolution = resolution, settings.readers = readers;
                plan.cases.push_back(ddgi(settings, {64 * kThousand}, frames));
                plan.cases.push_back(ddgi(settings, {512 * kThousand}, fewFrames));
                if (resolution == 16 && readers == Readers::surfaces) plan.cases.push_back(asPicture(ddgi(settings, {64 * kThousand}, frames)));
            }
        }
    }
    for (const int resolution : {16, 32, 64}) {
        for (const float blend : {0.05f, 0.2f}) {
            plan.cases.push_back(thesis({.resolution = resolution, .blend = blend}, {16 * kThousand, 64 * kThousand}, frames));
            plan.cases.push_back(thesis({.resolution = resolution, .blend = blend}, {512 * kThousand}, fewFrames));
        }
    }
    // Light crosses the scene in about as many steps as it has cells along an axis.
    for (const int resolution : {8, 16, 32}) {
        for (const int iterations : {resolution, 2 * resolution}) plan.cases.push_back(propagation({.resolution = resolution, .iterations = iterations}, {1, 4, 16}));
    }
    addVulkan(vulkanDevice, {16, 32, 64}, {1, 4, 16}, plan.cases);
    // Most of the time is that of the others; this library's rows are compared with each other to the percent.
    for (MethodCase& one : plan.cases) {
        if (one.repeats == 0 && one.make()->name() != kLibraryName) one.repeats = 4;
    }
    plan.truth = {.points = 3000, .pictureWidth = 128, .samples = 65536};
    plan.repeats = 8;
    return plan;
}

}  // namespace clv
