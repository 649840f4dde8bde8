// What the sides of a cell should read: path tracing from the places in it that are open.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "clv/cpu/parallel.h"
#include "viz/cells.h"

namespace clv {

struct SideTruth {
    std::array<vec3, kSides> irradiance{};      // W/m^2: mean over the open part of the cell
    std::array<float, kSides> standardError{};  // W/m^2, length over the channels
};

struct TruthOptions {
    bool allBounces = false;
    std::uint64_t samples = 256;  // paths a side

    bool operator==(const TruthOptions&) const = default;
};

// Whether a level counts a position as open: unless what is met first shows its back both ways, on all of the three axes that meet something.
bool isOpen(const EmbreeScene& scene, const vec3& position);

// Keeps what it has computed until the options change or clear() is called.
class CellTruth {
public:
    // One for each cell; none where no open place is found.
    std::vector<std::optional<SideTruth>> of(std::span<const ShownCell> cells, const EmbreeScene& scene, const TruthOptions& options, const ParallelFor& parallelFor);
    void clear() { known_.clear(); }

private:
    using Key = std::array<float, 4>;  // centre and edge
    std::map<Key, std::optional<SideTruth>> known_;
    TruthOptions options_;
};

}  // namespace clv
