#include <gtest/gtest.h>

#include <array>

#include "clv/math/sh.h"

using namespace clv;

namespace {

std::array<float, 9> basis(vec3 d) {
    vec4 a = clvShTo3(d), b = clvShTo7(d);
    return {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, clvShTo8(d)};
}

// Integral over the sphere, exact for polynomials to degree 5: Gauss and Legendre's three heights, eight longitudes.
template <class F>
double overSphere(F f) {
    const std::array<double, 3> heights{-std::sqrt(0.6), 0.0, std::sqrt(0.6)}, weights{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 8; ++j) {
            double angle = (j + 0.3) * double(kClvPi) / 4.0, radius = std::sqrt(1.0 - heights[i] * heights[i]);
            sum += weights[i] * double(kClvPi) / 4.0 * f(vec3(radius * std::cos(angle), radius * std::sin(angle), heights[i]));
        }
    }
    return sum;
}

TEST(Sh, basisIsOrthonormal) {
    for (int i = 0; i < 9; ++i) {
        for (int j = 0; j < 9; ++j) {
            EXPECT_NEAR(overSphere([&](vec3 d) { return double(basis(d)[i]) * basis(d)[j]; }), i == j ? 1.0 : 0.0, 1e-6) << i << " " << j;
        }
    }
}

TEST(Sh, orderAndSignsAreTheDocumentedOnes) {
    vec3 d = normalize(vec3(1.0f, 2.0f, 4.0f));
    std::array<float, 9> y = basis(d);
    EXPECT_GT(y[1], 0.0f);
    EXPECT_FLOAT_EQ(y[1] / y[3], d.y / d.x);
    EXPECT_FLOAT_EQ(y[2] / y[3], d.z / d.x);
    EXPECT_FLOAT_EQ(y[4] / y[5], d.x / d.z);
    EXPECT_FLOAT_EQ(y[7] / y[5], d.x / d.y);
    EXPECT_GT(basis(vec3(0.0f, 0.0f, 1.0f))[6], 0.0f);
    EXPECT_GT(basis(vec3(1.0f, 0.0f, 0.0f))[8], 0.0f);
}

TEST(Sh, cosineConstantsAreTheLobesBands) {
    // A_l = 2 pi times the integral of P_l(c) c over c in [0, 1], by the midpoint rule.
    constexpr int steps = 20000;
    double a0 = 0.0, a1 = 0.0, a2 = 0.0;
    for (int i = 0; i < steps; ++i) {
        double c = (i + 0.5) / steps, w = 2.0 * double(kClvPi) * c / steps;
        a0 += w;
        a1 += w * c;
        a2 += w * 0.5 * (3.0 * c * c - 1.0);
    }
    EXPECT_NEAR(kClvShCosine0, a0, 1e-6);
    EXPECT_NEAR(kClvShCosine1, a1, 1e-6);
    EXPECT_NEAR(kClvShCosine2, a2, 1e-6);
}

}  // namespace
