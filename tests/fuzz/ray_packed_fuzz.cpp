// Any 32 bytes are a ray that is finite, walks through a grid and ends there, and packs into itself.
#include "clv/data/ray_packed.h"
#include "clv/stages/inject.h"
#include "fuzz/bytes.h"

using namespace clv;
using namespace clv::test;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    FuzzBytes bytes(data, size);
    const ClvRay ray = clvUnpackRay(bytes.take<ClvRayPacked>());
    require(clvIsFinite(ray.origin) && clvIsFinite(ray.direction) && clvIsFinite(ray.flux) && clvIsFinite(ray.maxDistance), "a ray is finite");
    require(std::abs(dot(ray.direction, ray.direction) - 1.0f) < 1e-5f, "its direction is of unit length");
    require(ray.maxDistance >= 0.0f && ray.dynamicity >= 0.0f && ray.dynamicity <= 1.0f, "its length and dynamicity are within range");
    require(ray.flux.x >= 0.0f && ray.flux.y >= 0.0f && ray.flux.z >= 0.0f, "its flux is not negative");

    const ClvRay again = clvUnpackRay(clvPackRay(ray));
    require(again.origin == ray.origin && again.maxDistance == ray.maxDistance && again.dynamicity == ray.dynamicity, "packing keeps place and dynamicity");
    require(dot(again.direction, ray.direction) > 0.99999f, "packing keeps the direction");
    const float largest = std::max({ray.flux.x, ray.flux.y, ray.flux.z});
    require(std::max({again.flux.x, again.flux.y, again.flux.z}) == largest, "packing keeps the largest channel of the flux");

    ClvVolume volume{};
    volume.resolution = ivec3(5, 3, 7), volume.cellSize = 0.25f, volume.origin = vec3(-0.5f, 0.0f, 1.0f);
    int cells = 0;
    for (ClvWalk walk = clvWalkBegin(volume, ray); walk.running == 1;) {
        require(clvCellInside(volume, clvWalkStep(walk, ray.direction).cell) == 1, "the walk stays in the grid");
        require(++cells <= 5 + 3 + 7, "the walk ends");
    }
    return 0;
}
