#include "bindings/vulkan/vulkan_level.h"

namespace clv {
namespace {

std::string nameOf(std::size_t index) { return std::string(" ").append(std::to_string(index)); }

}  // namespace

LightFrameLevel describeLevel(const Level& level, const BrickSlots& bricks) {
    LightFrameLevel description;
    description.volume = level.volume;
    description.cells = level.table.size();
    description.splits = level.splits.size();
    description.slots = level.slots.size();
    description.groupEnds = bricks.groupEnds;
    return description;
}

ClvLevelFrame levelConstants(const Level& level, const BrickSlots& bricks, const LightFrameSettings& settings, float weight, float largestFlux) {
    const auto raysOfHalf = uint(settings.rays / settings.halves);
    const ivec3 counts = clvBrickCounts(level.volume);
    ClvLevelFrame constants{};
    constants.volume = level.volume;
    constants.slotCount = uint(level.slots.size());
    constants.scale = 1.0f / float(raysOfHalf);
    constants.weight = weight;
    constants.fixedScale = clvFixedScale(largestFlux, raysOfHalf, clvLargestDeposit(settings.rule, settings.turned ? 1u : 0u, level.volume.cellSize));
    constants.groupEnds = uvec4(bricks.groupEnds[0], bricks.groupEnds[1], bricks.groupEnds[2], bricks.groupEnds[3]);
    constants.groupCount = bricks.groupCount();
    constants.brickCount = uint(counts.x) * uint(counts.y) * uint(counts.z);
    return constants;
}

void uploadLevel(VulkanFrame& frame, const LightFrameSettings& settings, std::size_t index, const Level& level, const BrickSlots& bricks) {
    const std::string name = nameOf(index);
    const bool slices = settings.inject == InjectWay::slices, pictured = index == 0 && settings.picture.x > 0;
    if (!slices || pictured) {
        frame.upload("table" + name, std::span(level.table));
        frame.upload("splits" + name, std::span(level.splits));
    }
    if (slices || pictured || gathers(settings.inject)) frame.upload("slots" + name, std::span(level.slots));
    if (!gathers(settings.inject)) return;
    frame.upload("brick slots" + name, std::span(bricks.slots));
    frame.upload("brick mask" + name, std::span(bricks.mask));
}

void uploadLookup(VulkanFrame& frame, std::size_t index, const LookupTable& table) {
    const std::string name = nameOf(index);
    const std::vector<uint> ends(table.ends().begin(), table.ends().end());
    frame.upload("lookup ends" + name, std::span(ends));
    frame.upload("lookup slots" + name, table.slots());
    frame.upload("lookup weights" + name, table.weights());
}

}  // namespace clv
