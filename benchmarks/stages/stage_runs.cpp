#include "benchmarks/stages/stage_runs.h"

#include <algorithm>
#include <ctime>

#include "benchmarks/stages/limits.h"
#include "clv/cpu/evaluate.h"
#include "clv/cpu/lookup_table.h"
#include "clv/cpu/volume.h"
#include "clv/stages/rsm.h"

namespace clv {
namespace {

double threadSeconds() {
    std::timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

void nothing() {}

// Sums go where the compiler cannot tell that nobody reads them.
std::function<void()> bareRays(const StageScene& s, std::vector<ClvRay> rays) {
    return [&s, rays = std::move(rays), sum = 0.0f]() mutable { sum += traceBare(s.bare, rays); };
}

}  // namespace

StageTurn takeTurn(const StageRun& run) {
    run.before();
    const double begin = threadSeconds();
    run.stage();
    const double middle = threadSeconds();
    run.limit();
    return {middle - begin, threadSeconds() - middle};
}

StageRun rsmRun(const StageScene& s) {
    constexpr int kSide = StageScene::kRsmSide;
    const std::size_t each = std::size_t(kSide) * kSide;
    const ClvLight& light = s.scene.lights.front().light;
    std::vector<ClvRay> rays(each);
    for (std::size_t i = 0; i < each; ++i) {
        rays[i] = clvLightRay(light, clvRsmSamplePoint(uvec2(i % kSide, i / kSide), uint(kSide), 0, StageScene::kSeed), s.scene.bounds.lo, s.scene.bounds.hi);
    }
    return {"texel", double(each), double(each * sizeof(ClvRsmTexel)), "bare Embree", nothing,
            [&s, &light, texels = std::vector<ClvRsmTexel>(each)]() mutable { renderRsm(s.embree, light, kSide, 0, StageScene::kSeed, serialFor(), texels); },
            bareRays(s, std::move(rays))};
}

StageRun raysRun(const StageScene& s) {
    const std::size_t count = s.rays.size();
    const double bytes = double(count * (sizeof(ClvRsmTexel) + sizeof(ClvRay)));
    return {"ray", double(count), bytes, "copy", nothing,
            [&s, out = std::vector<ClvRay>(count), index = 0u]() mutable {
                makeRays(s.sampler, index += std::uint32_t(out.size()), StageScene::kSeed, s.embree.surfaceOffset(), out);
            },
            Copy(bytes)};
}

StageRun traceRun(const StageScene& s) {
    const auto traced = std::make_shared<std::vector<ClvRay>>();
    return {"ray", double(s.rays.size()), double(2 * s.rays.size() * sizeof(ClvRay)), "bare Embree", [&s, traced] { *traced = s.rays; },
            [&s, traced] { s.embree.trace(*traced); }, bareRays(s, s.rays)};
}

StageRun injectRun(const StageScene& s, int n, std::uint32_t storage) {
    struct State {
        State(const StageScene& s, int n, const DepositLayout& layout)
            : level(s.denseLevel(n, layout.storage)), scatter(level, layout, s.cut), deposits(level.slots.size() * layout.stride(), 0.0f) {}
        Level level;
        ScatterAdd scatter;
        AlignedFloats deposits;
    };
    const DepositLayout layout{storage, 3};
    const auto state = std::make_shared<State>(s, n, layout);
    const double crossings = double(state->scatter.crossings());
    return {"crossing", crossings, 2.0 * crossings * layout.stride() * sizeof(float), "scatter-add", nothing,
            [&s, state, layout] { inject(state->level, layout, kClvInjectTrackLength, s.cut, {state->deposits, {}}); },
            [state] { state->scatter(state->deposits); },
            {{"crossings/ray", crossings / double(s.rays.size())}}};
}

StageRun mergeRun(const StageScene& s, int n) {
    const DepositLayout layout;
    const auto volume = std::make_shared<Volume>(s.denseLevel(n, layout.storage), layout, VolumeParts{2, 1});
    const double slots = double(volume->level().slots.size()) * volume->parts().halves, rays = double(s.rays.size());
    // Sums are read and cleared, the history is read and written.
    const double bytes = 4.0 * slots * layout.stride() * sizeof(float);
    return {"slot", slots, bytes, "copy", nothing, [volume, rays] { volume->merge(rays, 2.0f / float(rays), serialFor()); }, Copy(bytes)};
}

StageRun evaluateRun(const StageScene& s, const std::shared_ptr<const LitLevel>& lit, std::uint32_t lookup) {
    LookupOptions options;
    options.lookup = lookup;
    const double bytes = lit->bytes(LookupTable(lit->level, s.receivers, options, serialFor()).slots().size());
    return {"receiver", double(s.receivers.size()), bytes, "copy", nothing,
            [&s, lit, options, weights = SlotWeights(), sum = vec3(0.0f)]() mutable {
                for (const ClvReceiver& receiver : s.receivers) {
                    lookupWeights(lit->level, receiver, options, weights);
                    sum += readIrradiance(lit->layout, lit->deposits, weights, lit->layout.read(receiver.normal));
                }
            },
            Copy(bytes)};
}

StageRun evaluateKeptRun(const StageScene& s, const std::shared_ptr<const LitLevel>& lit) {
    const auto table = std::make_shared<LookupTable>(lit->level, s.receivers, LookupOptions(), serialFor());
    const double bytes = lit->bytes(table->slots().size()) + double(table->bytes());
    return {"receiver", double(s.receivers.size()), bytes, "copy", nothing,
            [&s, lit, table, sum = vec3(0.0f)]() mutable {
                for (std::size_t i = 0; i < s.receivers.size(); ++i) sum += table->irradiance(i, lit->layout, lit->deposits, lit->layout.read(s.receivers[i].normal));
            },
            Copy(bytes)};
}

// The lines and rays that it asks for are held against bare Embree, which finds the first surface on each.
StageRun buildLevelRun(const StageScene& s, int n) {
    const ClvVolume volume = s.grid(n, kClvStorageCube9);
    const auto needed = neededCells(volume, s.receivers);
    std::vector<ClvRay> asked;
    const auto ask = [&](const vec3& origin, const vec3& direction, float length) {
        ClvRay& ray = asked.emplace_back();
        ray.origin = origin, ray.direction = direction, ray.maxDistance = length;
    };
    const SceneProbe probe = s.embree.probe();
    const SceneProbe noting{.lineHits = [&](const vec3& origin, const vec3& direction, float length, std::vector<LineHit>& hits) {
                                ask(origin, direction, length);
                                probe.lineHits(origin, direction, length, hits);
                            },
                            .occluded = [&](const vec3& from, const vec3& to) {
                                ask(from, normalize(to - from), distance(from, to));
                                return probe.occluded(from, to);
                            }};
    const Level level = buildLevel(volume, noting, needed, serialFor());
    const double cells = double(std::ranges::count(needed, 1)), queries = double(asked.size());
    return {"cell", cells, double(level.bytes()), "bare Embree", nothing,
            [volume, probe, needed, slots = std::size_t(0)]() mutable { slots += buildLevel(volume, probe, needed, serialFor()).slots.size(); },
            bareRays(s, std::move(asked)), {{"queries/cell", queries / cells}}};
}

}  // namespace clv
