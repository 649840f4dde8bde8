// clv plan: what a scene needs, what is left out and why, the memory of each resolution before it is taken, and what a budget buys.
#include <memory>
#include <span>

#include <fmt/format.h>

#include "benchmarks/report/trials.h"
#include "bindings/cli/command_line.h"
#include "bindings/cli/light_options.h"
#include "bindings/cli/options.h"
#include "bindings/cli/plan_choice.h"
#include "bindings/cli/scene_facts.h"
#include "clv/cpu/resolution.h"

namespace clv {
namespace {

// Upper bounds on the memory of one resolution: every cell with a record, none of them left out.
Report describeResolution(const Scene& scene, int resolution, const LightOptions& options, const Needs& needs) {
    const ClvVolume volume = volumeOver(scene, resolution, options);
    const DepositLayout layout{options.storage, needs.channels, needs.frame};
    const std::size_t cells = std::size_t(volume.resolution.x) * volume.resolution.y * volume.resolution.z;
    const std::uint64_t rays = options.seconds > 0.0 ? UINT64_MAX : options.rays;
    // A set of volumes for what surfaces receive, and with feedback two more that take turns.
    auto bytes = [&](std::size_t slotsPerCell) {
        const std::size_t slots = cells * slotsPerCell;
        const std::size_t tables = cells * sizeof(uint) + slots * sizeof(ClvSlot) + (slots - cells) * sizeof(ClvSplit);
        std::size_t sum = tables + Volume::bytes(slots, layout, volumeParts(needs.halves, rays));
        if (needs.feedback) sum += 2 * (tables + Volume::bytes(slots, layout, volumeParts(1, options.rays)));
        return sum;
    };
    return {{"resolution", resolution},
            {"cells", {volume.resolution.x, volume.resolution.y, volume.resolution.z}},
            {"cell_size", volume.cellSize},
            {"bytes_a_record", layout.bytes(1)},
            {"bytes_if_no_wall_cuts_a_cell", bytes(1)},
            {"bytes_at_most", bytes(kClvMostSlots)}};
}

struct PlanCommand {
    CommonOptions common;
    SceneOptions scene;
    LightOptions light;
    ChoiceOptions choice;

    void run(const CLI::App& command) const {
        Report report = startReport(command, common);
        const Scene loaded = loadScene(scene, report);
        const Needs needs = planNeeds(sceneFacts(loaded, light));
        Report needed = Report::array(), leftOut = Report::array();
        for (const Decision& d : needs.decisions) (d.needed ? needed : leftOut).push_back({{"name", d.name}, {"reason", d.reason}});
        report["bounces"] = light.allBounces ? "all" : "one";
        report["needed"] = needed;
        report["left_out"] = leftOut;
        if (needs.stages) {
            Report open = Report::array({{{"name", "guided rays"}, {"reason", "used where pilot rays find that many rays leave the scene"}}});
            if (light.resolution == 0) open.push_back({{"name", "resolution"}, {"reason", "the two halves of the rays judge it"}});
            report["decided_while_running"] = open;
            report["channels"] = needs.channels;
            report["resolutions"] = Report::array();
            const std::span<const int> resolutions = light.resolution > 0 ? std::span(&light.resolution, 1) : resolutionsFor(double(light.rays));
            for (int resolution : resolutions) report["resolutions"].push_back(describeResolution(loaded, resolution, light, needs));
        }
        if (choice.asked()) {
            if (!needs.stages) throw InputError(fmt::format("{}: no light to plan for", scene.scene));
            chooseSetting(loaded, light.resolution > 0 ? std::span(&light.resolution, 1) : std::span(kTrialResolutions), choice, common, report);
        }
        printReport(report, common);
    }
};

}  // namespace

void addPlanCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("plan", "Say what a scene needs, what is left out and why, the memory it takes, and which setting a budget buys");
    auto options = std::make_shared<PlanCommand>();
    addSceneOptions(*command, options->scene, true);
    addLightOptions(*command, options->light);
    addChoiceOptions(*command, options->choice);
    addCommonOptions(*command, options->common);
    command->callback([options, command] { options->run(*command); });
}

}  // namespace clv
