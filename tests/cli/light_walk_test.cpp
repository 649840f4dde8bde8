// The walk over bounces, in rooms of which only the albedo counts: what its rays carry is a geometric series a room and a channel.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <gtest/gtest.h>

#include "bindings/cli/light_walk.h"
#include "clv/math/hash.h"
#include "clv/stages/rays.h"

namespace clv::test {
namespace {

// Closed rooms at x = 0, 1, 2, ...: a ray ends in the room that it starts in. A share of each room may be black.
class Rooms : public Lighting {
public:
    explicit Rooms(std::vector<vec3> albedos, float black = 0.0f) : albedos_(std::move(albedos)), black_(black) {}

    void emit(std::span<const ClvRsmTexel> emitters) override {
        if (emitters.size() % kEmitterWidth != 0) throw std::logic_error("emitters that are no whole rows");
        ends_.clear(), emitters_.assign(emitters.begin(), emitters.end());
        double sum = 0.0;
        for (const ClvRsmTexel& texel : emitters) ends_.push_back(sum += clvTexelWeight(texel));
        mostEmitters = std::max(mostEmitters, emitters.size());
    }
    void draw(std::uint32_t seed, std::span<ClvRay> rays, std::span<ClvHit> hits) override {
        for (std::size_t k = 0; k < rays.size(); ++k) {
            const double at = (double(k) + clvUnitFloat(clvHashCombine(seed, uint(k)))) / double(rays.size()) * ends_.back();
            const std::size_t i = std::min<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), at) - ends_.begin(), ends_.size() - 1);
            const ClvRsmTexel& from = emitters_[i];
            rays[k] = ClvRay{from.position, 0.5f, vec3(0.0f, 1.0f, 0.0f), from.dynamicity, from.flux * float(ends_.back() / double(clvTexelWeight(from))), 0.0f};
            hits[k].distance = 0.5f, hits[k].normal = vec3(0.0f, -1.0f, 0.0f), hits[k].primitive = 0;
            hits[k].albedo = clvUnitFloat(clvHashCombine(seed + 2u, uint(k))) < black_ ? vec3(0.0f) : albedos_[std::size_t(from.position.x)];
            // Somewhere else in the room.
            rays[k].origin.y = clvUnitFloat(clvHashCombine(seed + 1u, uint(k)));
        }
    }

    void renderMaps(std::uint32_t) override { throw std::logic_error("not the walk's"); }
    void guideBy(const RayGuide&) override { throw std::logic_error("not the walk's"); }
    std::unique_ptr<LightLevel> makeLevel(Level) override { throw std::logic_error("not the walk's"); }
    std::size_t shoot(std::size_t, std::span<LightLevel* const>) override { throw std::logic_error("not the walk's"); }
    void shootAgain(LightLevel&) override { throw std::logic_error("not the walk's"); }
    LitPlaces takeLit(int) override { throw std::logic_error("not the walk's"); }
    void add(std::span<const ClvRay>, LightLevel&) override { throw std::logic_error("not the walk's"); }

    std::size_t mostEmitters = 0;

private:
    std::vector<vec3> albedos_;
    float black_;
    std::vector<ClvRsmTexel> emitters_;
    std::vector<double> ends_;
};

const Bounds kBounds{vec3(0.0f), vec3(3.0f, 1.0f, 1.0f)};

// A thousand places a room, that send `flux` together.
LitPlaces litRooms(std::span<const vec3> flux, const glm::dvec3& kept = glm::dvec3(0.5)) {
    LitPlaces lit;
    for (std::size_t room = 0; room < flux.size(); ++room) {
        for (int k = 0; k < 1000; ++k) lit.texels.push_back({vec3(float(room), 0.001f * float(k), 0.5f), 0.0f, vec3(0.0f, 1.0f, 0.0f), 1u, flux[room] / 1000.0f, 0.0f});
    }
    lit.sent = fluxOf(lit.texels) / kept;
    return lit;
}

// What the rays carry, of each room: their mean.
std::map<int, glm::dvec3> carried(std::span<const ClvRay> rays) {
    std::map<int, glm::dvec3> sums;
    for (const ClvRay& ray : rays) sums[int(ray.origin.x)] += glm::dvec3(ray.flux) / double(rays.size());
    return sums;
}

TEST(LightWalk, carriesTheSeriesOfEachChannel) {
    const vec3 albedo(0.99f, 0.9f, 0.5f), flux(3.0f, 1.0f, 2.0f);
    Rooms rooms({albedo});
    LightWalk walk(rooms, kBounds);
    for (std::uint32_t seed = 1; seed < 4; ++seed) {  // the first call does not know yet how much light there is
        const auto rays = walk.follow(litRooms({&flux, 1}), 1 << 17, seed);
        const glm::dvec3 sum = carried(rays)[0];
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] * (1.0 - albedo[c]) / flux[c], 1.0, 0.01) << c << " seed " << seed;
        EXPECT_LE(rays.size(), std::size_t(1.01 * (1 << 17)));
        EXPECT_GT(rays.size(), std::size_t(0.8 * (1 << 17)));
    }
    EXPECT_FALSE(walk.limitless());
    EXPECT_GT(walk.bounces(), 200);
    EXPECT_NEAR(walk.pace().x, 0.99, 0.002);
}

// The light of the bright room is gone after some bounces; that of the other one, a ten-thousandth of it, is what then counts.
TEST(LightWalk, keepsADimRoomWhenABrightOneIsDark) {
    const vec3 flux[] = {vec3(1.0f), vec3(1e-4f)};
    Rooms rooms({vec3(0.3f), vec3(0.98f)});
    LightWalk walk(rooms, kBounds);
    double mean = 0.0;
    for (std::uint32_t seed = 1; seed <= 16; ++seed) {
        auto sums = carried(walk.follow(litRooms(flux), 1 << 19, seed));
        EXPECT_NEAR(sums[0].x * 0.7, 1.0, 1e-3) << seed;
        mean += sums[1].x * 0.02 / 1e-4 / 16.0;
    }
    EXPECT_NEAR(mean, 1.0, 0.05);
}

TEST(LightWalk, extrapolatesFromManyPlacesWhereRaysAreFew) {
    const vec3 flux(1.0f);
    Rooms rooms({vec3(0.999f)});
    LightWalk walk(rooms, kBounds);
    walk.follow(litRooms({&flux, 1}), 1 << 11, 6);
    const auto rays = walk.follow(litRooms({&flux, 1}), 1 << 15, 7);
    EXPECT_NEAR(carried(rays)[0].x / 1000.0, 1.0, 0.05) << "half of a ray counts as lost";
    // Of the light from any hundredth of the room no more than three hundredths.
    std::vector<double> byPlace(100, 0.0);
    for (const ClvRay& ray : rays) byPlace[std::min<std::size_t>(std::size_t(ray.origin.y * 100.0f), 99)] += ray.flux.x / double(rays.size());
    EXPECT_LT(*std::ranges::max_element(byPlace), 30.0);
}

TEST(LightWalk, givesUpAChannelThatLosesNothing) {
    const vec3 flux(1.0f), albedo(1.0f, 0.5f, 0.99f);
    for (const std::size_t count : {1, 50, 300, 700, 4096, 65536}) {
        Rooms rooms({albedo});
        LightWalk walk(rooms, kBounds);
        for (std::uint32_t seed = 1; seed <= 3; ++seed) {  // later calls know how much light there is
            const glm::dvec3 sum = carried(walk.follow(litRooms({&flux, 1}, glm::dvec3(albedo)), count, seed))[0];
            EXPECT_TRUE(walk.limitless());
            EXPECT_NEAR(walk.pace().x, 1.0, 1e-5) << count;
            EXPECT_NEAR(sum.x, double(kLastWithoutLimit - 1), 0.05) << count;
            if (count < 4096) continue;
            EXPECT_NEAR(sum.y, 2.0, 0.01);
            EXPECT_NEAR(sum.z, 100.0, 2.0) << count;
        }
    }
}

// White rooms with a little that is black: few rays may lose nothing by chance.
TEST(LightWalk, isNotMisledByFewRays) {
    const vec3 flux(1.0f);
    for (const float black : {0.05f, 0.01f, 0.002f}) {
        for (const std::size_t count : {500, 2000, 16000}) {
            Rooms rooms({vec3(1.0f)}, black);
            constexpr int kRuns = 200;
            double mean = 0.0;
            for (int run = 0; run < kRuns; ++run) {
                LightWalk walk(rooms, kBounds);
                walk.follow(litRooms({&flux, 1}, glm::dvec3(1.0 - black)), count / 16, std::uint32_t(run + kRuns));
                mean += carried(walk.follow(litRooms({&flux, 1}, glm::dvec3(1.0 - black)), count, std::uint32_t(run)))[0].x * double(black) / kRuns;
                EXPECT_FALSE(walk.limitless());
            }
            RecordProperty("mean over exact, black " + std::to_string(black) + ", rays " + std::to_string(count), std::to_string(mean));
            EXPECT_GT(mean, 0.4) << black << ' ' << count;
            EXPECT_LT(mean, 1.35) << black << ' ' << count;
            if (double(count) * black >= 160.0) {
                EXPECT_NEAR(mean, 1.0, 0.05) << black << ' ' << count;
            }
        }
    }
}

TEST(LightWalk, ofNothingIsNothing) {
    Rooms rooms({vec3(0.5f)});
    LightWalk walk(rooms, kBounds);
    EXPECT_TRUE(walk.follow(LitPlaces(), 1 << 10, 1).empty());
    const vec3 black(0.0f);
    EXPECT_TRUE(walk.follow(litRooms({&black, 1}), 1 << 10, 1).empty());
    const vec3 flux(1.0f);
    EXPECT_GT(carried(walk.follow(litRooms({&flux, 1}), 1, 1))[0].x, 1.0) << "of one ray as many are made as a walk needs";
    EXPECT_EQ(rooms.mostEmitters % kEmitterWidth, 0u);
}

}  // namespace
}  // namespace clv::test
