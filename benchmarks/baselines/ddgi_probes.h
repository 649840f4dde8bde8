// Where the probes of a DDGI volume stand: on a grid, moved out of solids and away from surfaces, and only where they are of use.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "benchmarks/baselines/readers.h"

namespace clv {

inline constexpr std::uint32_t kNoProbe = ~0u;

// Evenly spread directions of unit length: the spherical Fibonacci lattice (Keinert et al. 2015).
vec3 fibonacciDirection(std::size_t index, std::size_t count);

// The eight probes around a point, with their trilinear weights.
struct ProbeCage {
    std::array<std::uint32_t, 8> probe;  // kNoProbe: nothing stands there
    std::array<float, 8> weight;
};

class DdgiProbes {
public:
    // About resolution^3 probes around and inside the scene's bounds. gridShift: of a spacing, [0, 1).
    void place(const MethodWorld& world, int resolution, const vec3& gridShift, Readers readers, std::span<const ReferencePoint> receivers);

    float spacing() const { return spacing_; }                        // m
    const std::vector<vec3>& positions() const { return positions_; } // m, a probe each
    std::size_t bytes() const { return at_.size() * sizeof(std::uint32_t) + positions_.size() * sizeof(vec3); }

    // The point at which light is looked up for a receiver, off its surface.
    vec3 biased(const vec3& position, const vec3& normal) const;
    // Points outside of the grid read its rim.
    ProbeCage cageAround(const vec3& point) const;

private:
    // Calls visit(index into at_, trilinear weight) for the corners of the grid's cell that holds the point.
    template <class Visit>
    void forCorners(const vec3& point, Visit&& visit) const;
    std::size_t index(const ivec3& p) const { return std::size_t(p.x) + std::size_t(count_.x) * (p.y + std::size_t(count_.y) * p.z); }

    vec3 origin_{0.0f};   // m, of the first point of the grid
    float spacing_ = 0.0f;
    ivec3 count_{0};
    std::vector<std::uint32_t> at_;  // a point of the grid each: its probe, or kNoProbe
    std::vector<vec3> positions_;
};

}  // namespace clv
