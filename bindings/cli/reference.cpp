// clv reference: the path-traced truth at given points.
#include <memory>

#include "benchmarks/report/metrics.h"
#include "bindings/cli/command_line.h"
#include "bindings/cli/heed_lights.h"
#include "bindings/cli/options.h"
#include "bindings/cli/point_table.h"
#include "bindings/cli/progress.h"
#include "bindings/cli/reference_run.h"
#include "bindings/cli/staged_output.h"
#include "bindings/cli/standard_streams.h"

namespace clv {
namespace {

struct ReferenceCommand {
    CommonOptions common;
    SceneOptions scene;
    std::string points, out;
    bool allBounces = false;
    ReferenceBudget budget;

    void run(const CLI::App& command) const {
        Report report = startReport(command, common);
        keepInputs(out, {scene.scene, scene.lights, points});
        const Scene loaded = loadScene(scene, report);
        const PointTable table = readPointTable(points, loaded.anchor);
        StagedFile output(out);
        const EmbreeScene embree(loaded);
        const ReferenceRun reference = runReference(embree, table.points, budget, allBounces, common.seed, parallelForOf(common));
        const std::vector<glm::vec3> irradiance = reference.irradiance(), standardError = reference.standardError();
        writePointTable(output.path(), table, {{"E_r,E_g,E_b", irradiance}, {"s_r,s_g,s_b", standardError}});
        output.commit();

        const double paths = double(reference.samplesPerPoint) * double(table.points.size());
        const std::vector<std::string> warnings = heedNearLights(embree, table.points, paths, parallelForOf(common));
        for (const std::string& warning : warnings) sayOnStderr("clv: " + warning);
        if (!warnings.empty()) report["warnings"] = warnings;

        report["points"] = table.points.size();
        report["bounces"] = allBounces ? "all" : "one";
        report["samples_per_point"] = reference.samplesPerPoint;
        report["mean_irradiance"] = meanIrradiance(irradiance);
        report["mean_standard_error"] = meanStandardError(reference.results);
        report["relative_standard_error"] = relativeStandardError(reference.results);
        report["seconds"] = reference.seconds;
        report["out"] = out;
        printReport(report, common);
    }
};

}  // namespace

void addReferenceCommand(CLI::App& app) {
    CLI::App* command = app.add_subcommand("reference", "Path-trace the true irradiance at points, with its standard error");
    auto options = std::make_shared<ReferenceCommand>();
    addSceneOptions(*command, options->scene, true);
    addPointOptions(*command, options->points, options->out, "E_r,E_g,E_b and the standard errors s_r,s_g,s_b (W/m^2)");
    addBouncesOption(*command, options->allBounces);
    addReferenceBudget(*command, options->budget);
    addCommonOptions(*command, options->common);
    command->callback([options, command] { options->run(*command); });
}

}  // namespace clv
