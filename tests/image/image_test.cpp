// Pictures survive the way to disk and back.
#include "bindings/image/image.h"

#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

namespace {

using namespace clv;

// A folder of its own for each test, removed at its end.
class ImageFile : public ::testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::path(::testing::TempDir()) /
                  (std::string("clv_image_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string file(const char* name) const { return (folder_ / name).string(); }

    std::filesystem::path folder_;
};

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = {0.1f * float(x), 7.3f * float(y), 1e-3f * float(x * y + 1)};
    return image;
}

TEST_F(ImageFile, exrInFloatComesBackToTheLastBit) {
    const Image written = gradient(7, 5);
    writeExr(written, file("f.exr"), ExrPrecision::kFloat);
    const Image read = readImage(file("f.exr"));
    ASSERT_EQ(read.width, 7);
    ASSERT_EQ(read.height, 5);
    EXPECT_EQ(read.pixels, written.pixels);
}

TEST_F(ImageFile, exrInHalfComesBackWithinItsElevenBits) {
    const Image written = gradient(7, 5);
    writeExr(written, file("h.exr"));
    const Image read = readImage(file("h.exr"));
    for (std::size_t i = 0; i < written.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(read.pixels[i][channel], written.pixels[i][channel], written.pixels[i][channel] / 2048.0f);
    EXPECT_NE(read.pixels, written.pixels);
}

TEST_F(ImageFile, pngComesBackWithinHalfAStepOfItsEightBits) {
    Image written(256, 1);
    for (int x = 0; x < 256; ++x) written.at(x, 0) = glm::vec3(float(x) / 255.0f, 1.0f - float(x) / 255.0f, 0.5f);
    writePng(written, file("p.png"));
    const Image read = readImage(file("p.png"));
    for (std::size_t i = 0; i < written.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(srgbFromLinear(read.pixels[i][channel]), srgbFromLinear(written.pixels[i][channel]), 0.5f / 255.0f + 1e-5f);
}

TEST_F(ImageFile, pngClampsWhatTheScreenCannotShow) {
    Image written(3, 1);
    written.at(0, 0) = glm::vec3(-1.0f, 17.0f, std::numeric_limits<float>::quiet_NaN());
    written.at(1, 0) = glm::vec3(std::numeric_limits<float>::infinity());
    writePng(written, file("c.png"));
    const Image read = readImage(file("c.png"));
    EXPECT_EQ(read.at(0, 0), glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_EQ(read.at(1, 0), glm::vec3(1.0f));
}

TEST_F(ImageFile, aFolderThatDoesNotExistIsNamedInOneLine) {
    for (const char* name : {"missing/a.exr", "missing/a.png"}) {
        try {
            name[std::string(name).size() - 3] == 'e' ? writeExr(Image(2, 2), file(name)) : writePng(Image(2, 2), file(name));
            FAIL() << "expected an ImageError";
        } catch (const ImageError& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find(file(name)), std::string::npos) << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        }
    }
    EXPECT_THROW(readImage(file("missing.exr")), ImageError);
}

TEST(Srgb, encodingAndDecodingAreInverse) {
    for (int i = 0; i <= 1000; ++i) EXPECT_NEAR(linearFromSrgb(srgbFromLinear(float(i) / 1000.0f)), float(i) / 1000.0f, 2e-6f);
    // IEC 61966-2-1: middle grey, 18 %, is 118 of 255.
    EXPECT_EQ(std::lround(255.0f * srgbFromLinear(0.18f)), 118);
}

}  // namespace
