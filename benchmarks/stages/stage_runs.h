// The stages at one setting each, ready to run, and beside each of them the machine's own limit for the same work.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "benchmarks/stages/stage_scene.h"
#include "clv/cpu/aligned.h"
#include "clv/cpu/inject.h"

namespace clv {

struct StageRun {
    std::string item;                 // that time and bytes are counted by
    double items = 0.0, bytes = 0.0;  // of one run; bytes are read and written
    std::string limitName;
    std::function<void()> before;     // not measured
    std::function<void()> stage, limit;
    std::vector<std::pair<std::string, double>> figures{};  // what else is worth a number
};

// Times of the stage and of its limit, one after the other, s, while this thread had the processor: other programs do not count.
struct StageTurn {
    double stage = 0.0, limit = 0.0;
};
StageTurn takeTurn(const StageRun& run);

// The open regions of about n^3 cells with the light of the scene's rays: what receivers read.
struct LitLevel {
    LitLevel(const StageScene& s, int n) : level(s.openLevel(n, layout.storage)), deposits(level.slots.size() * layout.stride(), 0.0f) {
        inject(level, layout, kClvInjectTrackLength, s.cut, {deposits, {}});
    }
    double bytes(std::size_t records) const { return double(records * layout.stride() * sizeof(float)); }

    const DepositLayout layout;
    Level level;
    AlignedFloats deposits;
};

// Of a scene that outlives the run. `n`: about n^3 cells, all of which have a slot.
StageRun rsmRun(const StageScene& s);
StageRun raysRun(const StageScene& s);
StageRun traceRun(const StageScene& s);
StageRun injectRun(const StageScene& s, int n, std::uint32_t storage);
StageRun mergeRun(const StageScene& s, int n);
// Weights are found anew, as for a camera that moves; kept, as for what stands still.
StageRun evaluateRun(const StageScene& s, const std::shared_ptr<const LitLevel>& lit, std::uint32_t lookup);
StageRun evaluateKeptRun(const StageScene& s, const std::shared_ptr<const LitLevel>& lit);
StageRun buildLevelRun(const StageScene& s, int n);  // of cells that receivers read

}  // namespace clv
