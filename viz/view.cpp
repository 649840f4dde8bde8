#include "viz/view.h"

#include <algorithm>
#include <iterator>

namespace clv {
namespace {

constexpr const char* kNames[kSubjects] = {"cubes", "irradiance", "dynamicity", "samples", "variance", "open", "error", "mesh", "rays", "texels"};

}  // namespace

std::string nameOf(Subject subject) {
    return kNames[int(subject)];
}

Subject subjectOf(const std::string& name) {
    return Subject(std::ranges::find(kNames, name) - std::begin(kNames));
}

std::optional<Quantity> quantityOf(Subject subject) {
    const int index = int(subject) - int(Subject::irradiance);
    return index >= 0 && index < kQuantities ? std::optional(Quantity(index)) : std::nullopt;
}

}  // namespace clv
