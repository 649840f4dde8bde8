// What an engine sees of an installed library: the umbrella header, its version, and arithmetic that is not fused.
#include <clv/clv.h>

#include <cstdio>
#include <string>

namespace {

int failures = 0;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::printf("%s\n", what);
    ++failures;
}

}  // namespace

int main() {
    const std::string header = std::to_string(CLV_VERSION_MAJOR) + "." + std::to_string(CLV_VERSION_MINOR) + "." + std::to_string(CLV_VERSION_PATCH);
    expect(header == FOUND_VERSION, "the package's version is not that of its headers");

    // (1 + e)^2 - (1 + 2e) is e^2 if fused, and 0 if the product is rounded first.
    volatile float factor = 1.0f + 0x1p-12f, rounded = 1.0f + 0x1p-11f;
    const float a = factor, c = rounded;
    expect(a * a - c == 0.0f, "the compiler fused a multiplication with a subtraction: -ffp-contract=off did not arrive");

    // A cell one metre wide, crossed from face to face against +x: the +x side receives the ray's flux over one square metre.
    const clv::ClvVolume volume{.origin = clv::vec3(0.0f), .cellSize = 1.0f, .resolution = clv::ivec3(1), .storage = clv::kClvStorageCube};
    clv::BuildOptions empty;
    empty.findRegions = false;
    clv::StillLightingSettings settings;
    settings.layout = {clv::kClvStorageCube, 1};
    clv::Volume light(clv::buildLevel(volume, {}, {}, clv::serialFor(), empty), settings.layout, settings.parts);
    clv::ClvRay ray = clv::clvDeadRay();
    ray.origin = clv::vec3(2.0f, 0.5f, 0.5f);
    ray.maxDistance = 2.0f;
    ray.direction = clv::vec3(-1.0f, 0.0f, 0.0f);
    ray.flux = clv::vec3(3.0f);
    clv::inject(light.level(), light.layout(), clv::kClvInjectTrackLength, {&ray, 1}, light.partial(0, 0));
    light.merge(1.0, 1.0f, clv::serialFor());
    expect(std::abs(light.history(0)[0] - 3.0f) < 1e-5f, "a ray of 3 W through one square metre is not 3 W/m^2");
    return failures == 0 ? 0 : 1;
}
