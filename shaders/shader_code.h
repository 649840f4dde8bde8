// The library's entry points as SPIR-V words, compiled from GLSL and from HLSL when the library was built.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace clv {

enum class ShaderLanguage { glsl, hlsl };

struct ShaderCode {
    std::string_view name;  // of the file, without its endings; with its stage, as in x.vert, but in compute
    ShaderLanguage language;
    std::span<const std::uint32_t> words;
};

// Every shader that was built.
std::span<const ShaderCode> shaderCodes();

// One shader's words; entry point `main`. Throws std::runtime_error where there is none of that name.
std::span<const std::uint32_t> shaderCode(std::string_view name, ShaderLanguage language);

}  // namespace clv
