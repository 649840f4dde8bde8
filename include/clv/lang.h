// The only file that knows which language it is compiled as: C++20 with GLM, GLSL (4.50, Vulkan) or HLSL (5+).
// Everything in math/, data/ and stages/ is written in GLSL's vocabulary plus the macros below.
//
// Functions that walk what lies in buffers (a tree of boxes, a level's cells) begin with CLV_READER_FN and take CLV_READER before
// their other parameters. They read by CLV_READ clvReadXxx(index), and call each other with CLV_PASS_READER. In C++ the reader is an
// object with members of these names; in shaders they are functions that the entry point defines before it includes the header.
#ifndef CLV_LANG_H
#define CLV_LANG_H

#if defined(__cplusplus)

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#define CLV_NAMESPACE_BEGIN namespace clv {
#define CLV_NAMESPACE_END }
#define CLV_FN inline
#define CLV_CONST inline constexpr
#define CLV_IN(type) const type&  // for large structs
#define CLV_INOUT(type) type&
#define CLV_OUT(type) type&
#define CLV_READER_FN template <class Reader> inline
#define CLV_READER const Reader& reader,
#define CLV_PASS_READER reader,
#define CLV_READ reader.

namespace clv {

using glm::ivec2;
using glm::ivec3;
using glm::mat3;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;

using glm::abs;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::floor;
using glm::fract;
using glm::length;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using std::acos;
using std::cos;
using std::exp;
using std::pow;
using std::sin;
using std::sqrt;

// Angle of the point (x, y), rad, (-pi, pi].
inline float clvAtan2(float y, float x) { return std::atan2(y, x); }
inline uint clvBitsFromFloat(float x) { return std::bit_cast<uint>(x); }
inline float clvFloatFromBits(uint x) { return std::bit_cast<float>(x); }
inline uint clvReverseBits(uint x) {
    x = (x >> 16) | (x << 16);
    x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
    x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
    return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

}  // namespace clv

#elif defined(CLV_HLSL)

#define CLV_NAMESPACE_BEGIN
#define CLV_NAMESPACE_END
#define CLV_FN
#define CLV_CONST static const
#define CLV_IN(type) type
#define CLV_INOUT(type) inout type
#define CLV_OUT(type) out type
#define CLV_READER_FN
#define CLV_READER
#define CLV_PASS_READER
#define CLV_READ

#define vec2 float2
#define vec3 float3
#define vec4 float4
#define ivec2 int2
#define ivec3 int3
#define uvec2 uint2
#define uvec3 uint3
#define uvec4 uint4
#define mat3 float3x3
#define mix lerp
#define fract frac

float clvAtan2(float y, float x) { return atan2(y, x); }
uint clvBitsFromFloat(float x) { return asuint(x); }
float clvFloatFromBits(uint x) { return asfloat(x); }
uint clvReverseBits(uint x) { return reversebits(x); }

#else  // GLSL

#define CLV_NAMESPACE_BEGIN
#define CLV_NAMESPACE_END
#define CLV_FN
#define CLV_CONST const
#define CLV_IN(type) type
#define CLV_INOUT(type) inout type
#define CLV_OUT(type) out type
#define CLV_READER_FN
#define CLV_READER
#define CLV_PASS_READER
#define CLV_READ

float clvAtan2(float y, float x) { return atan(y, x); }
uint clvBitsFromFloat(float x) { return floatBitsToUint(x); }
float clvFloatFromBits(uint x) { return uintBitsToFloat(x); }
uint clvReverseBits(uint x) { return bitfieldReverse(x); }

#endif

#endif  // CLV_LANG_H
