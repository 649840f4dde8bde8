#include "bindings/scene/import_gltf.h"

#include <cmath>
#include <map>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "bindings/scene/gltf_document.h"
#include "bindings/scene/gltf_ignored.h"
#include "bindings/scene/gltf_triangles.h"
#include "bindings/scene/scene_builder.h"
#include "bindings/scene/texture_codec.h"

namespace clv {
namespace {

constexpr const char* kLights = "KHR_lights_punctual";
constexpr double kRounding = 1e-6;  // of matrices that exporters write

class GltfImport {
public:
    explicit GltfImport(const std::string& file) : document_(readGltf(file)), root_(document_.root()), builder_(sceneName(file)) {}

    Scene run() && {
        noteIgnoredFeatures(root_, builder_);
        addMaterials();
        meshes_ = root_.elements("meshes");
        nodes_ = root_.elements("nodes");
        cameras_ = root_.elements("cameras");
        primitives_ = decodeTriangles(document_, texCoordOfMaterial_);
        if (root_.has("extensions") && root_["extensions"].has(kLights)) lights_ = root_["extensions"][kLights].elements("lights");
        for (std::size_t node : rootNodes()) addNode(node, glm::dmat4(1.0));
        return std::move(builder_).finish(document_.file);
    }

private:
    static std::string sceneName(const std::string& file);
    void addMaterials();
    int addTexture(const JsonReader& textureInfo);
    std::uint32_t materialOf(const JsonReader& primitive);
    std::vector<std::size_t> rootNodes() const;
    void addNode(std::size_t index, const glm::dmat4& worldFromParent);
    void addMesh(const JsonReader& node, const std::string& name, const glm::dmat4& worldFromNode);
    void addLight(const JsonReader& node, const glm::dmat4& worldFromNode);
    void addCamera(const JsonReader& node, const glm::dmat4& worldFromNode);

    GltfDocument document_;
    JsonReader root_;
    SceneBuilder builder_;
    std::vector<JsonReader> meshes_, nodes_, cameras_, lights_;
    std::vector<std::vector<GltfPrimitive>> primitives_;
    std::vector<std::size_t> texCoordOfMaterial_;
    std::map<std::size_t, int> textureOfImage_;
    int defaultMaterial_ = -1;  // made when first needed
};

std::string GltfImport::sceneName(const std::string& file) {
    const std::size_t slash = file.find_last_of('/') + 1;
    return file.substr(slash, file.find_last_of('.') - slash);
}

int GltfImport::addTexture(const JsonReader& textureInfo) {
    const std::vector<JsonReader> textures = root_.elements("textures"), images = root_.elements("images");
    const JsonReader& texture = textures[textureInfo["index"].index(textures.size())];
    const std::size_t imageIndex = texture["source"].index(images.size());
    const auto known = textureOfImage_.find(imageIndex);
    if (known != textureOfImage_.end()) return known->second;

    const JsonReader& image = images[imageIndex];
    std::vector<std::uint8_t> bytes;
    if (image.has("bufferView")) {
        const std::size_t view = image["bufferView"].index(root_.elements("bufferViews").size());
        const ByteRange range = bufferViewBytes(document_, view);
        bytes.assign(range.begin, range.begin + range.size);
    } else {
        bytes = readUri(document_, image["uri"]);
    }
    const bool isFile = image.has("uri") && image["uri"].text().rfind("data:", 0) != 0;
    const std::string name = image.text("name", isFile ? image["uri"].text() : fmt::format("image {}", imageIndex));
    const int index = builder_.addTexture(decodeTexture(bytes, name, fmt::format("{}: {}", document_.file, image.place())));
    textureOfImage_[imageIndex] = index;
    return index;
}

void GltfImport::addMaterials() {
    const std::vector<JsonReader> materials = root_.elements("materials");
    for (std::size_t i = 0; i < materials.size(); ++i) {
        Material material{materials[i].text("name", fmt::format("material {}", i)), glm::vec3(1.0f), -1};
        std::size_t texCoord = 0;
        if (materials[i].has("pbrMetallicRoughness")) {
            const JsonReader pbr = materials[i]["pbrMetallicRoughness"];
            if (pbr.has("baseColorFactor")) {
                const JsonReader factor = pbr["baseColorFactor"];
                const std::vector<double> rgba = factor.numbers(4);
                material.albedo = {rgba[0], rgba[1], rgba[2]};
                for (int channel = 0; channel < 3; ++channel)
                    if (!(rgba[channel] >= 0.0 && rgba[channel] <= 1.0))
                        factor.fail(fmt::format("albedo from 0 to 1 of material '{}', not {}", material.name, rgba[channel]));
            }
            if (pbr.has("baseColorTexture")) {
                material.texture = addTexture(pbr["baseColorTexture"]);
                texCoord = pbr["baseColorTexture"].index("texCoord", 0);
            }
        }
        builder_.addMaterial(material);
        texCoordOfMaterial_.push_back(texCoord);
    }
}

std::uint32_t GltfImport::materialOf(const JsonReader& primitive) {
    if (primitive.has("material")) return std::uint32_t(primitive["material"].index(texCoordOfMaterial_.size()));
    // glTF's default material is white.
    if (defaultMaterial_ < 0) defaultMaterial_ = int(builder_.addMaterial({"default", glm::vec3(1.0f), -1}));
    return std::uint32_t(defaultMaterial_);
}

std::vector<std::size_t> GltfImport::rootNodes() const {
    std::vector<std::size_t> roots;
    const std::vector<JsonReader> scenes = root_.elements("scenes");
    if (!scenes.empty()) {
        const std::size_t shown = root_.has("scene") ? root_["scene"].index(scenes.size()) : 0;
        for (const JsonReader& node : scenes[shown].elements("nodes")) roots.push_back(node.index(nodes_.size()));
        return roots;
    }
    std::vector<bool> isChild(nodes_.size());
    for (const JsonReader& node : nodes_)
        for (const JsonReader& child : node.elements("children")) isChild[child.index()] = true;
    for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (!isChild[i]) roots.push_back(i);
    return roots;
}

glm::dmat4 parentFromNode(const JsonReader& node) {
    glm::dmat4 transform(1.0);
    if (node.has("matrix")) {
        const std::vector<double> columns = node["matrix"].numbers(16);
        for (int i = 0; i < 16; ++i) transform[i / 4][i % 4] = columns[i];
        for (int i = 0; i < 4; ++i)
            if (std::abs(transform[i][3] - (i == 3 ? 1.0 : 0.0)) > kRounding) node["matrix"].fail("a last row of 0, 0, 0, 1");
        return transform;
    }
    transform = glm::translate(transform, node.vector("translation", glm::dvec3(0.0)));
    if (node.has("rotation")) {
        const std::vector<double> xyzw = node["rotation"].numbers(4);
        const glm::dquat rotation(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
        const double length = glm::length(rotation);
        if (!(length > 0.0 && std::isfinite(length))) node["rotation"].fail("a quaternion that is finite and not zero");
        transform *= glm::mat4_cast(glm::normalize(rotation));
    }
    return glm::scale(transform, node.vector("scale", glm::dvec3(1.0)));
}

// Where a light shines in the world, unit length.
glm::vec3 directionOf(const JsonReader& node, const glm::dmat4& worldFromNode) {
    const glm::dvec3 direction = glm::dmat3(worldFromNode) * glm::dvec3(0, 0, -1);
    if (!(glm::length(direction) > 0.0)) node.fail("a transform that leaves a direction to a light");
    return glm::vec3(glm::normalize(direction));
}

void GltfImport::addNode(std::size_t index, const glm::dmat4& worldFromParent) {
    const JsonReader& node = nodes_[index];
    const glm::dmat4 worldFromNode = worldFromParent * parentFromNode(node);
    if (node.has("mesh")) addMesh(node, node.text("name", fmt::format("node {}", index)), worldFromNode);
    if (node.has("camera")) addCamera(node, worldFromNode);
    if (node.has("extensions") && node["extensions"].has(kLights)) addLight(node, worldFromNode);
    for (const JsonReader& child : node.elements("children")) addNode(child.index(), worldFromNode);
}

void GltfImport::addMesh(const JsonReader& node, const std::string& name, const glm::dmat4& worldFromNode) {
    const std::size_t mesh = node["mesh"].index(meshes_.size());
    const std::string meshName = meshes_[mesh].text("name", fmt::format("mesh {}", mesh));
    const bool isMirrored = glm::determinant(glm::dmat3(worldFromNode)) < 0.0;
    const std::vector<JsonReader> descriptions = meshes_[mesh]["primitives"].elements();
    builder_.beginNode(name);
    for (std::size_t p = 0; p < descriptions.size(); ++p) {
        const GltfPrimitive& primitive = primitives_[mesh][p];
        if (primitive.triangles.empty()) continue;
        const std::uint32_t material = materialOf(descriptions[p]);
        const std::uint32_t first = builder_.vertexCount();
        for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
            const glm::dvec3 position(worldFromNode * glm::dvec4(primitive.positions[v], 1.0));
            const glm::vec2 uv = primitive.uvs[v];
            if (!std::isfinite(position.x + position.y + position.z) || !std::isfinite(glm::dot(uv, uv)))
                descriptions[p].fail(fmt::format("mesh '{}' to have a finite position at vertex {}", meshName, v));
            builder_.addVertex(position, uv);
        }
        for (const glm::uvec3& t : primitive.triangles) {
            const glm::uvec3 corners = first + (isMirrored ? glm::uvec3(t.x, t.z, t.y) : t);
            builder_.addTriangle(corners.x, corners.y, corners.z, material);
        }
    }
}

void GltfImport::addLight(const JsonReader& node, const glm::dmat4& worldFromNode) {
    const JsonReader& light = lights_[node["extensions"][kLights]["light"].index(lights_.size())];
    const std::string name = node.text("name", light.text("name", fmt::format("light {}", builder_.lightCount())));
    const glm::dvec3 color = light.vector("color", glm::dvec3(1.0));
    const double strength = light.number("intensity", 1.0);
    if (!(strength >= 0.0)) light["intensity"].fail("a number that is not negative");
    const glm::vec3 intensity(strength * color);
    const std::string type = light["type"].text();
    ClvLight made;
    if (type == "point") {
        made = makePointLight(intensity);
    } else if (type == "directional") {
        made = makeDirectionalLight(directionOf(node, worldFromNode), intensity);
    } else if (type == "spot") {
        const JsonReader spot = light["spot"];
        // Defaults of KHR_lights_punctual.
        made = makeSpotLight(directionOf(node, worldFromNode), intensity, float(spot.number("innerConeAngle", 0.0)),
                             float(spot.number("outerConeAngle", kClvPi / 4.0)));
    } else {
        light["type"].fail("point, spot or directional");
    }
    builder_.addLight(name, made, glm::dvec3(worldFromNode[3]));
}

void GltfImport::addCamera(const JsonReader& node, const glm::dmat4& worldFromNode) {
    const JsonReader& definition = cameras_[node["camera"].index(cameras_.size())];
    if (definition["type"].text() != "perspective") {
        builder_.ignore("orthographic cameras");
        return;
    }
    const JsonReader lens = definition["perspective"];
    Camera camera;
    camera.name = node.text("name", definition.text("name", fmt::format("camera {}", builder_.cameraCount())));
    camera.yfov = float(lens["yfov"].number());
    if (!(camera.yfov > 0.0f && camera.yfov < kClvPi)) lens["yfov"].fail("an angle between 0 and pi");
    camera.aspect = float(lens.number("aspectRatio", camera.aspect));
    if (!(camera.aspect > 0.0f && std::isfinite(camera.aspect))) lens["aspectRatio"].fail("a positive number that fits a float");
    const glm::dmat3 worldFromCamera(worldFromNode);
    const glm::dvec3 forward = glm::normalize(worldFromCamera * glm::dvec3(0, 0, -1));
    const glm::dvec3 right = glm::cross(forward, glm::normalize(worldFromCamera * glm::dvec3(0, 1, 0)));
    // Negated, because a flat transform leaves no numbers.
    if (!(glm::length(right) > 0.0)) {
        builder_.warn(fmt::format("{}: {}: its camera has no direction and is left out", document_.file, node.place()));
        return;
    }
    camera.forward = glm::vec3(forward);
    camera.up = glm::vec3(glm::cross(glm::normalize(right), forward));
    builder_.addCamera(camera, glm::dvec3(worldFromNode[3]));
}

}  // namespace

Scene importGltf(const std::string& file) { return GltfImport(file).run(); }

}  // namespace clv
