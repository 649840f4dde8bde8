// Whole pictures by few lookups: how far they are from lookups at every point, and what they cost.
#include "benchmarks/baselines/picture_reading.h"

#include "baselines/method_run.h"
#include "benchmarks/baselines/light_volume.h"

namespace clv::test {
namespace {

constexpr std::size_t kRays = 64 << 10;

// Of a method at a room's points, after one frame.
std::vector<glm::vec3> lightOf(Method& method, const MeasuredRoom& room) {
    method.prepare(room.world(), room.points);
    return lightAfter(method, room, 1, 1, kRays);
}

TEST(PictureReading, errsAtThePixelsHardlyMoreThanLookupsAtEachOfThem) {
    for (const char* name : {"cornell", "atrium"}) {
        const MeasuredRoom room(name, 500, 1024);
        const auto truth = room.trueIrradiance();
        const LightVolumeSettings settings{.resolution = 32, .guided = false};
        const auto exact = lightOf(*makeLightVolume(settings), room), read = lightOf(*makePictureReading(makeLightVolume(settings), 4), room);
        EXPECT_LT(relativeErrors(read, truth).rmse, 1.05 * relativeErrors(exact, truth).rmse) << name;
        EXPECT_LT(relativeErrors(read, exact).rmse, 0.1) << name;
        EXPECT_GT(relativeErrors(read, exact).rmse, 0.0) << name << ": most points are interpolated";
    }
}

TEST(PictureReading, itsErrorIsThatOfTheInterpolationToo) {
    const MeasuredRoom room("cornell", 200, 1);
    const LightVolumeSettings settings{.resolution = 16, .guided = false};
    const auto exact = lightOf(*makeLightVolume(settings), room), fine = lightOf(*makePictureReading(makeLightVolume(settings), 4), room),
               coarse = lightOf(*makePictureReading(makeLightVolume(settings), 64), room);
    EXPECT_GT(relativeErrors(coarse, exact).rmse, 2.0 * relativeErrors(fine, exact).rmse);
}

TEST(PictureReading, readsAllPixelsThatSeeASurfaceFasterThanOneByOne) {
    const MeasuredRoom room("cornell", 50, 1);
    const auto method = makePictureReading(makeLightVolume({.resolution = 16, .guided = false}), 4);
    EXPECT_EQ(method->picturePixels(), 0u) << "not prepared yet";
    lightOf(*method, room);
    EXPECT_GT(method->picturePixels(), 100'000u);
    EXPECT_LE(method->picturePixels(), std::size_t(kPictureWidth) * kPictureHeight);
    EXPECT_EQ(method->settings().back(), (MethodSettings::value_type{"pixels", "1 in 16"}));
    EXPECT_EQ(method->name(), "clv");
    method->readPicture();
}

TEST(PictureReading, whatNoCameraSeesIsReadForItself) {
    MeasuredRoom room("cornell", 5, 1);
    const Camera& camera = room.embree.scene().cameras.front();
    room.points.push_back({camera.position - camera.forward * 0.1f, camera.forward});
    const LightVolumeSettings settings{.resolution = 16, .guided = false};
    const auto exact = lightOf(*makeLightVolume(settings), room), read = lightOf(*makePictureReading(makeLightVolume(settings), 4), room);
    EXPECT_LT(glm::length(read.back() - exact.back()), 1e-6f * glm::length(exact.front()));
}

}  // namespace
}  // namespace clv::test
