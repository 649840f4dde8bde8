// A file of motion is read, or refused in one line that names it; at any frame what it says can be lit with and looked from.
#include <cmath>

#include "bindings/scene/motion.h"
#include "clv/math/finite.h"
#include "fuzz/bytes.h"
#include "fuzz/fuzz_file.h"

using namespace clv;
using namespace clv::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const FuzzFile file(".json");
    static const Scene scene = [] {
        Scene scene = makeBuiltinScene("two_rooms");
        scene.anchor = glm::dvec3(1.0, 2.0, 3.0);
        scene.lights.push_back({"sun", scene.lights.at(0).light});
        return scene;
    }();
    const std::string name = file.with({data, size});
    try {
        const Motion motion = loadMotion(name, scene);
        require(std::isfinite(float(1.0 / motion.fps)) && float(1.0 / motion.fps) > 0.0f, "a frame takes a while");
        require(!motion.lights.empty() || motion.camera, "something moves");
        const std::uint32_t last = motion.lastFrame;
        for (const std::uint32_t frame : {0u, 1u, last / 3, last / 2, last, last + 1}) {
            const std::vector<NamedLight> lights = lightsAt(motion, scene, frame);
            require(lights.size() == scene.lights.size(), "no light comes or goes");
            for (const auto& [lightName, light] : lights) {
                require(clvIsFinite(light.position) && clvIsFinite(light.direction) && clvIsFinite(light.intensity), "a light is finite");
                require(std::abs(glm::length(light.direction) - 1.0f) < 1e-3f, "its direction is of unit length");
                require(light.intensity.x >= 0.0f && light.intensity.y >= 0.0f && light.intensity.z >= 0.0f, "its intensity is not negative");
                require(light.dynamicity == 0.0f || light.dynamicity == 1.0f, "it moves or does not");
            }
            const Camera camera = cameraAt(motion, scene, scene.cameras.at(0), frame);
            require(clvIsFinite(camera.position), "a camera is somewhere");
            require(std::abs(glm::length(camera.forward) - 1.0f) < 1e-3f && std::abs(glm::length(camera.up) - 1.0f) < 1e-3f, "it looks somewhere");
            require(std::abs(glm::dot(camera.forward, camera.up)) < 1e-3f, "its sides are square");
            require(camera.yfov > 0.0f && camera.yfov <= 3.14f, "its angle is one");
        }
    } catch (const InputError& error) {
        require(std::string(error.what()).starts_with(name), "an error names the file");
    }
    return 0;
}
