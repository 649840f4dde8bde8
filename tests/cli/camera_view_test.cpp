// Cameras are found by name and by index.
#include "bindings/cli/camera_view.h"

#include <gtest/gtest.h>

namespace {

using namespace clv;

TEST(CameraView, camerasAreChosenByNameFirstAndElseByIndex) {
    Scene scene;
    scene.cameras = {{.name = "front"}, {.name = "7"}};
    EXPECT_EQ(&chooseCamera(scene, "front"), &scene.cameras[0]);
    EXPECT_EQ(&chooseCamera(scene, "1"), &scene.cameras[1]);
    EXPECT_EQ(&chooseCamera(scene, "7"), &scene.cameras[1]);
    try {
        chooseCamera(scene, "2");
        FAIL() << "expected an InputError";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "--camera 2: expected an index below 2 or one of: front, 7");
    }
    EXPECT_THROW(chooseCamera(scene, "-1"), InputError);
    EXPECT_THROW(chooseCamera(Scene{}, "0"), InputError);
}

}  // namespace
