// How far apart two pictures are, by the measures of OpenImageIO.
#pragma once
#include "bindings/image/image.h"

namespace clv {

// How far a picture is from the true one, both brought to the screen by the exposure of the true one.
struct ImageErrors {
    double rms = 0.0;   // of the channels, white = 1
    double psnr = 0.0;  // dB; infinite for the same picture
    // Share of the pixels that look different (Yee 2004). OpenImageIO 2.4 lets differences of brightness alone pass, however large.
    double perceptualFailures = 0.0;
};

// Radiance, pictures of the same size. Measured by OpenImageIO. Throws ImageError.
ImageErrors compareImages(const Image& radiance, const Image& trueRadiance);

}  // namespace clv
