// All bounces after the first, in levels of their own.
#pragma once
#include <vector>

#include "bindings/cli/first_bounce.h"
#include "bindings/cli/light_walk.h"

namespace clv {

class FurtherBounces {
public:
    explicit FurtherBounces(LightJob& job);

    // Follows what the last round of the first bounce met, with as many rays; the pilots of the first bounce count too. Its halves stay apart.
    // target: rays of all rounds, as far as is known.
    void follow(FirstBounce& first, std::size_t rays, double target);
    // Its levels, mixed, give all bounces after the first; none where nothing was met. The job's report is told what it took.
    std::span<const LitLevel> finish(const FirstBounce& first);

private:
    struct Half {
        LightWalk walk;
        LitPlaces lit;  // to be followed; flux times the rays that met them
        std::vector<ClvRay> rays;
    };

    void followAll(std::span<const LitLevel> first);
    void walk(std::size_t raysOfHalf);

    LightJob& job_;
    std::unique_ptr<Lighting> lighting_;
    LevelSet levels_;
    std::vector<Half> halves_;
    std::vector<ClvRay> last_;  // of the last walk, of all halves
    std::uint32_t walks_ = 0;
    double done_ = 0.0, target_ = 0.0;  // rays that walks were to have, so far and in all
    std::size_t shot_ = 0;  // rays of each half that met what is to be followed
    double left_ = 0.0;     // rays that each half may take
};

}  // namespace clv
