#include "bindings/image/compare_images.h"

#include <limits>

#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include "bindings/image/tone_map.h"

namespace clv {
namespace {

OIIO::ImageBuf bufferOver(const Image& image) {
    const OIIO::ImageSpec spec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT);
    return OIIO::ImageBuf(spec, const_cast<glm::vec3*>(image.pixels.data()));
}

// What a screen shows: nothing is brighter than white.
Image shownOn(const Image& radiance, const Exposure& exposure) {
    Image display = toneMap(radiance, exposure);
    for (glm::vec3& pixel : display.pixels) pixel = glm::min(pixel, glm::vec3(1.0f));
    return display;
}

}  // namespace

ImageErrors compareImages(const Image& radiance, const Image& trueRadiance) {
    const Exposure exposure = autoExposure(trueRadiance);
    const Image shown = shownOn(radiance, exposure), truth = shownOn(trueRadiance, exposure);
    const OIIO::ImageBuf a = bufferOver(shown), b = bufferOver(truth);
    // No pixel counts as failed or warned of by its difference alone: what eyes see is asked below.
    const float any = std::numeric_limits<float>::max();
    const OIIO::ImageBufAlgo::CompareResults all = OIIO::ImageBufAlgo::compare(a, b, any, any);
    if (all.error) throw ImageError(fmt::format("pictures cannot be compared: {}", OIIO::geterror()));
    OIIO::ImageBufAlgo::CompareResults seen;
    const int failures = OIIO::ImageBufAlgo::compare_Yee(a, b, seen);
    return {all.rms_error, all.PSNR, double(failures) / double(truth.pixels.size())};
}

}  // namespace clv
