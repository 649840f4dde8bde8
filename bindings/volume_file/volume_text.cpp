#include "bindings/volume_file/volume_text.h"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "bindings/scene/json_reader.h"
#include "bindings/volume_file/word_checksum.h"

namespace clv {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostCells = 0x7fffffff;  // so that the index of a cell fits an int

const std::map<std::string, uint> kStorages{
    {"cube", kClvStorageCube}, {"cube9", kClvStorageCube9}, {"sh1", kClvStorageSh1}, {"sh2", kClvStorageSh2}};
const std::map<std::string, uint> kLightTypes{{"point", kClvLightPoint}, {"spot", kClvLightSpot}, {"directional", kClvLightDirectional}};

std::string nameOf(const std::map<std::string, uint>& names, uint value) {
    for (const auto& [name, number] : names)
        if (number == value) return name;
    return {};
}

uint valueOf(const std::map<std::string, uint>& names, const JsonReader& reader) {
    const auto found = names.find(reader.text());
    if (found != names.end()) return found->second;
    std::string expected;
    for (const auto& [name, value] : names) expected += (expected.empty() ? "" : ", ") + name;
    reader.fail("one of: " + expected);
}

template <class Vector>
Json numbers(const Vector& v) {
    return {v.x, v.y, v.z};
}

float finite(const JsonReader& reader) {
    const float number = float(reader.number());
    if (!std::isfinite(number)) reader.fail("a number that fits a float");
    return number;
}
float notNegative(const JsonReader& reader) {
    const float number = finite(reader);
    if (!(number >= 0.0f)) reader.fail("a number that is not negative");
    return number;
}
float above0(const JsonReader& reader) {
    const float number = finite(reader);
    if (!(number > 0.0f)) reader.fail("a number above 0");
    return number;
}
vec3 vector(const JsonReader& reader) {
    vec3 v(0.0f);
    const auto elements = reader.elements();
    if (elements.size() != 3) reader.fail("3 numbers");
    for (int axis = 0; axis < 3; ++axis) v[axis] = finite(elements[std::size_t(axis)]);
    return v;
}

Json describe(const NamedLight& named) {
    const ClvLight& light = named.light;
    return {{"name", named.name},
            {"type", nameOf(kLightTypes, light.type)},
            {"position", numbers(light.position)},
            {"direction", numbers(light.direction)},
            {"intensity", numbers(light.intensity)},
            {"innerConeAngle", light.innerConeAngle},
            {"outerConeAngle", light.outerConeAngle},
            {"dynamicity", light.dynamicity}};
}

NamedLight lightFrom(const JsonReader& reader) {
    NamedLight named{reader["name"].text(), {}};
    ClvLight& light = named.light;
    light.type = valueOf(kLightTypes, reader["type"]);
    light.position = vector(reader["position"]);
    light.direction = vector(reader["direction"]);
    light.intensity = vector(reader["intensity"]);
    light.innerConeAngle = notNegative(reader["innerConeAngle"]);
    light.outerConeAngle = notNegative(reader["outerConeAngle"]);
    light.dynamicity = notNegative(reader["dynamicity"]);
    return named;
}

Json describe(const Camera& camera) {
    return {{"name", camera.name},         {"position", numbers(camera.position)}, {"forward", numbers(camera.forward)},
            {"up", numbers(camera.up)},    {"yfov", camera.yfov},                  {"aspect", camera.aspect}};
}

Camera cameraFrom(const JsonReader& reader) {
    return {reader["name"].text(), vector(reader["position"]), vector(reader["forward"]), vector(reader["up"]), above0(reader["yfov"]), above0(reader["aspect"])};
}

SceneMark markFrom(const JsonReader& reader) {
    SceneMark mark{reader["triangles"].index(), {}};
    const auto corners = reader["bounds"].elements();
    if (corners.size() != 2) reader["bounds"].fail("2 vectors");
    mark.bounds = {vector(corners[0]), vector(corners[1])};
    return mark;
}

// Of all that a volume is.
std::string contentOf(const BakedVolume& volume, const Json& description) {
    WordChecksum sum;
    const std::string text = description.dump();
    sum.add(std::as_bytes(std::span(text)));
    for (const BakedCascade& cascade : volume.cascades) {
        const auto add = [&sum](const auto& values) { sum.add(std::as_bytes(std::span(values))); };
        add(cascade.level.table), add(cascade.level.slots), add(cascade.level.splits), add(cascade.samples), add(cascade.dynamicity);
        for (const std::vector<float>& estimate : cascade.estimates) add(estimate);
    }
    return fmt::format("{:016x}", sum.value());
}

}  // namespace

Json describeVolume(const BakedVolume& volume) {
    Json lights = Json::array();
    for (const NamedLight& light : volume.lights) lights.push_back(describe(light));
    const mat3& frame = volume.layout.frame;
    Json text{{"format", kVolumeFormat},
              {"clv", volume.libraryVersion},
              {"units", "m, W/m^2"},
              {"scene", volume.scene},
              {"anchor", numbers(volume.anchor)},
              {"lights", lights},
              {"bounces", volume.allBounces ? "all" : "one"},
              {"seed", volume.seed},
              {"frame", volume.frame},
              {"storage", nameOf(kStorages, volume.layout.storage)},
              {"channels", volume.layout.channels},
              {"direction_frame", {numbers(frame[0]), numbers(frame[1]), numbers(frame[2])}},
              {"margin_cells", volume.marginCells},
              {"blend_cells", volume.blendCells},
              {"cascades", volume.cascades.size()}};
    if (volume.camera) text["camera"] = describe(*volume.camera);
    if (volume.mark) text["scene_mark"] = {{"triangles", volume.mark->triangles}, {"bounds", {numbers(volume.mark->bounds.lo), numbers(volume.mark->bounds.hi)}}};
    text["content"] = contentOf(volume, text);
    return text;
}

BakedVolume volumeFromDescription(const std::string& file, const nlohmann::json& description) {
    const JsonReader reader(file, description);
    if (reader["format"].index() != kVolumeFormat) reader["format"].fail(fmt::format("{}, the version of volume files that this program reads", kVolumeFormat));
    BakedVolume volume;
    volume.libraryVersion = reader["clv"].text();
    volume.scene = reader["scene"].text();
    volume.anchor = reader["anchor"].vector();
    if (reader.has("scene_mark")) volume.mark = markFrom(reader["scene_mark"]);
    for (const JsonReader& light : reader["lights"].elements()) volume.lights.push_back(lightFrom(light));
    if (reader.has("camera")) volume.camera = cameraFrom(reader["camera"]);
    volume.allBounces = reader["bounces"].text() == "all";
    volume.seed = std::uint32_t(reader["seed"].index(std::size_t(1) << 32));
    volume.frame = std::uint32_t(reader["frame"].index(std::size_t(1) << 32));
    volume.layout.storage = valueOf(kStorages, reader["storage"]);
    volume.layout.channels = int(reader["channels"].index(4));
    if (volume.layout.channels != 1 && volume.layout.channels != 3) reader["channels"].fail("1 or 3");
    const auto columns = reader["direction_frame"].elements();
    if (columns.size() != 3) reader["direction_frame"].fail("3 vectors");
    for (int k = 0; k < 3; ++k) volume.layout.frame[k] = vector(columns[std::size_t(k)]);
    volume.marginCells = notNegative(reader["margin_cells"]);
    volume.blendCells = notNegative(reader["blend_cells"]);
    volume.cascades.resize(reader["cascades"].index(kClvMaxCascades + 1));
    if (volume.cascades.empty()) reader["cascades"].fail("at least 1");
    return volume;
}

Json describeGrid(const ClvVolume& grid, std::size_t cascade) {
    return {{"cascade", cascade}, {"origin", numbers(grid.origin)}, {"cell_size", grid.cellSize}, {"resolution", numbers(grid.resolution)}};
}

ClvVolume gridFromDescription(const std::string& file, const nlohmann::json& description, uint storage) {
    const JsonReader reader(file, description);
    ClvVolume grid{};
    grid.origin = vector(reader["origin"]);
    grid.cellSize = above0(reader["cell_size"]);
    const auto resolution = reader["resolution"].elements();
    if (resolution.size() != 3) reader["resolution"].fail("3 numbers");
    std::size_t cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
        grid.resolution[axis] = int(resolution[std::size_t(axis)].index(kMostCells / cells + 1));
        if (grid.resolution[axis] == 0) resolution[std::size_t(axis)].fail("at least one cell");
        cells *= std::size_t(grid.resolution[axis]);
    }
    grid.storage = storage;
    return grid;
}

}  // namespace clv
