#include "bindings/scene/glb_container.h"

#include <cstring>
#include <limits>
#include <stdexcept>

#include "bindings/scene/json_reader.h"

namespace clv {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67u, kVersion = 2u;             // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4e4f534au, kBinChunk = 0x004e4942u;  // "JSON", "BIN\0"
constexpr std::size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

std::uint32_t wordAt(const std::vector<std::uint8_t>& bytes, std::size_t offset) {
    std::uint32_t word;
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

void appendWord(std::vector<std::uint8_t>& bytes, std::size_t word) {
    const auto value = std::uint32_t(word);
    appendBytes(bytes, &value, sizeof value);
}

void appendChunk(std::vector<std::uint8_t>& bytes, std::uint32_t type, const std::vector<std::uint8_t>& data) {
    appendWord(bytes, data.size());
    appendWord(bytes, type);
    appendBytes(bytes, data.data(), data.size());
}

}  // namespace

void appendBytes(std::vector<std::uint8_t>& bytes, const void* data, std::size_t size) {
    const std::size_t end = bytes.size();
    bytes.resize(end + size);
    if (size > 0) std::memcpy(bytes.data() + end, data, size);
}

void padBytes(std::vector<std::uint8_t>& bytes, std::size_t alignment, std::uint8_t filler) {
    while (bytes.size() % alignment != 0) bytes.push_back(filler);
}

GlbParts unpackGlb(const std::string& file, const std::vector<std::uint8_t>& bytes) {
    auto fail = [&](std::size_t offset, const std::string& expected) {
        throw InputError(fmt::format("{}: byte {}: expected {}", file, offset, expected));
    };
    if (bytes.size() < kHeaderBytes) fail(bytes.size(), "a GLB header of 12 bytes; the file is truncated");
    if (wordAt(bytes, 0) != kMagic) fail(0, "the letters glTF that begin a GLB file");
    if (wordAt(bytes, 4) != kVersion) fail(4, "GLB version 2");
    if (wordAt(bytes, 8) != bytes.size())
        fail(8, fmt::format("the length of the file, {} bytes, not {}; the file is truncated or damaged", bytes.size(), wordAt(bytes, 8)));

    GlbParts parts;
    bool hasJson = false;
    for (std::size_t offset = kHeaderBytes; offset < bytes.size();) {
        if (bytes.size() - offset < kChunkHeaderBytes) fail(offset, "a chunk header of 8 bytes");
        const std::size_t length = wordAt(bytes, offset);
        const std::uint32_t type = wordAt(bytes, offset + 4);
        offset += kChunkHeaderBytes;
        if (length > bytes.size() - offset) fail(offset, fmt::format("a chunk of at most {} bytes, not {}", bytes.size() - offset, length));
        if (!hasJson && type != kJsonChunk) fail(offset, "the JSON chunk first");
        const std::span<const std::uint8_t> data(bytes.data() + offset, length);
        if (!hasJson) {
            parts.document = parseJson(file, data);
            hasJson = true;
        } else if (type == kBinChunk && !parts.binary) {
            parts.binary.emplace(data.begin(), data.end());
        }
        offset += length;
    }
    if (!hasJson) fail(kHeaderBytes, "a JSON chunk");
    return parts;
}

std::vector<std::uint8_t> packGlb(const nlohmann::json& document, std::vector<std::uint8_t> binary) {
    const std::string dumped = document.dump();
    std::vector<std::uint8_t> text(dumped.begin(), dumped.end());
    padBytes(text, 4, ' ');
    padBytes(binary, 4, 0);
    const std::size_t size = kHeaderBytes + 2 * kChunkHeaderBytes + text.size() + binary.size();
    if (size > std::numeric_limits<std::uint32_t>::max()) throw std::runtime_error("a GLB file holds at most 4 GiB");

    std::vector<std::uint8_t> bytes;
    bytes.reserve(size);
    appendWord(bytes, kMagic);
    appendWord(bytes, kVersion);
    appendWord(bytes, size);
    appendChunk(bytes, kJsonChunk, text);
    appendChunk(bytes, kBinChunk, binary);
    return bytes;
}

}  // namespace clv
