// What points see around them: the room that they are in, and nothing of the next one.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bindings/cli/stress/whole_run.h"
#include "bindings/cli/surroundings.h"
#include "bindings/embree/task_pool.h"

namespace clv::test {
namespace {

// Two closed rooms of 2 m, at x = 0 and x = 8 m.
Scene twoRooms() {
    SceneBuilder builder("rooms");
    const std::uint32_t grey = builder.addMaterial({"grey", glm::vec3(0.5f), -1});
    builder.beginNode("rooms");
    for (double x : {0.0, 8.0}) addRoom(builder, grey, 1.0, {x, 0.0, 0.0});
    return std::move(builder).finish("rooms");
}

std::vector<ClvReceiver> onFloorOfTheFirst(const Scene& scene, int count) {
    std::vector<ClvReceiver> points;
    for (int i = 0; i < count; ++i) points.push_back({vec3(-0.9f + 1.8f * float(i) / float(count), -1.0f, 0.2f) - vec3(scene.anchor), 0.0f, vec3(0.0f, 1.0f, 0.0f), 0.0f});
    return points;
}

TEST(Surroundings, nearSightIsWhatATenthOfThePointsSeeHalfOf) {
    const Scene scene = twoRooms();
    const EmbreeScene embree(scene);
    const auto looks = lookAround(embree, onFloorOfTheFirst(scene, 200), tbbParallelFor(2));
    std::vector<float> middles;
    for (const Look& look : looks) middles.push_back(look.middle);
    std::ranges::sort(middles);
    EXPECT_EQ(nearSight(looks), middles[20]);
    EXPECT_GT(middles.front(), 0.3f);
    EXPECT_LT(middles.back(), 2.5f);
    EXPECT_EQ(nearSight({}), kClvFar);
}

}  // namespace
}  // namespace clv::test
