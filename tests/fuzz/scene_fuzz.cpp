// A scene file is converted, or refused in one line that names it; what is converted holds together. The first byte says which format it is.
#include "bindings/scene/scene.h"
#include "clv/math/finite.h"
#include "fuzz/bytes.h"
#include "fuzz/fuzz_file.h"

using namespace clv;
using namespace clv::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const FuzzFile files[] = {FuzzFile(".gltf"), FuzzFile(".glb"), FuzzFile(".obj")};
    if (size == 0) return 0;
    const std::string name = files[data[0] % std::size(files)].with({data + 1, size - 1});
    try {
        const Scene scene = loadScene(name);
        require(!scene.triangles.empty(), "a scene has triangles");
        require(scene.materialOf.size() == scene.triangles.size() && scene.nodeOf.size() == scene.triangles.size(), "a material and a node a triangle");
        require(scene.uvs.empty() || scene.uvs.size() == scene.positions.size(), "texture coordinates for all vertices, or for none");
        for (const glm::vec3& position : scene.positions) require(clvIsFinite(position), "a position is finite");
        for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
            for (int k = 0; k < 3; ++k) require(scene.triangles[t][k] < scene.positions.size(), "a corner is a vertex");
            require(scene.materialOf[t] < scene.materials.size() && scene.nodeOf[t] < scene.nodeNames.size(), "a triangle has a material and a node");
            const glm::vec3 albedo = scene.albedo(std::uint32_t(t), 0.3f, 0.3f);
            require(clvIsFinite(albedo) && glm::all(glm::greaterThanEqual(albedo, vec3(0.0f))) && glm::all(glm::lessThanEqual(albedo, vec3(1.0f))), "an albedo lies in [0, 1]");
        }
        for (const NamedLight& named : scene.lights) require(clvIsFinite(named.light.position) && clvIsFinite(named.light.intensity), "a light is finite");
    } catch (const InputError& error) {
        // A material library is named by itself; what other formats left beside the file may be one.
        require(std::string(error.what()).starts_with(name.substr(0, name.rfind('.'))), "an error names the file");
    }
    return 0;
}
