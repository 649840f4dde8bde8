// Irradiance of a whole picture from lookups at few of its pixels.
#ifndef CLV_CPU_PICTURE_LOOKUP_H
#define CLV_CPU_PICTURE_LOOKUP_H
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "evaluate.h"
#include "parallel.h"

namespace clv {

// Looked up are every `spacing`-th pixel across and down, the last row and column among them. A pixel between them is bilinear among those of
// the four around it that lie on its own surface; where none of them does, it is looked up itself. Everything but the lookups is found once, for a
// camera that stands still.
class PictureLookup {
public:
    PictureLookup() = default;
    // What each pixel sees, row by row: its normal is 0 where that is nothing. `spacing` > 0.
    PictureLookup(std::span<const ClvReceiver> pixels, int width, int spacing, const ParallelFor& parallelFor)
        : width_(width), height_(int(pixels.size()) / width), spacing_(spacing), columns_(gridSize(width)), rows_(gridSize(height_)), shares_(pixels.size()) {
        assert(spacing > 0 && pixels.size() == std::size_t(width) * height_);
        for (int row = 0; row < rows_; ++row) {
            for (int column = 0; column < columns_; ++column) gridPoint_.push_back(addPoint(pixels[pixelAt(column, row)]));
        }
        std::vector<std::vector<uint>> alone(height_);
        parallelFor(alone.size(), [&](std::size_t y) {
            for (int x = 0; x < width_; ++x) {
                const std::size_t pixel = y * width_ + x;
                if (seesNothing(pixels[pixel])) continue;
                shares_[pixel] = sharesAt(pixels, x, int(y));
                if (shares_[pixel] == Shares{}) alone[y].push_back(uint(pixel));
            }
        });
        for (const auto& row : alone) {
            for (const uint pixel : row) alone_.push_back({pixel, addPoint(pixels[pixel])});
        }
    }

    int width() const { return width_; }
    int height() const { return height_; }
    // Where irradiance is to be looked up.
    std::span<const ClvReceiver> points() const { return points_; }
    std::size_t bytes() const { return points_.size() * sizeof(ClvReceiver) + shares_.size() * sizeof(Shares) + gridPoint_.size() * sizeof(uint) + alone_.size() * sizeof(Alone); }

    // W/m^2 of every pixel from that at points(), 0 where nothing is seen.
    void irradiance(std::span<const vec3> atPoints, std::span<vec3> out, const ParallelFor& parallelFor) const {
        assert(atPoints.size() == points_.size() && out.size() == shares_.size());
        constexpr int kRows = 16;
        parallelFor(std::size_t(height_ + kRows - 1) / kRows, [&](std::size_t piece) {
            for (int y = int(piece) * kRows; y < std::min(height_, int(piece + 1) * kRows); ++y) fillRow(atPoints, y, out);
        });
        constexpr std::size_t kPiece = 4096;
        parallelFor((alone_.size() + kPiece - 1) / kPiece, [&](std::size_t piece) {
            for (std::size_t i = piece * kPiece; i < std::min(alone_.size(), (piece + 1) * kPiece); ++i) out[alone_[i].pixel] = atPoints[alone_[i].point];
        });
    }

private:
    static constexpr uint kNoPoint = ~0u;
    // Of the four around a pixel, in 255ths: they sum to 255, or are all 0.
    using Shares = std::array<std::uint8_t, 4>;
    struct Alone {
        uint pixel, point;
    };

    int gridSize(int pixels) const { return (pixels - 1 + spacing_ - 1) / spacing_ + 1; }
    static bool seesNothing(const ClvReceiver& pixel) { return pixel.normal == vec3(0.0f); }
    std::size_t pixelAt(int column, int row) const {
        return std::size_t(std::min(row * spacing_, height_ - 1)) * width_ + std::min(column * spacing_, width_ - 1);
    }
    uint addPoint(const ClvReceiver& pixel) {
        if (seesNothing(pixel)) return kNoPoint;
        points_.push_back(pixel);
        return uint(points_.size() - 1);
    }

    // Whether light at b can stand for that at a: each lies in the other's plane, about, and faces the same way.
    static bool onOneSurface(const ClvReceiver& a, const ClvReceiver& b) {
        constexpr float kLeastCosine = 0.9f, kSteepest = 0.1f;
        const vec3 between = b.position - a.position;
        const float most = kSteepest * length(between);
        return dot(a.normal, b.normal) >= kLeastCosine && std::abs(dot(a.normal, between)) <= most && std::abs(dot(b.normal, between)) <= most;
    }

    // Column and row of the first of the four around a pixel.
    ivec2 corner(int x, int y) const { return ivec2(std::min(x / spacing_, std::max(0, columns_ - 2)), std::min(y / spacing_, std::max(0, rows_ - 2))); }
    std::array<std::size_t, 4> corners(const ivec2& c) const {
        const int right = std::min(c.x + 1, columns_ - 1), below = std::min(c.y + 1, rows_ - 1);
        const auto at = [&](int column, int row) { return std::size_t(row) * columns_ + column; };
        return {at(c.x, c.y), at(right, c.y), at(c.x, below), at(right, below)};
    }

    Shares sharesAt(std::span<const ClvReceiver> pixels, int x, int y) const {
        const ivec2 c = corner(x, y);
        const auto along = [&](int pixel, int cell, int last) {
            const int first = cell * spacing_;
            return float(pixel - first) / float(std::max(1, std::min(first + spacing_, last) - first));
        };
        const float u = along(x, c.x, width_ - 1), v = along(y, c.y, height_ - 1);
        // Each counts a little everywhere, so that one alone serves the pixels in line with the others.
        constexpr float kLeast = 1e-3f;
        std::array<float, 4> weight{(1 - u) * (1 - v) + kLeast, u * (1 - v) + kLeast, (1 - u) * v + kLeast, u * v + kLeast};
        float sum = 0.0f;
        const auto corner = corners(c);
        for (int k = 0; k < 4; ++k) {
            const uint point = gridPoint_[corner[k]];
            if (point == kNoPoint || !onOneSurface(pixels[std::size_t(y) * width_ + x], points_[point])) weight[k] = 0.0f;
            sum += weight[k];
        }
        if (sum == 0.0f) return {};
        Shares shares{};
        int left = 255;
        for (int k = 0; k < 4; ++k) {
            shares[k] = std::uint8_t(std::lround(255.0f * weight[k] / sum));
            left -= shares[k];
        }
        *std::max_element(shares.begin(), shares.end()) += std::uint8_t(left);
        return shares;
    }

    void fillRow(std::span<const vec3> atPoints, int y, std::span<vec3> out) const {
        for (int x = 0; x < width_;) {
            const ivec2 c = corner(x, y);
            const int end = c.x >= columns_ - 2 ? width_ : (c.x + 1) * spacing_;
            std::array<vec3, 4> light;
            const auto corner = corners(c);
            for (int k = 0; k < 4; ++k) {
                const uint point = gridPoint_[corner[k]];
                light[k] = point == kNoPoint ? vec3(0.0f) : atPoints[point] * (1.0f / 255.0f);
            }
            for (; x < end; ++x) {
                const Shares& s = shares_[std::size_t(y) * width_ + x];
                out[std::size_t(y) * width_ + x] = light[0] * float(s[0]) + light[1] * float(s[1]) + light[2] * float(s[2]) + light[3] * float(s[3]);
            }
        }
    }

    int width_ = 0, height_ = 0, spacing_ = 1;
    int columns_ = 0, rows_ = 0;
    std::vector<ClvReceiver> points_;
    std::vector<uint> gridPoint_;  // a point of the grid each: its index in points_, or kNoPoint
    std::vector<Shares> shares_;   // a pixel each
    std::vector<Alone> alone_;     // pixels that are looked up themselves
};

}  // namespace clv
#endif
