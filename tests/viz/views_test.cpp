// Views drawn without a display, against pictures that a person has looked at.
#include <vtkImageData.h>
#include <vtkImageDifference.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "viz/viz_command.h"

using namespace clv;
using namespace clv::test;

namespace {

constexpr int kWidth = 320, kHeight = 180;
// Differences that VTK counts, in steps of a whole pixel from black to white, a pixel of the picture: other versions of Mesa and FreeType
// move edges and letters by a fraction of a pixel.
constexpr double kTolerance = 0.01;

double differencePerPixel(const std::string& picture, const std::string& reference) {
    vtkNew<vtkPNGReader> a, b;
    a->SetFileName(picture.c_str());
    b->SetFileName(reference.c_str());
    a->Update();
    b->Update();
    const int* size = a->GetOutput()->GetDimensions();
    if (size[0] != kWidth || size[1] != kHeight) return 1.0;
    vtkNew<vtkImageDifference> difference;
    difference->SetInputConnection(a->GetOutputPort());
    difference->SetImageConnection(b->GetOutputPort());
    difference->Update();
    return difference->GetThresholdedError() / (kWidth * kHeight);
}

struct NamedView {
    std::string name;
    std::vector<std::string> options;
};

class Views : public VizCommand, public ::testing::WithParamInterface<NamedView> {};

TEST_P(Views, lookLikeTheirReference) {
    unsetenv("DISPLAY");
    const std::string volume = bake("cornell", 12), picture = file("picture.png");
    std::vector<std::string> arguments{volume, "--size", "320x180", "--out", picture};
    arguments.insert(arguments.end(), GetParam().options.begin(), GetParam().options.end());
    const CommandResult result = runViz(arguments);
    ASSERT_EQ(result.status, 0) << result.err;
    const std::string reference = CLV_SOURCE_DIR "/tests/viz/references/" + GetParam().name + ".png";
    const double difference = differencePerPixel(picture, reference);
    EXPECT_LE(difference, kTolerance);
    // Kept, to be looked at.
    const std::string kept = CLV_BINARY_DIR "/viz_" + GetParam().name + ".png";
    std::filesystem::remove(kept);
    if (!(difference <= kTolerance)) std::filesystem::copy_file(picture, kept);
}

INSTANTIATE_TEST_SUITE_P(Headless, Views,
                         ::testing::Values(NamedView{"cubes", {}}, NamedView{"variance_slices", {"--view", "variance", "--slice", "z=0.1", "x=0.2"}},
                                           NamedView{"irradiance_volume", {"--view", "irradiance", "--on", "volume", "--wireframe"}},
                                           NamedView{"mesh_from_within", {"--view", "mesh", "--direct", "--camera", "0"}},
                                           NamedView{"rays", {"--view", "rays", "--rays", "300", "--lights", "--frustum"}},
                                           NamedView{"error", {"--view", "error", "--error-samples", "64"}}),
                         [](const auto& info) { return info.param.name; });

TEST_F(Views, pictureIsWholeOrAbsent) {
    const std::string volume = bake("cornell", 8);
    const CommandResult result = runViz({volume, "--out", file("missing/picture.png")});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(listing(), (std::vector<std::string>{"V", "V.vtm"}));
}

}  // namespace
