#include "bindings/scene/import_obj.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/obj_check.h"
#include "bindings/scene/obj_text.h"
#include "bindings/scene/scene_builder.h"
#include "bindings/scene/texture_codec.h"

namespace clv {
namespace {

// Gives assimp the texts that were checked.
class CleanTexts : public Assimp::DefaultIOSystem {
public:
    Assimp::IOStream* Open(const char* file, const char*) override {
        if (!isFile(file)) return nullptr;
        const std::string text = readObjText(file);
        auto* bytes = new std::uint8_t[text.size()];
        std::ranges::copy(text, bytes);
        return new Assimp::MemoryIOStream(bytes, text.size(), true);
    }
};

Material readMaterial(const aiMaterial& source, const std::string& file, SceneBuilder& builder, std::map<std::string, int>& textures) {
    Material material;
    material.name = source.GetName().C_Str();
    if (material.name == AI_DEFAULT_MATERIAL_NAME) return material;  // faces that name no material
    aiColor3D diffuse(material.albedo.r, material.albedo.g, material.albedo.b);
    source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
    material.albedo = {diffuse.r, diffuse.g, diffuse.b};
    for (int channel = 0; channel < 3; ++channel)
        if (!(material.albedo[channel] >= 0.0f && material.albedo[channel] <= 1.0f))
            throw InputError(fmt::format("{}: material '{}': Kd {}; expected albedo from 0 to 1", file, material.name,
                                         material.albedo[channel]));
    aiString path;
    if (source.GetTexture(aiTextureType_DIFFUSE, 0, &path) != aiReturn_SUCCESS) return material;
    const std::string image = path.C_Str();
    const auto [known, isNew] = textures.try_emplace(image, -1);
    if (isNew) {
        const std::string place = fmt::format("{}: material '{}'", file, material.name);
        const std::filesystem::path beside = std::filesystem::path(file).parent_path() / image;
        if (!isFile(beside)) throw InputError(fmt::format("{}: expected a file {}", place, beside.string()));
        known->second = builder.addTexture(decodeTexture(readFileBytes(beside.string()), image, place));
    }
    material.texture = known->second;
    return material;
}

void addMesh(const aiMesh& mesh, const std::string& file, SceneBuilder& builder) {
    const std::uint32_t first = builder.vertexCount();
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& p = mesh.mVertices[i];
        const aiVector3D uv = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][i] : aiVector3D(0.0f);
        if (!std::isfinite(double(p.x) + p.y + p.z) || !std::isfinite(uv.SquareLength()))
            throw InputError(fmt::format("{}: mesh '{}', vertex {}: expected a finite position", file, mesh.mName.C_Str(), i));
        builder.addVertex({p.x, p.y, p.z}, {uv.x, 1.0f - uv.y});  // OBJ's v points up
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices == 3)
            builder.addTriangle(first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2], mesh.mMaterialIndex);
        else
            builder.ignore("points and lines");
    }
}

void addNode(const aiScene& scene, const aiNode& node, const std::string& file, SceneBuilder& builder) {
    if (node.mNumMeshes > 0) builder.beginNode(node.mName.C_Str());
    for (unsigned i = 0; i < node.mNumMeshes; ++i) addMesh(*scene.mMeshes[node.mMeshes[i]], file, builder);
    for (unsigned i = 0; i < node.mNumChildren; ++i) addNode(scene, *node.mChildren[i], file, builder);
}

}  // namespace

Scene importObj(const std::string& file) {
    const std::vector<std::string> warnings = checkObj(file);
    Assimp::Importer importer;
    importer.SetIOHandler(new CleanTexts);  // which the importer then owns
    const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate);
    if (!scene || !scene->mRootNode) throw InputError(fmt::format("{}: {}", file, importer.GetErrorString()));
    SceneBuilder builder(std::filesystem::path(file).stem().string());
    for (const std::string& warning : warnings) builder.warn(warning);
    std::map<std::string, int> textures;
    for (unsigned i = 0; i < scene->mNumMaterials; ++i) builder.addMaterial(readMaterial(*scene->mMaterials[i], file, builder, textures));
    addNode(*scene, *scene->mRootNode, file, builder);
    return std::move(builder).finish(file);
}

}  // namespace clv
