// The truth of a scene is found once.
#include "benchmarks/report/scene_truth.h"

#include "support/temporary_folder.h"

namespace clv::test {
namespace {

class Truth : public TemporaryFolder {};

TEST_F(Truth, isThatOfThePathTracerAtPointsAndInThePicture) {
    const Scene scene = makeBuiltinScene("white_sphere");
    const EmbreeScene embree(scene);
    const SceneTruth truth = findTruth(embree, {.points = 40, .pictureWidth = 8, .samples = 1024}, folder_, serialFor());
    EXPECT_EQ(truth.points, 40u);
    EXPECT_EQ(truth.receivers.size(), truth.points + truth.surfaces.size());
    EXPECT_EQ(truth.surfaces.size(), std::size_t(truth.width * truth.height)) << "the camera stands inside";
    for (const glm::vec3& e : truth.irradiance) EXPECT_NEAR(e.x, 0.8, 0.01);
    EXPECT_LT(truth.error, 0.01);
}

TEST_F(Truth, isReadFromItsFileAndFoundAnewForAnotherQuestionOrADamagedFile) {
    Scene scene = makeBuiltinScene("cornell");
    const EmbreeScene embree(scene);
    const TruthSettings settings{.points = 40, .pictureWidth = 8, .samples = 64};
    const SceneTruth first = findTruth(embree, settings, folder_, serialFor());
    int traced = 0;
    const ParallelFor counting = [&](std::size_t count, const std::function<void(std::size_t)>& body) {
        ++traced;
        serialFor()(count, body);
    };
    findTruth(embree, settings, folder_, counting);
    const int withoutTracing = traced;
    const SceneTruth second = findTruth(embree, settings, folder_, counting);
    EXPECT_EQ(second.irradiance, first.irradiance);
    EXPECT_EQ(second.error, first.error);
    EXPECT_EQ(traced, 2 * withoutTracing);

    scene.materials[0].albedo *= 0.5f;
    findTruth(EmbreeScene(scene), settings, folder_, counting);
    EXPECT_EQ(traced, 3 * withoutTracing + 1) << "other materials, another truth";
    const auto names = listing();
    ASSERT_EQ(names.size(), 2u);
    for (const std::string& name : names) write(name, "nonsense");
    findTruth(EmbreeScene(scene), settings, folder_, counting);
    EXPECT_EQ(traced, 4 * withoutTracing + 2);
}

}  // namespace
}  // namespace clv::test
