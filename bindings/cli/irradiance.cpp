// clv irradiance: indirect irradiance at given points, read from a light volume.
#include <memory>

#include "benchmarks/report/metrics.h"
#include "bindings/cli/command_line.h"
#include "bindings/cli/light_options.h"
#include "bindings/cli/options.h"
#include "bindings/cli/pipeline.h"
#include "bindings/cli/point_table.h"
#include "bindings/cli/staged_output.h"

namespace clv {
namespace {

struct IrradianceCommand {
    CommonOptions common;
    SceneOptions scene;
    std::string points, out, motion;
    LightOptions light;

    void run(const CLI::App& command) const {
        Report report = startReport(command, common, true);
        if (!motion.empty()) throw InputError("--motion: light in motion is not available yet; expected a still scene");
        keepInputs(out, {scene.scene, scene.lights, points, light.proxy});
        const Scene loaded = loadScene(scene, report);
        const PointTable table = readPointTable(points, loaded.anchor);
        StagedFile output(out);
        std::vector<glm::vec3> irradiance(table.points.size());
        const PipelineReport run = lightPoints(loaded, light, common.seed, parallelForOf(common), table.points, irradiance);
        writePointTable(output.path(), table, {{"E_r,E_g,E_b", irradiance}});
        output.commit();

        report["points"] = table.points.size();
        report["bounces"] = light.allBounces ? "all" : "one";
        report["mean_irradiance"] = meanIrradiance(irradiance);
        reportLight(run, report);
        report["out"] = out;
        printReport(report, common);
    }
};

}  // namespace

void addIrradianceCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("irradiance", "Compute indirect irradiance at points through a light volume");
    auto options = std::make_shared<IrradianceCommand>();
    addSceneOptions(*command, options->scene, true);
    addPointOptions(*command, options->points, options->out, "E_r,E_g,E_b (indirect irradiance, W/m^2)");
    addLightOptions(*command, options->light);
    command->add_option("--motion", options->motion, "A JSON file of moving lights, camera and objects");
    addCommonOptions(*command, options->common);
    command->callback([options, command] {
        options->light.backend.choice = options->common.backend;
        options->run(*command);
    });
}

}  // namespace clv
