// Views drawn without a display, against pictures that a person has looked at.
#include <vtkImageData.h>
#include <vtkImageDifference.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "viz/viz_command.h"

using namespace clv;
using namespace clv::test;

namespace {

// Differences that VTK counts, in steps of a whole pixel from black to white, a pixel of the picture: other versions of Mesa and FreeType
// move edges and letters by a fraction of a pixel.
constexpr double kTolerance = 0.01;

vtkNew<vtkPNGReader> readPicture(const std::string& file) {
    vtkNew<vtkPNGReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    return reader;
}

double differencePerPixel(const std::string& picture, const std::string& reference) {
    const auto a = readPicture(picture), b = readPicture(reference);
    const int *size = a->GetOutput()->GetDimensions(), *expected = b->GetOutput()->GetDimensions();
    if (size[0] != expected[0] || size[1] != expected[1]) return 1.0;
    vtkNew<vtkImageDifference> difference;
    difference->SetInputConnection(a->GetOutputPort());
    difference->SetImageConnection(b->GetOutputPort());
    difference->Update();
    return difference->GetThresholdedError() / (double(size[0]) * size[1]);
}

enum class Shown { one, two, moved };

struct NamedView {
    std::string name;
    std::vector<std::string> options;
    Shown shown = Shown::one;
    int scale = 2;  // of the smallest size, which words and plots do not fit into
};

class Views : public VizCommand, public ::testing::WithParamInterface<NamedView> {
protected:
    // The volumes that a view is of; of two the second one has half the light in the left half of the room.
    std::vector<std::string> bakeFor(Shown shown) const {
        const std::string volume = bake("cornell", 12);
        if (shown == Shown::one) return {volume};
        BakedVolume other = shown == Shown::moved ? movedScene("cornell", 12) : bakedScene("cornell", 12);
        BakedCascade& cascade = other.cascades[0];
        const std::size_t stride = std::size_t(other.layout.stride());
        for (std::size_t slot = 0; shown == Shown::two && slot < cascade.level.slots.size(); ++slot) {
            if (cascade.level.slots[slot].openCentroid.x > other.mark->bounds.center().x) continue;
            for (auto& estimate : cascade.estimates) {
                for (std::size_t k = 0; k < stride; ++k) estimate[slot * stride + k] *= 0.5f;
            }
        }
        writeVolume("W.vtm", other, pathOf());
        return shown == Shown::moved ? std::vector{file("W.vtm")} : std::vector{volume, file("W.vtm")};
    }
};

TEST_P(Views, lookLikeTheirReference) {
    unsetenv("DISPLAY");
    const std::string picture = file("picture.png");
    std::vector<std::string> arguments = bakeFor(GetParam().shown);
    arguments.insert(arguments.end(), {"--size", GetParam().scale == 1 ? "320x180" : "640x360", "--out", picture});
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
                         ::testing::Values(NamedView{"cubes", {}, Shown::one, 1}, NamedView{"lights_behind_cubes", {"--lights", "--frustum", "--pick", "0.28,0.28,0.28"}},
                                            NamedView{"variance_slices", {"--view", "variance", "--slice", "z=0.1", "x=0.2"}, Shown::one, 1},
                                           NamedView{"picked_cell", {"--view", "irradiance", "--slice", "z=0.3", "--pick", "0.2,0.3,0.3"}},
                                           NamedView{"noise_slices", {"--view", "noise", "--slice", "z=0.1"}},
                                           NamedView{"irradiance_volume", {"--view", "irradiance", "--on", "volume", "--wireframe"}, Shown::one, 1},
                                           NamedView{"mesh_from_within", {"--view", "mesh", "--direct", "--camera", "0"}, Shown::one, 1},
                                           NamedView{"rays", {"--view", "rays", "--rays", "300", "--lights", "--frustum"}, Shown::one, 1},
                                           NamedView{"error", {"--view", "error", "--error-samples", "64"}, Shown::one, 1},
                                           NamedView{"error_cells", {"--view", "error", "--on", "cells", "--error-samples", "64", "--range", "0,1"}},
                                           NamedView{"error_slices", {"--view", "error", "--slice", "z=0.1", "--error-samples", "64", "--range", "0,1"}},
                                           NamedView{"truth", {"--truth", "--view", "irradiance", "--slice", "z=0.1", "--error-samples", "64"}},
                                           NamedView{"side_by_side", {"--view", "irradiance", "--on", "cells"}, Shown::two},
                                           NamedView{"difference", {"--view", "irradiance", "--difference"}, Shown::two},
                                           NamedView{"probe", {"--view", "irradiance", "--slice", "y=0.3", "--probe", "0.05,0.3,0.2,0.5,0.3,0.4"}},
                                           NamedView{"probe_across_a_block", {"--view", "irradiance", "--probe", "0.01,0.2,0.3,0.54,0.2,0.3"}},
                                           NamedView{"histogram", {"--view", "irradiance", "--histogram"}},
                                           NamedView{"figure_3_1", {"--figure", "3.1"}}, NamedView{"figure_3_2", {"--figure", "3.2"}},
                                           NamedView{"figure_3_3", {"--figure", "3.3"}, Shown::moved}, NamedView{"figure_4_1", {"--figure", "4.1"}},
                                           NamedView{"figure_4_3", {"--figure", "4.3"}}),
                         [](const auto& info) { return info.param.name; });

TEST_F(Views, aVolumeIsAsDenseFromOneSideAsFromAnother) {
    unsetenv("DISPLAY");
    const std::string volume = bake("cornell", 12);
    // All cells hold the light of the same number of rays. The background is darker than 30.
    for (const std::string camera : {"0.28,0.28,-1.2,0.28,0.28,0.3", "1.7,0.28,0.28,0.3,0.28,0.28", "1.2,1.1,-0.9,0.28,0.28,0.28"}) {
        const CommandResult result = runViz({volume, "--view", "samples", "--on", "volume", "--no-boxes", "--camera", camera, "--size", "160x120", "--out", file("picture.png")});
        ASSERT_EQ(result.status, 0) << result.err;
        const auto reader = readPicture(file("picture.png"));
        for (int c = 0; c < 3; ++c) EXPECT_GT(reader->GetOutput()->GetScalarComponentAsDouble(80, 60, 0, c), 50.0) << camera;
    }
}

TEST_F(Views, pictureIsWholeOrAbsent) {
    const std::string volume = bake("cornell", 8);
    const CommandResult result = runViz({volume, "--out", file("missing/picture.png")});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(listing(), (std::vector<std::string>{"V", "V.vtm"}));
}

}  // namespace
