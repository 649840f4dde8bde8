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
    Camera camera() const { return world.scene().cameras.front(); }
    void frame(LiveLight& live) { live.frame(1.0f / 30.0f, camera(), volume); }
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
    LiveLight live(scene.world, {.resolution = 18, .historyTime = 100.0}, scene.camera(), parallelFor);
    for (int frame = 0; frame < 16; ++frame) scene.frame(live);
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
    LiveLight live(scene.world, {.resolution = 12}, scene.camera(), tbbParallelFor());
    scene.frame(live);
    EXPECT_EQ(scene.mostDynamicity(), 0.0f);
    std::vector<NamedLight> lights = scene.volume.lights;
    lights[0].light.dynamicity = 1.0f;
    scene.world.setLights(lights);
    scene.frame(live);
    EXPECT_FLOAT_EQ(scene.mostDynamicity(), 1.0f);
    EXPECT_FLOAT_EQ(scene.volume.lights[0].light.dynamicity, 1.0f);
}

TEST(LiveLight, saysWhatEachStageTook) {
    LiveScene scene;
    LiveLight live(scene.world, {.resolution = 12}, scene.camera(), tbbParallelFor());
    scene.frame(live);
    std::vector<std::string> names;
    for (const auto& [name, seconds] : live.stages()) {
        names.push_back(name);
        EXPECT_GT(seconds, 0.0) << name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"move", "rsm", "rays", "trace", "inject", "merge"}));
    scene.frame(live);
    EXPECT_EQ(live.stages().front().first, "rsm") << "the volume stays where it is";
}

TEST(LiveLight, cascadesFollowTheCameraAndKeepTheirLight) {
    LiveScene scene;
    const ParallelFor parallelFor = tbbParallelFor();
    LiveLight live(scene.world, {.resolution = 16, .cascades = 2, .rays = 64 << 10}, scene.camera(), parallelFor);
    Camera camera = scene.camera();
    for (int frame = 0; frame < 4; ++frame) live.frame(1.0f / 30.0f, camera, scene.volume);
    ASSERT_EQ(scene.volume.cascades.size(), 2u);
    const vec3 before = scene.volume.cascades[0].level.volume.origin;
    const float cell = scene.volume.cascades[0].level.volume.cellSize;
    EXPECT_FLOAT_EQ(scene.volume.cascades[1].level.volume.cellSize, 2.0f * cell);
    camera.position += 3.0f * cell * camera.forward;
    live.frame(1.0f / 30.0f, camera, scene.volume);
    const BakedCascade& moved = scene.volume.cascades[0];
    EXPECT_NEAR(glm::length(moved.level.volume.origin - before), 3.0f * cell, 1.8f * cell);
    EXPECT_EQ(scene.volume.camera->position, camera.position);
    // What was there already stands for more frames than what is new.
    EXPECT_NEAR(std::ranges::max(moved.samples), 5.0f * float(64 << 10), 1.0f);
    EXPECT_LT(std::ranges::min(moved.samples), 4.0f * float(64 << 10));
}

}  // namespace
