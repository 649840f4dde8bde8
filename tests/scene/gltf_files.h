// Small glTF documents that tests change and write.
#pragma once
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bindings/scene/glb_container.h"
#include "bindings/scene/scene.h"
#include "support/temporary_folder.h"

namespace clv {

using nlohmann::json;

struct TestGltf {
    json document;
    std::vector<std::uint8_t> binary;
};

// The triangle (0,0,0), (1,0,0), (0,1,0) with texture coordinates equal to x and y, as node "leaf" with material "paint".
inline TestGltf triangleGltf() {
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, uvs[] = {0, 0, 1, 0, 0, 1};
    const std::uint16_t indices[] = {0, 1, 2};
    TestGltf gltf;
    appendBytes(gltf.binary, positions, sizeof positions);
    appendBytes(gltf.binary, uvs, sizeof uvs);
    appendBytes(gltf.binary, indices, sizeof indices);
    gltf.document = json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "leaf", "mesh": 0}],
        "meshes": [{"name": "sheet", "primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [{"name": "paint", "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 1]}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
                      {"bufferView": 1, "componentType": 5126, "type": "VEC2", "count": 3},
                      {"bufferView": 2, "componentType": 5123, "type": "SCALAR", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
                        {"buffer": 0, "byteOffset": 60, "byteLength": 6}]})");
    gltf.document["buffers"] = {{{"byteLength", gltf.binary.size()}}};
    return gltf;
}

class GltfFiles : public TemporaryFolder {
protected:
    std::string writeGltf(const TestGltf& gltf, const std::string& name = "test.glb") const {
        const std::vector<std::uint8_t> bytes = packGlb(gltf.document, gltf.binary);
        return write(name, std::string(bytes.begin(), bytes.end()));
    }
    Scene load(const TestGltf& gltf) const { return loadScene(writeGltf(gltf)); }
    // What the InputError says that loading throws; empty when it throws none.
    static std::string errorOf(const std::string& file) {
        try {
            loadScene(file);
        } catch (const InputError& error) {
            return error.what();
        }
        return {};
    }
    std::string errorOf(const TestGltf& gltf) const { return errorOf(writeGltf(gltf)); }
};

inline glm::vec3 corner(const Scene& scene, std::size_t triangle, int i) { return scene.positions[scene.triangles[triangle][i]]; }

inline glm::dvec3 areaVector(const Scene& scene, std::size_t triangle) {
    const glm::dvec3 a = corner(scene, triangle, 0), b = corner(scene, triangle, 1), c = corner(scene, triangle, 2);
    return 0.5 * glm::cross(b - a, c - a);
}

}  // namespace clv
