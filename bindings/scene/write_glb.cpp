// Writes a scene as GLB.
#include <algorithm>
#include <array>
#include <map>

#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/glb_container.h"
#include "bindings/scene/scene.h"
#include "bindings/scene/texture_codec.h"

namespace clv {
namespace {

using nlohmann::json;

constexpr int kComponentFloat = 5126, kComponentUint = 5125;  // glTF component types

json jsonFrom(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

json rotationOf(const glm::dmat3& worldFromNode) {
    const glm::dquat q = glm::normalize(glm::quat_cast(worldFromNode));
    return {q.x, q.y, q.z, q.w};
}

// Axes of a node whose -Z looks along `forward` and whose +Y is as near to `up` as can be.
glm::dmat3 axesLooking(const glm::dvec3& forward, const glm::dvec3& up) {
    const glm::dvec3 back = -glm::normalize(forward), right = glm::normalize(glm::cross(up, back));
    return {right, glm::cross(back, right), back};
}

class GlbWriter {
public:
    explicit GlbWriter(const Scene& scene) : scene_(scene) {
        document_ = {{"asset", {{"version", "2.0"}, {"generator", "clv"}}}, {"scene", 0}, {"scenes", {{{"name", scene.name}}}},
                     {"nodes", json::array()}};
    }

    std::vector<std::uint8_t> run() && {
        addMaterials();
        addMeshes();
        addLights();
        addCameras();
        document_["scenes"][0]["nodes"] = roots_;
        document_["buffers"] = {{{"byteLength", binary_.size()}}};
        return packGlb(document_, std::move(binary_));
    }

private:
    std::size_t addBufferView(const void* data, std::size_t size) {
        padBytes(binary_, 4, 0);
        document_["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}});
        appendBytes(binary_, data, size);
        return document_["bufferViews"].size() - 1;
    }
    template <class Element>
    std::size_t addAccessor(const std::vector<Element>& elements, int componentType, const char* type, std::size_t count) {
        const std::size_t view = addBufferView(elements.data(), elements.size() * sizeof(Element));
        document_["accessors"].push_back({{"bufferView", view}, {"componentType", componentType}, {"type", type}, {"count", count}});
        return document_["accessors"].size() - 1;
    }
    void addNode(json node) {
        roots_.push_back(document_["nodes"].size());
        document_["nodes"].push_back(std::move(node));
    }

    void addMaterials();
    void addMeshes();
    json primitiveOf(std::uint32_t material, const std::vector<std::uint32_t>& triangles);
    void addLights();
    void addCameras();

    const Scene& scene_;
    json document_;
    json roots_ = json::array();
    std::vector<std::uint8_t> binary_;
};

void GlbWriter::addMaterials() {
    for (const Texture& texture : scene_.textures) {
        const std::vector<std::uint8_t> png = encodePng(texture);
        document_["images"].push_back({{"name", texture.name}, {"mimeType", "image/png"}, {"bufferView", addBufferView(png.data(), png.size())}});
        document_["textures"].push_back({{"source", document_["images"].size() - 1}});
    }
    for (const Material& material : scene_.materials) {
        json pbr = {{"baseColorFactor", {material.albedo.r, material.albedo.g, material.albedo.b, 1.0}},
                    {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}};
        if (material.texture >= 0) pbr["baseColorTexture"] = {{"index", material.texture}};
        document_["materials"].push_back({{"name", material.name}, {"doubleSided", true}, {"pbrMetallicRoughness", pbr}});
    }
}

// One mesh a node, one primitive a material of it, in the order in which they first appear.
void GlbWriter::addMeshes() {
    struct Group {
        std::uint32_t material;
        std::vector<std::uint32_t> triangles;
    };
    std::vector<std::vector<Group>> groupsOf(scene_.nodeNames.size());
    for (std::uint32_t t = 0; t < scene_.triangles.size(); ++t) {
        std::vector<Group>& groups = groupsOf[scene_.nodeOf[t]];
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.material == scene_.materialOf[t]; });
        if (group == groups.end()) group = groups.insert(groups.end(), {scene_.materialOf[t], {}});
        group->triangles.push_back(t);
    }
    for (std::size_t node = 0; node < groupsOf.size(); ++node) {
        if (groupsOf[node].empty()) continue;
        json primitives = json::array();
        for (const Group& group : groupsOf[node]) primitives.push_back(primitiveOf(group.material, group.triangles));
        document_["meshes"].push_back({{"name", scene_.nodeNames[node]}, {"primitives", primitives}});
        addNode({{"name", scene_.nodeNames[node]}, {"mesh", document_["meshes"].size() - 1}, {"translation", jsonFrom(scene_.anchor)}});
    }
}

json GlbWriter::primitiveOf(std::uint32_t material, const std::vector<std::uint32_t>& triangles) {
    std::map<std::uint32_t, std::uint32_t> localOf;
    std::vector<std::uint32_t> indices;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uvs;
    for (std::uint32_t t : triangles)
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = scene_.triangles[t][corner];
            const auto [local, isNew] = localOf.try_emplace(vertex, std::uint32_t(positions.size()));
            if (isNew) positions.push_back(scene_.positions[vertex]);
            if (isNew && !scene_.uvs.empty()) uvs.push_back(scene_.uvs[vertex]);
            indices.push_back(local->second);
        }
    glm::vec3 lo = positions.front(), hi = positions.front();
    for (const glm::vec3& position : positions) {
        lo = glm::min(lo, position);
        hi = glm::max(hi, position);
    }
    const std::size_t position = addAccessor(positions, kComponentFloat, "VEC3", positions.size());
    document_["accessors"][position]["min"] = jsonFrom(lo);
    document_["accessors"][position]["max"] = jsonFrom(hi);
    json primitive = {{"material", material}, {"attributes", {{"POSITION", position}}}};
    if (!uvs.empty()) primitive["attributes"]["TEXCOORD_0"] = addAccessor(uvs, kComponentFloat, "VEC2", uvs.size());
    primitive["indices"] = addAccessor(indices, kComponentUint, "SCALAR", indices.size());
    return primitive;
}

void GlbWriter::addLights() {
    if (scene_.lights.empty()) return;
    document_["extensionsUsed"] = {"KHR_lights_punctual"};
    json& lights = document_["extensions"]["KHR_lights_punctual"]["lights"];
    for (const NamedLight& named : scene_.lights) {
        const ClvLight& light = named.light;
        // glTF keeps colours in [0, 1]: the brightest channel becomes the intensity.
        const glm::dvec3 intensity(light.intensity);
        const double strength = std::max({intensity.r, intensity.g, intensity.b});
        const std::array<const char*, 3> types = {"point", "spot", "directional"};
        json definition = {{"name", named.name}, {"type", types[light.type]}, {"intensity", strength},
                           {"color", jsonFrom(strength > 0.0 ? intensity / strength : glm::dvec3(1.0))}};
        if (light.type == kClvLightSpot)
            definition["spot"] = {{"innerConeAngle", light.innerConeAngle}, {"outerConeAngle", light.outerConeAngle}};
        lights.push_back(definition);

        json node = {{"name", named.name}, {"extensions", {{"KHR_lights_punctual", {{"light", lights.size() - 1}}}}},
                     {"translation", jsonFrom(scene_.anchor + glm::dvec3(light.position))}};
        if (light.type != kClvLightPoint) {
            const bool isUpright = std::abs(light.direction.y) > 0.9f;
            node["rotation"] = rotationOf(axesLooking(light.direction, isUpright ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0)));
        }
        addNode(node);
    }
}

void GlbWriter::addCameras() {
    for (const Camera& camera : scene_.cameras) {
        // glTF asks for a near plane; nothing here reads it.
        constexpr double kNear = 0.01;  // m
        document_["cameras"].push_back({{"name", camera.name}, {"type", "perspective"},
                                        {"perspective", {{"yfov", camera.yfov}, {"aspectRatio", camera.aspect}, {"znear", kNear}}}});
        addNode({{"name", camera.name}, {"camera", document_["cameras"].size() - 1},
                 {"translation", jsonFrom(scene_.anchor + glm::dvec3(camera.position))},
                 {"rotation", rotationOf(axesLooking(camera.forward, camera.up))}});
    }
}

}  // namespace

void writeGlb(const Scene& scene, const std::string& file) { writeFileBytes(file, GlbWriter(scene).run()); }

}  // namespace clv
