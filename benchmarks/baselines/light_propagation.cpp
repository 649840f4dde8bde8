#include "benchmarks/baselines/light_propagation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "bindings/embree/light_maps.h"
#include "bindings/embree/surface_samples.h"
#include "clv/cpu/level.h"
#include "clv/math/hash.h"
#include "clv/math/sh.h"

namespace clv {
namespace {

constexpr int kBands = 4;     // coefficients of two bands
constexpr int kChannels = 3;
constexpr int kFaces = 6;     // +x -x +y -y +z -z, of a cell
constexpr std::size_t kBlockers = 256;  // surface samples that make up the geometry volume, times the square of the resolution
// Surfels and receivers count for the cell half a cell in front of them, so that a surface does not light itself.
constexpr float kInFront = 0.5f;
// What a cube shows to a direction, on average, in squares of its side: a quarter of its surface (Cauchy).
constexpr float kShownSide = 1.5f;

vec3 faceNormal(int face) {
    vec3 n(0.0f);
    n[face / 2] = face % 2 == 0 ? 1.0f : -1.0f;
    return n;
}

// max(0, cos) around an axis, in two bands.
vec4 cosineLobe(const vec3& axis) {
    return clvShTo3(axis) * vec4(kClvShCosine0, kClvShCosine1, kClvShCosine1, kClvShCosine1);
}

// Light that goes from a cell through the one of its neighbour's faces that lies in direction `towards`; the face between the two is
// not among them. Both cells' shares of directions are the same all over the grid.
struct Link {
    int travel, face;  // to which neighbour, and onto which of its faces
    vec4 basis;        // of the direction from the cell's centre to the face's
    float solidAngle;  // sr, of that face seen from there
};

std::array<Link, kFaces * (kFaces - 1)> makeLinks() {
    // Unit square at a height of 3/2 over its centre; the four sides share what the face between the cells covers beyond that.
    const float front = 4.0f * std::atan(0.25f / (1.5f * std::sqrt(0.25f + 0.25f + 2.25f)));
    const float side = (4.0f * kClvPi / float(kFaces) - front) / 4.0f;
    std::array<Link, kFaces * (kFaces - 1)> links;
    std::size_t count = 0;
    for (int travel = 0; travel < kFaces; ++travel) {
        for (int face = 0; face < kFaces; ++face) {
            if (face == (travel ^ 1)) continue;
            const vec3 towards = faceNormal(travel) + 0.5f * faceNormal(face);
            links[count++] = {travel, face, clvShTo3(normalize(towards)), face == travel ? front : side};
        }
    }
    return links;
}

// Numbers of a grid's cells, a plane of memory each, with one empty cell all around.
class Planes {
public:
    Planes() = default;
    Planes(const ivec3& size, int planes) : size_(size + 2), cells_(std::size_t(size_.x) * size_.y * size_.z), floats_(cells_ * planes) {}

    float* plane(int k) { return floats_.data() + cells_ * k; }
    const float* plane(int k) const { return floats_.data() + cells_ * k; }
    // Cell coordinates from -1 on.
    std::size_t index(const ivec3& cell) const { return std::size_t(cell.x + 1) + std::size_t(size_.x) * ((cell.y + 1) + std::size_t(size_.y) * (cell.z + 1)); }
    std::ptrdiff_t step(int face) const {
        const std::ptrdiff_t stride[] = {1, size_.x, std::ptrdiff_t(size_.x) * size_.y};
        return face % 2 == 0 ? stride[face / 2] : -stride[face / 2];
    }
    std::size_t bytes() const { return floats_.size() * sizeof(float); }
    void clear() { std::fill(floats_.begin(), floats_.end(), 0.0f); }

private:
    ivec3 size_{0};
    std::size_t cells_ = 0;
    std::vector<float> floats_;
};

class LightPropagation : public Method {
public:
    explicit LightPropagation(const LightPropagationSettings& settings) : settings_(settings) {}

    std::string name() const override { return "light_propagation"; }
    MethodSettings settings() const override {
        return {{"resolution", std::to_string(settings_.resolution)},
                {"grid_shift", gridShiftText(settings_.gridShift)},
                {"iterations", std::to_string(settings_.iterations)},
                {"blocking", fmt::format("{:g}", settings_.blocking)},
                {"damped", settings_.damped ? "yes" : "no"}};
    }

    void prepare(const MethodWorld& world, std::span<const ReferencePoint> receivers) override {
        world_.emplace(world);
        receivers_.assign(receivers.begin(), receivers.end());
        const Bounds& bounds = world.scene.scene().bounds;
        volume_ = volumeOverBounds(bounds.lo, bounds.hi, settings_.resolution, kClvStorageSh1, settings_.gridShift);
        for (Planes* light : {&injected_, &passed_, &next_, &sum_}) *light = Planes(volume_.resolution, kBands * kChannels);
        findBlockers();
        restart(1);
    }

    void restart(std::uint32_t seed) override {
        frames_ = 0;
        maps_.emplace(world_->scene, clvHashCombine(seed, 0x3u), world_->parallelFor);
        for (Planes* light : {&injected_, &sum_}) light->clear();
    }

    void renderMaps() override { texels_ = maps_->render(frames_); }

    void frame(std::size_t) override {
        inject(1.0f / float(++frames_));
        passed_ = injected_;
        sum_ = injected_;
        for (int step = 0; step < settings_.iterations; ++step) {
            propagate(step > 0);
            std::swap(passed_, next_);
        }
    }

    void irradiance(std::span<glm::vec3> out) override {
        forPieces(*world_, out.size(), 256, [&](std::size_t i) { out[i] = lookUp(receivers_[i]); });
    }

    std::size_t bytes() const override { return injected_.bytes() + passed_.bytes() + next_.bytes() + sum_.bytes() + open_.bytes(); }
    std::uint64_t raysTraced() const override { return 0; }

private:
    static constexpr int kLinks = kFaces * (kFaces - 1);

    ivec3 cellOf(const vec3& position) const { return clvClampCell(volume_, clvCellFromPosition(volume_, position)); }

    // The frame's texels, each a light of its own: intensity flux / pi max(0, cos), into the mean of all frames.
    void inject(float share) {
        for (int k = 0; k < kBands * kChannels; ++k) {
            float* plane = injected_.plane(k);
            const std::size_t end = injected_.index(volume_.resolution);
            for (std::size_t i = 0; i < end; ++i) plane[i] *= 1.0f - share;
        }
        for (const ClvRsmTexel& texel : texels_) {
            if (texel.valid == 0u) continue;
            const vec4 lobe = cosineLobe(texel.normal) * (kClvInvPi * share);
            const std::size_t cell = injected_.index(cellOf(texel.position + texel.normal * (kInFront * volume_.cellSize)));
            for (int c = 0; c < kChannels; ++c)
                for (int k = 0; k < kBands; ++k) injected_.plane(c * kBands + k)[cell] += lobe[k] * texel.flux[c];
        }
    }

    // The geometry volume: a grid half a cell off, whose points are the corners of cells, keeps how much of a cell's side
    // is blocked for light that travels along a direction. In place of surfels from the maps, which see what lights and camera see, it is
    // made of samples of all surfaces. What is kept is the share of each link that stays open: blockers at the middle of the face
    // between two cells are the mean of its four corners'.
    void findBlockers() {
        const SurfaceSamples surfaces = sampleSurfaces(world_->scene, kBlockers * settings_.resolution * settings_.resolution, 1, world_->parallelFor);
        Planes blocked(volume_.resolution + 1, kBands);
        const ivec3 lastCorner = volume_.resolution;
        for (std::size_t k = 0; k < surfaces.receivers.size(); ++k) {
            const ClvReceiver& surfel = surfaces.receivers[k];
            const vec3 place = (surfel.position - volume_.origin) / volume_.cellSize;
            const ivec3 corner = clamp(ivec3(floor(place + 0.5f)), ivec3(0), lastCorner);
            const vec4 lobe = cosineLobe(-surfel.normal) * (surfaces.area / (volume_.cellSize * volume_.cellSize));
            for (int band = 0; band < kBands; ++band) blocked.plane(band)[blocked.index(corner)] += lobe[band];
        }
        open_ = Planes(volume_.resolution, kLinks + 1);
        std::fill_n(open_.plane(kLinks), open_.index(volume_.resolution), 1.0f);
        forRows([&](int y, int z) {
            for (int x = 0; x < volume_.resolution.x; ++x) {
                const ivec3 cell(x, y, z);
                for (int l = 0; l < kLinks; ++l) {
                    // Light comes into this cell through the face on the other side of where it travels to.
                    const int axis = links_[l].travel / 2, b = (axis + 1) % 3, c = (axis + 2) % 3;
                    ivec3 corner = cell;
                    corner[axis] += links_[l].travel % 2;
                    vec4 mean(0.0f);
                    for (int k = 0; k < 4; ++k) {
                        ivec3 at = corner;
                        at[b] += k % 2, at[c] += k / 2;
                        for (int band = 0; band < kBands; ++band) mean[band] += 0.25f * blocked.plane(band)[blocked.index(at)];
                    }
                    open_.plane(l)[open_.index(cell)] = 1.0f - clamp(settings_.blocking * dot(mean, links_[l].basis), 0.0f, 1.0f);
                }
            }
        });
    }

    template <class Body>
    void forRows(const Body& body) const {
        const std::size_t rows = std::size_t(volume_.resolution.y) * volume_.resolution.z;
        forPieces(*world_, rows, 16, [&](std::size_t row) { body(int(row) % volume_.resolution.y, int(row) / volume_.resolution.y); });
    }

    // One step: what each cell gets from its six neighbours, face by face, goes on from its middle as a lobe towards that face whose
    // flux is the same. No blockers in the first step, for the sake of the surfaces that the light comes from.
    void propagate(bool blocked) {
        forRows([&](int y, int z) {
            const std::size_t first = passed_.index(ivec3(0, y, z));
            for (int c = 0; c < kChannels; ++c) propagateRow(first, c, blocked);
        });
    }
    void propagateRow(std::size_t first, int channel, bool blocked) {
        constexpr int kBlock = 64;  // cells side by side: loops over them run in vectors
        const int width = volume_.resolution.x;
        for (int begin = 0; begin < width; begin += kBlock) {
            const int count = std::min(kBlock, width - begin);
            float flux[kFaces][kBlock] = {};  // W, onto each face
            for (int l = 0; l < kLinks; ++l) {
                const Link& link = links_[l];
                const vec4 basis = link.basis * link.solidAngle;
                const std::size_t from = first + begin - passed_.step(link.travel);
                const float* const i0 = passed_.plane(channel * kBands) + from;
                const float* const i1 = passed_.plane(channel * kBands + 1) + from;
                const float* const i2 = passed_.plane(channel * kBands + 2) + from;
                const float* const i3 = passed_.plane(channel * kBands + 3) + from;
                const float* const open = open_.plane(blocked ? l : kLinks) + first + begin;
                float* __restrict onto = flux[link.face];
                for (int x = 0; x < count; ++x) {
                    onto[x] += open[x] * std::max(0.0f, basis.x * i0[x] + basis.y * i1[x] + basis.z * i2[x] + basis.w * i3[x]);
                }
            }
            for (int k = 0; k < kBands; ++k) {
                float* __restrict next = next_.plane(channel * kBands + k) + first + begin;
                float* __restrict sum = sum_.plane(channel * kBands + k) + first + begin;
                const float lobe[kFaces] = {lobes_[0][k], lobes_[1][k], lobes_[2][k], lobes_[3][k], lobes_[4][k], lobes_[5][k]};
                for (int x = 0; x < count; ++x) {
                    next[x] = lobe[0] * flux[0][x] + lobe[1] * flux[1][x] + lobe[2] * flux[2][x] + lobe[3] * flux[3][x] + lobe[4] * flux[4][x] + lobe[5] * flux[5][x];
                    sum[x] += next[x];
                }
            }
        }
    }

    using Intensity = std::array<vec4, kChannels>;  // W/sr, a channel each

    // Trilinear between eight cells.
    Intensity read(const vec3& position) const {
        const vec3 place = (position - volume_.origin) / volume_.cellSize - 0.5f;
        const ivec3 low(floor(clamp(place, vec3(0.0f), vec3(volume_.resolution - 1))));
        const vec3 f = clamp(place - vec3(low), 0.0f, 1.0f);
        Intensity intensity{};
        for (int k = 0; k < 8; ++k) {
            const ivec3 step(k & 1, k >> 1 & 1, k >> 2);
            const vec3 share = mix(vec3(1.0f) - f, f, vec3(step));
            const std::size_t cell = sum_.index(low + step);
            for (int c = 0; c < kChannels; ++c)
                for (int band = 0; band < kBands; ++band) intensity[c][band] += share.x * share.y * share.z * sum_.plane(c * kBands + band)[cell];
        }
        return intensity;
    }

    vec3 lookUp(const ReferencePoint& receiver) const {
        const vec3 ahead = receiver.normal * (kInFront * volume_.cellSize);
        const vec3 at = receiver.position + ahead;
        const Intensity intensity = read(at);
        // Light travels towards the surface. The flux per solid angle through a cell is its radiance times what the cell shows.
        const vec4 weight = cosineLobe(-receiver.normal) / (kShownSide * volume_.cellSize * volume_.cellSize);
        vec3 irradiance(0.0f);
        for (int c = 0; c < kChannels; ++c) irradiance[c] = dot(weight, intensity[c]);
        if (settings_.damped) {
            // What falls off along the normal is the surface's own light: damped as far as slope and intensity turn from each other.
            const Intensity front = read(at + ahead), behind = read(at - ahead);
            for (int c = 0; c < kChannels; ++c) {
                const vec4 slope = front[c] - behind[c];
                const float lengths = length(slope) * length(intensity[c]);
                irradiance[c] *= lengths > 0.0f ? std::max(0.0f, dot(slope, intensity[c]) / lengths) : 1.0f;
            }
        }
        return max(irradiance, vec3(0.0f));
    }

    static std::array<vec4, kFaces> makeLobes() {
        std::array<vec4, kFaces> lobes;
        for (int face = 0; face < kFaces; ++face) lobes[face] = cosineLobe(faceNormal(face)) * kClvInvPi;
        return lobes;
    }

    const LightPropagationSettings settings_;
    const std::array<Link, kLinks> links_ = makeLinks();
    const std::array<vec4, kFaces> lobes_ = makeLobes();  // 1/sr: intensity for a unit of flux onto a face
    std::optional<MethodWorld> world_;
    std::vector<ReferencePoint> receivers_;
    ClvVolume volume_{};
    Planes injected_, passed_, next_, sum_;  // W/sr: put in, under way, after the next step, and of all steps
    Planes open_;                            // a link each into a cell: the share that blockers let through; and one without blockers

    std::optional<LightMaps> maps_;
    std::span<const ClvRsmTexel> texels_;
    std::uint32_t frames_ = 0;
};

}  // namespace

std::unique_ptr<Method> makeLightPropagation(const LightPropagationSettings& settings) {
    return std::make_unique<LightPropagation>(settings);
}

}  // namespace clv
