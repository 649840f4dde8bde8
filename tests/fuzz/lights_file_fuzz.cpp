// A file of lights is read, or refused in one line that names it; what is read can be lit with.
#include "bindings/scene/scene.h"
#include "clv/math/finite.h"
#include "fuzz/bytes.h"
#include "fuzz/fuzz_file.h"

using namespace clv;
using namespace clv::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const FuzzFile file(".json");
    const std::string name = file.with({data, size});
    try {
        for (const NamedLight& named : loadLights(name, glm::dvec3(1.0, 2.0, 3.0))) {
            const ClvLight& light = named.light;
            require(clvIsFinite(light.position) && clvIsFinite(light.direction) && clvIsFinite(light.intensity), "a light is finite");
            require(light.intensity.x >= 0.0f && light.intensity.y >= 0.0f && light.intensity.z >= 0.0f, "its intensity is not negative");
        }
    } catch (const InputError& error) {
        require(std::string(error.what()).starts_with(name), "an error names the file");
    }
    return 0;
}
