// Numbers in fewer bits. Rounding is to the nearest; every encoder takes any input, and every decoder yields finite numbers.
#ifndef CLV_MATH_PACK_H
#define CLV_MATH_PACK_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

// The nearest integer, halves up, of x in [0, 2^24). Adding 1/2 and cutting would go wrong from 2^23 on.
CLV_FN uint clvRound(float x) {
    uint whole = uint(x);
    return x - float(whole) >= 0.5f ? whole + 1u : whole;
}

// A float cut to a number that is neither negative nor above `largest`; NaN becomes 0.
CLV_FN float clvSaturate(float x, float largest) { return x > 0.0f ? min(x, largest) : 0.0f; }

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

// IEEE 754 half precision, ties to even. Beyond 65504 (the largest) and infinity give 65504, NaN gives 0, the sign is kept;
// exponent 31 is never written and reads as the largest. Relative error at most 2^-11 from 2^-14 up, absolute 2^-25 below.
CLV_FN uint clvHalfFromFloat(float x) {
    uint sign = (clvBitsFromFloat(x) >> 16) & 0x8000u;
    float magnitude = clvSaturate(abs(x), 65504.0f);
    uint bits = clvBitsFromFloat(magnitude);
    if (magnitude < 6.103515625e-05f) {
        // Below 2^-14 steps are 2^-24 wide: adding 1/2, where a float has the same step, rounds by the hardware's own rule.
        return sign | (clvBitsFromFloat(magnitude + 0.5f) & 0x7ffu);
    }
    uint odd = (bits >> 13) & 1u;
    return sign | ((bits - ((127u - 15u) << 23) + 0xfffu + odd) >> 13);
}
CLV_FN float clvFloatFromHalf(uint bits) {
    uint exponent = (bits >> 10) & 31u;
    float mantissa = float(bits & 0x3ffu);
    float magnitude = mantissa * clvExp2Int(-24);
    if (exponent == 31u) {
        magnitude = 65504.0f;
    } else if (exponent > 0u) {
        magnitude = (mantissa + 1024.0f) * clvExp2Int(int(exponent) - 25);
    }
    return (bits & 0x8000u) != 0u ? -magnitude : magnitude;
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
