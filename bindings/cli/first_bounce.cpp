#include "bindings/cli/first_bounce.h"

#include <algorithm>
#include <bit>

#include "bindings/cli/progress.h"
#include "bindings/cli/scene_facts.h"

namespace clv {
namespace {

constexpr std::size_t kFirstRound = 64 << 10;      // rays
constexpr std::size_t kMostOfAMap = 128 << 10;    // rays: more would leave from the same texels, which in wide scenes are as wide as rooms
constexpr std::size_t kMostPilots = 64 << 10;      // rays that show where light goes
constexpr std::uint64_t kPilotShare = 8;           // one ray in so many

}  // namespace

std::size_t FirstBounce::shoot(std::size_t count) {
    std::vector<LightLevel*> levels;
    for (const LitLevel& level : levels_.levels()) levels.push_back(level.light.get());
    const std::size_t rays = lighting_->shoot(count, levels);
    job_.report.rays += rays, shot_ += rays;
    return rays;
}

// A few rays show where the light goes; where much of it leaves the scene, the others are guided. False where the lights reach nothing.
bool FirstBounce::pilot(std::uint64_t budget) {
    lighting_->renderMaps(0);
    std::vector<ClvRay> rays(std::size_t(std::min<std::uint64_t>(kMostPilots, budget / kPilotShare)));
    guide_.emplace(job_.scene.bounds.lo, job_.scene.bounds.hi);
    job_.clock.time("guide", [&] {
        lighting_->draw(clvHashCombine(job_.seed, 0x7u), rays);
        guide_->learn(rays);
        guide_->finish();
    });
    job_.report.rays += pilots_ = rays.size();
    job_.report.shareThatMeets = guide_->share();
    job_.report.guided = guide_->worthwhile();
    if (job_.report.guided) job_.clock.time("setup", [&] { lighting_->guideBy(*guide_); });
    return rays.empty() || std::ranges::any_of(rays, [](const ClvRay& ray) { return ray.maxDistance > 0.0f; });
}

void FirstBounce::run(const AfterRound& afterRound) {
    const LightOptions& options = job_.options;
    std::uint64_t budget = options.seconds > 0.0 ? ~std::uint64_t(0) : options.allBounces ? std::max<std::uint64_t>(options.rays / 2, 1) : options.rays;
    LightingSettings settings = job_.lightingSettings(job_.halves, budget, 1);
    settings.firstShot = std::size_t(std::min<std::uint64_t>(budget, options.frames > 1 ? budget / options.frames : kFirstRound));
    lighting_ = job_.makeLighting(settings);
    Progress progress("light");
    if (!pilot(options.seconds > 0.0 ? kFirstRound : budget)) return;
    if (options.seconds <= 0.0) budget -= pilots_;
    levels_.begin(*lighting_, double(budget) + double(pilots_));

    // While levels are judged all of them are filled, so this ends with about the first quarter of the rays. A power of two: the
    // halves of other stretches of the sequence fill each other's gaps, and what is meant to judge the bias shows less of it.
    const std::uint64_t judged = job_.automatic ? std::bit_floor(std::max<std::uint64_t>(budget / 3, 1)) : 0;
    std::size_t round = options.frames > 1 ? std::size_t((budget + options.frames - 1) / options.frames) : kFirstRound;
    if (job_.automatic) round = std::size_t(std::min<std::uint64_t>(round, judged));
    std::uint64_t done = 0, sinceMaps = 0;
    for (std::uint32_t pass = 0; done < budget; ++pass) {
        const double before = progress.seconds();
        if (pass == 0 || sinceMaps >= kFirstRound) {
            lighting_->renderMaps(pass);
            sinceMaps = 0;
        }
        const std::size_t count = shoot(std::size_t(std::min<std::uint64_t>(round, budget - done)));
        done += count;
        sinceMaps += count;
        double now = progress.seconds();
        // With a budget of time, as many rays are still to come as the pace so far promises.
        const double target = options.seconds > 0.0 ? std::max(double(done), double(done) * options.seconds / std::max(now, 1e-6)) : double(budget);
        levels_.judge(double(shot_), target, options.seconds > 0.0 ? double(done) >= 0.25 * target : done >= judged);
        if (afterRound) afterRound(pass, count, target);
        now = progress.seconds();
        if (options.seconds > 0.0 && now + (now - before) > options.seconds) break;
        progress.update(options.seconds > 0.0 ? now / options.seconds : double(done) / double(budget));
        if (options.frames <= 1) round = std::min(2 * round, kMostOfAMap);
    }
    job_.report.bytes += levels_.bytes();
    for (const LitLevel& level : levels_.levels()) {
        job_.report.slots += level.light->level().slots.size();
        if (level.weight > 0.0) job_.report.levels.emplace_back(level.resolution, level.weight);
    }
}

}  // namespace clv
