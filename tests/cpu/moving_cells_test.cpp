// What becomes of the light in cells when the camera moves: it stays with those that stay, and new ones start from a guess.
#include <gtest/gtest.h>

#include "cpu/moving_scene.h"

using namespace clv;
using namespace clv::test;

namespace {

TEST(MovingCells, cellsThatStayKeepTheirHistoryToTheLastBit) {
    const LitHall hall;
    MovingLighting lighting(twoCascades(), hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(viewFrom(-2.0, -1.0, 0.0));
    hall.frame(lighting, 20000);
    for (std::size_t c = 0; c < 2; ++c) {
        const MovingVolume& volume = lighting.volumes()[c];
        const Level before = volume.level();
        const std::vector<float> history(volume.history().begin(), volume.history().end());
        lighting.moveTo(viewFrom(c == 0 ? -0.5 : 2.5, -1.0, 1.0));
        const Level& after = volume.level();
        const vec3 moved = (after.volume.origin - before.volume.origin) / before.volume.cellSize;
        std::size_t kept = 0, lit = 0;
        for (uint cell = 0; cell < before.cellCount(); ++cell) {
            const ivec3 now = clvCellFromIndex(before.volume, cell) - ivec3(glm::round(moved));
            if (!clvCellInside(after.volume, now) || before.table[cell] == kClvNoSlot) continue;
            ASSERT_EQ(before.table[cell], after.table[cell]);
            const CellSlots slots = slotsOfCell(before, before.table[cell]);
            const std::size_t stride = DepositLayout{}.stride();
            for (std::size_t i = slots.first * stride; i < (slots.first + slots.count) * stride; ++i) {
                ASSERT_EQ(history[i], volume.history()[i]);
                lit += history[i] != 0.0f;
            }
            ++kept;
        }
        EXPECT_GT(kept, before.cellCount() / 4);
        EXPECT_LT(kept, before.cellCount());
        EXPECT_GT(lit, kept);
    }
}

// Error at receivers that only new cells light, one frame after a move from one view to another.
double errorAfterMove(const LitHall& hall, const MovingLightingSettings& settings, const CameraView& from, const CameraView& to,
                      std::span<const ClvReceiver> receivers) {
    const std::size_t rays = 1000;
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(from);
    for (int frame = 0; frame < 100; ++frame) hall.frame(lighting, rays);
    lighting.moveTo(to);
    hall.frame(lighting, rays);
    return relativeError(irradianceAt(lighting, receivers), stillIrradiance(hall, lighting, 0, receivers, 1000000, 17));
}

TEST(MovingCells, newCellsStartFromTheNextCoarserCascade) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.slidOutFrames = 0.0f;
    // The finest cascade reaches to x = -1 before, and to x = 2 after the move.
    const CameraView from = viewFrom(-6.0, -1.5, 1.0), to = viewFrom(-3.0, -1.5, 1.0);
    const auto receivers = floorAround(vec3(-0.1f, 0.0f, 1.0f), 0.7f);
    const double guessed = errorAfterMove(hall, settings, from, to, receivers);
    settings.guessFrames = 0.0f;
    const double blank = errorAfterMove(hall, settings, from, to, receivers);
    EXPECT_LT(guessed, blank / 3.0);
}

TEST(MovingCells, newCellsOfTheLastCascadeStartFromWhatSlidOut) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.cascades.count = 1;
    // Across the hall, where the light on both sides of the volume is much the same.
    const CameraView from = viewFrom(-6.0, -1.5, -1.5), to = viewFrom(-6.0, -1.5, 1.5);
    const auto receivers = floorAround(vec3(-6.0f, 0.0f, 5.0f), 1.0f);
    const double guessed = errorAfterMove(hall, settings, from, to, receivers);
    settings.slidOutFrames = 0.0f;
    const double blank = errorAfterMove(hall, settings, from, to, receivers);
    EXPECT_LT(guessed, blank / 1.3);
}

TEST(MovingCells, newCellsHaveNoHistoryWhereThereIsNothingToGuessFrom) {
    const LitHall hall;
    MovingLighting lighting(twoCascades(), hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(viewFrom(-6.0, -1.5, 1.0));
    lighting.moveTo(viewFrom(-3.0, -1.5, 1.0));
    for (const MovingVolume& volume : lighting.volumes()) {
        EXPECT_EQ(*std::max_element(volume.frames().begin(), volume.frames().end()), 0.0f);
        EXPECT_EQ(*std::max_element(volume.history().begin(), volume.history().end()), 0.0f);
    }
}

TEST(MovingCells, newCellsForgetTheirGuessFasterWhereDynamicityIsKept) {
    const LitHall hall;
    MovingLightingSettings settings = twoCascades();
    settings.movingLights = true;
    MovingLighting lighting(settings, hall.scene.probe(), hall.tracer(), serialFor());
    lighting.moveTo(viewFrom(-6.0, -1.5, 1.0));
    const int before = 40, after = 10;
    for (int frame = 0; frame < before; ++frame) hall.frame(lighting, 100);
    lighting.moveTo(viewFrom(-3.0, -1.5, 1.0));
    for (int frame = 0; frame < after; ++frame) hall.frame(lighting, 100);
    // A frame's weight is 1 / (frames that the history stands for). Cells that stayed: the mean of all frames. New ones: decay at
    // the rate of their dynamicity, which is linear in it and has worn off a little.
    const MovingVolume& volume = lighting.volumes()[0];
    ClvMergeSettings merge = settings.merge;
    const float dynamicity = settings.newCellDynamicity * std::exp(-float(after) * merge.timestep / merge.dynamicityTime);
    const float raised = 1.0f / clvMergeAlpha(merge, dynamicity);
    ASSERT_LT(raised, settings.guessFrames + float(after));
    std::size_t stayed = 0, renewed = 0;
    const Level& level = volume.level();
    for (const uint entry : level.table) {
        if (entry == kClvNoSlot) continue;
        const uint slot = slotsOfCell(level, entry).first;
        const bool isNew = level.slots[slot].openCentroid.x > -1.0f;
        const float expected = isNew ? raised : float(before + after);
        EXPECT_NEAR(volume.frames()[slot], expected, 1e-3f * expected);
        ++(isNew ? renewed : stayed);
    }
    EXPECT_GT(stayed, 1000u);
    EXPECT_GT(renewed, 500u);
}

}  // namespace
