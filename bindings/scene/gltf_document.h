// A glTF or GLB file whose JSON is parsed and whose byte ranges are checked.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bindings/scene/json_reader.h"

namespace clv {

struct GltfDocument {
    std::string file;
    nlohmann::json json;
    std::vector<std::vector<std::uint8_t>> buffers;  // as long as their byteLength says, or longer

    JsonReader root() const { return {file, json}; }
};

// A run of bytes inside one of the document's buffers.
struct ByteRange {
    const std::uint8_t* begin;
    std::size_t size;
};

// Reads the container and all buffers; checks lengths, ranges of buffer views and accessors, what sparse ones list, and that the nodes form trees.
// Throws InputError.
GltfDocument readGltf(const std::string& file);

// The bytes of buffer view `index`.
ByteRange bufferViewBytes(const GltfDocument& document, std::size_t index);

// `count` unsigned integers side by side, in the buffer view that `source` names, with their type.
std::vector<std::uint32_t> readIndices(const GltfDocument& document, const JsonReader& source, std::size_t count);

// Bytes of a data: URI or of a file beside the document.
std::vector<std::uint8_t> readUri(const GltfDocument& document, const JsonReader& uri);

}  // namespace clv
