// What keys and the mouse do in the window.
#include "viz/viz_window.h"

using namespace clv;
using namespace clv::test;

namespace {

class Window : public VizWindow {};

// Positions that clicks printed, "at (x, y, z) m".
std::vector<vec3> placesIn(const std::string& text) {
    std::vector<vec3> places;
    for (std::size_t at = 0; (at = text.find("at (", at)) != std::string::npos; ++at) {
        vec3 p(0.0f);
        if (std::sscanf(text.c_str() + at, "at (%f, %f, %f) m", &p.x, &p.y, &p.z) == 3) places.push_back(p);
    }
    return places;
}

TEST_F(Window, aClickPrintsTheCellAndAKeyCloses) {
    open({bake("cornell", 8), "--size", "320x180"});
    ASSERT_EQ(doToWindow("mousemove 160 90 click 1"), 0);
    const CommandResult result = close();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_TRUE(contains(result.out, "of cascade 0")) << result.out;
    EXPECT_TRUE(contains(result.out, "dynamicity")) << result.out;
}

TEST_F(Window, aSliceFollowsTheMouse) {
    // Looks along -z, a little from the right, at the middle of a plane across x.
    open({bake("cornell", 8), "--size", "320x180", "--no-boxes", "--camera", "1.2,0.28,2.4,0.3,0.28,0.25", "--view", "irradiance", "--slice", "x=0.3"});
    ASSERT_EQ(doToWindow("mousemove 160 90 click 1 mousedown 1 mousemove 152 90 mousemove 145 90 mouseup 1 click 1"), 0);
    const CommandResult result = close();
    EXPECT_EQ(result.status, 0) << result.err;
    const std::vector<vec3> places = placesIn(result.out);
    ASSERT_EQ(places.size(), 2u) << result.out;
    EXPECT_NEAR(places[0].x, 0.3f, 1e-3f);
    EXPECT_LT(places[1].x, 0.25f);
    EXPECT_GT(places[1].x, 0.05f);
}

TEST_F(Window, theSceneIsSeenThroughItsCamerasAgain) {
    const std::string volume = bake("two_rooms", 8);
    const Scene scene = loadScene("two_rooms");
    ASSERT_GE(scene.cameras.size(), 2u);
    open({volume, "--size", "320x180", "--view", "mesh"});
    ASSERT_EQ(doToWindow("key s mousemove 160 90 click 1 key r key s mousemove 160 90 click 1"), 0);
    const CommandResult result = close();
    EXPECT_EQ(result.status, 0) << result.err;
    const std::vector<vec3> places = placesIn(result.out);
    ASSERT_EQ(places.size(), 2u) << result.out;
    for (std::size_t k = 0; k < 2; ++k) {
        const Camera& camera = scene.cameras[k];
        EXPECT_GT(dot(normalize(vec3(glm::dvec3(places[k]) - scene.anchor) - camera.position), camera.forward), 0.99f) << camera.name;
    }
}

TEST_F(Window, keysChangeTheViewAndListThemselves) {
    const std::string volume = bake("cornell", 8);
    open({volume, "--size", "320x180"});
    // Help; then each subject, each light of the mesh, an own plane, another cascade, thresholds.
    ASSERT_EQ(doToWindow("key h key h key 3 key 4 key 8 key d key i key z key c key Up key Down key o key s key r key n key 1 mousemove 160 90 click 1"), 0);
    const CommandResult result = close();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
}

TEST_F(Window, liveLightRunsBesideTheViewWhileASliderMoves) {
    open({"--live", "--scene", "cornell", "--view", "mesh", "--size", "320x180"});
    // The first slider says how many rays a frame has.
    ASSERT_EQ(doToWindow("mousemove 280 15 mousedown 1 mousemove 265 15 mouseup 1 sleep 0.3 mousemove 150 90 click 1"), 0);
    const CommandResult result = close();
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(contains(result.out, "the surface receives")) << result.out;
}

}  // namespace
