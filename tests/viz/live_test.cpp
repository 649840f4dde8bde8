// Light that is computed beside the view.
#include <gtest/gtest.h>

#include "bindings/embree/task_pool.h"
#include "bindings/embree/visible_points.h"
#include "viz/live_light.h"

using namespace clv;

namespace {

struct LiveScene {
    BakedVolume volume;
    World world;

    LiveScene() : volume(volumeOf(loadScene("cornell"))), world(volume, "") {}
    static BakedVolume volumeOf(const Scene& scene) {
        BakedVolume volume;
        volume.scene = "cornell";
        volume.anchor = scene.anchor;
        volume.lights = scene.lights;
        return volume;
    }
    float mostDynamicity() const { return std::ranges::max(volume.cascades[0].dynamicity); }
};

double meanOf(const std::vector<vec3>& irradiance) {
    double sum = 0.0;
    for (const vec3& e : irradiance) sum += double(e.x + e.y + e.z) / 3.0;
    return sum / double(irradiance.size());
}

TEST(LiveLight, comesToTheIrradianceOfPathTracing) {
    constexpr double kTolerance = 0.05;  // of the mean: what 16 frames of rays and cells of a sixteenth of the room leave of error
    LiveScene scene;
    const ParallelFor parallelFor = tbbParallelFor();
    LiveLight live(scene.world, {.resolution = 18, .historyTime = 100.0f}, parallelFor);
    for (int frame = 0; frame < 16; ++frame) live.frame(1.0f / 30.0f, scene.volume);
    EXPECT_EQ(scene.volume.frame, 16u);
    std::vector<ReferencePoint> points;
    std::vector<vec3> irradiance;
    for (const ClvReceiver& receiver : visiblePoints(scene.world.embree(), 300, 1)) {
        points.push_back({receiver.position, receiver.normal});
        irradiance.push_back(irradianceAt(scene.volume, receiver));
    }
    std::vector<ReferenceResult> results(points.size());
    referenceIrradiance(scene.world.embree(), points, {.samplesPerPoint = 512}, parallelFor, results);
    std::vector<vec3> truth;
    for (const ReferenceResult& result : results) truth.push_back(result.irradiance);
    EXPECT_NEAR(meanOf(irradiance), meanOf(truth), kTolerance * meanOf(truth));
    EXPECT_GT(meanOf(truth), 0.0);
}

TEST(LiveLight, sidesThatALightOnTheMoveReachesAreDynamic) {
    LiveScene scene;
    LiveLight live(scene.world, {.resolution = 12}, tbbParallelFor());
    live.frame(1.0f / 30.0f, scene.volume);
    EXPECT_EQ(scene.mostDynamicity(), 0.0f);
    std::vector<NamedLight> lights = scene.volume.lights;
    lights[0].light.dynamicity = 1.0f;
    scene.world.setLights(lights);
    live.frame(1.0f / 30.0f, scene.volume);
    EXPECT_FLOAT_EQ(scene.mostDynamicity(), 1.0f);
    EXPECT_FLOAT_EQ(scene.volume.lights[0].light.dynamicity, 1.0f);
}

TEST(LiveLight, saysWhatEachStageTook) {
    LiveScene scene;
    LiveLight live(scene.world, {.resolution = 12}, tbbParallelFor());
    live.frame(1.0f / 30.0f, scene.volume);
    std::vector<std::string> names;
    for (const auto& [name, seconds] : live.stages()) {
        names.push_back(name);
        EXPECT_GT(seconds, 0.0) << name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"rsm", "rays", "trace", "inject", "merge"}));
}

}  // namespace
