#include "benchmarks/gpu_run/ray_cases.h"

#include "benchmarks/gpu_run/cpu_scene.h"
#include "clv/plan/map_faces.h"

namespace clv {
namespace {

// Where maps are drawn, texels at outlines differ, with pictures of kFaceSide^2 texels.
constexpr std::uint32_t kFaceSide = 192;
constexpr double kOutlines = 0.03;
// Where a guide prefers directions, rays next to the border between two candidates take either.
constexpr double kChoices = 0.01;

// Maps, rays where they begin and end, and what they meet.
StoredCase traceCase(const CpuScene& cpu, const std::string& name) {
    StoredCase stored{.name = name, .settings = cpu.settings(kFewRays), .steps = {"rsm", "light"}, .buffers = cpu.sceneBuffers()};
    cpu.addScene(stored.settings);
    stored.settings.keepHits = true;
    stored.buffers.push_back(buffer("frame", cpu.constants(stored.settings)));
    std::vector<ClvHit> hits;
    const std::vector<ClvRay> rays = cpu.rays(kFewRays, &hits);
    stored.checks = {cpu.mapCheck(kExceptions), cpu.check("rays", rays, offsetof(ClvRay, flux), kExceptions), cpu.check("hits", hits, sizeof(ClvHit), kExceptions)};
    return stored;
}

// The same maps, drawn.
StoredCase drawnCase(const CpuScene& cpu) {
    StoredCase stored{.name = "drawn_maps", .settings = cpu.settings(kFewRays), .steps = {"rsm", "light"}, .buffers = cpu.sceneBuffers()};
    const std::vector<ClvMapFace> faces = mapFaces(cpu.lights, cpu.scene.bounds.lo, cpu.scene.bounds.hi, kFaceSide);
    cpu.addScene(stored.settings);
    stored.settings.mapFaces = std::uint32_t(faces.size()), stored.settings.faceSide = kFaceSide;
    ClvFrame constants = cpu.constants(stored.settings);
    constants.faceCount = stored.settings.mapFaces, constants.faceSide = kFaceSide;
    stored.buffers.push_back(buffer("frame", constants));
    stored.buffers.push_back(buffer("map faces", faces));
    stored.checks = {cpu.mapCheck(kOutlines)};
    return stored;
}

// Rays that go where earlier ones met something.
StoredCase guidedCase(const CpuScene& cpu) {
    StoredCase stored{.name = "guided_rays", .settings = cpu.settings(kFewRays), .steps = {"rsm", "light"}, .buffers = cpu.sceneBuffers()};
    RayGuide guide(cpu.scene.bounds.lo, cpu.scene.bounds.hi);
    guide.learn(cpu.rays(kManyRays));
    guide.finish();
    if (!guide.worthwhile()) throw std::runtime_error("the guided case needs a scene from which rays leave");
    cpu.addScene(stored.settings);
    stored.settings.guideCells = guide.cells().size(), stored.settings.guideRows = guide.weights().size() / kClvGuideRow;
    stored.buffers.push_back(buffer("frame", cpu.constants(stored.settings)));
    stored.buffers.push_back(buffer("guide", guide.grid()));
    stored.buffers.push_back(buffer("guide cells", std::span<const uint>(guide.cells())));
    stored.buffers.push_back(buffer("guide weights", std::span<const float>(guide.weights())));
    TexelSampler sampler;
    sampler.build(cpu.texels, int(kRsmSide), serialFor(), &guide);
    stored.checks = {cpu.check("rays", cpu.rays(sampler, kFewRays), offsetof(ClvRay, flux), kChoices)};
    return stored;
}

// The Cornell box with chequered walls.
Scene paintedCornell() {
    Scene scene = makeBuiltinScene("cornell");
    Texture paint{.name = "paint", .width = 4, .height = 4, .texels = {}};
    for (int i = 0; i < 16; ++i) paint.texels.push_back(glm::vec3((i + i / 4) % 2 == 0 ? 0.9f : 0.2f));
    scene.textures = {paint};
    for (Material& material : scene.materials) material.texture = 0;
    for (const glm::vec3& p : scene.positions) scene.uvs.push_back(glm::vec2(p.x + 0.5f * p.z, 0.7f * p.y - p.z));
    return scene;
}

}  // namespace

std::vector<StoredCase> rayCases() {
    const CpuScene rooms(makeBuiltinScene("two_rooms")), atrium(makeBuiltinScene("atrium")), painted(paintedCornell());
    return {traceCase(rooms, "trace"), traceCase(painted, "trace_textured"), drawnCase(rooms), guidedCase(atrium)};
}

}  // namespace clv
