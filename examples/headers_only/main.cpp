// The headers alone, with a tracer of the engine's own: a lamp in a round white room.
//
// In a sphere every point sees every other one under the same form factor, so that one bounce lights the whole wall alike:
// E = albedo * intensity / radius^2. The program reads the light volume all over the wall and compares.
#include <clv/clv.h>

#include <cstdio>

using namespace clv;

namespace {

constexpr float kRadius = 2.0f;      // m
constexpr float kAlbedo = 0.7f;
constexpr float kIntensity = 10.0f;  // W/sr
constexpr int kMapSide = 128;        // texels
constexpr int kFrames = 16;
constexpr std::size_t kRays = 65536;  // a frame
constexpr uint kSeed = 1;

// The tracer. Roots t of |origin + t * direction| = kRadius.
struct Roots {
    bool real;
    float near, far;  // m
};
Roots sphereRoots(vec3 origin, vec3 direction) {
    const float b = dot(origin, direction), discriminant = b * b - dot(origin, origin) + kRadius * kRadius;
    const float root = std::sqrt(std::max(0.0f, discriminant));
    return {discriminant > 0.0f, -b - root, -b + root};
}

// From inside, the first hit is the far root. Normals point into the room.
ClvHit hitFromInside(const ClvRay& ray) {
    ClvHit hit = clvNoHit();
    hit.distance = sphereRoots(ray.origin, ray.direction).far;
    hit.normal = -normalize(ray.origin + ray.direction * hit.distance);
    hit.albedo = vec3(kAlbedo);
    return hit;
}

void trace(std::span<ClvRay> rays) {
    for (ClvRay& ray : rays) {
        if (ray.maxDistance > 0.0f) ray = clvCutRay(ray, hitFromInside(ray));
    }
}

// What the library asks about the geometry once, to find how much of each cell is open.
SceneProbe probe() {
    SceneProbe probe;
    probe.lineHits = [](const vec3& origin, const vec3& direction, float maxDistance, std::vector<LineHit>& hits) {
        hits.clear();
        const Roots roots = sphereRoots(origin, direction);
        for (float t : {roots.near, roots.far}) {
            // A line comes in through the wall's back, and meets its front on the way out.
            if (roots.real && t > 0.0f && t < maxDistance) hits.push_back({t, t == roots.far, -normalize(origin + direction * t)});
        }
    };
    probe.occluded = [](const vec3& from, const vec3& to) {
        return (dot(from, from) < kRadius * kRadius) != (dot(to, to) < kRadius * kRadius);
    };
    return probe;
}

// The reflective shadow map: what the lamp lights. An engine rasters its own.
std::vector<ClvRsmTexel> renderMap() {
    ClvLight lamp{};
    lamp.type = kClvLightPoint;
    lamp.intensity = vec3(kIntensity);
    std::vector<ClvRsmTexel> texels;
    for (uint i = 0; i < kMapSide * kMapSide; ++i) {
        const vec2 u = clvRsmSamplePoint(uvec2(i % kMapSide, i / kMapSide), kMapSide, 0, kSeed);
        const ClvRay ray = clvLightRay(lamp, u, vec3(-kRadius), vec3(kRadius));
        texels.push_back(clvRsmTexelFromHit(ray, hitFromInside(ray), 1.0f / (kMapSide * kMapSide)));
    }
    return texels;
}

}  // namespace

int main() {
    StillLightingSettings settings;
    settings.layout = {kClvStorageCube9, 1};  // no colour in this room
    settings.seed = kSeed;
    const ClvVolume grid = volumeOverBounds(vec3(-kRadius), vec3(kRadius), 16, settings.layout.storage);
    StillLighting lighting(settings, trace, serialFor());
    const Volume& volume = lighting.addLevel(buildLevel(grid, probe(), {}, serialFor()));
    std::printf("%d x %d x %d cells, %.1f MB\n", grid.resolution.x, grid.resolution.y, grid.resolution.z, double(volume.bytes()) / 1e6);

    const std::vector<ClvRsmTexel> map = renderMap();
    TexelSampler sampler;
    sampler.build(map, kMapSide, serialFor());
    for (int frame = 0; frame < kFrames; ++frame) {
        lighting.rays(sampler, kRays);
        lighting.trace();
        lighting.inject();
        lighting.merge();
    }

    // Points all over the wall.
    const float analytic = kAlbedo * kIntensity / (kRadius * kRadius);
    constexpr int kPoints = 1000;
    double sum = 0.0, squares = 0.0;
    for (uint i = 0; i < kPoints; ++i) {
        const vec3 inwards = clvSphereFromSquare(vec2(clvSobolUnit(i, 0, kSeed), clvSobolUnit(i, 1, kSeed)));
        const ClvReceiver receiver{inwards * -kRadius, 0.0f, inwards, 0.0f};
        SlotWeights weights;
        lookupWeights(volume.level(), receiver, {}, weights);
        const ClvCoefficients read = settings.layout.read(receiver.normal);
        float irradiance = 0.0f;
        for (int half = 0; half < settings.parts.halves; ++half) {
            irradiance += readIrradiance(settings.layout, volume.history(half), weights, read).x / float(settings.parts.halves);
        }
        sum += irradiance;
        squares += double(irradiance - analytic) * (irradiance - analytic);
    }
    const double bias = sum / kPoints / analytic - 1.0, error = std::sqrt(squares / kPoints) / analytic;
    std::printf("irradiance on the wall, W/m^2: %.4f from the light volume, %.4f analytic\n", sum / kPoints, double(analytic));
    std::printf("bias %+.2f %%, relative RMSE %.2f %%\n", 100.0 * bias, 100.0 * error);
    return std::abs(bias) < 0.01 && error < 0.05 ? 0 : 1;
}
