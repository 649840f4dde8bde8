// A scene on the host and on the device, with the steps of the library's frame that come before its levels.
#ifndef CLV_TESTS_VULKAN_TRACED_SCENE_H
#define CLV_TESTS_VULKAN_TRACED_SCENE_H
#include <cstring>
#include <optional>

#include "bindings/embree/embree_scene.h"
#include "bindings/vulkan/vulkan_frame.h"
#include "clv/cpu/ray_guide.h"
#include "clv/plan/light_frame.h"
#include "clv/plan/map_faces.h"
#include "clv/plan/triangle_corners.h"
#include "support/scene_reader.h"

namespace clv::test {

struct TracedScene {
    Scene scene;
    EmbreeScene embree;
    Bvh bvh;
    SurfaceRows rows;
    std::vector<ClvLight> lights;
    std::vector<ClvMapFace> faces;
    ClvFrame constants{};
    LightFrameSettings settings;
    std::optional<RayGuide> guide;
    VulkanDevice device{{.device = "", .floatAtomics = true, .rayQueries = true, .rayPipelines = true, .validate = true}};

    TracedScene(Scene source, std::uint32_t side, std::uint32_t rays, bool keepHits)
        : scene(std::move(source)), embree(scene), bvh(buildBvh(scene)), rows(surfaceRowsOf(scene)) {
        for (const NamedLight& light : scene.lights) lights.push_back(light.light);
        constants.boundsLo = scene.bounds.lo, constants.boundsHi = scene.bounds.hi;
        constants.rayCount = rays, constants.halves = 2, constants.halfStep = rays / 2, constants.seed = 3;
        constants.rsmPass = 2, constants.rsmSeed = 5, constants.rsmSide = side, constants.texelRows = uint(lights.size()) * side;
        constants.originOffset = embree.surfaceOffset(), constants.triangleCount = uint(bvh.triangles.size() / kClvTriangleRows);
        settings.lights = lights.size(), settings.rsmSide = side, settings.rays = rays, settings.halves = 2, settings.keepHits = keepHits;
        settings.triangles = scene.triangles.size(), settings.bvhNodes = bvh.children.size(), settings.textureTexels = rows.textureTexels.size();
    }

    void guideBy(const RayGuide& learnt) {
        guide = learnt;
        settings.guideCells = learnt.cells().size(), settings.guideRows = learnt.weights().size() / kClvGuideRow;
    }

    // The maps are drawn, in pictures of faceSide^2 texels, instead of traced.
    void drawMaps(std::uint32_t faceSide) {
        faces = mapFaces(lights, scene.bounds.lo, scene.bounds.hi, faceSide);
        settings.mapFaces = constants.faceCount = std::uint32_t(faces.size());
        settings.faceSide = constants.faceSide = faceSide;
    }

    // Rays find triangles in the device's acceleration structure.
    void traceBy(TraceWay way) {
        settings.trace = way;
        settings.accelerationBytes = device.accelerationBytes(settings.triangles);
    }

    SceneReader reader() const { return {bvh, rows}; }

    template <class Executor>
    void uploadScene(Executor& vulkan) const {
        vulkan.upload("frame", constants);
        if (settings.lights > 0) vulkan.upload("lights", std::span<const ClvLight>(lights));
        if (settings.trace == TraceWay::walk) {
            vulkan.upload("bvh boxes", std::span<const vec4>(bvh.boxes));
            vulkan.upload("bvh children", std::span<const uvec4>(bvh.children));
        } else {
            vulkan.upload("corners", std::span<const vec3>(triangleCorners(bvh.triangles, settings.triangles)));
            vulkan.run("scene");
        }
        vulkan.upload("triangles", std::span<const vec4>(bvh.triangles));
        vulkan.upload("surfaces", std::span<const vec4>(rows.surfaces));
        if (!faces.empty()) vulkan.upload("map faces", std::span<const ClvMapFace>(faces));
        if (settings.textureTexels > 0) {
            vulkan.upload("texture rows", std::span<const uvec4>(rows.textureRows));
            vulkan.upload("texture texels", std::span<const vec4>(rows.textureTexels));
        }
        if (guide) {
            vulkan.upload("guide", guide->grid());
            vulkan.upload("guide cells", std::span<const uint>(guide->cells()));
            vulkan.upload("guide weights", std::span<const float>(guide->weights()));
        }
    }

    struct Results {
        std::vector<ClvRsmTexel> texels;
        std::vector<float> sums;
        std::vector<ClvRay> rays;
        std::vector<ClvHit> hits;
    };
    // `emitters`: in place of maps, where the settings say so.
    Results run(ShaderLanguage language, std::span<const ClvRsmTexel> emitters = {}) {
        Frame frame = lightFrame(settings);
        for (FrameBuffer& buffer : frame.buffers) buffer.readBack = buffer.readBack || (buffer.source == FrameSource::passes && !buffer.isImage() && !buffer.isAcceleration());
        VulkanFrame vulkan(device, frame, language);
        uploadScene(vulkan);
        if (settings.emitters > 0) vulkan.upload("texels", emitters);
        vulkan.run("rsm");
        vulkan.run("light");
        Results results;
        const std::size_t height = constants.texelRows;
        results.texels.resize(height * settings.rsmSide);
        results.sums.resize(height * (settings.rsmSide + 1) + height + 1);
        results.rays.resize(settings.rays);
        if (settings.lights > 0) vulkan.download("texels", std::span(results.texels));
        vulkan.download("texel sums", std::span(results.sums));
        vulkan.download("rays", std::span(results.rays));
        if (settings.keepHits) {
            results.hits.resize(settings.rays);
            vulkan.download("hits", std::span(results.hits));
        }
        return results;
    }
};

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

// The same run in both languages, compared to the bit; the validation layer must be silent.
inline TracedScene::Results runInBothLanguages(TracedScene& traced, std::span<const ClvRsmTexel> emitters = {}) {
    const TracedScene::Results glsl = traced.run(ShaderLanguage::glsl, emitters), hlsl = traced.run(ShaderLanguage::hlsl, emitters);
    EXPECT_TRUE(sameBits(glsl.texels, hlsl.texels));
    EXPECT_TRUE(sameBits(glsl.sums, hlsl.sums));
    EXPECT_TRUE(sameBits(glsl.rays, hlsl.rays));
    EXPECT_TRUE(sameBits(glsl.hits, hlsl.hits));
    EXPECT_EQ(traced.device.messages(), std::vector<std::string>());
    return glsl;
}

// The Cornell box with walls of chequered paint.
inline Scene paintedCornell() {
    Scene scene = makeBuiltinScene("cornell");
    Texture paint{.name = "paint", .width = 5, .height = 3, .texels = {}};
    for (int i = 0; i < 15; ++i) paint.texels.push_back(glm::vec3(float(i % 5) / 4.0f, float(i / 5) / 2.0f, 0.5f));
    scene.textures = {Texture{.name = "unused", .width = 1, .height = 1, .texels = {glm::vec3(7.0f)}}, paint};
    for (std::size_t m = 0; m < scene.materials.size(); m += 2) scene.materials[m].texture = 1;
    for (const glm::vec3& p : scene.positions) scene.uvs.push_back(glm::vec2(p.x + 0.5f * p.z, 0.7f * p.y - p.z));
    return scene;
}

}  // namespace clv::test
#endif
