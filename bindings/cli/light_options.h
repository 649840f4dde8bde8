// Options of the commands that compute indirect light through a light volume.
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include <CLI/App.hpp>

#include "clv/data/cell.h"

namespace clv {

struct BackendOptions {
    std::string choice = "cpu";   // "auto", "cpu" or "vulkan"
    std::string device{};         // of Vulkan: index or a part of its name; empty: any
    bool repeatable = false;      // the same to the last bit from run to run, on a GPU too
    std::string loader{};         // see VulkanOptions
};

struct LightOptions {
    bool allBounces = false;
    int resolution = 0;                     // about resolution^3 cells; 0: chosen by the library
    std::uint64_t rays = 4u << 20;          // segments traced in all: pilots, every frame, sweep and bounce; counts where seconds is 0
    double seconds = 0.0;                   // run time, s; 0: not set
    std::uint32_t frames = 1;               // the rays are shared out among as many frames, merged one after the other
    uint storage = kClvStorageCube9;
    std::array<double, 3> cellShift = {};   // cells, (-1, 1]
    std::string proxy;                      // scene that rays are intersected with instead, or empty
    BackendOptions backend;
};
void addLightOptions(CLI::App& command, LightOptions& options);

}  // namespace clv
