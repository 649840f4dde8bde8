#include "viz/describe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <ranges>

#include <fmt/format.h>

#include "clv/cpu/explain_reading.h"
#include "viz/cells.h"

namespace clv {
namespace {

std::string textOf(const glm::dvec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); }

std::string describeSides(const CellLight& light, bool errorsKnown) {
    std::string text = "side   irradiance, W/m^2 (r, g, b)     std. error, W/m^2   dynamicity\n";
    for (std::size_t side = 0; side < kSides; ++side) {
        const vec3& e = light.irradiance[side];
        const std::string error = errorsKnown ? fmt::format("{:.3g}", std::sqrt(light.variance[side])) : "unknown";
        text += fmt::format("{}     {:<10.4g} {:<10.4g} {:<10.4g} {:<19} {:.3g}\n", kSideNames[side], e.x, e.y, e.z, error, light.dynamicity[side]);
    }
    return text;
}

// Each open region of a cell, which walls part from the others.
std::string describeRegions(const ShownCell& cell, const vec3& place, const BakedVolume& volume) {
    const BakedCascade& cascade = volume.cascades[cell.cascade];
    const uint entry = cascade.level.table[clvCellIndex(cascade.level.volume, cell.cell)];
    const CellSlots slots = slotsOfCell(cascade.level, entry);
    if (slots.count == 1) return describeSides(cell.light, knowsVariance(volume));
    std::string text;
    for (uint i = 0; i < slots.count; ++i) {
        const uint slot = slots.first + i;
        const CellLight light = regionLight(volume, cascade, slot);
        text += fmt::format("region {} of {}, open {:.4g} m^3 around {} m{}\n", i + 1, slots.count, light.openVolume, textOf(glm::dvec3(cascade.level.slots[slot].openCentroid) + volume.anchor),
                            slotAtPosition(cascade.level, entry, place) == slot ? ": here" : "");
        text += describeSides(light, knowsVariance(volume));
    }
    return text;
}

std::string describeCell(const ShownCell& cell, const vec3& place, const BakedVolume& volume) {
    std::string text = fmt::format("cell {} {} {} of cascade {}, edge {:.4g} m, middle {} m\n", cell.cell.x, cell.cell.y, cell.cell.z, cell.cascade, cell.edge,
                                   textOf(glm::dvec3(cell.center) + volume.anchor));
    text += fmt::format("open {:.4g} m^3, {:.0f} % of the cell, in {} region{}; the mean of {:.4g} rays\n", cell.light.openVolume,
                        100.0f * valueOf(cell, Quantity::open), cell.light.slots, cell.light.slots == 1 ? "" : "s", cell.light.samples);
    return text + describeRegions(cell, place, volume);
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

constexpr float kLeastWeight = 0.0005f;  // of a term that has a line of its own

// What one cascade gives, cell by cell, those that weigh most first; cells that are too far to count are left out.
std::string describeReading(const BakedVolume& volume, uint cascade, ClvReceiver receiver, const LookupOptions& lookup) {
    const BakedCascade& baked = volume.cascades[cascade];
    receiver.position = clvClampToVolume(baked.level.volume, receiver.position);
    const std::vector<std::span<const float>> estimates(baked.estimates.begin(), baked.estimates.end());
    Reading reading = explainReading(baked.level, volume.layout, estimates, receiver, lookup);
    std::string text = fmt::format("cascade {} gives {} W/m^2{}\n", cascade, textOf(reading.irradiance), reading.hubAlone ? ": from its own cell alone, all others are left out" : "");
    text += "cell         weight  height, m   adds, W/m^2 (r, g, b)\n";
    std::erase_if(reading.terms, [](const ReadingTerm& term) { return term.use == TermUse::outside; });
    const auto weightOf = [&](const ReadingTerm& term) { return reading.hubAlone && term.use == TermUse::read ? 1.0f : term.weight; };
    std::ranges::stable_sort(reading.terms, std::greater(), weightOf);
    const auto light = std::ranges::find_if(reading.terms, [&](const ReadingTerm& term) { return weightOf(term) < kLeastWeight; });
    for (const ReadingTerm& term : std::ranges::subrange(reading.terms.begin(), light)) {
        const std::string cell = fmt::format("{} {} {}", term.cell.x, term.cell.y, term.cell.z);
        const std::string height = term.slot == kClvNoSlot ? "" : fmt::format("{:.3g}", term.height);
        text += fmt::format("{:<12} {:<7.3f} {:<11} {}\n", cell, weightOf(term), height, term.use == TermUse::read ? textOf(term.irradiance) : wordOf(term.use));
    }
    if (light == reading.terms.end()) return text;
    vec3 sum(0.0f);
    for (const ReadingTerm& term : std::ranges::subrange(light, reading.terms.end())) sum += term.irradiance;
    text += fmt::format("{:<12} < {:<17} {}\n", fmt::format("{} others", reading.terms.end() - light), kLeastWeight, textOf(sum));
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
    const auto cell = pickedCell(volume, pick);
    text += cell ? describeCell(*cell, placeInCell(volume, pick), volume) : "no cell: solid, or outside all cascades\n";
    if (pick.normal) text += describeSurface(volume, {pick.position, 0.0f, *pick.normal, 0.0f}, lookup);
    return text;
}

void printPick(const BakedVolume& volume, const Pick& pick, const LookupOptions& lookup) {
    fmt::print("{}\n", describe(volume, pick, lookup));
    std::fflush(stdout);
}

}  // namespace clv
