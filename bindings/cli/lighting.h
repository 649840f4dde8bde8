// What the light pipeline asks of a back end: rays from lights or lit surfaces, cut where they hit, and their light in levels.
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "clv/cpu/level.h"
#include "clv/cpu/ray_guide.h"
#include "clv/data/hit.h"
#include "clv/data/rsm_texel.h"

namespace clv {

// A level with its light, in the memory of the back end.
class LightLevel {
public:
    virtual ~LightLevel() = default;
    virtual const Level& level() const = 0;
    // Rays merged so far.
    virtual double rays() const = 0;
    // Of its volume and tables.
    virtual std::size_t bytes() const = 0;
    // Mean deposits of each half, one record a slot: W m for the whole flux of the lights. Valid until more rays come.
    virtual std::vector<std::span<const float>> histories() = 0;
};

// What surfaces send on that some rays met: a texel each.
struct LitPlaces {
    std::vector<ClvRsmTexel> texels;
    glm::dvec3 sent{0.0};  // W a channel, of the rays
};

// Rays from one source: the maps of the lights, or surfaces that send light. All back ends draw the same ones for the same seed.
class Lighting {
public:
    virtual ~Lighting() = default;

    // The maps of the scene's lights, at one of their well-spread samples: where the rays of the next shots come from.
    virtual void renderMaps(std::uint32_t pass) = 0;
    // Surfaces that send light, in place of maps: rows of kEmitterWidth, as many as the settings say at most.
    virtual void emit(std::span<const ClvRsmTexel> emitters) = 0;

    // Fills `rays` with the first ones of a sequence of their own, cut where they hit; and `hits`, as many or none, for settings that
    // keep hits. Each carries the whole flux.
    virtual void draw(std::uint32_t seed, std::span<ClvRay> rays, std::span<ClvHit> hits = {}) = 0;
    // Later rays go where this guide sends them, once maps are rendered. Call it before any level is made.
    virtual void guideBy(const RayGuide& guide) = 0;

    // A level without light. It must not outlive the lighting.
    virtual std::unique_ptr<LightLevel> makeLevel(Level level) = 0;

    // Draws `count` rays, rounded up so that each part of a half has as many, and adds their light to the levels. Returns how many.
    virtual std::size_t shoot(std::size_t count, std::span<LightLevel* const> levels) = 0;
    // The rays of the last shot for one more level, which has joined since.
    virtual void shootAgain(LightLevel& level) = 0;
    // Of a half of the last shot, for settings that keep hits; once a shot.
    virtual LitPlaces takeLit(int half) = 0;

    // For settings with emitters, in place of shots: adds the light of rays that are cut, which is their mean; each half has as many, one
    // half after the other. Nothing where there are none.
    virtual void add(std::span<const ClvRay> rays, LightLevel& level) = 0;
};

struct LightingSettings {
    DepositLayout layout;
    int halves = 1;
    std::uint64_t rays = 0;       // that are to come, about: volumes are cut into parts accordingly
    std::size_t firstShot = 0;    // rays; their memory is taken ahead
    std::uint32_t seed = 1;
    std::size_t emitters = 0;     // surfaces that may send light, rows of kEmitterWidth; 0: the scene's lights do
    bool keepHits = false;        // so that takeLit() knows what the rays met
    ClvVolume finest{};           // of the levels that may be made
};

constexpr int kEmitterWidth = 256;

class LightBackend {
public:
    virtual ~LightBackend() = default;
    // "cpu" or "vulkan".
    virtual std::string name() const = 0;
    // Of the device; empty where the processor computes.
    virtual std::string device() const = 0;
    virtual std::unique_ptr<Lighting> makeLighting(const LightingSettings& settings) = 0;
};

}  // namespace clv
