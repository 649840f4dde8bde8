#include "bindings/volume_file/baked_volume.h"

#include <algorithm>
#include <limits>

namespace clv {
namespace {

vec3 irradianceOf(const BakedVolume& volume, const BakedCascade& cascade, ClvReceiver receiver, const LookupOptions& lookup) {
    receiver.position = clvClampToVolume(cascade.level.volume, receiver.position);
    SlotWeights weights;
    lookupWeights(cascade.level, receiver, lookup, weights);
    const ClvCoefficients read = volume.layout.read(receiver.normal);
    vec3 sum(0.0f);
    for (const auto& deposits : cascade.estimates) sum += readIrradiance(volume.layout, deposits, weights, read);
    return sum / float(cascade.estimates.size());
}

CellLight lightOf(const BakedVolume& volume, const BakedCascade& cascade, const CellSlots& slots) {
    CellLight light;
    light.slots = slots.count;
    light.samples = cascade.samples[slots.first];
    SlotWeights weights;
    for (uint slot = slots.first; slot < slots.first + slots.count; ++slot) {
        weights.slot[weights.count++] = slot;
        light.openVolume += cascade.level.slots[slot].openVolume;
        light.samples = std::min(light.samples, cascade.samples[slot]);
        for (std::size_t side = 0; side < kSides && !cascade.dynamicity.empty(); ++side) {
            light.dynamicity[side] = std::max(light.dynamicity[side], cascade.dynamicity[slot * kSides + side]);
        }
    }
    std::fill_n(weights.weight.begin(), weights.count, 1.0f / light.openVolume);
    for (std::size_t side = 0; side < kSides; ++side) {
        const ClvCoefficients read = volume.layout.read(sideNormal(side));
        std::array<vec3, 2> estimate{};
        for (std::size_t i = 0; i < cascade.estimates.size(); ++i) estimate[i] = readIrradiance(volume.layout, cascade.estimates[i], weights, read);
        light.irradiance[side] = estimate[0];
        if (cascade.estimates.size() < 2) continue;
        const vec3 half = 0.5f * (estimate[0] - estimate[1]);
        light.irradiance[side] = 0.5f * (estimate[0] + estimate[1]);
        light.variance[side] = std::min(dot(half, half) / 3.0f, std::numeric_limits<float>::max());
    }
    return light;
}

}  // namespace

SceneMark markOf(const Scene& scene) {
    return {scene.triangles.size(), scene.bounds};
}

ClvCascades cascadesOf(const BakedVolume& volume) {
    ClvCascades cascades{};
    cascades.count = uint(volume.cascades.size());
    cascades.marginCells = volume.marginCells;
    cascades.blendCells = volume.blendCells;
    for (std::size_t i = 0; i < volume.cascades.size(); ++i) cascades.volumes[i] = volume.cascades[i].level.volume;
    return cascades;
}

std::size_t bytesOf(const BakedVolume& volume) {
    std::size_t sum = 0;
    for (const BakedCascade& cascade : volume.cascades) {
        sum += cascade.level.bytes() + (cascade.samples.size() + cascade.dynamicity.size()) * sizeof(float);
        for (const auto& deposits : cascade.estimates) sum += deposits.size() * sizeof(float);
    }
    return sum;
}

vec3 irradianceAt(const BakedVolume& volume, const ClvReceiver& receiver, const LookupOptions& lookup) {
    const ClvCascades cascades = cascadesOf(volume);
    const uint finest = clvCascadeFromPosition(cascades, receiver.position);
    const float weight = clvCascadeWeight(cascades, finest, receiver.position);
    const vec3 irradiance = irradianceOf(volume, volume.cascades[finest], receiver, lookup);
    if (weight == 1.0f) return irradiance;
    return mix(irradianceOf(volume, volume.cascades[finest + 1], receiver, lookup), irradiance, weight);
}

vec3 sideNormal(std::size_t side) {
    vec3 normal(0.0f);
    normal[int(side / 2)] = side % 2 == 0 ? 1.0f : -1.0f;
    return normal;
}

CellLight cellLight(const BakedVolume& volume, const BakedCascade& cascade, std::size_t cell) {
    const uint entry = cascade.level.table[cell];
    return entry == kClvNoSlot ? CellLight{} : lightOf(volume, cascade, slotsOfCell(cascade.level, entry));
}

CellLight regionLight(const BakedVolume& volume, const BakedCascade& cascade, uint slot) {
    return lightOf(volume, cascade, {slot, 1});
}

}  // namespace clv
