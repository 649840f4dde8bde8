// Collects triangles, lights and cameras in double precision and turns them into a Scene.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "bindings/scene/scene.h"

namespace clv {

class SceneBuilder {
public:
    explicit SceneBuilder(std::string name) { scene_.name = std::move(name); }

    std::uint32_t addMaterial(Material material);
    int addTexture(Texture texture);
    // Triangles added from here on belong to this node.
    void beginNode(std::string name);
    // Or to one that was begun before; its index in scene.nodeNames.
    void chooseNode(std::uint32_t node) { node_ = node; }
    // World space, m.
    std::uint32_t addVertex(const glm::dvec3& position, const glm::vec2& uv = glm::vec2(0.0f));
    std::uint32_t vertexCount() const { return std::uint32_t(positionsWorld_.size()); }
    std::size_t lightCount() const { return scene_.lights.size(); }
    std::size_t cameraCount() const { return scene_.cameras.size(); }
    // Counter-clockwise seen from the front.
    void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material);
    // Planar and convex, counter-clockwise seen from the front.
    void addQuad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, std::uint32_t material);
    // light.position is ignored: `position` is its place in world space, m.
    void addLight(std::string name, ClvLight light, const glm::dvec3& position);
    // camera.position is ignored: `position` is its place in world space, m.
    void addCamera(Camera camera, const glm::dvec3& position);
    // Says once that a feature of the file plays no part.
    void ignore(const std::string& feature);

    // A line that names file and place.
    void warn(const std::string& line) { scene_.warnings.push_back(line); }

    // Chooses the anchor, drops zero-area triangles and checks what is left. `source` begins the line of an error. Throws InputError.
    Scene finish(const std::string& source) &&;

private:
    void checkVertices(const std::string& source) const;
    void dropZeroAreaTriangles(const std::string& source);
    // Where rays start too far above small triangles, because others lie far away.
    void warnOfLostDetail(const std::string& source);

    Scene scene_;
    std::uint32_t node_ = 0;
    std::vector<glm::dvec3> positionsWorld_;
    std::vector<glm::dvec3> lightPositionsWorld_;
    std::vector<glm::dvec3> cameraPositionsWorld_;
};

Camera cameraLookingAt(std::string name, const glm::dvec3& position, const glm::dvec3& target, float yfov);

ClvLight makePointLight(const glm::vec3& intensity);
// Shines from its position along `direction` (any length but zero).
ClvLight makeSpotLight(const glm::vec3& direction, const glm::vec3& intensity, float innerConeAngle, float outerConeAngle);
// Shines along `direction` (any length but zero).
ClvLight makeDirectionalLight(const glm::vec3& direction, const glm::vec3& irradiance);

// Throws InputError, beginning with `place`, when the light cannot be: negative or non-finite intensity, bad cone angles, no direction.
void checkLight(const ClvLight& light, const std::string& place);

}  // namespace clv
