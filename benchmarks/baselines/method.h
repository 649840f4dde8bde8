// What a report asks of a method of indirect light: set it up, add frames of rays, read irradiance; the caller times each step.
//
// All methods answer the same question: indirect irradiance after one bounce (light -> surface -> receiver), W/m^2, without any
// ambient term, in a scene that stands still. They trace the same Embree scene on the same threads.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bindings/embree/embree_scene.h"
#include "bindings/embree/path_tracer.h"
#include "clv/cpu/parallel.h"

namespace clv {

// Of the picture whose run time a report gives.
inline constexpr int kPictureWidth = 1280, kPictureHeight = 720;

// What methods work on; both must outlive them.
struct MethodWorld {
    const EmbreeScene& scene;
    const ParallelFor& parallelFor;
};

// body(i) for every i in [0, count), `piece` of them in a row.
template <class Body>
void forPieces(const MethodWorld& world, std::size_t count, std::size_t piece, const Body& body) {
    world.parallelFor((count + piece - 1) / piece, [&](std::size_t which) {
        for (std::size_t i = which * piece; i < std::min(count, (which + 1) * piece); ++i) body(i);
    });
}

// Name and value of all that sets two runs of a method apart, in a fixed order: columns of a table.
using MethodSettings = std::vector<std::pair<std::string, std::string>>;
// A shift of a grid, cells, among them.
std::string gridShiftText(const glm::vec3& shift);

class Method {
public:
    virtual ~Method() = default;

    virtual std::string name() const = 0;
    virtual MethodSettings settings() const = 0;

    // Set-up: whatever a still scene and still readers need once. `receivers` are the points that irradiance() answers for; they are
    // copied. Called once; restart(1) is implied.
    virtual void prepare(const MethodWorld& world, std::span<const ReferencePoint> receivers) = 0;
    // Forgets all light. What comes is drawn from this seed: the same calls after it give the same results, on any number of threads.
    virtual void restart(std::uint32_t seed) = 0;

    // Light that the lamps throw on surfaces, as reflective shadow maps: once before each frame. Nothing for methods without maps.
    virtual void renderMaps() {}
    // One frame: about `rays` rays, > 0, merged with the frames since restart(). Where a method's least frame takes more, it takes more.
    virtual void frame(std::size_t rays) = 0;
    // W/m^2 of the first out.size() receivers, from the frames since restart(); 0 before the first.
    virtual void irradiance(std::span<glm::vec3> out) = 0;

    // Methods whose lookups serve several pixels of a picture each: pixels of the first camera's picture that see a surface, and the
    // reading of all of them. 0: receivers are read one by one.
    virtual std::size_t picturePixels() const { return 0; }
    virtual void readPicture() {}

    // Whether a frame's rays serve every receiver. Where they do not, each receiver sends rays of its own, and a frame costs what its
    // receivers cost.
    virtual bool sharesRays() const { return true; }
    // Held for the light and for finding it, the scene's acceleration structure, receivers and maps apart.
    virtual std::size_t bytes() const = 0;
    // Rays traced by the frames since restart(), shadow rays among them, those of maps not.
    virtual std::uint64_t raysTraced() const = 0;
};

}  // namespace clv
