#include "benchmarks/baselines/readers.h"

#include "bindings/embree/surface_samples.h"

namespace clv {
namespace {

// Dense enough that few cells of 64^3 which a surface crosses hold none.
constexpr std::size_t kSurfacePoints = 128 << 10;

}  // namespace

std::string readersName(Readers readers) {
    switch (readers) {
        case Readers::receivers: return "receivers";
        case Readers::surfaces: return "surfaces";
        default: return "anywhere";
    }
}

std::vector<ClvReceiver> readingPoints(Readers readers, const MethodWorld& world, std::span<const ReferencePoint> receivers) {
    std::vector<ClvReceiver> points;
    if (readers == Readers::anywhere) return points;
    if (readers == Readers::surfaces) points = sampleSurfaces(world.scene, kSurfacePoints, 1, world.parallelFor).receivers;
    for (const ReferencePoint& p : receivers) points.push_back({p.position, 0.0f, p.normal, 0.0f});
    return points;
}

}  // namespace clv
