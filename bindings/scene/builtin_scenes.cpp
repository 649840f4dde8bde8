// The list of built-in scenes.
#include "bindings/scene/builtin_scenes.h"

#include <fmt/format.h>

namespace clv {
namespace {

struct Entry {
    BuiltinScene scene;
    Scene (*make)();
};

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = {
        {{"atrium", "two storeys of arcades around a court, coloured drapes, a slanting sun (the default)"}, makeAtrium},
        {{"atrium_turned", "the atrium turned by 30 and 20 degrees, so that no wall follows the grid"}, makeAtriumTurned},
        {{"cornell", "the measured Cornell box: coloured walls, two blocks, a lamp below the ceiling"}, makeCornell},
        {{"two_rooms", "two rooms with walls 5 cm thick, a lamp in one of them, a door ajar"}, makeTwoRooms},
        {{"corridor", "a corridor around two corners with a lamp at one end"}, makeCorridor},
        {{"furnace_box", "a closed grey box whose mean irradiance is known in closed form"}, makeFurnaceBox},
        {{"white_sphere", "a closed sphere whose irradiance is the same everywhere and known in closed form"}, makeWhiteSphere},
    };
    return all;
}

}  // namespace

const std::vector<BuiltinScene>& builtinScenes() {
    static const std::vector<BuiltinScene> list = [] {
        std::vector<BuiltinScene> scenes;
        for (const Entry& entry : entries()) scenes.push_back(entry.scene);
        return scenes;
    }();
    return list;
}

Scene makeBuiltinScene(const std::string& name) {
    std::string names;
    for (const Entry& entry : entries()) {
        if (entry.scene.name == name) return entry.make();
        names += (names.empty() ? "" : ", ") + entry.scene.name;
    }
    throw InputError(fmt::format("{}: no such scene; expected a .glb, .gltf or .obj file, or one of {}", name, names));
}

}  // namespace clv
