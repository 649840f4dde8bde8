// Pictures from lookups at few pixels: bilinear on one surface, never across an edge.
#include "clv/cpu/picture_lookup.h"

#include <gtest/gtest.h>

namespace {

using namespace clv;

// What the pixels of a picture see, and the light that they ask for.
struct Picture {
    Picture(int width, int height) : width(width), pixels(std::size_t(width) * height, ClvReceiver{vec3(0.0f), 0.0f, vec3(0.0f), 0.0f}) {}
    ClvReceiver& at(int x, int y) { return pixels[std::size_t(y) * width + x]; }

    template <class Light>
    std::vector<vec3> lit(int spacing, const Light& light) {
        const PictureLookup lookup(pixels, width, spacing, serialFor());
        points = lookup.points().size();
        std::vector<vec3> atPoints, out(pixels.size(), vec3(-1.0f));
        for (const ClvReceiver& r : lookup.points()) atPoints.push_back(light(r));
        lookup.irradiance(atPoints, out, serialFor());
        return out;
    }

    int width;
    std::vector<ClvReceiver> pixels;
    std::size_t points = 0;  // looked up
};

// A wall in the plane z = depth, seen straight on: a pixel is a step.
ClvReceiver wall(int x, int y, float depth) { return {vec3(float(x), float(y), depth), 0.0f, vec3(0, 0, 1), 0.0f}; }

TEST(PictureLookup, onOneWallItIsBilinearAndLooksUpOnePixelInSpacingSquared) {
    for (const int spacing : {1, 2, 4, 5}) {
        Picture picture(22, 13);
        for (int y = 0; y < 13; ++y)
            for (int x = 0; x < 22; ++x) picture.at(x, y) = wall(x, y, 2.0f);
        const auto ramp = [](const ClvReceiver& r) { return vec3(10.0f + r.position.x, 20.0f + r.position.y, 7.0f); };
        const auto out = picture.lit(spacing, ramp);
        const auto across = [&](int pixels) { return std::size_t((pixels - 1 + spacing - 1) / spacing + 1); };
        EXPECT_EQ(picture.points, across(22) * across(13));
        for (std::size_t i = 0; i < out.size(); ++i) {
            const vec3 expected = ramp(picture.pixels[i]);
            // Shares are 255ths of what the four around differ by.
            EXPECT_NEAR(out[i].x, expected.x, 0.02f * float(spacing)) << i;
            EXPECT_NEAR(out[i].y, expected.y, 0.02f * float(spacing)) << i;
            EXPECT_NEAR(out[i].z, 7.0f, 1e-5f) << i;
        }
    }
}

TEST(PictureLookup, lightOfOneWallNeverReachesAnotherNorTheSky) {
    Picture picture(32, 32);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            if (x < 13) picture.at(x, y) = wall(x, y, 2.0f);
            if (x >= 13 && x < 26) picture.at(x, y) = wall(x, y, 9.0f);
            // A floor, and a post two pixels wide that no looked-up pixel of every fourth sees.
            if (y >= 27 && x < 26) picture.at(x, y) = {vec3(float(x), 0.0f, 0.1f * float(y)), 0.0f, vec3(0, 1, 0), 0.0f};
            if (x == 17 || x == 18) picture.at(x, y) = wall(x, y, 1.0f);
        }
    }
    const auto byPlace = [](const ClvReceiver& r) { return vec3(r.position.z, r.normal.y, 1.0f); };
    const auto out = picture.lit(4, byPlace);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const ClvReceiver& seen = picture.pixels[i];
        if (seen.normal == vec3(0.0f)) {
            EXPECT_EQ(out[i], vec3(0.0f)) << i;
        } else {
            EXPECT_NEAR(out[i].x, seen.position.z, seen.normal.y > 0.0f ? 0.3f : 1e-4f) << i % 32 << ", " << i / 32;
            EXPECT_NEAR(out[i].y, seen.normal.y, 1e-5f) << i % 32 << ", " << i / 32;
            EXPECT_NEAR(out[i].z, 1.0f, 1e-5f) << i;
        }
    }
    EXPECT_LT(picture.points, 32u * 32u / 5u);
}

TEST(PictureLookup, picturesThinnerThanASpacingAndEmptyOnesHold) {
    Picture line(1, 9), empty(5, 5);
    for (int y = 0; y < 9; ++y) line.at(0, y) = wall(0, y, 1.0f);
    const auto out = line.lit(4, [](const ClvReceiver& r) { return vec3(r.position.y); });
    for (int y = 0; y < 9; ++y) EXPECT_NEAR(out[std::size_t(y)].x, float(y), 0.05f);
    for (const vec3& e : empty.lit(4, [](const ClvReceiver&) { return vec3(1.0f); })) EXPECT_EQ(e, vec3(0.0f));
    EXPECT_EQ(empty.points, 0u);
}

}  // namespace
