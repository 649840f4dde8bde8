// The walk of a ray through a grid, and the packets that follow it.
#include "clv/cpu/packet_walk.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <set>

#include "support/chi_square.h"

using namespace clv;

namespace walk_test {

const float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();

ClvVolume gridOf(const ivec3& resolution, const ivec3& scroll, const vec3& origin, float cellSize) {
    ClvVolume volume{};
    volume.resolution = resolution;
    volume.scroll = scroll;
    volume.origin = origin;
    volume.cellSize = cellSize;
    return volume;
}

// A level in which every `gap`-th cell has no slot.
Level levelOf(const ClvVolume& volume, int gap = 0) {
    Level level;
    level.volume = volume;
    level.table.resize(std::size_t(volume.resolution.x) * volume.resolution.y * volume.resolution.z);
    for (std::size_t i = 0; i < level.table.size(); ++i) level.table[i] = gap > 0 && i % gap == 0 ? kClvNoSlot : uint(i);
    return level;
}

ClvRay rayOf(const vec3& origin, const vec3& direction, float distance) {
    ClvRay ray{};
    ray.origin = origin;
    ray.direction = direction;
    ray.maxDistance = distance;
    return ray;
}

vec3 randomPoint(uint seed, uint i) {
    return vec3(test::randomUnit(seed, 3 * i), test::randomUnit(seed, 3 * i + 1), test::randomUnit(seed, 3 * i + 2));
}

// Rays from in and around the grid, into all directions, of all lengths.
ClvRay randomRay(const ClvVolume& v, uint i) {
    const vec3 extent = vec3(v.resolution) * v.cellSize;
    const vec3 origin = v.origin + extent * (randomPoint(1, i) * 1.6f - 0.3f);
    return rayOf(origin, test::randomDirection(2, i), length(extent) * std::pow(test::randomUnit(3, i), 2.0f));
}

// What rounding and branches find hard: along axes and diagonals, in faces, through edges and corners, from boundaries, from far
// away, of no or endless length, not finite.
ClvRay adversarialRay(const ClvVolume& v, uint i) {
    auto pick = [&](uint salt, uint n) { return clvHashCombine(100u + salt, i) % n; };
    const float lattice[] = {0.0f, 0.5f, 1.0f, 2.0f, 3.0f, 1e-7f, -1e-7f, -1.0f};
    const float slopes[] = {0.0f, -0.0f, 1.0f, -1.0f, 0.5f, -0.5f, 1e-20f, -2e-20f, 1e-30f, 1e-7f, -1e-7f, 3.0f};
    const float lengths[] = {0.0f, 1e-30f, 1.0f, 2.5f, 100.0f, kClvFar, kInfinity, kNan, -1.0f};
    vec3 origin, direction;
    for (int axis = 0; axis < 3; ++axis) {
        const uint place = pick(10u + uint(axis), 20);
        const float cells = place < 16 ? lattice[place % 8] + (place < 8 ? 0.0f : float(v.resolution[axis]) - 3.0f) : 1e6f;
        origin[axis] = v.origin[axis] + cells * v.cellSize;
        direction[axis] = slopes[pick(20u + uint(axis), 12)];
    }
    if (length(direction) > 0.0f && pick(1, 8) != 0) direction = normalize(direction);
    ClvRay ray = rayOf(origin, direction, lengths[pick(2, 9)] * (pick(3, 2) == 0 ? v.cellSize : 1.0f));
    const float bad[] = {kNan, kInfinity, -kInfinity, 3e38f};
    if (pick(4, 40) == 0) ray.origin[int(pick(5, 3))] = bad[pick(6, 4)];
    if (pick(7, 40) == 0) ray.direction[int(pick(8, 3))] = bad[pick(9, 4)];
    return ray;
}

std::vector<ClvVolume> grids() {
    return {gridOf(ivec3(32), ivec3(0), vec3(0.0f), 1.0f / 32.0f), gridOf(ivec3(7, 19, 12), ivec3(3, 18, 5), vec3(-3.3f, 100.1f, 0.7f), 0.37f),
            gridOf(ivec3(1), ivec3(0), vec3(-1.0f), 2.0f), gridOf(ivec3(1, 64, 3), ivec3(0, 63, 1), vec3(1e3f), 0.125f)};
}

// Every crossing that a packet walk lets out, in order.
struct Recorded {
    std::vector<uint> entry, lane;
    std::vector<float> weight, middle;
    void operator()(CrossingBuffer& buffer) {
        entry.insert(entry.end(), buffer.entry, buffer.entry + buffer.count);
        lane.insert(lane.end(), buffer.lane, buffer.lane + buffer.count);
        weight.insert(weight.end(), buffer.weight, buffer.weight + buffer.count);
        middle.insert(middle.end(), buffer.middle, buffer.middle + buffer.count);
        buffer.count = 0;
    }
    bool sameBits(const Recorded& other) const {
        auto same = [](const auto& a, const auto& b) { return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0); };
        return same(entry, other.entry) && same(lane, other.lane) && same(weight, other.weight) && same(middle, other.middle);
    }
};

TEST(PacketWalk, isTheSameToTheLastBitWithAndWithoutVectors) {
    CrossingBuffer buffer;
    std::size_t crossings = 0;
    for (const ClvVolume& volume : grids()) {
        const Level level = levelOf(volume, 5);
        for (uint rule : {kClvInjectTrackLength, kClvInjectThesis}) {
            for (uint packet = 0; packet < 16000; ++packet) {
                std::vector<ClvRay> rays(1 + clvHashCombine(9u, packet) % kPacketLanes);
                for (uint i = 0; i < rays.size(); ++i) {
                    const uint number = packet * kPacketLanes + i;
                    rays[i] = packet % 2 ? adversarialRay(volume, number) : randomRay(volume, number);
                }
                Recorded vectors, portable;
                walkPacket(level, rule, rays, buffer, vectors);
                vectors(buffer);
                walkPacketPortable(level, rule, rays, buffer, portable);
                portable(buffer);
                ASSERT_TRUE(vectors.sameBits(portable)) << "packet " << packet << " of " << volume.resolution.y;
                crossings += portable.entry.size();
            }
        }
    }
    EXPECT_GT(crossings, 1000000u);
}

TEST(PacketWalk, letsOutTheCrossingsOfEachRayAsIfItWereAlone) {
    const ClvVolume volume = grids()[1];
    const Level level = levelOf(volume);
    CrossingBuffer buffer;
    std::vector<ClvRay> rays(kPacketLanes);
    for (uint i = 0; i < rays.size(); ++i) rays[i] = randomRay(volume, 777u + i);
    Recorded together;
    walkPacket(level, kClvInjectTrackLength, rays, buffer, together);
    together(buffer);
    for (uint i = 0; i < rays.size(); ++i) {
        Recorded alone;
        walkPacket(level, kClvInjectTrackLength, std::span(rays).subspan(i, 1), buffer, alone);
        alone(buffer);
        std::vector<uint> entries;
        for (std::size_t k = 0; k < together.entry.size(); ++k) {
            if (together.lane[k] == i) entries.push_back(together.entry[k]);
        }
        EXPECT_EQ(entries, alone.entry) << i;
    }
}

// The part of a ray that lies in the grid, m, in double.
double clippedLength(const ClvVolume& v, const ClvRay& ray) {
    double lo = 0.0, hi = ray.maxDistance;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (double(v.origin[axis]) - ray.origin[axis]) / ray.direction[axis];
        const double b = (double(v.origin[axis]) + double(v.resolution[axis]) * v.cellSize - ray.origin[axis]) / ray.direction[axis];
        lo = std::max(lo, std::min(a, b));
        hi = std::min(hi, std::max(a, b));
    }
    return std::max(0.0, hi - lo);
}

TEST(Walk, thePiecesAddUpToTheClippedLengthAndNoCellComesTwice) {
    const float epsilon = std::numeric_limits<float>::epsilon();
    for (const ClvVolume& volume : grids()) {
        const vec3 extent = vec3(volume.resolution) * volume.cellSize;
        for (uint i = 0; i < 250000; ++i) {
            const ClvRay ray = randomRay(volume, i);
            ClvWalk walk = clvWalkBegin(volume, ray);
            double sum = 0.0;
            int cells = 0;
            ivec3 last(-1000);
            ivec3 sense(0);
            while (walk.running == 1) {
                const ClvCrossing crossing = clvWalkStep(walk, ray.direction);
                ASSERT_EQ(clvCellInside(volume, crossing.cell), 1) << i;
                ASSERT_GE(crossing.tEnd, crossing.tBegin);
                if (cells > 0) {
                    // One step to a face neighbour, and never back along an axis: so no cell can come twice.
                    const ivec3 step = crossing.cell - last;
                    ASSERT_EQ(std::abs(step.x) + std::abs(step.y) + std::abs(step.z), 1) << i;
                    for (int axis = 0; axis < 3; ++axis) {
                        ASSERT_GE(step[axis] * sense[axis], 0) << i;
                        if (step[axis] != 0) sense[axis] = step[axis];
                    }
                }
                last = crossing.cell;
                sum += double(crossing.tEnd) - crossing.tBegin;
                ++cells;
            }
            // Distances are rounded at the size of the coordinates that they come from: from the ray's start to the far side of the grid.
            double reach = 0.0;
            for (int axis = 0; axis < 3; ++axis) {
                const double a = std::abs(double(ray.origin[axis]) - volume.origin[axis]);
                reach = std::max(reach, (std::max(a, std::abs(a - extent[axis])) + std::abs(volume.origin[axis])) / std::abs(ray.direction[axis]));
            }
            ASSERT_NEAR(sum * volume.cellSize, clippedLength(volume, ray), 4.0 * epsilon * std::min(reach, 1e6)) << i;
        }
    }
}

TEST(Walk, eachPieceLiesInItsCell) {
    const ClvVolume volume = grids()[0];
    for (uint i = 0; i < 20000; ++i) {
        const ClvRay ray = randomRay(volume, i);
        ClvWalk walk = clvWalkBegin(volume, ray);
        while (walk.running == 1) {
            const ClvCrossing crossing = clvWalkStep(walk, ray.direction);
            const vec3 middle = walk.origin + ray.direction * (0.5f * (crossing.tBegin + crossing.tEnd));
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_GE(middle[axis], float(crossing.cell[axis]) - 1e-4f) << i;
                ASSERT_LE(middle[axis], float(crossing.cell[axis]) + 1.0001f) << i;
            }
        }
    }
}

TEST(Walk, startAndEndCellBothCountWithTheirLength) {
    const ClvVolume volume = gridOf(ivec3(8), ivec3(0), vec3(0.0f), 0.5f);
    const ClvRay ray = rayOf(vec3(0.4f, 0.75f, 0.75f), vec3(1.0f, 0.0f, 0.0f), 0.9f);
    ClvWalk walk = clvWalkBegin(volume, ray);
    std::vector<float> lengths, thesis;
    while (walk.running == 1) {
        const ClvCrossing crossing = clvWalkStep(walk, ray.direction);
        lengths.push_back(clvCrossingWeight(kClvInjectTrackLength, crossing, volume.cellSize));
        thesis.push_back(clvCrossingWeight(kClvInjectThesis, crossing, volume.cellSize));
    }
    ASSERT_EQ(lengths.size(), 3u);
    EXPECT_NEAR(lengths[0], 0.1f, 1e-6f);
    EXPECT_NEAR(lengths[1], 0.5f, 1e-6f);
    EXPECT_NEAR(lengths[2], 0.3f, 1e-6f);
    // The thesis skips the first cell and keeps the last.
    EXPECT_EQ(thesis, (std::vector<float>{0.0f, 1.0f, 1.0f}));
}

TEST(Walk, aRayThatEntersFromOutsideHasNoStartCell) {
    const ClvVolume volume = gridOf(ivec3(4), ivec3(0), vec3(0.0f), 1.0f);
    const ClvRay ray = rayOf(vec3(-3.0f, 1.5f, 1.5f), vec3(1.0f, 0.0f, 0.0f), 4.5f);
    ClvWalk walk = clvWalkBegin(volume, ray);
    const ClvCrossing first = clvWalkStep(walk, ray.direction);
    EXPECT_EQ(first.cell, ivec3(0, 1, 1));
    EXPECT_EQ(clvCrossingWeight(kClvInjectThesis, first, 1.0f), 1.0f);
    EXPECT_EQ(clvWalkStep(walk, ray.direction).cell, ivec3(1, 1, 1));
    EXPECT_EQ(walk.running, 0);
}

TEST(Walk, whatIsNotARayHasNoCrossings) {
    const ClvVolume volume = gridOf(ivec3(4), ivec3(0), vec3(0.0f), 1.0f);
    const vec3 x(1.0f, 0.0f, 0.0f), inside(1.5f);
    EXPECT_EQ(clvWalkBegin(volume, rayOf(inside, x, 0.0f)).running, 0);
    EXPECT_EQ(clvWalkBegin(volume, rayOf(inside, x, -1.0f)).running, 0);
    EXPECT_EQ(clvWalkBegin(volume, rayOf(vec3(9.0f), x, 5.0f)).running, 0);
    EXPECT_EQ(clvWalkBegin(volume, rayOf(vec3(-1.0f, 5.0f, 1.0f), x, 50.0f)).running, 0);
    EXPECT_EQ(clvWalkBegin(volume, rayOf(inside, x, kNan)).running, 0);
    EXPECT_EQ(clvWalkBegin(volume, rayOf(inside, x, kInfinity)).running, 1);
    for (float bad : {kNan, kInfinity, -kInfinity}) {
        for (int axis = 0; axis < 3; ++axis) {
            vec3 origin = inside, direction = x;
            origin[axis] = bad;
            EXPECT_EQ(clvWalkBegin(volume, rayOf(origin, x, 5.0f)).running, 0) << axis;
            direction[axis] = bad;
            EXPECT_EQ(clvWalkBegin(volume, rayOf(inside, direction, 5.0f)).running, 0) << axis;
        }
    }
}

TEST(Walk, everyWalkEndsWithinTheGridsDiagonal) {
    for (const ClvVolume& volume : grids()) {
        const int most = volume.resolution.x + volume.resolution.y + volume.resolution.z;
        for (uint i = 0; i < 200000; ++i) {
            const ClvRay ray = adversarialRay(volume, i);
            ClvWalk walk = clvWalkBegin(volume, ray);
            int cells = 0;
            while (walk.running == 1) {
                ASSERT_EQ(clvCellInside(volume, clvWalkStep(walk, ray.direction).cell), 1) << i;
                ASSERT_LE(++cells, most) << i;
            }
        }
    }
}

}  // namespace walk_test
