#include "benchmarks/gpu_run/check.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "benchmarks/gpu_run/stored.h"
#include "benchmarks/gpu_run/ways.h"
#include "bindings/vulkan/vulkan_frame.h"
#include "clv/plan/triangle_corners.h"

namespace clv {
namespace {

// What the host reads back, a vector for each check.
using Outputs = std::vector<std::vector<float>>;

bool traces(const StoredCase& stored) { return stored.settings.lights > 0; }

// Corners of the case's triangles.
std::vector<vec3> cornersOf(const StoredCase& stored) {
    std::vector<vec4> rows;
    for (const StoredBuffer& buffer : stored.buffers) {
        if (buffer.name != "triangles") continue;
        rows.resize(buffer.bytes.size() / sizeof(vec4));
        std::memcpy(rows.data(), buffer.bytes.data(), buffer.bytes.size());
    }
    return triangleCorners(rows, stored.settings.triangles);
}

Outputs runCase(VulkanDevice& device, const StoredCase& stored, InjectWay way, TraceWay trace, ShaderLanguage language) {
    LightFrameSettings settings = stored.settings;
    settings.inject = way, settings.trace = trace;
    if (trace != TraceWay::walk) settings.accelerationBytes = device.accelerationBytes(settings.triangles);
    Frame frame = lightFrame(settings);
    for (const StoredCheck& check : stored.checks) frame.buffers.at(frame.bufferIndex(check.buffer)).readBack = true;
    VulkanFrame run(device, frame, language);
    for (const StoredBuffer& buffer : stored.buffers) {
        if (frame.bufferIndex(buffer.name) < frame.buffers.size()) run.upload(buffer.name, std::span(buffer.bytes));
    }
    if (trace != TraceWay::walk) {
        run.upload("corners", std::span<const vec3>(cornersOf(stored)));
        run.run("scene");
    }
    for (const std::string& step : stored.steps) run.run(step);
    Outputs outputs;
    for (const StoredCheck& check : stored.checks) run.download(check.buffer, std::span(outputs.emplace_back(check.expected.size())));
    return outputs;
}

// How far the numbers are from what is expected, in words; `passed` becomes false where that is too far.
std::string compare(const StoredCheck& check, const std::vector<float>& values, bool& passed) {
    double square = 0.0, sum = 0.0;
    std::uint64_t outside = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        // Integers among the floats may look like numbers that are none.
        if (std::memcmp(&values[i], &check.expected[i], sizeof(float)) == 0) {
            if (std::isfinite(values[i])) sum += values[i];
            continue;
        }
        const double difference = double(values[i]) - check.expected[i];
        square += difference * difference, sum += check.expected[i];
        // Not as a difference above the bound: a number that is none must not pass.
        if (!check.bounds.empty() && !(std::abs(difference) <= check.bounds[i])) ++outside;
    }
    const double count = double(values.size()), rmse = std::sqrt(square / count) / std::abs(sum / count);
    std::ostringstream words;
    words.precision(2);
    words << check.buffer << ": relative RMSE " << rmse;
    if (check.bounds.empty()) {
        passed = passed && rmse <= check.largestRmse;
        words << " of at most " << check.largestRmse;
    } else {
        passed = passed && outside <= check.exceptions;
        words << ", " << outside << " of " << values.size() << " numbers out of bounds, at most " << check.exceptions;
    }
    return words.str();
}

// The ways by which the device can add up what the case has.
std::vector<InjectWay> waysFor(const VulkanFeatures& features, const LightFrameSettings& settings) {
    if (settings.picture.x > 0 && !features.draws) return {};
    if (settings.inject == InjectWay::slices) return drawsSlices(features) ? std::vector{InjectWay::slices} : std::vector<InjectWay>();
    std::vector<InjectWay> ways = waysOf(features, settings.rule);
    if (settings.movingLights) std::erase_if(ways, gathers);
    if (settings.levels.empty()) ways.resize(1);
    return ways;
}

// A difference of languages is no fault: compilers of drivers may round differently where Vulkan lets them.
CaseResult repeatCase(VulkanDevice& device, const StoredCase& stored) {
    const auto run = [&](ShaderLanguage language) { return runCase(device, stored, InjectWay::fixedPoint, TraceWay::walk, language); };
    const Outputs first = run(ShaderLanguage::glsl);
    const bool again = run(ShaderLanguage::glsl) == first, hlsl = run(ShaderLanguage::hlsl) == first;
    return {stored.name + ", twice", "glsl", wayName(InjectWay::fixedPoint), traces(stored) ? traceName(TraceWay::walk) : "", again,
            std::string(again ? "the same bits again" : "other bits in the second run") + (hlsl ? ", and in HLSL" : ", others in HLSL")};
}

}  // namespace

std::vector<CaseResult> checkCases(VulkanDevice& device, const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".case") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    if (files.empty()) throw std::runtime_error(folder.string() + " holds no cases");
    std::vector<CaseResult> results;
    for (const auto& file : files) {
        const StoredCase stored = readStoredCase(file);
        const std::vector<InjectWay> ways = waysFor(device.info().features, stored.settings);
        if (ways.empty()) continue;  // the device does not draw
        const auto check = [&](InjectWay way, TraceWay trace, ShaderLanguage language) {
            CaseResult result{stored.name, language == ShaderLanguage::glsl ? "glsl" : "hlsl", stored.settings.levels.empty() ? "" : wayName(way), traces(stored) ? traceName(trace) : "", true, ""};
            const Outputs outputs = runCase(device, stored, way, trace, language);
            for (std::size_t i = 0; i < outputs.size(); ++i) result.words += (i > 0 ? "; " : "") + compare(stored.checks[i], outputs[i], result.passed);
            results.push_back(result);
        };
        for (const InjectWay way : ways) {
            for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl}) check(way, TraceWay::walk, language);
        }
        // Other ways to trace than the walk are of GLSL alone.
        for (const TraceWay trace : traceWaysOf(device.info())) {
            if (traces(stored) && trace != TraceWay::walk) check(ways.front(), trace, ShaderLanguage::glsl);
        }
        if (!stored.settings.levels.empty() && ways.front() != InjectWay::slices) results.push_back(repeatCase(device, stored));
    }
    return results;
}

}  // namespace clv
