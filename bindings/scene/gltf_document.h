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

// Reads the container and all buffers; checks lengths, ranges of buffer views and accessors, and that the nodes form trees.
// Throws InputError.
GltfDocument readGltf(const std::string& file);

// The bytes of buffer view `index`.
ByteRange bufferViewBytes(const GltfDocument& document, std::size_t index);

// Bytes of a data: URI or of a file beside the document.
std::vector<std::uint8_t> readUri(const GltfDocument& document, const JsonReader& uri);

}  // namespace clv
