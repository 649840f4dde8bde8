#include "benchmarks/baselines/ddgi_probes.h"

#include <algorithm>
#include <cmath>

namespace clv {
namespace {

// Self-shadow bias (Majercik et al. 2021): 0.3 of three quarters of the spacing, along the normal and towards the viewer;
// receivers here have no viewer, so that the normal stands for both.
constexpr float kSelfShadowBias = 0.3f * 0.75f;
// A probe lies in a solid where more of what its rays meet are back faces (Majercik et al. 2021). Rays that meet nothing
// are left out: else probes behind the corners of a closed room would count as free.
constexpr float kMostBackFaces = 0.25f;
// How far a probe may be moved, in spacings: not as far as to its neighbour's side (Majercik et al. 2021).
constexpr float kLongestMove = 0.45f;
// How far a probe is kept from surfaces, in spacings, where it can be.
constexpr float kClearance = 0.2f;
constexpr int kMoves = 6;
constexpr std::size_t kSurveyRays = 128;

// What rays from a point meet.
struct Survey {
    float backShare = 0.0f;                        // of the surfaces that are met
    float back = kClvFar, front = kClvFar;         // m to the nearest back and front face
    vec3 towardsBack{0.0f}, towardsFront{0.0f};
};

bool isBackFace(const Scene& scene, const ClvHit& hit, const vec3& direction) {
    const glm::uvec3& corner = scene.triangles[hit.primitive];
    const vec3 a = scene.positions[corner.x];
    return dot(cross(scene.positions[corner.y] - a, scene.positions[corner.z] - a), direction) > 0.0f;
}

Survey lookAround(const EmbreeScene& scene, const vec3& point) {
    std::array<ClvRay, kSurveyRays> rays;
    std::array<ClvHit, kSurveyRays> hits;
    for (std::size_t k = 0; k < kSurveyRays; ++k) {
        rays[k] = {.origin = point, .maxDistance = kClvFar, .direction = fibonacciDirection(k, kSurveyRays), .dynamicity = 0.0f, .flux = vec3(0.0f), .pad0 = 0.0f};
    }
    scene.trace(rays, hits);
    Survey survey;
    int met = 0, backs = 0;
    for (std::size_t k = 0; k < kSurveyRays; ++k) {
        if (hits[k].primitive == kClvNoPrimitive) continue;
        const bool back = isBackFace(scene.scene(), hits[k], rays[k].direction);
        ++met, backs += back;
        float& nearest = back ? survey.back : survey.front;
        if (hits[k].distance >= nearest) continue;
        nearest = hits[k].distance;
        (back ? survey.towardsBack : survey.towardsFront) = rays[k].direction;
    }
    survey.backShare = met > 0 ? float(backs) / float(met) : 0.0f;
    return survey;
}

// Out of a solid through its nearest face, then away from the nearest surface. False where it stays in a solid.
bool settle(const EmbreeScene& scene, float spacing, vec3& position) {
    const float clearance = kClearance * spacing;
    const vec3 gridPoint = position;
    Survey survey = lookAround(scene, position);
    for (int move = 0; move < kMoves; ++move) {
        vec3 step(0.0f);
        if (survey.backShare > kMostBackFaces) {
            step = survey.towardsBack * (survey.back + clearance);
        } else if (survey.front < clearance) {
            step = survey.towardsFront * (survey.front - clearance);
        }
        const vec3 moved = position + step;
        if (step == vec3(0.0f) || glm::length(moved - gridPoint) > kLongestMove * spacing) break;
        const Survey there = lookAround(scene, moved);
        const bool leavesSolid = survey.backShare > kMostBackFaces && there.backShare <= kMostBackFaces;
        if (!leavesSolid && !(there.backShare <= survey.backShare && there.front > survey.front)) break;
        position = moved;
        survey = there;
    }
    return survey.backShare <= kMostBackFaces;
}

}  // namespace

vec3 fibonacciDirection(std::size_t index, std::size_t count) {
    constexpr double kGoldenRatio = 1.6180339887498949;
    const double turn = 2.0 * M_PI * std::fmod(double(index) / kGoldenRatio, 1.0);
    const double z = 1.0 - (2.0 * double(index) + 1.0) / double(count), radius = std::sqrt(1.0 - z * z);
    return vec3(radius * std::cos(turn), radius * std::sin(turn), z);
}

void DdgiProbes::place(const MethodWorld& world, int resolution, const vec3& gridShift, Readers readers, std::span<const ReferencePoint> receivers) {
    const Bounds& bounds = world.scene.scene().bounds;
    const vec3 extent = bounds.extent();
    spacing_ = float(std::cbrt(double(extent.x) * extent.y * extent.z) / resolution);
    for (int axis = 0; axis < 3; ++axis) {
        // A lattice around the middle, as far as the first points outside of the bounds: surfaces on the rim have a front there too.
        const float reach = 0.5f * extent[axis] / spacing_, shift = gridShift[axis] + 0.5f;
        const float first = std::floor(-reach - shift), last = std::ceil(reach - shift);
        origin_[axis] = bounds.center()[axis] + spacing_ * (first + shift);
        count_[axis] = int(last - first) + 1;
    }
    const std::size_t points = std::size_t(count_.x) * count_.y * count_.z;
    at_.assign(points, kNoProbe);
    std::vector<std::uint8_t> wanted(points, readers == Readers::anywhere);
    for (const ClvReceiver& reader : readingPoints(readers, world, receivers)) {
        forCorners(biased(reader.position, reader.normal), [&](std::size_t corner, float) { wanted[corner] = 1; });
    }
    std::vector<vec3> position(points);
    world.parallelFor(points, [&](std::size_t i) {
        const ivec3 p(int(i) % count_.x, int(i) / count_.x % count_.y, int(i) / (count_.x * count_.y));
        position[i] = origin_ + spacing_ * vec3(p);
        if (wanted[i]) wanted[i] = settle(world.scene, spacing_, position[i]);
    });
    positions_.clear();
    for (std::size_t i = 0; i < points; ++i) {
        if (!wanted[i]) continue;
        at_[i] = std::uint32_t(positions_.size());
        positions_.push_back(position[i]);
    }
}

vec3 DdgiProbes::biased(const vec3& position, const vec3& normal) const {
    return position + normal * (kSelfShadowBias * spacing_);
}

template <class Visit>
void DdgiProbes::forCorners(const vec3& point, Visit&& visit) const {
    const vec3 place = clamp((point - origin_) / spacing_, vec3(0.0f), vec3(count_ - 1));
    const ivec3 low = min(ivec3(place), count_ - 2);
    const vec3 f = place - vec3(low);
    for (int k = 0; k < 8; ++k) {
        const ivec3 step(k & 1, k >> 1 & 1, k >> 2);
        const vec3 share = mix(vec3(1.0f) - f, f, vec3(step));
        visit(index(low + step), share.x * share.y * share.z);
    }
}

ProbeCage DdgiProbes::cageAround(const vec3& point) const {
    ProbeCage cage;
    int k = 0;
    forCorners(point, [&](std::size_t corner, float weight) {
        cage.probe[k] = at_[corner];
        cage.weight[k++] = weight;
    });
    return cage;
}

}  // namespace clv
