#include "bindings/scene/import_obj.h"

#include <cmath>
#include <filesystem>
#include <map>

#include <assimp/Importer.hpp>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/obj_check.h"
#include "bindings/scene/scene_builder.h"
#include "bindings/scene/texture_codec.h"

namespace clv {
namespace {

// The picture is a file beside `file`; those that were read are in `textures`.
Material readMaterial(const ObjMaterial& source, const std::string& file, SceneBuilder& builder, std::map<std::string, int>& textures) {
    Material material{.name = source.name};
    if (source.albedo) material.albedo = *source.albedo;
    if (source.picture.empty() || source.firstUse.empty()) return material;
    if (!source.albedo) material.albedo = glm::vec3(1.0f);
    const auto [known, isNew] = textures.try_emplace(source.picture, -1);
    if (isNew) {
        const std::string place = fmt::format("{}: material '{}'", source.definition, source.name);
        const std::filesystem::path beside = std::filesystem::path(file).parent_path() / source.picture;
        if (!isFile(beside)) throw InputError(fmt::format("{}: expected a file {}", place, beside.string()));
        known->second = builder.addTexture(decodeTexture(readFileBytes(beside.string()), source.picture, place));
    }
    material.texture = known->second;
    return material;
}

void addMesh(const aiMesh& mesh, std::uint32_t material, const std::string& place, SceneBuilder& builder) {
    const std::uint32_t first = builder.vertexCount();
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& p = mesh.mVertices[i];
        const aiVector3D uv = mesh.HasTextureCoords(0) ? mesh.mTextureCoords[0][i] : aiVector3D(0.0f);
        if (!std::isfinite(double(p.x) + p.y + p.z) || !std::isfinite(uv.SquareLength()))
            throw InputError(fmt::format("{}, vertex {}: expected a finite position", place, i));
        builder.addVertex({p.x, p.y, p.z}, {uv.x, 1.0f - uv.y});  // OBJ's v points up
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices != 3) throw InputError(fmt::format("{}, face {}: expected a face that can be cut into triangles", place, i));
        builder.addTriangle(first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2], material);
    }
}

void addGroup(const aiScene& scene, const aiNode& group, const CheckedObj& obj, const std::string& file, SceneBuilder& builder) {
    if (group.mNumMeshes == 0) return;
    const ObjPart& part = obj.parts.at(std::stoul(group.mName.C_Str()));
    builder.chooseNode(std::uint32_t(part.node));
    const std::string place = fmt::format("{}: node '{}'", file, obj.nodes[part.node]);
    for (unsigned i = 0; i < group.mNumMeshes; ++i) addMesh(*scene.mMeshes[group.mMeshes[i]], std::uint32_t(part.material), place, builder);
}

}  // namespace

Scene importObj(const std::string& file) {
    const CheckedObj obj = checkObj(file);
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFileFromMemory(obj.text.data(), obj.text.size(), aiProcess_Triangulate, "obj");
    if (!scene || !scene->mRootNode) throw InputError(fmt::format("{}: {}", file, importer.GetErrorString()));
    SceneBuilder builder(std::filesystem::path(file).stem().string());
    for (const std::string& warning : obj.warnings) builder.warn(warning);
    for (const std::string& feature : obj.ignored) builder.ignore(feature);
    std::map<std::string, int> textures;
    for (const ObjMaterial& material : obj.materials) builder.addMaterial(readMaterial(material, file, builder, textures));
    for (const std::string& node : obj.nodes) builder.beginNode(node);
    for (unsigned i = 0; i < scene->mRootNode->mNumChildren; ++i) addGroup(*scene, *scene->mRootNode->mChildren[i], obj, file, builder);
    return std::move(builder).finish(file);
}

}  // namespace clv
