// Reads {"lights":[...]} files; a member "range" plays no part.
#include <array>
#include <cmath>
#include <set>
#include <string_view>

#include "bindings/scene/file_bytes.h"
#include "bindings/scene/json_reader.h"
#include "bindings/scene/reach.h"
#include "bindings/scene/scene_builder.h"

namespace clv {
namespace {

struct LightFormat {
    std::string_view type;
    std::set<std::string> required, optional;  // keys beside "type"
};

const LightFormat& formatOf(const JsonReader& type) {
    static const std::array<LightFormat, 3> formats = {{
        {"point", {"position", "intensity"}, {"name", "direction", "range"}},
        {"spot", {"position", "direction", "intensity"}, {"name", "innerConeAngle", "outerConeAngle", "range"}},
        {"directional", {"direction", "intensity"}, {"name", "position", "range"}},
    }};
    for (const LightFormat& format : formats)
        if (format.type == type.text()) return format;
    type.fail("point, spot or directional");
}

void checkKeys(const JsonReader& light, const LightFormat& format) {
    for (const std::string& key : format.required)
        if (!light.has(key.c_str())) light.fail(fmt::format("a member '{}' for a {} light", key, format.type));
    for (const std::string& key : light.keys())
        if (key != "type" && !format.required.contains(key) && !format.optional.contains(key))
            light.fail(fmt::format("no member '{}' for a {} light", key, format.type));
}

glm::vec3 unitDirection(const JsonReader& direction) {
    const glm::dvec3 d = direction.vector();
    const double length = glm::length(d);
    if (!(length > 0.0 && std::isfinite(length))) direction.fail("a direction that is finite and not zero");
    return glm::vec3(d / length);
}

NamedLight readLight(const std::string& file, const JsonReader& source, std::size_t index, const glm::dvec3& anchor) {
    const LightFormat& format = formatOf(source["type"]);
    checkKeys(source, format);
    const glm::vec3 intensity(source["intensity"].vector());
    NamedLight named{source.text("name", fmt::format("light {}", index)), {}};
    if (format.type == "point")
        named.light = makePointLight(intensity);
    else if (format.type == "directional")
        named.light = makeDirectionalLight(unitDirection(source["direction"]), intensity);
    else
        named.light = makeSpotLight(unitDirection(source["direction"]), intensity, float(source.number("innerConeAngle", 0.0)),
                                    float(source.number("outerConeAngle", kClvPi / 4.0)));
    if (source.has("position")) {
        const JsonReader position = source["position"];
        checkReach(position.vector(), fmt::format("{}: {}", file, position.place()));
        named.light.position = glm::vec3(position.vector() - anchor);
    }
    checkLight(named.light, fmt::format("{}: {}", file, source.place()));
    return named;
}

}  // namespace

std::vector<NamedLight> loadLights(const std::string& file, const glm::dvec3& anchor) {
    const nlohmann::json json = parseJson(file, readFileBytes(file));
    const JsonReader root(file, json);
    for (const std::string& key : root.keys())
        if (key != "lights") root.fail(fmt::format("no member '{}' beside 'lights'", key));
    std::vector<NamedLight> lights;
    for (const JsonReader& light : root["lights"].elements()) lights.push_back(readLight(file, light, lights.size(), anchor));
    return lights;
}

}  // namespace clv
