// This library on the CPU, behind the interface of the methods that it is compared with.
#pragma once
#include <memory>

#include "benchmarks/baselines/readers.h"
#include "clv/data/cell.h"
#include "clv/stages/evaluate.h"

namespace clv {

struct LightVolumeSettings {
    int resolution = 0;                   // about resolution^3 cells; 0: chosen by the library from the first frame on
    unsigned storage = kClvStorageCube9;  // kClvStorage...
    glm::vec3 gridShift{0.0f};            // of a cell, [0, 1)
    Readers readers = Readers::surfaces;  // cells that nobody reads have no slot
    unsigned lookup = kClvLookupLinearFit;  // kClvLookup...: how receivers read it
    bool keptWeights = true;              // receivers stand still: their weights are found at set-up, not at each reading
    bool guided = true;                     // where much light leaves the scene, an eighth of the first frame, of 16k rays or more, shows
                                            // where it goes, and the other rays are guided
    // That the choice of a resolution looks ahead to: what the frames to come add up to; 0: the first frame alone.
    std::size_t plannedRays = 0;
};

std::unique_ptr<Method> makeLightVolume(const LightVolumeSettings& settings);

}  // namespace clv
