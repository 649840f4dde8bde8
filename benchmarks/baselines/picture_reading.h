// Any method whose rays are shared, read for a whole picture: looked up at a part of the pixels, and bilinear between them.
#pragma once
#include <memory>

#include "benchmarks/baselines/method.h"

namespace clv {

// `spacing`: every so many pixels across and down are looked up, and those that none of them can stand for (clv/cpu/picture_lookup.h). Each
// receiver is read as the pixel of its camera's picture in which it lies, its error that of the interpolation and the method's own; those that no
// camera sees are read for themselves.
std::unique_ptr<Method> makePictureReading(std::unique_ptr<Method> method, int spacing);

}  // namespace clv
