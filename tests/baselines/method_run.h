// A scene, receivers in it and their truth, and how far a method is from it.
#ifndef CLV_TESTS_BASELINES_METHOD_RUN_H
#define CLV_TESTS_BASELINES_METHOD_RUN_H
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "benchmarks/baselines/method.h"
#include "bindings/embree/task_pool.h"
#include "bindings/embree/visible_points.h"

namespace clv::test {

struct MeasuredRoom {
    explicit MeasuredRoom(const std::string& name) : scene(makeBuiltinScene(name)), embree(scene) {}
    // Points that the scene's cameras see, and `samples` paths for the truth at each.
    MeasuredRoom(const std::string& name, std::size_t count, std::uint64_t samples) : MeasuredRoom(name) {
        for (const ClvReceiver& r : visiblePoints(embree, count, 7)) points.push_back({r.position, r.normal});
        truth.resize(points.size());
        referenceIrradiance(embree, points, {.samplesPerPoint = samples}, parallelFor, truth);
    }
    MeasuredRoom(const MeasuredRoom&) = delete;

    MethodWorld world() const { return {embree, parallelFor}; }
    std::vector<glm::vec3> trueIrradiance() const {
        std::vector<glm::vec3> values;
        for (const ReferenceResult& t : truth) values.push_back(t.irradiance);
        return values;
    }

    Scene scene;
    EmbreeScene embree;
    ParallelFor parallelFor = tbbParallelFor();
    std::vector<ReferencePoint> points;
    std::vector<ReferenceResult> truth;
};

inline std::vector<glm::vec3> irradianceOf(Method& method, std::size_t receivers) {
    std::vector<glm::vec3> values(receivers);
    method.irradiance(values);
    return values;
}

// W/m^2 at the room's points after `frames` frames of `rays` rays from a fresh start.
inline std::vector<glm::vec3> lightAfter(Method& method, const MeasuredRoom& room, std::uint32_t seed, int frames, std::size_t rays) {
    method.restart(seed);
    for (int k = 0; k < frames; ++k) {
        method.renderMaps();
        method.frame(rays);
    }
    return irradianceOf(method, room.points.size());
}

// The same seed gives the same light, after a restart and on any number of threads; another seed gives other light.
template <class Make>
void expectLightFollowsFromTheSeed(const Make& make, std::size_t rays) {
    const MeasuredRoom room("two_rooms", 70, 1);
    const ParallelFor serial = serialFor();
    const std::unique_ptr<Method> parallel = make(), alone = make();
    parallel->prepare(room.world(), room.points);
    alone->prepare({room.embree, serial}, room.points);
    const auto light = lightAfter(*parallel, room, 5, 2, rays);
    EXPECT_EQ(light, lightAfter(*alone, room, 5, 2, rays));
    EXPECT_NE(light, lightAfter(*parallel, room, 6, 2, rays));
    EXPECT_EQ(light, lightAfter(*parallel, room, 5, 2, rays));
}

// Nothing is read before the first frame, and nothing is counted.
inline void expectNothingAfterRestart(Method& method, const MeasuredRoom& room) {
    method.restart(2);
    EXPECT_EQ(method.raysTraced(), 0u);
    for (const glm::vec3& e : irradianceOf(method, room.points.size())) EXPECT_EQ(e, glm::vec3(0.0f));
}

// Over points and channels, relative to the mean of the truth.
struct RelativeErrors {
    double rmse = 0.0, bias = 0.0;
};
inline RelativeErrors relativeErrors(const std::vector<glm::vec3>& estimate, const std::vector<glm::vec3>& truth) {
    double squares = 0.0, difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(estimate[i]) - glm::dvec3(truth[i]);
        squares += glm::dot(d, d);
        difference += d.x + d.y + d.z;
        sum += double(truth[i].x) + truth[i].y + truth[i].z;
    }
    return {std::sqrt(squares * 3.0 * double(truth.size())) / sum, difference / sum};
}

}  // namespace clv::test
#endif
