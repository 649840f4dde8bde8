// Integer hashes: random numbers as a pure function of what they are for (seed, frame, dimension, index).
#ifndef CLV_MATH_HASH_H
#define CLV_MATH_HASH_H
#include "../lang.h"
CLV_NAMESPACE_BEGIN

// A bijection of the 32-bit integers in which each input bit flips each output bit about half of the time.
// Multiply and xor-shift rounds with the low-bias constants of Wellons' search (2018, "Prospecting for hash functions").
CLV_FN uint clvHash(uint x) {
    x ^= x >> 16;
    x *= 0x21f0aaadu;
    x ^= x >> 15;
    x *= 0xd35a2d97u;
    x ^= x >> 15;
    return x;
}

// Derives a seed from another seed and a number. Bijective in each argument while the other stands still.
// The value is hashed before it meets the seed: with hash(seed + value), seeds one apart give one stream shifted by one.
// The added golden ratio keeps (0, 0), which both hashes would map to 0, away from it.
CLV_FN uint clvHashCombine(uint seed, uint value) {
    return clvHash(seed ^ clvHash(value + 0x9e3779b9u));
}

// The upper 24 bits as a float in [0, 1): all of them fit the mantissa, so that nothing rounds up to 1.
CLV_FN float clvUnitFloat(uint bits) { return float(bits >> 8) * (1.0f / 16777216.0f); }

CLV_NAMESPACE_END
#endif
