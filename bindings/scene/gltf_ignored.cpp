#include "bindings/scene/gltf_ignored.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/ranges.h>

namespace clv {
namespace {

constexpr std::array<std::string_view, 2> kRead = {"KHR_lights_punctual", "KHR_draco_mesh_compression"};

bool isRead(const std::string& extension) { return std::ranges::find(kRead, extension) != kRead.end(); }

void noteExtensions(const JsonReader& root, SceneBuilder& builder) {
    for (const JsonReader& extension : root.elements("extensionsRequired"))
        if (!isRead(extension.text())) extension.fail(fmt::format("{}, not {}", fmt::join(kRead, " or "), extension.text()));
    for (const JsonReader& extension : root.elements("extensionsUsed"))
        if (!isRead(extension.text())) builder.ignore("extension " + extension.text());
}

void noteMaterials(const JsonReader& root, SceneBuilder& builder) {
    for (const JsonReader& material : root.elements("materials")) {
        if (material.has("normalTexture")) builder.ignore("normal maps");
        if (material.has("occlusionTexture")) builder.ignore("occlusion maps");
        if (material.has("emissiveTexture")) builder.ignore("emissive light");
        if (material.vector("emissiveFactor", glm::dvec3(0.0)) != glm::dvec3(0.0)) builder.ignore("emissive light");
        if (material.text("alphaMode", "OPAQUE") != "OPAQUE") builder.ignore("transparency (every face is opaque)");
        if (!material.has("pbrMetallicRoughness")) continue;
        const JsonReader pbr = material["pbrMetallicRoughness"];
        if (pbr.has("metallicRoughnessTexture")) builder.ignore("metallic and roughness maps");
    }
}

void noteMeshes(const JsonReader& root, SceneBuilder& builder) {
    for (const JsonReader& mesh : root.elements("meshes"))
        for (const JsonReader& primitive : mesh.elements("primitives")) {
            constexpr std::size_t kTriangles = 4;
            if (primitive.index("mode", kTriangles) < kTriangles) builder.ignore("points and lines");
            if (primitive.has("targets")) builder.ignore("morph targets");
            if (primitive["attributes"].has("COLOR_0")) builder.ignore("vertex colours");
        }
}

void noteSamplers(const JsonReader& root, SceneBuilder& builder) {
    constexpr std::size_t kRepeat = 10497;
    for (const JsonReader& sampler : root.elements("samplers"))
        if (sampler.index("wrapS", kRepeat) != kRepeat || sampler.index("wrapT", kRepeat) != kRepeat)
            builder.ignore("clamped or mirrored textures (all repeat)");
}

}  // namespace

void noteIgnoredFeatures(const JsonReader& root, SceneBuilder& builder) {
    noteExtensions(root, builder);
    if (!root.elements("animations").empty()) builder.ignore("animations");
    if (!root.elements("skins").empty()) builder.ignore("skins");
    if (root.elements("scenes").size() > 1) builder.ignore("scenes other than the default one");
    noteMaterials(root, builder);
    noteMeshes(root, builder);
    noteSamplers(root, builder);
}

}  // namespace clv
