#include "viz/compose.h"

#include <fmt/format.h>

#include "viz/cell_errors.h"
#include "viz/cell_shapes.h"
#include "viz/outlines.h"
#include "viz/surface_shapes.h"

namespace clv {
namespace {

const glm::u8vec3 kProbeColor(120, 190, 255);

const World& needed(const World* world, Subject subject) {
    if (!world) throw InputError(fmt::format("--view {}: expected the scene of the volume; name it with --scene", nameOf(subject)));
    return *world;
}

// A plot, and where its line runs.
void drawProbe(const BakedVolume& volume, Quantity quantity, const View& view, Drawing& drawing) {
    const vec3 from(view.probe->first - volume.anchor), to(view.probe->second - volume.anchor);
    drawing.plot = probe(volume, quantity, view.cascade, from, to);
    drawing.signs.add(from, to, kProbeColor);
}

}  // namespace

Drawing compose(const BakedVolume& volume, const World* world, const View& view, const ParallelFor& parallelFor) {
    Drawing drawing;
    const bool cellTruth = view.truth && (view.subject == Subject::cubes || view.subject == Subject::irradiance);
    if (view.truth && !cellTruth && view.subject != Subject::mesh) throw InputError(fmt::format("--truth: expected --view cubes, irradiance or mesh, not {}", nameOf(view.subject)));
    if (cellTruth) drawCellTruth(volume, needed(world, view.subject), view, parallelFor, drawing);
    else if (view.subject == Subject::cubes) drawCubes(cellsOf(volume, view, parallelFor), view, parallelFor, drawing);
    else if (const auto quantity = quantityOf(view.subject)) drawQuantity(volume, *quantity, view, parallelFor, drawing);
    if (view.subject == Subject::error) (carrierOf(view) == Carrier::surfaces ? drawError : drawCellErrors)(volume, needed(world, view.subject), view, parallelFor, drawing);
    if (view.subject == Subject::mesh || view.mesh) drawMesh(volume, needed(world, Subject::mesh), view, parallelFor, drawing);
    if (view.subject == Subject::rays || view.rays > 0) drawRays(needed(world, Subject::rays), view, parallelFor, drawing);
    if (view.subject == Subject::texels || view.texels) drawTexels(needed(world, Subject::texels), view, parallelFor, drawing);
    const Quantity plotted = quantityOf(view.subject).value_or(Quantity::irradiance);
    if (view.histogram && knows(volume, plotted)) drawing.plot = histogram(volume, plotted, view.cascade, parallelFor);
    if (view.probe && knows(volume, plotted)) drawProbe(volume, plotted, view, drawing);
    if (view.wireframe || view.subject == Subject::rays || view.subject == Subject::texels) drawWireframe(needed(world, view.subject).scene(), drawing);
    if (view.boxes) drawBoxes(volume, drawing);
    if (view.frustum) drawFrustum(volume, world ? &world->scene() : nullptr, drawing);
    if (view.lights) drawLights(volume, drawing);
    return drawing;
}

Drawing composeDifference(const BakedVolume& volume, const BakedVolume& other, const View& view, const ParallelFor& parallelFor) {
    if (!quantityOf(view.subject) && view.subject != Subject::cubes) throw InputError(fmt::format("no difference of {} is shown", nameOf(view.subject)));
    Drawing drawing;
    drawDifference(volume, other, quantityOf(view.subject).value_or(Quantity::irradiance), view, parallelFor, drawing);
    if (view.boxes) drawBoxes(volume, drawing);
    return drawing;
}

}  // namespace clv
