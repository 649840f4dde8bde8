// A scene on the host: world-space triangles, Lambertian materials, lights and cameras.
#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "clv/data/light.h"

namespace clv {

// Bad usage or bad input: what() is one line that names the file, the place and what was expected. Commands exit with 2.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Texture {
    std::string name;
    int width = 0, height = 0;
    std::vector<glm::vec3> texels;  // linear RGB, row 0 at v = 0 (the top, as in glTF)
};

struct Material {
    std::string name;
    glm::vec3 albedo{0.8f};  // linear RGB in [0, 1]; multiplies the texture
    int texture = -1;        // index into Scene::textures, or -1
};

struct Camera {
    std::string name;
    glm::vec3 position{0.0f};        // m, relative to Scene::anchor
    glm::vec3 forward{0, 0, -1};     // unit length
    glm::vec3 up{0, 1, 0};           // unit length, orthogonal to forward
    float yfov = 0.8f;               // rad, whole vertical angle
    float aspect = 16.0f / 9.0f;     // width / height
};

struct NamedLight {
    std::string name;
    ClvLight light;
};

struct Bounds {
    glm::vec3 lo{0.0f}, hi{0.0f};  // m
    glm::vec3 extent() const { return hi - lo; }
    glm::vec3 center() const { return 0.5f * (lo + hi); }
};

struct Scene {
    std::string name;
    glm::dvec3 anchor{0.0};                      // m, world space; every position below is relative to it
    std::vector<glm::vec3> positions;            // m, a vertex each
    std::vector<glm::vec2> uvs;                  // a vertex each, or empty when no material has a texture
    std::vector<glm::uvec3> triangles;           // indices into positions; front face counter-clockwise
    std::vector<std::uint32_t> materialOf;       // a triangle each
    std::vector<std::uint32_t> nodeOf;           // a triangle each, index into nodeNames
    std::vector<std::string> nodeNames;
    std::vector<Material> materials;
    std::vector<Texture> textures;
    std::vector<NamedLight> lights;
    std::vector<Camera> cameras;
    Bounds bounds;                               // of all triangles
    std::vector<std::string> ignored;            // features of the file that play no part here, a few words each
    std::vector<std::string> warnings;           // of what may not be as it was meant, a line each
    std::size_t droppedTriangles = 0;            // zero-area triangles that were left out

    // Base colour at a point of a triangle, linear RGB in [0, 1]; barycentrics (u, v) belong to vertices 1 and 2.
    // Textures repeat and are filtered bilinearly.
    glm::vec3 albedo(std::uint32_t triangle, float u, float v) const;
};

// Loads a .glb, .gltf or .obj file, or makes the built-in scene of that name. Throws InputError.
// A scene without triangles is an error here; one without lights is not (lights may be given apart).
Scene loadScene(const std::string& fileOrName);

// The built-in scenes, in the order in which they are listed; each has lights and cameras.
struct BuiltinScene {
    std::string name;
    std::string description;  // one line
};
const std::vector<BuiltinScene>& builtinScenes();
Scene makeBuiltinScene(const std::string& name);

// Reads a lights file {"lights":[...]} (angles in radians, direction the way the light travels). Throws InputError.
// Positions come back relative to `anchor`.
std::vector<NamedLight> loadLights(const std::string& file, const glm::dvec3& anchor);

// Writes the scene as a .glb with its lights and cameras, under a temporary name that is then renamed.
void writeGlb(const Scene& scene, const std::string& file);

}  // namespace clv
