#include "viz/describe.h"

#include <cmath>

#include <fmt/format.h>

#include "clv/cpu/explain_reading.h"
#include "viz/cells.h"

namespace clv {
namespace {

std::string textOf(const glm::dvec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); }

std::string describeCell(const ShownCell& cell, const BakedVolume& volume) {
    std::string text = fmt::format("cell {} {} {} of cascade {}, edge {:.4g} m, middle {} m\n", cell.cell.x, cell.cell.y, cell.cell.z, cell.cascade, cell.edge,
                                   textOf(glm::dvec3(cell.center) + volume.anchor));
    text += fmt::format("open {:.4g} m^3, {:.0f} % of the cell, in {} region{}; the mean of {:.4g} rays\n", cell.light.openVolume,
                        100.0f * valueOf(cell, Quantity::open), cell.light.slots, cell.light.slots == 1 ? "" : "s", cell.light.samples);
    text += "side   irradiance, W/m^2 (r, g, b)     std. error   dynamicity\n";
    for (std::size_t side = 0; side < kSides; ++side) {
        const vec3& e = cell.light.irradiance[side];
        const std::string error = knowsVariance(volume) ? fmt::format("{:.3g}", std::sqrt(cell.light.variance[side])) : "unknown";
        text += fmt::format("{}     {:<10.4g} {:<10.4g} {:<10.4g} {:<12} {:.3g}\n", kSideNames[side], e.x, e.y, e.z, error, cell.light.dynamicity[side]);
    }
    return text;
}

std::string wordOf(TermUse use) {
    switch (use) {
        case TermUse::read: return "read";
        case TermUse::behind: return "behind the surface";
        case TermUse::hidden: return "not in sight";
        case TermUse::noSlot: return "solid, or not kept";
        case TermUse::outside: return "too far";
    }
    return {};
}

// What one cascade gives, cell by cell; cells that are too far to count are left out.
std::string describeReading(const BakedVolume& volume, uint cascade, ClvReceiver receiver, const LookupOptions& lookup) {
    const BakedCascade& baked = volume.cascades[cascade];
    receiver.position = clvClampToVolume(baked.level.volume, receiver.position);
    const std::vector<std::span<const float>> estimates(baked.estimates.begin(), baked.estimates.end());
    const Reading reading = explainReading(baked.level, volume.layout, estimates, receiver, lookup);
    std::string text = fmt::format("cascade {} gives {} W/m^2{}\n", cascade, textOf(reading.irradiance), reading.hubAlone ? ": from its own cell alone, all others are left out" : "");
    text += "cell         weight  height, m   adds, W/m^2 (r, g, b)\n";
    for (const ReadingTerm& term : reading.terms) {
        if (term.use == TermUse::outside) continue;
        const std::string cell = fmt::format("{} {} {}", term.cell.x, term.cell.y, term.cell.z);
        const std::string height = term.slot == kClvNoSlot ? "" : fmt::format("{:.3g}", term.height);
        text += fmt::format("{:<12} {:<7.3f} {:<11} {}\n", cell, term.weight, height, term.use == TermUse::read ? textOf(term.irradiance) : wordOf(term.use));
    }
    return text;
}

std::string describeSurface(const BakedVolume& volume, const ClvReceiver& receiver, const LookupOptions& lookup) {
    const ClvCascades cascades = cascadesOf(volume);
    const uint finest = clvCascadeFromPosition(cascades, receiver.position);
    const float weight = clvCascadeWeight(cascades, finest, receiver.position);
    std::string text = fmt::format("the surface receives {} W/m^2\n", textOf(irradianceAt(volume, receiver, lookup)));
    if (weight < 1.0f) text += fmt::format("{:.0f} % of it from cascade {}, the rest from cascade {}\n", 100.0f * weight, finest, finest + 1);
    text += describeReading(volume, finest, receiver, lookup);
    if (weight < 1.0f) text += describeReading(volume, finest + 1, receiver, lookup);
    return text;
}

}  // namespace

std::string describe(const BakedVolume& volume, const Pick& pick, const LookupOptions& lookup) {
    std::string text = fmt::format("at {} m", textOf(glm::dvec3(pick.position) + volume.anchor));
    if (pick.normal) text += fmt::format(", normal {}", textOf(*pick.normal));
    text += "\n";
    // The cell in front of a surface, not the one behind it.
    const float ahead = pick.normal ? kClvSideOffset * volume.cascades.front().level.volume.cellSize : 0.0f;
    const auto cell = cellAt(volume, pick.position + ahead * pick.normal.value_or(vec3(0.0f)), {});
    text += cell ? describeCell(*cell, volume) : "no cell: solid, or outside all cascades\n";
    if (pick.normal) text += describeSurface(volume, {pick.position, 0.0f, *pick.normal, 0.0f}, lookup);
    return text;
}

void printPick(const BakedVolume& volume, const Pick& pick, const LookupOptions& lookup) {
    fmt::print("{}\n", describe(volume, pick, lookup));
    std::fflush(stdout);
}

}  // namespace clv
