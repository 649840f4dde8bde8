// The trace passes cut rays where the shared walk does on the host, and say what they met.
#include <gtest/gtest.h>

#include "clv/math/sobol.h"
#include "clv/stages/pick_texel.h"
#include "clv/stages/rays.h"
#include "vulkan/traced_scene.h"

namespace clv::test {
namespace trace_test {

constexpr std::uint32_t kSide = 32, kRays = 8192;

// The ray as the rays pass left it.
ClvRay uncut(ClvRay ray) {
    if (ray.maxDistance > 0.0f) ray.maxDistance = kClvFar;
    return ray;
}

void expectRaysOfTheHost(const TracedScene& traced, const TracedScene::Results& results) {
    std::size_t cut = 0;
    for (std::size_t i = 0; i < results.rays.size(); ++i) {
        const ClvHit hit = traced.reader().hit(uncut(results.rays[i]));
        ASSERT_EQ(results.rays[i].maxDistance, clvCutRay(uncut(results.rays[i]), hit).maxDistance) << i;
        cut += hit.primitive != kClvNoPrimitive;
    }
    EXPECT_GT(cut, results.rays.size() / 8);
}

TEST(VulkanTrace, cutsRaysWhereTheHostCutsThem) {
    for (const char* name : {"cornell", "two_rooms", "atrium"}) {
        SCOPED_TRACE(name);
        TracedScene traced(makeBuiltinScene(name), kSide, kRays, false);
        const TracedScene::Results results = runInBothLanguages(traced);
        expectRaysOfTheHost(traced, results);
        std::vector<ClvRay> embree;
        for (const ClvRay& ray : results.rays) embree.push_back(uncut(ray));
        traced.embree.trace(embree);
        std::size_t different = 0;
        for (std::size_t i = 0; i < kRays; ++i) different += std::abs(results.rays[i].maxDistance - embree[i].maxDistance) > 1e-4f * embree[i].maxDistance;
        EXPECT_LE(different, 1u);
    }
}

void expectHitsOfTheHost(const TracedScene& traced, const TracedScene::Results& results) {
    expectRaysOfTheHost(traced, results);
    for (std::size_t i = 0; i < results.rays.size(); ++i) {
        const ClvHit expected = traced.reader().hit(uncut(results.rays[i])), hit = results.hits[i];
        ASSERT_EQ(hit.primitive, expected.primitive) << i;
        ASSERT_EQ(hit.distance, expected.distance) << i;
        ASSERT_EQ(hit.normal, expected.normal) << i;
        ASSERT_EQ(hit.albedo, expected.albedo) << i;
    }
}

TEST(VulkanTrace, hitsAreThoseOfTheHost) {
    TracedScene traced(makeBuiltinScene("two_rooms"), kSide, kRays, true);
    expectHitsOfTheHost(traced, runInBothLanguages(traced));
}

TEST(VulkanTrace, hitsInPaintedScenesHaveTheTexturesColour) {
    TracedScene traced(paintedCornell(), kSide, kRays, true);
    ASSERT_GT(traced.settings.textureTexels, 0u);
    const TracedScene::Results results = runInBothLanguages(traced);
    expectHitsOfTheHost(traced, results);
    std::size_t painted = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
        const ClvHit& hit = results.hits[i];
        if (hit.primitive == kClvNoPrimitive) continue;
        const ClvRay ray = uncut(results.rays[i]);
        const ClvHit embree = traced.embree.hit(ray.origin, ray.direction, kClvFar);
        if (embree.primitive != hit.primitive) continue;
        EXPECT_LT(length(hit.albedo - embree.albedo), 1e-4f) << i;
        painted += traced.scene.materials[traced.scene.materialOf[hit.primitive]].texture >= 0;
    }
    EXPECT_GT(painted, kRays / 8);
}

TEST(VulkanTrace, framesWithoutTexturesBindNone) {
    LightFrameSettings settings = TracedScene(makeBuiltinScene("cornell"), kSide, kRays, true).settings;
    const auto bindsTextures = [](const Frame& frame) {
        for (const FrameBuffer& buffer : frame.buffers) {
            if (buffer.binding == CLV_BIND_TEXTURE_ROWS || buffer.binding == CLV_BIND_TEXTURE_TEXELS) return true;
        }
        return false;
    };
    EXPECT_FALSE(bindsTextures(lightFrame(settings)));
    settings.textureTexels = 1;
    EXPECT_TRUE(bindsTextures(lightFrame(settings)));
}

// The device finds the triangles that the walk finds, in what it has built of them.
void expectWhatTheWalkFinds(TraceWay way) {
    for (const bool keepHits : {false, true}) {
        for (const char* name : {"cornell", "two_rooms", "atrium", "painted"}) {
            SCOPED_TRACE(name);
            TracedScene traced(name == std::string("painted") ? paintedCornell() : makeBuiltinScene(name), kSide, kRays, keepHits);
            const TracedScene::Results walked = traced.run(ShaderLanguage::glsl);
            traced.traceBy(way);
            const TracedScene::Results found = traced.run(ShaderLanguage::glsl);
            // Rays through an edge may meet either of two triangles, or pass between them in one of the two.
            std::size_t texels = 0, rays = 0, hits = 0;
            for (std::size_t i = 0; i < walked.texels.size(); ++i) texels += std::memcmp(&walked.texels[i], &found.texels[i], sizeof(ClvRsmTexel)) != 0;
            for (std::size_t i = 0; i < walked.rays.size(); ++i) rays += walked.rays[i].maxDistance != found.rays[i].maxDistance;
            for (std::size_t i = 0; i < walked.hits.size(); ++i) hits += std::memcmp(&walked.hits[i], &found.hits[i], sizeof(ClvHit)) != 0;
            EXPECT_EQ(texels, 0u);
            EXPECT_EQ(rays, 0u);
            EXPECT_EQ(hits, 0u);
            EXPECT_EQ(traced.device.messages(), std::vector<std::string>());
        }
    }
}

TEST(VulkanTrace, queriesFindWhatTheWalkFinds) {
    if (!VulkanDevice().info().features.rayQueries) GTEST_SKIP() << "this device has no ray queries";
    expectWhatTheWalkFinds(TraceWay::query);
}

TEST(VulkanTrace, pipelinesFindWhatTheWalkFinds) {
    if (!VulkanDevice().info().features.rayPipelines) GTEST_SKIP() << "this device has no ray-tracing pipelines";
    expectWhatTheWalkFinds(TraceWay::pipeline);
}

// Expects that the device refuses frames that trace by that way, in one line that holds the words.
void expectRefusal(const VulkanOptions& options, TraceWay way, const std::string& words) {
    LightFrameSettings settings = TracedScene(makeBuiltinScene("cornell"), kSide, kRays, false).settings;
    settings.trace = way, settings.accelerationBytes = 1 << 20;
    VulkanDevice device(options);
    try {
        VulkanFrame frame(device, lightFrame(settings));
        ADD_FAILURE() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
    EXPECT_EQ(device.messages(), std::vector<std::string>());
}

TEST(VulkanTrace, rayTracingIsRefusedWhereItIsNotSwitchedOn) {
    for (const TraceWay way : {TraceWay::query, TraceWay::pipeline}) expectRefusal({.validate = true}, way, " ray tracing");
}

// Many devices of data centres have pipelines alone.
TEST(VulkanTrace, oneWayToTraceDoesNotSwitchOnTheOther) {
    const VulkanFeatures features = VulkanDevice().info().features;
    if (!features.rayQueries || !features.rayPipelines) GTEST_SKIP() << "this device has not both";
    expectRefusal({.rayPipelines = true, .validate = true}, TraceWay::query, "needs ray queries, which are not switched on");
    expectRefusal({.rayQueries = true, .validate = true}, TraceWay::pipeline, "needs ray-tracing pipelines, which are not switched on");
}

TEST(VulkanTrace, deadRaysStayDead) {
    // No light sends anything: all rays are dead.
    Scene scene = makeBuiltinScene("cornell");
    for (NamedLight& light : scene.lights) light.light.intensity = vec3(0.0f);
    TracedScene traced(std::move(scene), kSide, 256, true);
    const TracedScene::Results results = runInBothLanguages(traced);
    for (std::size_t i = 0; i < results.rays.size(); ++i) {
        EXPECT_EQ(results.rays[i].maxDistance, 0.0f);
        EXPECT_EQ(results.rays[i].flux, vec3(0.0f));
        EXPECT_EQ(results.hits[i].primitive, kClvNoPrimitive);
        EXPECT_EQ(results.hits[i].distance, kClvFar);
    }
}

}  // namespace trace_test
}  // namespace clv::test
