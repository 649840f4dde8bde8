#include "benchmarks/baselines/method.h"

#include <fmt/format.h>

namespace clv {

std::string gridShiftText(const glm::vec3& shift) { return fmt::format("{:.3g} {:.3g} {:.3g}", shift.x, shift.y, shift.z); }

}  // namespace clv
