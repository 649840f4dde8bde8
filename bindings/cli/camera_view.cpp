#include "bindings/cli/camera_view.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace clv {

const Camera& chooseCamera(const Scene& scene, const std::string& nameOrIndex) {
    const auto named = std::ranges::find(scene.cameras, nameOrIndex, &Camera::name);
    if (named != scene.cameras.end()) return *named;
    std::size_t index = 0;
    const char* end = nameOrIndex.data() + nameOrIndex.size();
    const auto [rest, error] = std::from_chars(nameOrIndex.data(), end, index);
    if (error == std::errc() && rest == end && index < scene.cameras.size()) return scene.cameras[index];
    if (scene.cameras.empty()) throw InputError(fmt::format("{}: no cameras; expected one to look through", scene.name));
    std::vector<std::string> names;
    for (const Camera& camera : scene.cameras) names.push_back(camera.name);
    throw InputError(fmt::format("--camera {}: expected an index below {} or one of: {}", nameOrIndex, names.size(), fmt::join(names, ", ")));
}

}  // namespace clv
