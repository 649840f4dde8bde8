#include "bindings/cli/light_options.h"

#include <map>

#include <fmt/format.h>

#include "bindings/cli/options.h"

namespace clv {
namespace {

constexpr int kMaxResolution = 1024;
constexpr std::uint32_t kMaxFrames = 1000000;

const std::map<std::string, uint> kStorages = {
    {"cube9", kClvStorageCube9}, {"cube", kClvStorageCube}, {"sh1", kClvStorageSh1}, {"sh2", kClvStorageSh2}};

}  // namespace

void addLightOptions(CLI::App& command, LightOptions& options) {
    addBouncesOption(command, options.allBounces);
    command.add_option("--resolution", options.resolution, "A volume of about N^3 cells; default: chosen by the library, which judges 16, 32, 64 and 128 by the rays, and 8 where there are fewer than 512k")
        ->check(CLI::Range(1, kMaxResolution));
    auto* rays = addCountOption(command, "--rays", options.rays, 
                                fmt::format("Segments traced in all, pilots, frames and every bounce counted; default {}", options.rays));
    addPositiveOption(command, "--seconds", options.seconds, "Run time instead of a number of rays, s")->excludes(rays);
    command.add_option("--frames", options.frames, "Frames that the rays are shared out among, merged one after the other")
        ->excludes("--seconds")
        ->check(CLI::Range(1u, kMaxFrames))
        ->capture_default_str();
    command
        .add_option_function<std::string>(
            "--storage", [&options](const std::string& name) { options.storage = kStorages.at(name); }, "What a cell stores")
        ->check(CLI::IsMember(kStorages))
        ->default_str("cube9");
    command.add_option("--cell-shift", options.cellShift, "Move the grid by a fraction of a cell: x,y,z")
        ->delimiter(',')
        ->check(finiteNumber(-1.0, 1.0, "a shift in cells, above -1 and at most 1"));
    command.add_option("--proxy", options.proxy, "A simpler scene that rays are intersected with; the rest sees the full one");
    command.add_option("--device", options.backend.device, "With --backend vulkan or auto: the device, by index or a part of its name; see clv info");
    command.add_flag("--repeatable", options.backend.repeatable, "The same to the last bit from run to run, on a GPU too, where sums are then made of integers");
}

}  // namespace clv
