// Numbers in fewer bits. Rounding is to the nearest; every encoder takes any input, and every decoder yields finite numbers.
#ifndef CLV_MATH_PACK_H
#define CLV_MATH_PACK_H
#include "finite.h"
CLV_NAMESPACE_BEGIN

// The nearest integer, halves up, of x in [0, 2^24). Adding 1/2 and cutting would go wrong from 2^23 on.
CLV_FN uint clvRound(float x) {
    uint whole = uint(x);
    return x - float(whole) >= 0.5f ? whole + 1u : whole;
}

// A float cut to a number that is neither negative nor above `largest`; NaN becomes 0.
CLV_FN float clvSaturate(float x, float largest) { return x > 0.0f && !clvIsNan(x) ? min(x, largest) : 0.0f; }

// [0, 1] in 16 bits. Below 0 and NaN give 0, above 1 gives 1. Error at most 1/131070.
CLV_FN uint clvUnorm16FromFloat(float x) { return clvRound(clvSaturate(x, 1.0f) * 65535.0f); }
CLV_FN float clvFloatFromUnorm16(uint bits) { return float(bits & 0xffffu) * (1.0f / 65535.0f); }

// [-1, 1] in 16 bits, two's complement of x * 32767. NaN gives 0; -32768 is never written and reads as -1.
// Error at most 1/65534.
CLV_FN uint clvSnorm16FromFloat(float x) {
    uint magnitude = clvRound(clvSaturate(abs(x), 1.0f) * 32767.0f);
    return (x < 0.0f ? 0u - magnitude : magnitude) & 0xffffu;
}
CLV_FN float clvFloatFromSnorm16(uint bits) {
    int value = int((bits & 0xffffu) ^ 0x8000u) - 0x8000;
    return max(float(value) * (1.0f / 32767.0f), -1.0f);
}

// 2^exponent, for exponents in [-126, 127].
CLV_FN float clvExp2Int(int exponent) { return clvFloatFromBits(uint(exponent + 127) << 23); }

// Floats of five exponent bits and `bits` of mantissa, without a sign: x in [0, largest], ties to even.
CLV_FN uint clvSmallFloatFromFloat(float x, uint bits) {
    if (x < 6.103515625e-05f) {
        // Below 2^-14 steps are equally wide: adding a number whose float steps are as wide rounds by the hardware's own rule.
        return clvBitsFromFloat(x + clvExp2Int(9 - int(bits))) & ((2u << bits) - 1u);
    }
    uint cut = 23u - bits;
    uint odd = (clvBitsFromFloat(x) >> cut) & 1u;
    return (clvBitsFromFloat(x) - ((127u - 15u) << 23) + ((1u << (cut - 1u)) - 1u) + odd) >> cut;
}
// Exponent 31 is never written and reads as `largest`.
CLV_FN float clvFloatFromSmallFloat(uint x, uint bits, float largest) {
    uint exponent = (x >> bits) & 31u;
    float mantissa = float(x & ((1u << bits) - 1u));
    if (exponent == 31u) return largest;
    if (exponent == 0u) return mantissa * clvExp2Int(-14 - int(bits));
    return (mantissa + float(1u << bits)) * clvExp2Int(int(exponent) - 15 - int(bits));
}

// IEEE 754 half precision, ties to even. Beyond 65504 (the largest) and infinity give 65504, NaN gives 0, the sign is kept;
// exponent 31 is never written and reads as the largest. Relative error at most 2^-11 from 2^-14 up, absolute 2^-25 below.
CLV_FN uint clvHalfFromFloat(float x) {
    uint sign = (clvBitsFromFloat(x) >> 16) & 0x8000u;
    return sign | clvSmallFloatFromFloat(clvSaturate(abs(x), 65504.0f), 10u);
}
CLV_FN float clvFloatFromHalf(uint bits) {
    float magnitude = clvFloatFromSmallFloat(bits & 0x7fffu, 10u, 65504.0f);
    return clvFloatFromBits(clvBitsFromFloat(magnitude) | ((bits & 0x8000u) << 16));
}
// The same, rounded up or down by chance, so that the mean over many random numbers is x: a history kept in halves goes on where
// rounding to the nearest would stop. `random`: 32 random bits.
CLV_FN uint clvHalfDithered(float x, uint random) {
    uint sign = (clvBitsFromFloat(x) >> 16) & 0x8000u;
    float magnitude = clvSaturate(abs(x), 65504.0f);
    if (magnitude < 6.103515625e-05f) {
        float steps = magnitude * 16777216.0f;
        uint whole = uint(steps);
        return sign | (float(random >> 8) * (1.0f / 16777216.0f) < steps - float(whole) ? whole + 1u : whole);
    }
    return sign | clvSmallFloatFromFloat(min(clvFloatFromBits((clvBitsFromFloat(magnitude) + (random & 0x1fffu)) & 0xffffe000u), 65504.0f), 10u);
}

// Three numbers of at least 0 as floats of 11, 11 and 10 bits: the layout of R11G11B10 textures. Largest 65024 and, in blue, 64512.
// Relative error at most 2^-7, in blue 2^-6, from 2^-14 up.
CLV_FN uint clvR11g11b10FromFloat(vec3 rgb) {
    uint red = clvSmallFloatFromFloat(clvSaturate(rgb.x, 65024.0f), 6u);
    uint green = clvSmallFloatFromFloat(clvSaturate(rgb.y, 65024.0f), 6u);
    return red | (green << 11) | (clvSmallFloatFromFloat(clvSaturate(rgb.z, 64512.0f), 5u) << 22);
}
CLV_FN vec3 clvFloatFromR11g11b10(uint bits) {
    return vec3(clvFloatFromSmallFloat(bits & 0x7ffu, 6u, 65024.0f), clvFloatFromSmallFloat((bits >> 11) & 0x7ffu, 6u, 65024.0f),
                clvFloatFromSmallFloat(bits >> 22, 5u, 64512.0f));
}

// Three numbers of at least 0 with nine bits each and a shared exponent of five: the layout of R9G9B9E5 textures.
// Largest 65408. Error at most 2^-9 of the largest channel, or 2^-25 where that is more.
CLV_FN uint clvRgb9e5FromFloat(vec3 rgb) {
    vec3 c = vec3(clvSaturate(rgb.x, 65408.0f), clvSaturate(rgb.y, 65408.0f), clvSaturate(rgb.z, 65408.0f));
    float largest = max(c.x, max(c.y, c.z));
    int exponent = max(int(clvBitsFromFloat(largest) >> 23) - 127, -16) + 1;
    // Rounding up can need one more bit than nine.
    if (clvRound(largest * clvExp2Int(9 - exponent)) == 512u) ++exponent;
    float scale = clvExp2Int(9 - exponent);
    uint red = clvRound(c.x * scale);
    uint green = clvRound(c.y * scale);
    uint blue = clvRound(c.z * scale);
    return red | (green << 9) | (blue << 18) | (uint(exponent + 15) << 27);
}
CLV_FN vec3 clvFloatFromRgb9e5(uint bits) {
    float scale = clvExp2Int(int(bits >> 27) - 24);
    return vec3(float(bits & 511u), float((bits >> 9) & 511u), float((bits >> 18) & 511u)) * scale;
}

// Three numbers of at least 0 with 24 bits each in the lower bits of xyz and a shared exponent of eight bits in w.
// The largest channel is kept to the bit; the others err by at most 2^-24 of it, or by 2^-127 where that is more.
CLV_FN uvec4 clvSharedExponentFromFloat(vec3 rgb) {
    float top = clvFloatFromBits(0x7f7fffffu);
    vec3 c = vec3(clvSaturate(rgb.x, top), clvSaturate(rgb.y, top), clvSaturate(rgb.z, top));
    float largest = max(c.x, max(c.y, c.z));
    // A biased exponent of at least 24 keeps both scales below inside the range of normal floats.
    uint exponent = max(clvBitsFromFloat(largest) >> 23, 24u);
    float scale = clvExp2Int(150 - int(exponent));
    return uvec4(clvRound(c.x * scale), clvRound(c.y * scale), clvRound(c.z * scale), exponent);
}
CLV_FN vec3 clvFloatFromSharedExponent(uvec4 parts) {
    uint exponent = clamp(parts.w & 0xffu, 24u, 254u);
    float scale = clvExp2Int(int(exponent) - 150);
    return vec3(float(parts.x & 0xffffffu), float(parts.y & 0xffffffu), float(parts.z & 0xffffffu)) * scale;
}

CLV_NAMESPACE_END
#endif
