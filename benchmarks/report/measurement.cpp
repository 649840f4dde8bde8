#include "benchmarks/report/measurement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace clv {
namespace {

// JSON has no infinity: null stands for it.
nlohmann::ordered_json number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

double numberFrom(const nlohmann::ordered_json& json) {
    return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

// A field with a comma, a quote or a line's end is quoted (RFC 4180).
std::string csvField(const nlohmann::ordered_json& value) {
    if (value.is_null()) return "";
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    return quoted + "\"";
}

}  // namespace

double Measurement::seconds(double readers) const {
    if (wholePicture && readers < double(receivers)) return std::numeric_limits<double>::infinity();
    const double share = receivers > 0 ? readers / double(receivers) : 0.0;
    return (sharesRays ? 1.0 : share) * frameSeconds + share * lookupSeconds;
}

std::string settingOf(const Measurement& m, const std::string& name) {
    const auto found = std::ranges::find(m.settings, name, &MethodSettings::value_type::first);
    return found == m.settings.end() ? "" : found->second;
}

std::string settingsText(const MethodSettings& settings) {
    std::string text;
    for (const auto& [name, value] : settings) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, value);
    return text;
}

std::string curveName(const Measurement& m) {
    return m.settings.empty() ? m.method : fmt::format("{} ({})", m.method, settingsText(m.settings));
}

nlohmann::ordered_json toJson(const Measurement& m) {
    nlohmann::ordered_json settings = nlohmann::ordered_json::object();
    for (const auto& [name, value] : m.settings) settings[name] = value;
    return {{"key", m.key},
            {"scene", m.scene},
            {"method", m.method},
            {"settings", settings},
            {"rays", m.rays},
            {"frames", m.frames},
            {"relative_rmse", number(m.errors.relativeRmse)},
            {"relative_rmse_interval", number(m.errorInterval)},
            {"bias", number(m.errors.bias)},
            {"p95", number(m.errors.p95)},
            {"leak", m.leak ? number(*m.leak) : nlohmann::ordered_json()},
            {"truth_error", number(m.truthError)},
            {"picture_rms", number(m.picture.rms)},
            {"picture_psnr", number(m.picture.psnr)},
            {"picture_failures", m.picture.perceptualFailures},
            {"setup_s", m.setupSeconds},
            {"maps_s", m.mapSeconds},
            {"frame_s", m.frameSeconds},
            {"frame_s_least", m.frameSecondsLeast},
            {"frame_s_spread", m.frameSecondsSpread},
            {"lookup_s", m.lookupSeconds},
            {"receivers", m.receivers},
            {"whole_picture", m.wholePicture},
            {"shares_rays", m.sharesRays},
            {"rays_traced", m.raysTraced},
            {"bytes", m.bytes}};
}

Measurement measurementFrom(const nlohmann::ordered_json& json) {
    Measurement m;
    m.key = json.at("key"), m.scene = json.at("scene"), m.method = json.at("method");
    for (const auto& [name, value] : json.at("settings").items()) m.settings.emplace_back(name, value.get<std::string>());
    m.rays = json.at("rays"), m.frames = json.at("frames");
    m.errors = {numberFrom(json.at("relative_rmse")), numberFrom(json.at("bias")), numberFrom(json.at("p95"))};
    m.errorInterval = numberFrom(json.at("relative_rmse_interval"));
    m.truthError = numberFrom(json.at("truth_error"));
    if (!json.at("leak").is_null()) m.leak = json.at("leak").get<double>();
    m.picture = {numberFrom(json.at("picture_rms")), numberFrom(json.at("picture_psnr")), json.at("picture_failures")};
    m.setupSeconds = json.at("setup_s");
    m.mapSeconds = json.at("maps_s");
    m.frameSeconds = json.at("frame_s");
    m.frameSecondsLeast = json.at("frame_s_least");
    m.frameSecondsSpread = json.at("frame_s_spread");
    m.lookupSeconds = json.at("lookup_s");
    m.receivers = json.at("receivers"), m.wholePicture = json.value("whole_picture", false), m.sharesRays = json.at("shares_rays");
    m.raysTraced = json.at("rays_traced"), m.bytes = json.at("bytes");
    return m;
}

std::string csvOf(const std::vector<Measurement>& all) {
    std::string text;
    for (const Measurement& m : all) {
        nlohmann::ordered_json row = toJson(m);
        row["settings"] = settingsText(m.settings);
        std::vector<std::string> names, values;
        for (const auto& [name, value] : row.items()) names.push_back(name), values.push_back(csvField(value));
        if (text.empty()) text = fmt::format("{}\n", fmt::join(names, ","));
        text += fmt::format("{}\n", fmt::join(values, ","));
    }
    return text;
}

}  // namespace clv
