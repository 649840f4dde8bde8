// The figures of Brattén and Lindén (2013) as presets of the options.
#pragma once
#include <CLI/App.hpp>

#include "viz/options.h"

namespace clv {

// --figure. Options that stand after it change what it sets.
void addFigureOption(CLI::App& app, VizOptions& options);

}  // namespace clv
