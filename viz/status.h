// What keys have set and the picture alone does not tell, in a line.
#pragma once
#include <string>

#include "viz/view.h"

namespace clv {

// Of the view that is shown: threshold, exposure, places of the planes, the cascade, how surfaces read the volume.
std::string statusOf(const View& view, std::size_t cascades);

}  // namespace clv
