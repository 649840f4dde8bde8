#include "bindings/scene/gltf_triangles.h"

#include <algorithm>
#include <map>
#include <string_view>

#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include "bindings/scene/glb_container.h"

namespace clv {
namespace {

using nlohmann::json;

constexpr const char* kDraco = "KHR_draco_mesh_compression";
constexpr std::size_t kTriangles = 4, kStrip = 5, kFan = 6;  // glTF primitive modes
constexpr std::size_t kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;  // glTF component types

std::size_t triangleCount(const JsonReader& primitive, const std::vector<JsonReader>& accessors) {
    const JsonReader attributes = primitive["attributes"];
    const JsonReader counted = primitive.has("indices") ? primitive["indices"] : attributes["POSITION"];
    const std::size_t corners = accessors[counted.index(accessors.size())]["count"].index();
    const std::size_t mode = primitive.index("mode", kTriangles);
    if (mode == kTriangles && corners % 3 == 0) return corners / 3;
    if ((mode == kStrip || mode == kFan) && corners >= 3) return corners - 2;
    counted.fail(fmt::format("a count that makes whole triangles, not {}", corners));
}

// Assimp takes what the accessor holds for floats whatever it says, so the types are checked here.
void checkType(const JsonReader& accessor, const std::string& type, bool typeIsGood) {
    if (!typeIsGood || accessor["type"].text() != type)
        accessor.fail(fmt::format("{} of {}", type, type == "SCALAR" ? "unsigned integers" : "32-bit floats"));
}

void checkPrimitive(const GltfDocument& document, const JsonReader& primitive, const json& reduced, const std::vector<JsonReader>& accessors) {
    auto accessorOf = [&](const JsonReader& index) { return accessors[index.index(accessors.size())]; };
    const bool isCompressed = primitive.has("extensions") && primitive["extensions"].has(kDraco);
    const JsonReader positions = accessorOf(primitive["attributes"]["POSITION"]);
    checkType(positions, "VEC3", positions["componentType"].index() == kFloat);
    // Without a view, positions are 0 but for those that are listed.
    if (!isCompressed && !positions.has("bufferView") && !positions.has("sparse")) positions.fail("a member 'bufferView' or 'sparse'");
    const json& attributes = reduced["attributes"];
    if (attributes.contains("TEXCOORD_0")) {
        const JsonReader& uvs = accessors[attributes["TEXCOORD_0"].get<std::size_t>()];
        checkType(uvs, "VEC2", uvs["componentType"].index() == kFloat);
        if (uvs["count"].index() != positions["count"].index()) uvs["count"].fail("as many texture coordinates as positions");
    }
    if (!primitive.has("indices")) return;
    const JsonReader indices = accessorOf(primitive["indices"]);
    const std::size_t type = indices["componentType"].index();
    checkType(indices, "SCALAR", type == kUnsignedByte || type == kUnsignedShort || type == kUnsignedInt);
    if (isCompressed) return;
    if (!indices.has("bufferView")) indices.fail("a member 'bufferView'");
    const std::size_t vertices = positions["count"].index();
    if (std::ranges::max(readIndices(document, indices, indices["count"].index())) >= vertices)
        primitive["indices"].fail(fmt::format("indices below {}, the number of vertices", vertices));
}

// What assimp needs to know of a primitive: positions, indices and the one set of texture coordinates that its material reads.
json reducePrimitive(const JsonReader& primitive, const std::vector<std::size_t>& texCoordOfMaterial, std::size_t accessorCount) {
    const std::size_t set = primitive.has("material") ? texCoordOfMaterial[primitive["material"].index(texCoordOfMaterial.size())] : 0;
    const std::string texCoord = fmt::format("TEXCOORD_{}", set);
    const JsonReader attributes = primitive["attributes"];
    json reduced = {{"attributes", {{"POSITION", attributes["POSITION"].index(accessorCount)}}}, {"mode", primitive.index("mode", kTriangles)}};
    const bool hasUvs = attributes.has(texCoord.c_str());
    if (hasUvs) reduced["attributes"]["TEXCOORD_0"] = attributes[texCoord.c_str()].index(accessorCount);
    if (primitive.has("indices")) reduced["indices"] = primitive["indices"].index(accessorCount);
    if (!primitive.has("extensions") || !primitive["extensions"].has(kDraco)) return reduced;
    const JsonReader draco = primitive["extensions"][kDraco], ids = draco["attributes"];
    json& compressed = reduced["extensions"][kDraco];
    compressed = {{"bufferView", draco["bufferView"].index()}, {"attributes", {{"POSITION", ids["POSITION"].index()}}}};
    if (hasUvs) compressed["attributes"]["TEXCOORD_0"] = ids[texCoord.c_str()].index();
    return reduced;
}

// A GLB with nothing but the geometry: node and mesh i hold primitive i. Materials, textures, animations and the node tree are
// read elsewhere, so that nothing about them can trip assimp.
struct ReducedGltf {
    json document;
    std::vector<std::uint8_t> binary;
};

void joinBuffers(const GltfDocument& document, ReducedGltf& reduced) {
    std::vector<std::size_t> begin;
    for (const std::vector<std::uint8_t>& buffer : document.buffers) {
        padBytes(reduced.binary, 8, 0);
        begin.push_back(reduced.binary.size());
        appendBytes(reduced.binary, buffer.data(), buffer.size());
    }
    reduced.document["buffers"] = {{{"byteLength", reduced.binary.size()}}};
    reduced.document["bufferViews"] = json::array();
    for (const JsonReader& view : document.root().elements("bufferViews")) {
        json moved = {{"buffer", 0}, {"byteOffset", view.index("byteOffset", 0) + begin[view["buffer"].index()]},
                      {"byteLength", view["byteLength"].index()}};
        if (view.has("byteStride")) moved["byteStride"] = view["byteStride"].index();
        reduced.document["bufferViews"].push_back(moved);
    }
}

// The root, which is the node itself where there is but one, and those below it.
std::map<std::string_view, const aiNode*> nodesByName(const aiNode& root) {
    std::map<std::string_view, const aiNode*> nodes = {{root.mName.C_Str(), &root}};
    for (unsigned i = 0; i < root.mNumChildren; ++i) nodes.emplace(root.mChildren[i]->mName.C_Str(), root.mChildren[i]);
    return nodes;
}

GltfPrimitive takeTriangles(const aiMesh& mesh) {
    GltfPrimitive primitive;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& p = mesh.mVertices[i];
        primitive.positions.push_back({p.x, p.y, p.z});
        const aiVector3D uv = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][i] : aiVector3D(0.0f, 1.0f, 0.0f);
        primitive.uvs.push_back({uv.x, 1.0f - uv.y});  // assimp turns v upside down
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        primitive.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
    }
    return primitive;
}

}  // namespace

std::vector<std::vector<GltfPrimitive>> decodeTriangles(const GltfDocument& document,
                                                        const std::vector<std::size_t>& texCoordOfMaterial) {
    const JsonReader root = document.root();
    const std::vector<JsonReader> accessors = root.elements("accessors"), meshes = root.elements("meshes");

    ReducedGltf reduced;
    reduced.document = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"meshes", json::array()}, {"nodes", json::array()},
                        {"scenes", {{{"nodes", json::array()}}}}, {"accessors", json::array()},
                        {"extensionsUsed", {kDraco}}, {"extensionsRequired", {kDraco}}};
    if (root.has("accessors")) reduced.document["accessors"] = document.json["accessors"];

    struct Expected {
        std::size_t mesh, primitive, triangles;
    };
    std::vector<Expected> expected;
    std::vector<std::vector<GltfPrimitive>> result(meshes.size());
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const std::vector<JsonReader> primitives = meshes[m]["primitives"].elements();
        result[m].resize(primitives.size());
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const JsonReader& primitive = primitives[p];
            if (primitive.index("mode", kTriangles) < kTriangles) continue;
            if (primitive.index("mode", kTriangles) > kFan) primitive["mode"].fail("a mode from 0 to 6");
            const std::size_t triangles = triangleCount(primitive, accessors);
            const json slim = reducePrimitive(primitive, texCoordOfMaterial, accessors.size());
            checkPrimitive(document, primitive, slim, accessors);
            const std::size_t node = expected.size();
            reduced.document["meshes"].push_back({{"name", std::to_string(node)}, {"primitives", {slim}}});
            reduced.document["nodes"].push_back({{"name", std::to_string(node)}, {"mesh", node}});
            reduced.document["scenes"][0]["nodes"].push_back(node);
            expected.push_back({m, p, triangles});
        }
    }
    if (expected.empty()) return result;

    joinBuffers(document, reduced);
    const std::vector<std::uint8_t> bytes = packGlb(reduced.document, std::move(reduced.binary));
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "glb");
    if (!scene || !scene->mRootNode) throw InputError(fmt::format("{}: meshes: {}", document.file, importer.GetErrorString()));
    const std::map<std::string_view, const aiNode*> nodes = nodesByName(*scene->mRootNode);
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto& [m, p, triangles] = expected[i];
        const JsonReader primitive = meshes[m]["primitives"].element(p);
        const auto node = nodes.find(std::to_string(i));
        if (node == nodes.end() || node->second->mNumMeshes != 1) primitive.fail("a primitive that can be decoded");
        const aiMesh& mesh = *scene->mMeshes[node->second->mMeshes[0]];
        if (mesh.mNumFaces != triangles) primitive.fail(fmt::format("{} triangles, not the {} that could be decoded", triangles, mesh.mNumFaces));
        result[m][p] = takeTriangles(mesh);
    }
    return result;
}

}  // namespace clv
