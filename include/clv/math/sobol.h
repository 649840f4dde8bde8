// The first four dimensions of the Sobol' sequence with the direction numbers of Joe and Kuo (2008), Owen-scrambled.
//
// Dimension j has a primitive polynomial p of degree s over GF(2); its direction numbers obey p(E) v = R^s v, with
// E the step to the next direction number and R the shift to the right by one bit. An index is a polynomial B(E), and
// the point is B(E) v. Squaring is linear over GF(2): p(E)^m v = R^(s*m) v for m = 1, 2, 4, 8. So B is divided by
// p^8, quotient and remainder by p^4, and so on down to digits of s bits, each with its power of R, all digits at once
// inside one word. That takes some 30 shifts where the plain recurrence takes a step for each bit of the index.
#ifndef CLV_MATH_SOBOL_H
#define CLV_MATH_SOBOL_H
#include "hash.h"
CLV_NAMESPACE_BEGIN

CLV_CONST uint kClvSobolDimensions = 4u;

// Divides every field of 2*s*m bits, a polynomial each, by E^(s*m) + E^m + 1, which is p^m for p = E^s + E + 1:
// the quotient goes into the field's upper half, the remainder into its lower half. `lower` masks the lower halves.
CLV_FN uint clvSobolDivide(uint x, uint s, uint m, uint lower) {
    uint quotient = (x >> (s * m)) & lower;
    quotient ^= (quotient >> ((s - 1u) * m)) & lower;
    uint remainder = (x ^ quotient ^ (quotient << m)) & lower;
    return (quotient << (s * m)) | remainder;
}

// The Sobol' integer of `index` in `dimension` [0, 4), its bits in reverse order: the lowest is worth one half.
CLV_FN uint clvSobolReversed(uint index, uint dimension) {
    uint x = index;
    if (dimension == 1u) {  // p = E + 1, v1 = 1
        x ^= (x >> 16) & 0x0000ffffu;
        x ^= (x >> 8) & 0x00ff00ffu;
        x ^= (x >> 4) & 0x0f0f0f0fu;
        x ^= (x >> 2) & 0x33333333u;
        x ^= (x >> 1) & 0x55555555u;
    } else if (dimension == 2u) {  // p = E^2 + E + 1, v1 = 1, v2 = 1 + R
        x = clvSobolDivide(x, 2u, 8u, 0x0000ffffu);
        x = clvSobolDivide(x, 2u, 4u, 0x00ff00ffu);
        x = clvSobolDivide(x, 2u, 2u, 0x0f0f0f0fu);
        x = clvSobolDivide(x, 2u, 1u, 0x33333333u);
        x ^= (x >> 1) & 0x55555555u;
    } else if (dimension == 3u) {  // p = E^3 + E + 1, v1 = 1, v2 = 1 + R, v3 = R^2
        x = clvSobolDivide(x, 3u, 8u, 0x00ffffffu);
        x = clvSobolDivide(x, 3u, 4u, 0xff000fffu);
        x = clvSobolDivide(x, 3u, 2u, 0x3f03f03fu);
        x = clvSobolDivide(x, 3u, 1u, 0xc71c71c7u);
        x ^= (x >> 1) & 0x49249249u;
    }
    return x;
}

// The Sobol' integer of `index` in `dimension` [0, 4): the point's coordinate times 2^32. Dimension 0 is van der Corput's.
CLV_FN uint clvSobol(uint index, uint dimension) { return clvReverseBits(clvSobolReversed(index, dimension)); }

// Permutes the integers so that each bit is flipped by a hash of the bits below it and of the seed.
// Laine and Karras (2011), section 3.1, with the multipliers of Vegdahl (2021, "Building a better LK hash").
CLV_FN uint clvLaineKarras(uint x, uint seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Nested uniform (Owen) scramble by a hash: each bit is flipped by a hash of the bits above it (Burley 2020, section 3).
CLV_FN uint clvOwenScramble(uint x, uint seed) { return clvReverseBits(clvLaineKarras(clvReverseBits(x), seed)); }

// Coordinate `dimension` of point `index`, scrambled, in [0, 1). Each dimension is scrambled by its own hash of the seed.
// The bits are turned round once, not three times.
CLV_FN float clvSobolUnit(uint index, uint dimension, uint seed) {
    uint bits = clvLaineKarras(clvSobolReversed(index, dimension), clvHashCombine(seed, dimension));
    return clvUnitFloat(clvReverseBits(bits));
}

// Point `index` of the scrambled sequence, in [0, 1)^4; frames go on counting where the last one stopped.
// Any 2^m indices in a row from a multiple of 2^m on put one point into each of the 2^m equal boxes of a grid over one
// coordinate or over the pair (0, 1), four into each of 2^(m-2) over the pair (2, 3), eight into each of 2^(m-3) over all four.
CLV_FN vec4 clvSobol4(uint index, uint seed) {
    return vec4(clvSobolUnit(index, 0u, seed), clvSobolUnit(index, 1u, seed),
                clvSobolUnit(index, 2u, seed), clvSobolUnit(index, 3u, seed));
}

CLV_NAMESPACE_END
#endif
