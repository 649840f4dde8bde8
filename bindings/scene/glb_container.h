// The GLB container: a header, a JSON chunk and a binary chunk.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace clv {

struct GlbParts {
    nlohmann::json document;
    std::optional<std::vector<std::uint8_t>> binary;  // the data of buffer 0, when that names no uri
};

// Throws InputError that begins with `file` when a length or a chunk is not as it should be.
GlbParts unpackGlb(const std::string& file, const std::vector<std::uint8_t>& bytes);

std::vector<std::uint8_t> packGlb(const nlohmann::json& document, std::vector<std::uint8_t> binary);

void appendBytes(std::vector<std::uint8_t>& bytes, const void* data, std::size_t size);
// Appends `filler` until the size is a multiple of `alignment`.
void padBytes(std::vector<std::uint8_t>& bytes, std::size_t alignment, std::uint8_t filler);

}  // namespace clv
