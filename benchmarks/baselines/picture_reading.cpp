#include "benchmarks/baselines/picture_reading.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bindings/embree/visible_points.h"
#include "clv/cpu/picture_lookup.h"

namespace clv {
namespace {

// The pixel of a camera's picture that a point lies in, if it is seen there: nothing stands before it.
std::optional<std::size_t> pixelOf(const EmbreeScene& scene, const Camera& camera, const glm::vec3& position) {
    const glm::vec3 towards = position - camera.position;
    const float depth = dot(towards, camera.forward), tangent = std::tan(0.5f * camera.yfov);
    if (!(depth > 0.0f)) return {};
    const float across = dot(towards, cross(camera.forward, camera.up)) / (depth * tangent) * float(kPictureHeight) / float(kPictureWidth);
    const float upwards = dot(towards, camera.up) / (depth * tangent);
    const int x = int(std::floor(0.5f * (across + 1.0f) * kPictureWidth)), y = int(std::floor(0.5f * (1.0f - upwards) * kPictureHeight));
    if (x < 0 || x >= kPictureWidth || y < 0 || y >= kPictureHeight) return {};
    const float distance = length(towards);
    constexpr float kNear = 1e-3f;  // of the distance, that a hit may lie before the point
    if (scene.hit(camera.position, towards / distance, kClvFar).distance < (1.0f - kNear) * distance) return {};
    return std::size_t(y) * kPictureWidth + x;
}

class PictureReading : public Method {
public:
    PictureReading(std::unique_ptr<Method> method, int spacing) : method_(std::move(method)), spacing_(spacing) {}

    std::string name() const override { return method_->name(); }
    MethodSettings settings() const override {
        MethodSettings all = method_->settings();
        all.emplace_back("pixels", "1 in " + std::to_string(spacing_ * spacing_));
        return all;
    }

    void prepare(const MethodWorld& world, std::span<const ReferencePoint> receivers) override {
        world_.emplace(world);
        std::vector<ReferencePoint> points;
        place_.assign(receivers.size(), {});
        for (const Camera& camera : world.scene.scene().cameras) addPicture(camera, receivers, points);
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            if (place_[i].picture != kNowhere) continue;
            place_[i].index = points.size();
            points.push_back(receivers[i]);
        }
        atPoints_.resize(points.size());
        pixels_.resize(std::size_t(kPictureWidth) * kPictureHeight);
        method_->prepare(world, points);
    }
    void restart(std::uint32_t seed) override { method_->restart(seed); }
    void renderMaps() override { method_->renderMaps(); }
    void frame(std::size_t rays) override { method_->frame(rays); }

    void irradiance(std::span<glm::vec3> out) override {
        method_->irradiance(atPoints_);
        for (std::size_t k = 0; k < pictures_.size(); ++k) {
            fill(k);
            for (std::size_t i = 0; i < out.size(); ++i) {
                if (place_[i].picture == k) out[i] = pixels_[place_[i].index];
            }
        }
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (place_[i].picture == kNowhere) out[i] = atPoints_[place_[i].index];
        }
    }

    std::size_t picturePixels() const override { return pictures_.empty() ? 0 : pictures_.front().seen; }
    void readPicture() override {
        method_->irradiance(std::span(atPoints_).first(pictures_.front().lookup.points().size()));
        fill(0);
    }

    std::size_t bytes() const override { return method_->bytes() + (pictures_.empty() ? 0 : pictures_.front().lookup.bytes()); }
    std::uint64_t raysTraced() const override { return method_->raysTraced(); }

private:
    static constexpr std::size_t kNowhere = ~std::size_t(0);
    struct Picture {
        PictureLookup lookup;
        std::size_t first = 0;  // of its points among all
        std::size_t seen = 0;   // pixels with a surface
    };
    // Of a receiver: the pixel of a picture, or its own point.
    struct Place {
        std::size_t picture = kNowhere, index = 0;
    };

    // Receivers take the place of the pixels in which they lie, one a pixel.
    void addPicture(const Camera& camera, std::span<const ReferencePoint> receivers, std::vector<ReferencePoint>& points) {
        std::vector<ClvReceiver> pixels(std::size_t(kPictureWidth) * kPictureHeight, ClvReceiver{vec3(0.0f), 0.0f, vec3(0.0f), 0.0f});
        const auto surfaces = visibleSurfaces(world_->scene, camera, kPictureWidth, kPictureHeight, world_->parallelFor);
        for (const VisibleSurface& s : surfaces) pixels[s.pixel] = {s.point.position, 0.0f, s.point.normal, 0.0f};
        std::vector<bool> taken(pixels.size(), false);
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            if (place_[i].picture != kNowhere) continue;
            const auto pixel = pixelOf(world_->scene, camera, receivers[i].position);
            if (!pixel || taken[*pixel]) continue;
            taken[*pixel] = true;
            pixels[*pixel] = {receivers[i].position, 0.0f, receivers[i].normal, 0.0f};
            place_[i] = {pictures_.size(), *pixel};
        }
        Picture& picture = pictures_.emplace_back(Picture{PictureLookup(pixels, kPictureWidth, spacing_, world_->parallelFor), points.size(), surfaces.size()});
        for (const ClvReceiver& r : picture.lookup.points()) points.push_back({r.position, r.normal});
    }

    void fill(std::size_t k) {
        const Picture& picture = pictures_[k];
        picture.lookup.irradiance(std::span(atPoints_).subspan(picture.first, picture.lookup.points().size()), pixels_, world_->parallelFor);
    }

    const std::unique_ptr<Method> method_;
    const int spacing_;
    std::optional<MethodWorld> world_;
    std::vector<Picture> pictures_;       // a camera each
    std::vector<Place> place_;            // a receiver each
    std::vector<glm::vec3> atPoints_;     // W/m^2: points of all pictures, and of what no camera sees
    std::vector<glm::vec3> pixels_;       // W/m^2, of one picture
};

}  // namespace

std::unique_ptr<Method> makePictureReading(std::unique_ptr<Method> method, int spacing) {
    return std::make_unique<PictureReading>(std::move(method), spacing);
}

}  // namespace clv
