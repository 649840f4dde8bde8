// Path tracing a pixel: each receiver sends rays of its own, and every hit is lit by shadow rays. Unbiased; nothing is shared.
#pragma once
#include <memory>

#include "benchmarks/baselines/method.h"

namespace clv {

// Cosine-weighted directions; those of a receiver are one Owen-scrambled Sobol' sequence that goes on from frame to frame. A frame
// sends the same number of rays, at least one, from every receiver.
std::unique_ptr<Method> makePathTracing();

}  // namespace clv
