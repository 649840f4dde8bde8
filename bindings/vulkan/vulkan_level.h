// A level of the light volume, from the host into a frame's buffers.
#pragma once
#include "bindings/vulkan/vulkan_frame.h"
#include "clv/cpu/brick_slots.h"
#include "clv/cpu/lookup_table.h"
#include "clv/plan/light_frame.h"

namespace clv {

// How large the level is, for LightFrameSettings::levels.
LightFrameLevel describeLevel(const Level& level, const BrickSlots& bricks);

// The level's constants for a frame of `settings` that merges with `weight`. largestFlux: W, of any channel of any ray; matters to
// fixed point alone.
ClvLevelFrame levelConstants(const Level& level, const BrickSlots& bricks, const LightFrameSettings& settings, float weight, float largestFlux);

// Uploads the tables of level number `index` of a frame that lightFrame made with these settings.
void uploadLevel(VulkanFrame& frame, const LightFrameSettings& settings, std::size_t index, const Level& level, const BrickSlots& bricks);

// Uploads what still receivers read of level number `index`; settings.levels[index].lookupEntries is the number of its slots().
void uploadLookup(VulkanFrame& frame, std::size_t index, const LookupTable& table);

}  // namespace clv
