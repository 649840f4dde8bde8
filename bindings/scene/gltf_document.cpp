#include "bindings/scene/gltf_document.h"

#include <array>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <optional>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/glb_container.h"

namespace clv {
namespace {

constexpr std::size_t kDeepestNode = 256;

std::vector<std::uint8_t> decodeBase64(const JsonReader& uri, const std::string& text, std::size_t begin) {
    static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    std::uint32_t bits = 0;
    int bitCount = 0;
    std::size_t end = text.find_last_not_of('=') + 1;
    for (std::size_t i = begin; i < end; ++i) {
        const std::size_t digit = kDigits.find(text[i]);
        if (digit == std::string::npos) uri.fail("base64 data");
        bits = bits << 6 | std::uint32_t(digit);
        bitCount += 6;
        if (bitCount < 8) continue;
        bitCount -= 8;
        bytes.push_back(std::uint8_t(bits >> bitCount));
    }
    return bytes;
}

std::string decodePercent(const JsonReader& uri, const std::string& text) {
    std::string path;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            path += text[i];
            continue;
        }
        auto isHex = [&](std::size_t at) { return at < text.size() && std::isxdigit(static_cast<unsigned char>(text[at])); };
        if (!isHex(i + 1) || !isHex(i + 2)) uri.fail("two hexadecimal digits after each %");
        path += char(std::stoi(text.substr(i + 1, 2), nullptr, 16));
        i += 2;
    }
    return path;
}

void readBuffers(GltfDocument& document, std::optional<std::vector<std::uint8_t>> binary) {
    for (const JsonReader& buffer : document.root().elements("buffers")) {
        const std::size_t length = buffer["byteLength"].index();
        const bool isBinaryChunk = !buffer.has("uri") && document.buffers.empty() && binary;
        if (!buffer.has("uri") && !isBinaryChunk) buffer.fail("a uri, or a binary chunk in the file");
        document.buffers.push_back(isBinaryChunk ? std::move(*binary) : readUri(document, buffer["uri"]));
        if (document.buffers.back().size() < length)
            buffer.fail(fmt::format("{} bytes of data as byteLength says, not {}", length, document.buffers.back().size()));
    }
}

// Throws unless bytes [offset, offset + size) lie in a piece of `limit` bytes.
void checkRange(const JsonReader& place, std::size_t offset, std::size_t size, std::size_t limit) {
    if (offset > limit || size > limit - offset)
        place.fail(fmt::format("bytes {} to {} to lie within {} bytes", offset, offset + size, limit));
}

void checkBufferViews(const GltfDocument& document) {
    for (const JsonReader& view : document.root().elements("bufferViews")) {
        const std::size_t buffer = view["buffer"].index(document.buffers.size());
        const std::size_t stride = view.index("byteStride", 4);
        if (stride < 4 || stride > 252) view["byteStride"].fail("a whole number from 4 to 252");
        checkRange(view, view.index("byteOffset", 0), view["byteLength"].index(), document.buffers[buffer].size());
    }
}

std::size_t componentBytes(const JsonReader& componentType) {
    switch (componentType.index()) {
        case 5120: case 5121: return 1;
        case 5122: case 5123: return 2;
        case 5125: case 5126: return 4;
        default: componentType.fail("5120, 5121, 5122, 5123, 5125 or 5126");
    }
}

std::size_t elementBytes(const JsonReader& accessor) {
    const std::size_t component = componentBytes(accessor["componentType"]);
    const std::string type = accessor["type"].text();
    const std::array<std::pair<const char*, std::size_t>, 4> vectors = {{{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}}};
    for (const auto& [name, components] : vectors)
        if (type == name) return components * component;
    // Columns of matrices begin at multiples of four bytes.
    const std::array<std::pair<const char*, std::size_t>, 3> matrices = {{{"MAT2", 2}, {"MAT3", 3}, {"MAT4", 4}}};
    for (const auto& [name, rows] : matrices)
        if (type == name) return rows * ((rows * component + 3) / 4 * 4);
    accessor["type"].fail("SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
}

// `view` holds the members bufferView and byteOffset.
void checkElements(const JsonReader& view, const std::vector<JsonReader>& bufferViews, std::size_t count, std::size_t bytes) {
    const JsonReader& target = bufferViews[view["bufferView"].index(bufferViews.size())];
    const std::size_t stride = target.index("byteStride", bytes);
    if (stride < bytes) target["byteStride"].fail(fmt::format("at least {} bytes, those of an element of {}", bytes, view.place()));
    checkRange(view, view.index("byteOffset", 0), (count - 1) * stride + bytes, target["byteLength"].index());
}

std::size_t indexBytes(const JsonReader& componentType) {
    switch (componentType.index()) {
        case 5121: return 1;
        case 5123: return 2;
        case 5125: return 4;
        default: componentType.fail("5121, 5123 or 5125");
    }
}

void checkListed(const JsonReader& place, const std::vector<std::uint32_t>& indices, std::size_t limit) {
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] < limit && (i == 0 || indices[i] > indices[i - 1])) continue;
        const std::string after = i == 0 ? "" : fmt::format(" after {}", indices[i - 1]);
        place.fail(fmt::format("indices that rise, below {}, not {}{}", limit, indices[i], after));
    }
}

void checkAccessors(const GltfDocument& document) {
    const std::vector<JsonReader> bufferViews = document.root().elements("bufferViews");
    for (const JsonReader& accessor : document.root().elements("accessors")) {
        const std::size_t bytes = elementBytes(accessor);
        const std::size_t count = accessor["count"].index(std::size_t(1) << 31);
        if (count == 0) accessor["count"].fail("at least 1");
        if (accessor.has("bufferView")) checkElements(accessor, bufferViews, count, bytes);
        if (!accessor.has("sparse")) continue;
        const JsonReader sparse = accessor["sparse"];
        const std::size_t sparseCount = sparse["count"].index(count + 1);
        if (sparseCount == 0) sparse["count"].fail("at least 1");
        checkElements(sparse["indices"], bufferViews, sparseCount, indexBytes(sparse["indices"]["componentType"]));
        checkElements(sparse["values"], bufferViews, sparseCount, bytes);
        checkListed(sparse["indices"], readIndices(document, sparse["indices"], sparseCount), count);
    }
}

// Every node has at most one parent, none lies below itself, and roots have no parent and are listed once: walks end, and meet each node once.
void checkNodes(const GltfDocument& document) {
    const std::vector<JsonReader> nodes = document.root().elements("nodes");
    std::vector<std::size_t> parent(nodes.size(), nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const JsonReader& child : nodes[i].elements("children")) {
            const std::size_t index = child.index(nodes.size());
            if (parent[index] != nodes.size()) child.fail(fmt::format("a node without another parent; node {} has one", index));
            parent[index] = i;
        }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::size_t depth = 0;
        for (std::size_t above = parent[i]; above != nodes.size(); above = parent[above])
            if (++depth > kDeepestNode) nodes[i].fail(fmt::format("at most {} nodes above it, and no cycle", kDeepestNode));
    }
    for (const JsonReader& scene : document.root().elements("scenes")) {
        std::vector<bool> isRoot(nodes.size());
        for (const JsonReader& root : scene.elements("nodes")) {
            const std::size_t index = root.index(nodes.size());
            if (parent[index] != nodes.size()) root.fail(fmt::format("a node without a parent; node {} has one", index));
            if (isRoot[index]) root.fail(fmt::format("a node that is not listed before; node {} is", index));
            isRoot[index] = true;
        }
    }
}

}  // namespace

ByteRange bufferViewBytes(const GltfDocument& document, std::size_t index) {
    const JsonReader view = document.root()["bufferViews"].element(index);
    return {document.buffers[view["buffer"].index()].data() + view.index("byteOffset", 0), view["byteLength"].index()};
}

std::vector<std::uint32_t> readIndices(const GltfDocument& document, const JsonReader& source, std::size_t count) {
    const std::size_t bytes = indexBytes(source["componentType"]), view = source["bufferView"].index();
    if (document.root()["bufferViews"].element(view).index("byteStride", bytes) != bytes) source.fail("indices without a stride");
    const std::uint8_t* next = bufferViewBytes(document, view).begin + source.index("byteOffset", 0);
    std::vector<std::uint32_t> indices(count);
    for (std::uint32_t& index : indices) {
        std::memcpy(&index, next, bytes);
        next += bytes;
    }
    return indices;
}

std::vector<std::uint8_t> readUri(const GltfDocument& document, const JsonReader& uri) {
    const std::string text = uri.text();
    if (text.rfind("data:", 0) == 0) {
        const std::string marker = ";base64,";
        const std::size_t data = text.find(marker);
        if (data == std::string::npos) uri.fail("base64 data after data:");
        return decodeBase64(uri, text, data + marker.size());
    }
    const std::filesystem::path beside = std::filesystem::path(document.file).parent_path() / decodePercent(uri, text);
    if (!isFile(beside)) uri.fail(fmt::format("a file {}", beside.string()));
    return readFileBytes(beside.string());
}

GltfDocument readGltf(const std::string& file) {
    GltfDocument document;
    document.file = file;
    const std::vector<std::uint8_t> bytes = readFileBytes(file);
    std::optional<std::vector<std::uint8_t>> binary;
    const std::string extension = std::filesystem::path(file).extension().string();
    if (extension == ".glb" || extension == ".GLB") {
        GlbParts parts = unpackGlb(file, bytes);
        document.json = std::move(parts.document);
        binary = std::move(parts.binary);
    } else {
        document.json = parseJson(file, bytes);
    }
    const JsonReader asset = document.root()["asset"], version = asset["version"];
    if (version.text().rfind("2.", 0) != 0) version.fail("glTF version 2.x");
    if (const std::string least = asset.text("minVersion", "2.0"); least != "2.0" && !least.starts_with("1."))
        asset["minVersion"].fail("at most 2.0, not " + least);
    readBuffers(document, std::move(binary));
    checkBufferViews(document);
    checkAccessors(document);
    checkNodes(document);
    return document;
}

}  // namespace clv
