// DDGI: its maps, its probes, and how near it comes to the truth.
#include <numeric>

#include <gtest/gtest.h>

#include "baselines/method_run.h"
#include "benchmarks/baselines/ddgi.h"
#include "benchmarks/baselines/ddgi_probes.h"
#include "benchmarks/baselines/octahedral_maps.h"
#include "furnace/surface_points.h"

namespace clv::test {
namespace {

TEST(OctahedralMaps, readWhatTheirTexelsHold) {
    OctahedralMaps<8, 2> maps;
    maps.clear(2);
    for (int t = 0; t < 64; ++t) maps.texel(1, t)[1] = float(t);
    maps.fillBorder(1);
    for (int t = 0; t < 64; ++t) EXPECT_NEAR((maps.read(1, maps.direction(t))[1]), float(t), 1e-4f);
}

TEST(OctahedralMaps, readingsAreContinuousAcrossTheSquaresEdges) {
    OctahedralMaps<16, 3> maps;
    maps.clear(1);
    for (int t = 0; t < 256; ++t) {
        const vec3 d = maps.direction(t);
        for (int c = 0; c < 3; ++c) maps.texel(0, t)[c] = d[c];
    }
    maps.fillBorder(0);
    // The edges are the meridians x = 0 and y = 0 below the equator: next to them on both sides lies the same light.
    for (int i = 0; i < 100; ++i) {
        const float angle = kClvPi * (float(i) + 0.5f) / 100.0f, side = 1e-4f;
        for (const int across : {0, 1}) {
            vec3 left(std::cos(angle), std::cos(angle), -std::sin(angle)), right;
            left[across] = side;
            right = left, right[across] = -side;
            const auto a = maps.read(0, normalize(left)), b = maps.read(0, normalize(right));
            EXPECT_LT(glm::distance(vec3(a[0], a[1], a[2]), vec3(b[0], b[1], b[2])), 10.0f * side) << i;
        }
    }
}

TEST(DdgiProbes, standInTheOpen) {
    const MeasuredRoom room("furnace_box");
    DdgiProbes probes;
    probes.place(room.world(), 12, vec3(0.2f, 0.5f, 0.7f), Readers::anywhere, {});
    EXPECT_GT(probes.positions().size(), 500u);
    for (const vec3& p : probes.positions()) {
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GT(p[axis], room.scene.bounds.lo[axis]);
            EXPECT_LT(p[axis], room.scene.bounds.hi[axis]);
        }
        EXPECT_FALSE(p.x > 0.17f && p.y < -0.11f && p.z < -0.16f) << "in the cupboard";
    }
}

TEST(DdgiProbes, thoseNearSurfacesAreWhatReceiversRead) {
    const MeasuredRoom room("two_rooms", 300, 1);
    DdgiProbes all, near;
    all.place(room.world(), 20, vec3(0.0f), Readers::anywhere, room.points);
    near.place(room.world(), 20, vec3(0.0f), Readers::surfaces, room.points);
    EXPECT_LT(near.positions().size(), all.positions().size() * 3 / 4);
    for (const ReferencePoint& point : room.points) {
        const ProbeCage a = all.cageAround(all.biased(point.position, point.normal)), b = near.cageAround(near.biased(point.position, point.normal));
        EXPECT_NEAR(std::accumulate(a.weight.begin(), a.weight.end(), 0.0f), 1.0f, 1e-5f);
        for (int k = 0; k < 8; ++k) {
            EXPECT_EQ(a.weight[k], b.weight[k]);
            ASSERT_EQ(a.probe[k] == kNoProbe, b.probe[k] == kNoProbe);
            if (a.probe[k] == kNoProbe) continue;
            EXPECT_EQ(all.positions()[a.probe[k]], near.positions()[b.probe[k]]);
        }
    }
}

// Errors of the mean of `frames` frames.
RelativeErrors errorsOf(const MeasuredRoom& room, DdgiSettings settings, int frames, std::size_t rays) {
    const auto method = makeDdgi(settings);
    method->prepare(room.world(), room.points);
    return relativeErrors(lightAfter(*method, room, 1, frames, rays), room.trueIrradiance());
}

TEST(Ddgi, whiteSphereReadsItsClosedForm) {
    MeasuredRoom room("white_sphere");
    room.points = surfacePoints(room.scene, 200, 3);
    const double expected = 0.8 * 4.0 * M_PI / surfaceArea(room.scene);
    for (const float encoding : {1.0f, 5.0f}) {
        const auto method = makeDdgi({.resolution = 8, .readers = Readers::receivers, .encoding = encoding});
        method->prepare(room.world(), room.points);
        for (const glm::vec3& e : lightAfter(*method, room, 1, 2, 64 << 10)) EXPECT_NEAR(e.x / expected, 1.0, 4e-3);
    }
}

TEST(Ddgi, convergesNearToTheTruth) {
    // Rooms that it was made for. What remains is interpolation between probes: an eighth at this spacing.
    const DdgiSettings mean{.resolution = 16, .gridShift = vec3(0.13f, 0.37f, 0.21f), .hysteresis = 1.0f, .encoding = 1.0f};
    for (const char* name : {"cornell", "two_rooms"}) {
        const MeasuredRoom room(name, 400, 2048);
        EXPECT_LT(errorsOf(room, mean, 2, 1 << 20).rmse, 0.125) << name;
    }
}

TEST(Ddgi, finerProbesComeNearer) {
    const MeasuredRoom room("cornell", 300, 2048);
    DdgiSettings settings{.resolution = 6, .readers = Readers::receivers, .hysteresis = 1.0f, .encoding = 1.0f};
    const double coarse = errorsOf(room, settings, 1, 1 << 20).rmse;
    settings.resolution = 20;
    EXPECT_LT(errorsOf(room, settings, 1, 1 << 20).rmse, 0.7 * coarse);
}

TEST(Ddgi, encodingDarkensWhatIsNoisy) {
    const MeasuredRoom room("cornell", 300, 2048);
    DdgiSettings settings{.resolution = 12, .readers = Readers::receivers, .hysteresis = 1.0f, .encoding = 1.0f};
    const double converged = errorsOf(room, settings, 1, 1 << 20).bias, linear = errorsOf(room, settings, 32, 32 << 10).bias;
    settings.encoding = 5.0f;
    const double encoded = errorsOf(room, settings, 32, 32 << 10).bias;
    // The mean of roots is less than the root of the mean; linear frames only add up.
    EXPECT_NEAR(linear, converged, 0.02);
    EXPECT_LT(encoded, linear - 0.05);
}

TEST(Ddgi, hysteresisBoundsWhatFramesAddUpTo) {
    const MeasuredRoom room("cornell", 300, 2048);
    DdgiSettings settings{.resolution = 12, .readers = Readers::receivers, .hysteresis = 0.5f, .encoding = 1.0f};
    const double forgetful = errorsOf(room, settings, 24, 16 << 10).rmse;
    settings.hysteresis = 1.0f;
    EXPECT_LT(errorsOf(room, settings, 24, 16 << 10).rmse, 0.8 * forgetful);
}

TEST(Ddgi, distancesOfEachFrameLeadToTheSameLight) {
    const MeasuredRoom room("two_rooms", 300, 2048);
    DdgiSettings settings{.resolution = 12, .readers = Readers::receivers, .hysteresis = 1.0f, .encoding = 1.0f};
    const double once = errorsOf(room, settings, 4, 1 << 20).rmse;
    settings.distancesOnce = false;
    EXPECT_NEAR(errorsOf(room, settings, 4, 1 << 20).rmse, once, 0.1 * once);
}

TEST(Ddgi, raysOfOneSequenceFillEachOthersGaps) {
    const MeasuredRoom room("two_rooms", 300, 2048);
    DdgiSettings settings{.resolution = 16, .readers = Readers::receivers, .hysteresis = 1.0f, .encoding = 1.0f};
    const double turned = errorsOf(room, settings, 32, 32 << 10).rmse;
    settings.turnedRays = false;
    EXPECT_LT(errorsOf(room, settings, 32, 32 << 10).rmse, 0.8 * turned);
}

TEST(Ddgi, weightsFoundAtEachReadingAreThoseThatAreKept) {
    const MeasuredRoom room("two_rooms", 200, 1);
    const auto kept = makeDdgi({.resolution = 10, .keptWeights = true}), each = makeDdgi({.resolution = 10, .keptWeights = false});
    for (const auto& method : {kept.get(), each.get()}) method->prepare(room.world(), room.points);
    EXPECT_EQ(lightAfter(*kept, room, 1, 1, 16 << 10), lightAfter(*each, room, 1, 1, 16 << 10));
}

TEST(Ddgi, lightFollowsFromTheSeed) {
    expectLightFollowsFromTheSeed([] { return makeDdgi({.resolution = 6, .distancesOnce = false}); }, 16 << 10);
}

TEST(Ddgi, forgetsOnRestart) {
    const MeasuredRoom room("cornell", 50, 1);
    const auto method = makeDdgi({.resolution = 6, .readers = Readers::receivers});
    method->prepare(room.world(), room.points);
    lightAfter(*method, room, 1, 1, 4 << 10);
    EXPECT_GT(method->raysTraced(), 4u << 10);
    expectNothingAfterRestart(*method, room);
}

}  // namespace
}  // namespace clv::test
