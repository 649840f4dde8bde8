// All bounces after the first, in levels like those of the first.
#pragma once
#include <vector>

#include "bindings/cli/light_job.h"
#include "bindings/cli/light_walk.h"

namespace clv {

class FurtherBounces {
public:
    explicit FurtherBounces(LightJob& job);

    // lit: what surfaces send on that the last `rays` rays of the first bounce met, whose levels are in play. As many rays follow it.
    void follow(std::span<const ClvRsmTexel> lit, std::size_t rays, std::span<const LitLevel> first);
    // Levels of the same weights as those of the first bounce; without light where nothing was sent on. The job's report is told what it took.
    std::span<const LitLevel> finish(std::span<const LitLevel> first);

private:
    void walk(std::span<const LitLevel> first);
    void walk(std::size_t rays);
    void takeLevels(std::span<const LitLevel> first);

    LightJob& job_;
    std::unique_ptr<Lighting> lighting_;
    std::vector<LitLevel> levels_;
    LightWalk walk_;
    std::uint32_t walks_ = 0;
    std::vector<ClvRsmTexel> lit_;  // to be followed; flux times the rays of its shot
    std::size_t shot_ = 0;          // rays that met them
    double left_ = 0.0;             // rays that may be taken
};

}  // namespace clv
