// What a volume file says about itself beside its numbers, as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "bindings/volume_file/baked_volume.h"

namespace clv {

// Changes whenever files of one version cannot be read by another.
constexpr int kVolumeFormat = 2;

// Of the whole volume: all but its cascades, whose number it gives, and a checksum by which pieces of one volume know each other.
nlohmann::ordered_json describeVolume(const BakedVolume& volume);
// Throws InputError that begins with `file`.
BakedVolume volumeFromDescription(const std::string& file, const nlohmann::json& description);

// Of the grid of one cascade, 0 the finest.
nlohmann::ordered_json describeGrid(const ClvVolume& grid, std::size_t cascade);
ClvVolume gridFromDescription(const std::string& file, const nlohmann::json& description, uint storage);

}  // namespace clv
