#include "viz/view.h"

#include <algorithm>
#include <iterator>

namespace clv {
namespace {

constexpr const char* kNames[kSubjects] = {"cubes", "irradiance", "dynamicity", "samples", "variance", "open", "noise", "error", "mesh", "rays", "texels"};

}  // namespace

std::string nameOf(Subject subject) {
    return kNames[int(subject)];
}

Subject subjectOf(const std::string& name) {
    return Subject(std::ranges::find(kNames, name) - std::begin(kNames));
}

Carrier carrierOf(const View& view) {
    const bool error = view.subject == Subject::error;
    if (view.carrier && (error || view.carrier != Carrier::surfaces)) return *view.carrier;
    return !view.slices.empty() ? Carrier::slices : error ? Carrier::surfaces : Carrier::cells;
}

bool showsCubes(const View& view) {
    return view.subject == Subject::cubes || ((quantityOf(view.subject) || view.subject == Subject::error) && carrierOf(view) == Carrier::cells);
}

bool fillsSpace(const View& view) {
    return showsCubes(view) || ((quantityOf(view.subject) || view.subject == Subject::error) && carrierOf(view) == Carrier::volume);
}

std::optional<Quantity> quantityOf(Subject subject) {
    const int index = int(subject) - int(Subject::irradiance);
    return index >= 0 && index < kQuantities ? std::optional(Quantity(index)) : std::nullopt;
}

}  // namespace clv
