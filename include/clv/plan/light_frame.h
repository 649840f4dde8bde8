// The library's own frame for still light on the GPU: rsm -> rays -> trace -> inject -> merge, and evaluate.
#ifndef CLV_PLAN_LIGHT_FRAME_H
#define CLV_PLAN_LIGHT_FRAME_H
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "../data/bvh.h"
#include "../data/cell.h"
#include "../data/frame.h"
#include "../data/hit.h"
#include "../data/light.h"
#include "../data/picture.h"
#include "../data/ray.h"
#include "../data/rsm_texel.h"
#include "../data/surface.h"
#include "../stages/evaluate.h"
#include "../stages/gather.h"
#include "../stages/map_face.h"
#include "../stages/merge.h"
#include "../stages/ray_guide.h"
#include "../stages/slices.h"
#include "frame.h"
#include "frame_check.h"

namespace clv {

// How crossings are added up.
enum class InjectWay {
    bricks,        // each slot gathers the rays of its brick of 2^3 cells, shared by shuffles; track lengths only
    bricksPlain,   // the same without subgroups
    floatAtomics,  // each ray adds to what it crosses
    fixedPoint,    // the same with integers: the same to the last bit from run to run, where the others depend on the order
    slices,        // as the thesis did it: lines drawn into slices; kClvInjectThesis and kClvStorageCube alone, and all slots of a cell get its light
};

// How rays find the nearest triangle.
enum class TraceWay {
    walk,      // through the tree of data/bvh.h, in the shader
    query,     // ray queries of the graphics API in an acceleration structure of its own; GLSL alone
    pipeline,  // ray-tracing pipelines of the graphics API in the same; GLSL alone
};

inline bool gathers(InjectWay way) { return way == InjectWay::bricks || way == InjectWay::bricksPlain; }

struct LightFrameLevel {
    ClvVolume volume{};
    std::uint64_t cells = 0, splits = 0, slots = 0;
    std::array<uint, kClvMostSplits + 1> groupEnds{};  // see BrickSlots; used by gathers alone
    std::uint64_t lookupEntries = 0;   // slots that all receivers read together
};

struct LightFrameSettings {
    // Without lights and emitters the frame begins with rays that the host, or the engine's own tracer, has written and cut.
    std::uint64_t lights = 0, rsmSide = 0, triangles = 0, bvhNodes = 0;
    std::uint64_t emitters = 0;        // texels that the host writes in place of the lights' maps, in rows of rsmSide
    bool sharedRays = false;           // without lights and emitters: the rays are another frame's
    std::uint64_t textureTexels = 0;   // of all textures together; 0: a scene without any
    std::uint32_t mapFaces = 0, faceSide = 0;  // > 0: reflective shadow maps are drawn, in so many pictures; see plan/map_faces.h
    std::uint64_t rays = 0;            // a frame
    std::uint64_t receivers = 0;       // 0: no evaluate step
    std::uint32_t halves = 1, storage = kClvStorageCube9, channels = 3;
    uvec2 picture{0};                  // pixels; not 0: a picture step, which needs lights
    bool turned = false;               // cells keep directions along ClvFrame's axes, not along those of the grid
    std::uint32_t rule = kClvInjectTrackLength;
    std::uint64_t guideCells = 0, guideRows = 0;  // of what guides the rays; 0: nothing does
    bool movingLights = false;         // history gives way by dynamicity, not by ClvLevelFrame::weight; InjectWay::floatAtomics and fixedPoint alone
    TraceWay trace = TraceWay::walk;
    std::uint64_t accelerationBytes = 0;  // but of TraceWay::walk: what the graphics API wants for an acceleration structure of the triangles
    bool keepHits = false;             // further bounces need to know what rays met
    InjectWay inject = InjectWay::bricks;
    FrameFormat sliceFormat = FrameFormat::rgba32Float;  // of InjectWay::slices; rgba16Float, sums up to 65504 W, where a device cannot add up 32 bits
    std::vector<LightFrameLevel> levels;
};

// Floats of a slot's record: its coefficients times its channels, padded to whole vectors of eight.
inline std::uint32_t frameStride(const LightFrameSettings& settings) {
    return (clvCoefficientCount(settings.storage) * settings.channels + 7u) / 8u * 8u;
}

// Cells keep directions along the rows of `axes`, an orthonormal matrix; for frames whose settings are `turned`.
inline void keepDirectionsAlong(const mat3& axes, ClvFrame& frame) {
    const mat3 rows = glm::transpose(axes);
    frame.axisX = rows[0], frame.axisY = rows[1], frame.axisZ = rows[2];
}

// Bricks that a straight line crosses at most.
inline std::uint64_t frameBricksOfRay(const ClvVolume& volume) {
    const ivec3 bricks = clvBrickCounts(volume);
    return std::uint64_t(bricks.x + bricks.y + bricks.z - 2);
}

// Entries that the brick lists can need at most.
inline std::uint64_t frameListCapacity(const LightFrameSettings& settings, const ClvVolume& volume) {
    return settings.rays * frameBricksOfRay(volume);
}

// The most rays that a frame with otherwise these settings can have on a device with these limits; a host that wants more runs the
// light step in rounds.
inline std::uint64_t largestFrameRays(const LightFrameSettings& settings, const FrameLimits& limits = {}) {
    std::uint64_t rays = limits.storageBytes / sizeof(ClvRay);
    if (settings.inject == InjectWay::slices) {
        for (const LightFrameLevel& level : settings.levels) rays = std::min(rays, limits.storageBytes / (std::uint64_t(level.volume.resolution.z) * sizeof(uint)));
    }
    if (gathers(settings.inject)) {
        rays = std::min<std::uint64_t>(rays, limits.texelElements * sizeof(vec4) / sizeof(ClvRay));
        for (const LightFrameLevel& level : settings.levels) rays = std::min(rays, limits.storageBytes / (frameBricksOfRay(level.volume) * sizeof(uint)));
    }
    return rays / settings.halves * settings.halves;
}

namespace detail {

class LightFrameBuilder {
public:
    explicit LightFrameBuilder(const LightFrameSettings& settings) : s_(settings) {}

    Frame build() {
        const auto frame = add("frame", CLV_BIND_FRAME, sizeof(ClvFrame), FrameSource::host);
        const bool draws = s_.lights > 0 || s_.emitters > 0;
        const FrameSource source = draws ? FrameSource::passes : s_.sharedRays ? FrameSource::shared : FrameSource::host;
        const auto rays = add("rays", CLV_BIND_RAYS, s_.rays * sizeof(ClvRay), source, !s_.sharedRays);
        if (draws) {
            addRays(frame, rays);
        } else {
            begin("light");
        }
        struct Read {
            std::string name;
            std::uint32_t level, history;
            std::uint64_t entries;
        };
        std::vector<Read> reads;
        for (std::size_t l = 0; l < s_.levels.size(); ++l) {
            const LightFrameLevel& level = s_.levels[l];
            const std::string name = std::string(" ").append(std::to_string(l));
            const std::uint64_t record = frameStride(s_) * sizeof(float), records = s_.halves * level.slots;
            const auto constants = add("level" + name, CLV_BIND_LEVEL, sizeof(ClvLevelFrame), FrameSource::host);
            const auto history = add("history" + name, CLV_BIND_HISTORY, records * record, FrameSource::zero, true);
            if (s_.inject == InjectWay::slices) {
                addSlices(level, name, frame, constants, rays, history);
            } else if (gathers(s_.inject)) {
                addGather(level, name, frame, constants, rays, history);
            } else {
                addInject(level, name, frame, constants, rays, history);
            }
            reads.push_back({name, constants, history, level.lookupEntries});
        }

        if (s_.receivers > 0) {
            const auto receivers = add("receivers", CLV_BIND_RECEIVERS, s_.receivers * sizeof(ClvReceiver), FrameSource::host);
            begin("evaluate");
            for (const Read& r : reads) {
                const auto ends = add("lookup ends" + r.name, CLV_BIND_LOOKUP_ENDS, s_.receivers * sizeof(uint), FrameSource::host);
                const auto slots = add("lookup slots" + r.name, CLV_BIND_LOOKUP_SLOTS, r.entries * sizeof(uint), FrameSource::host);
                const auto weights = add("lookup weights" + r.name, CLV_BIND_LOOKUP_WEIGHTS, r.entries * sizeof(float), FrameSource::host);
                const auto irradiance = add("irradiance" + r.name, CLV_BIND_IRRADIANCE, s_.halves * s_.receivers * sizeof(vec4), FrameSource::passes, true);
                pass("evaluate" + r.name, "evaluate", groupsFor(s_.halves * s_.receivers),
                     {uniform(frame), uniform(r.level), read(receivers), read(ends), read(slots), read(weights), texel(r.history), write(irradiance)}, recordConstants());
            }
        }
        if (s_.picture.x > 0) addPicture(frame, reads.front().level, reads.front().history);
        addBarriers(frame_);
        return std::move(frame_);
    }

private:
    using Uses = std::vector<FrameUse>;
    using Constants = std::vector<FrameConstant>;

    std::uint32_t add(const std::string& name, std::uint32_t binding, std::uint64_t bytes, FrameSource source, bool readBack = false) {
        frame_.buffers.push_back({name, binding, bytes, source, readBack});
        return std::uint32_t(frame_.buffers.size() - 1);
    }
    std::uint32_t addImage(const std::string& name, std::uint32_t binding, const FrameImage& image) {
        frame_.buffers.push_back(frameImage(name, binding, image));
        return std::uint32_t(frame_.buffers.size() - 1);
    }
    void begin(const std::string& step) { frame_.steps.push_back({step, {}}); }
    void pass(const std::string& name, const std::string& shader, const uvec3& groups, Uses uses, Constants constants = {}) {
        frame_.steps.back().passes.push_back({name, shader, std::move(constants), std::move(uses), groups, {}, {}});
    }

    void draw(const std::string& name, const std::string& shader, const FrameRaster& raster, Uses uses, Constants constants = {}) {
        pass(name, shader, uvec3(1), std::move(uses), std::move(constants));
        frame_.steps.back().passes.back().raster = raster;
    }

    // A pass that traces, by the frame's way.
    void tracePass(const std::string& name, const std::string& shader, const uvec3& groups, Uses uses) {
        pass(name, shader + (s_.trace == TraceWay::query ? "_query" : ""), groups, std::move(uses));
        if (s_.trace == TraceWay::pipeline) frame_.steps.back().passes.back().rays = {"nearest", "nearest"};
    }

    // The steps that end with this frame's rays, cut.
    void addRays(std::uint32_t frame, std::uint32_t rays) {
        const std::uint64_t rows = s_.emitters > 0 ? s_.emitters / s_.rsmSide : s_.lights * s_.rsmSide, texels = rows * s_.rsmSide;
        const auto triangles = add("triangles", CLV_BIND_TRIANGLES, s_.triangles * kClvTriangleRows * sizeof(vec4), FrameSource::host);
        const auto texelBuffer = add("texels", CLV_BIND_TEXELS, texels * sizeof(ClvRsmTexel), s_.emitters > 0 ? FrameSource::host : FrameSource::passes);
        const auto sums = add("texel sums", CLV_BIND_TEXEL_SUMS, (rows * (s_.rsmSide + 1) + rows + 1) * sizeof(float), FrameSource::passes);
        const Uses tracing = addTracing(triangles);
        Uses surfaces;
        std::string textured;
        const auto bindSurfaces = [&] {
            surfaces.push_back(texel(add("surfaces", CLV_BIND_SURFACES, s_.triangles * kClvSurfaceRows * sizeof(vec4), FrameSource::host)));
            if (s_.textureTexels == 0) return;
            textured = "_textured";
            surfaces.push_back(texel(add("texture rows", CLV_BIND_TEXTURE_ROWS, s_.triangles * kClvTextureRows * sizeof(uvec4), FrameSource::host), FrameFormat::rgba32Uint));
            surfaces.push_back(texel(add("texture texels", CLV_BIND_TEXTURE_TEXELS, s_.textureTexels * sizeof(vec4), FrameSource::host)));
        };
        if (s_.emitters == 0 || s_.keepHits) bindSurfaces();
        Uses guide;
        std::string guided;
        if (s_.guideRows > 0) {
            guided = "_guided";
            guide = {uniform(add("guide", CLV_BIND_GUIDE, sizeof(ClvVolume), FrameSource::host)),
                     read(add("guide cells", CLV_BIND_GUIDE_CELLS, s_.guideCells * sizeof(uint), FrameSource::host)),
                     read(add("guide weights", CLV_BIND_GUIDE_WEIGHTS, s_.guideRows * kClvGuideRow * sizeof(float), FrameSource::host))};
        }

        begin("rsm");
        if (s_.emitters == 0) addMaps(frame, texelBuffer, triangles, tracing, surfaces, textured);
        pass("texel rows", "texel_rows" + guided, groupsFor(rows * CLV_GROUP_SIZE), with({uniform(frame), read(texelBuffer), write(sums)}, guide));
        pass("texel columns", "texel_columns", uvec3(1), {uniform(frame), readWrite(sums)});

        begin("light");
        pass("rays", "rays" + guided, groupsFor(s_.rays), with({uniform(frame), read(texelBuffer), read(sums), write(rays)}, guide));
        if (s_.keepHits) {
            const auto hits = add("hits", CLV_BIND_HITS, s_.rays * sizeof(ClvHit), FrameSource::passes, true);
            tracePass("trace", "trace_hits" + textured, groupsFor(s_.rays), with(with({uniform(frame), readWrite(rays), write(hits)}, tracing), surfaces));
        } else {
            tracePass("trace", "trace", groupsFor(s_.rays), with({uniform(frame), readWrite(rays)}, tracing));
        }
    }

    // What a shader needs to find the nearest triangle. An acceleration structure has a step of its own, which builds it.
    Uses addTracing(std::uint32_t triangles) {
        if (s_.trace == TraceWay::walk) {
            const auto boxes = add("bvh boxes", CLV_BIND_BVH_BOXES, s_.bvhNodes * kClvBvhBoxRows * sizeof(vec4), FrameSource::host);
            const auto children = add("bvh children", CLV_BIND_BVH_CHILDREN, s_.bvhNodes * sizeof(uvec4), FrameSource::host);
            return {texel(boxes), texel(children, FrameFormat::rgba32Uint), texel(triangles)};
        }
        const auto corners = add("corners", CLV_BIND_CORNERS, s_.triangles * kFrameCornerBytes, FrameSource::host);
        const auto acceleration = add("acceleration", CLV_BIND_ACCELERATION, s_.accelerationBytes, FrameSource::passes);
        frame_.buffers[acceleration].triangles = s_.triangles;
        begin("scene");
        pass("build", "", uvec3(1), {{corners, FrameBinding::corners}, {acceleration, FrameBinding::acceleration, FrameAccess::write}});
        return {{acceleration, FrameBinding::acceleration}, texel(triangles)};
    }

    // The maps of the lights: traced, or drawn and then coloured by the surfaces that are seen.
    void addMaps(std::uint32_t frame, std::uint32_t texels, std::uint32_t triangles, const Uses& tracing, const Uses& surfaces, const std::string& textured) {
        const auto lights = add("lights", CLV_BIND_LIGHTS, s_.lights * sizeof(ClvLight), FrameSource::host);
        const uvec3 groups = groupsFor(s_.lights * s_.rsmSide * s_.rsmSide);
        if (s_.mapFaces == 0) {
            tracePass("rsm", "rsm" + textured, groups, with(with({uniform(frame), read(lights), write(texels)}, tracing), surfaces));
            return;
        }
        const auto faces = add("map faces", CLV_BIND_MAP_FACES, s_.mapFaces * sizeof(ClvMapFace), FrameSource::host);
        const auto seen = addImage("face triangles", CLV_BIND_FACE_TRIANGLES, {FrameFormat::r32Uint, FrameShape::array, uvec3(s_.faceSide, s_.faceSide, s_.mapFaces)});
        const auto depths = addImage("face depths", CLV_BIND_FACE_DEPTHS, {FrameFormat::depth32Float, FrameShape::flat, uvec3(s_.faceSide, s_.faceSide, 1)});
        draw("map faces", "map_faces", {FrameTopology::triangles, std::uint32_t(3 * s_.triangles)}, {uniform(frame), read(faces), texel(triangles), target(seen), target(depths)});
        pass("rsm", "rsm_from_faces" + textured, groups, with({uniform(frame), read(lights), read(faces), image(seen), write(texels), texel(triangles)}, surfaces));
    }

    // A picture of the first level's light.
    void addPicture(std::uint32_t frame, std::uint32_t constants, std::uint32_t history) {
        const auto camera = add("camera", CLV_BIND_MAP_FACES, sizeof(ClvMapFace), FrameSource::host);
        const auto picture = add("picture", CLV_BIND_PICTURE, sizeof(ClvPicture), FrameSource::host);
        const auto radiance = add("radiance", CLV_BIND_RADIANCE, std::uint64_t(s_.picture.x) * s_.picture.y * sizeof(vec4), FrameSource::passes, true);
        const auto seen = addImage("pixel triangles", CLV_BIND_FACE_TRIANGLES, {FrameFormat::r32Uint, FrameShape::flat, uvec3(s_.picture, 1)});
        const auto depths = addImage("pixel depths", CLV_BIND_FACE_DEPTHS, {FrameFormat::depth32Float, FrameShape::flat, uvec3(s_.picture, 1)});
        const auto named = [&](const char* name) { return frame_.bufferIndex(name); };
        const LightFrameLevel& level = s_.levels.front();
        // Ways to inject differ in what they need of a level.
        if (named("table 0") == frame_.buffers.size()) addTables(level, " 0");
        if (named("slots 0") == frame_.buffers.size()) add("slots 0", CLV_BIND_SLOTS, level.slots * sizeof(ClvSlot), FrameSource::host);
        begin("picture");
        draw("camera", "map_faces", {FrameTopology::triangles, std::uint32_t(3 * s_.triangles)}, {uniform(frame), read(camera), texel(named("triangles")), target(seen), target(depths)});
        Uses uses{uniform(frame), uniform(constants), uniform(picture), read(camera), read(named("table 0")), read(named("splits 0")), read(named("slots 0")), texel(history), image(seen), write(radiance),
                  texel(named("triangles")), texel(named("surfaces"))};
        if (s_.textureTexels > 0) uses = with(uses, {texel(named("texture rows"), FrameFormat::rgba32Uint), texel(named("texture texels"))});
        pass("deferred", s_.textureTexels > 0 ? "deferred_textured" : "deferred", groupsFor(std::uint64_t(s_.picture.x) * s_.picture.y), std::move(uses), recordConstants());
    }

    // Each ray adds to the sums of this frame, which are then merged and cleared.
    void addInject(const LightFrameLevel& level, const std::string& name, std::uint32_t frame, std::uint32_t constants, std::uint32_t rays, std::uint32_t history) {
        const bool fixed = s_.inject == InjectWay::fixedPoint;
        const std::uint64_t bytes = frame_.buffers[history].bytes;
        const auto [table, splits] = addTables(level, name);
        const auto deposits = add("deposits" + name, CLV_BIND_DEPOSITS, bytes, FrameSource::zero, true);
        std::string moving;
        Uses merge{uniform(frame), uniform(constants), readWrite(deposits), readWrite(history)};
        if (s_.movingLights) {
            moving = "_moving";
            merge.push_back(read(addDynamicity(level, name, {uniform(frame), uniform(constants)}, {read(rays), read(table), read(splits)})));
        }
        Constants spec = recordConstants();
        spec.push_back({CLV_SPEC_RULE, s_.rule});
        pass("inject" + name, fixed ? "inject_fixed" : "inject_float", groupsFor(s_.rays),
             {uniform(frame), uniform(constants), read(rays), read(table), read(splits), readWrite(deposits)}, spec);
        pass("merge" + name, (fixed ? "merge_fixed" : "merge") + moving, groupsFor(bytes / sizeof(vec4)), std::move(merge), {{CLV_SPEC_STRIDE, frameStride(s_)}});
    }

    // Returns the frames that each slot's history stands for.
    std::uint32_t addDynamicity(const LightFrameLevel& level, const std::string& name, const Uses& constants, const Uses& rays) {
        const std::uint64_t records = s_.halves * level.slots;
        const auto settings = add("merge settings" + name, CLV_BIND_MERGE, sizeof(ClvMergeSettings), FrameSource::host);
        const auto now = add("dynamicity" + name, CLV_BIND_DYNAMICITY, 6 * records * sizeof(uint), FrameSource::zero);
        const auto kept = add("kept dynamicity" + name, CLV_BIND_KEPT_DYNAMICITY, 6 * records * sizeof(float), FrameSource::zero, true);
        const auto frames = add("slot frames" + name, CLV_BIND_SLOT_FRAMES, records * sizeof(float), FrameSource::zero, true);
        pass("dynamicity" + name, "dynamicity", groupsFor(s_.rays), with(with(constants, rays), {readWrite(now)}), {{CLV_SPEC_RULE, s_.rule}, {CLV_SPEC_TURNED, s_.turned ? 1u : 0u}});
        pass("frames" + name, "slot_frames", groupsFor(records), with(constants, {uniform(settings), readWrite(now), readWrite(kept), readWrite(frames)}));
        return frames;
    }

    // Rays are listed a slice, drawn as lines, and what a cell holds is merged.
    void addSlices(const LightFrameLevel& level, const std::string& name, std::uint32_t frame, std::uint32_t constants, std::uint32_t rays, std::uint32_t history) {
        const std::uint32_t layers = s_.halves * std::uint32_t(level.volume.resolution.z);
        const uvec3 extent(level.volume.resolution.x + int(2 * kClvSliceRim), level.volume.resolution.y + int(2 * kClvSliceRim), layers);
        const auto slots = add("slots" + name, CLV_BIND_SLOTS, level.slots * sizeof(ClvSlot), FrameSource::host);
        const auto draws = add("slice draws" + name, CLV_BIND_SLICE_DRAWS, layers * sizeof(FrameDrawArguments), FrameSource::passes);
        const auto list = add("slice rays" + name, CLV_BIND_SLICE_RAYS, layers * (s_.rays / s_.halves) * sizeof(uint), FrameSource::passes);
        pass("begin" + name, "slice_begin", groupsFor(layers), {uniform(frame), uniform(constants), write(draws)});
        pass("list" + name, "slice_list", groupsFor(s_.rays), {uniform(frame), uniform(constants), texel(rays), readWrite(draws), write(list)});
        Uses lines{uniform(frame), uniform(constants), texel(rays), read(list), {draws, FrameBinding::arguments}}, merge{uniform(frame), uniform(constants), read(slots), readWrite(history)};
        for (std::uint32_t side = 0; side < 6; ++side) {
            const auto light = addImage("side " + std::to_string(side) + name, CLV_BIND_SIDE_0 + side, {s_.sliceFormat, FrameShape::volume, extent});
            lines.push_back(target(light, FrameBlend::addKeepLargestAlpha));
            merge.push_back(image(light));
        }
        draw("inject" + name, "inject_slices", {FrameTopology::lines}, lines, {{CLV_SPEC_CHANNELS, s_.channels}, {CLV_SPEC_TURNED, s_.turned ? 1u : 0u}});
        pass("merge" + name, "merge_slices", groupsFor(s_.halves * level.slots), merge, {{CLV_SPEC_CHANNELS, s_.channels}, {CLV_SPEC_STRIDE, frameStride(s_)}});
    }

    // Each slot adds up its rays and merges them at once.
    void addGather(const LightFrameLevel& level, const std::string& name, std::uint32_t frame, std::uint32_t constants, std::uint32_t rays, std::uint32_t history) {
        const auto [table, splits] = addTables(level, name);
        const ivec3 bricks = clvBrickCounts(level.volume);
        const std::uint64_t lists = s_.halves * std::uint64_t(bricks.x) * bricks.y * bricks.z, groups = level.groupEnds.back();
        const auto slots = add("slots" + name, CLV_BIND_SLOTS, level.slots * sizeof(ClvSlot), FrameSource::host);
        const auto mask = add("brick mask" + name, CLV_BIND_BRICK_MASK, clvBrickMaskWords(level.volume) * sizeof(uint), FrameSource::host);
        const auto cursors = add("brick cursors" + name, CLV_BIND_BRICK_CURSORS, (lists + 1) * sizeof(uint), FrameSource::passes);
        const auto begins = add("brick begins" + name, CLV_BIND_BRICK_BEGINS, lists * sizeof(uint), FrameSource::passes);
        const auto list = add("brick rays" + name, CLV_BIND_BRICK_RAYS, frameListCapacity(s_, level.volume) * sizeof(uint), FrameSource::passes);
        const auto brickSlots = add("brick slots" + name, CLV_BIND_BRICK_SLOTS, groups * kClvBrickLanes * sizeof(uint), FrameSource::host);
        pass("clear" + name, "", uvec3(1), {write(cursors)});
        pass("count" + name, "brick_count", groupsFor(s_.rays), {uniform(frame), uniform(constants), texel(rays), read(mask), readWrite(cursors)});
        pass("begin" + name, "brick_begin", groupsFor(lists), {uniform(frame), uniform(constants), readWrite(cursors), write(begins)});
        pass("list" + name, "brick_list", groupsFor(s_.rays), {uniform(frame), uniform(constants), texel(rays), read(mask), readWrite(cursors), write(list)});
        // A pass for each number of splits, so that slots that are whole cells carry no planes.
        for (uint depth = 0, first = 0; depth <= uint(kClvMostSplits); first = level.groupEnds[depth++]) {
            if (level.groupEnds[depth] == first) continue;
            Constants deep = recordConstants();
            deep.push_back({CLV_SPEC_DEPTH, depth});
            pass("inject" + name + (depth == 0 ? "" : " split " + std::to_string(depth)), s_.inject == InjectWay::bricks ? "inject_bricks" : "inject_bricks_plain",
                 groupsFor(s_.halves * (level.groupEnds[depth] - first) * kClvBrickLanes),
                 {uniform(frame), uniform(constants), texel(rays), read(cursors), read(begins), read(list), read(brickSlots), read(slots), read(table), read(splits), readWrite(history)}, deep);
        }
    }

    std::pair<std::uint32_t, std::uint32_t> addTables(const LightFrameLevel& level, const std::string& name) {
        const auto table = add("table" + name, CLV_BIND_TABLE, level.cells * sizeof(uint), FrameSource::host);
        // A buffer may not be empty, a level without splits is welcome.
        return {table, add("splits" + name, CLV_BIND_SPLITS, std::max<std::uint64_t>(level.splits, 1) * sizeof(ClvSplit), FrameSource::host)};
    }

    Constants recordConstants() const {
        return {{CLV_SPEC_STORAGE, s_.storage}, {CLV_SPEC_CHANNELS, s_.channels}, {CLV_SPEC_STRIDE, frameStride(s_)}, {CLV_SPEC_TURNED, s_.turned ? 1u : 0u}};
    }
    static FrameUse uniform(std::uint32_t b) { return {b, FrameBinding::uniform}; }
    static FrameUse read(std::uint32_t b) { return {b, FrameBinding::storage, FrameAccess::read, FrameFormat::none}; }
    static FrameUse write(std::uint32_t b) { return {b, FrameBinding::storage, FrameAccess::write, FrameFormat::none}; }
    static FrameUse readWrite(std::uint32_t b) { return {b, FrameBinding::storage, FrameAccess::readWrite, FrameFormat::none}; }
    static FrameUse image(std::uint32_t b) { return {b, FrameBinding::image, FrameAccess::read, FrameFormat::none}; }
    static FrameUse target(std::uint32_t b, FrameBlend blend = FrameBlend::replace) { return {b, FrameBinding::target, FrameAccess::write, FrameFormat::none, blend}; }
    static FrameUse texel(std::uint32_t b, FrameFormat format = FrameFormat::rgba32Float) { return {b, FrameBinding::texel, FrameAccess::read, format}; }
    static Uses with(Uses uses, const Uses& more) {
        uses.insert(uses.end(), more.begin(), more.end());
        return uses;
    }

    const LightFrameSettings& s_;
    Frame frame_;
};

}  // namespace detail

inline Frame lightFrame(const LightFrameSettings& settings) { return detail::LightFrameBuilder(settings).build(); }

}  // namespace clv
#endif
