// Names of the arrays in a volume's files.
#pragma once
#include <string>

namespace clv::arrays {

// Cell data.
inline const std::string kIrradiance = "irradiance ";  // and the side
inline const char* const kVariance = "variance";
inline const char* const kDynamicity = "dynamicity";
inline const char* const kSamples = "samples";
inline const char* const kOpenVolume = "open volume";
inline const char* const kLevel = "level";
inline const char* const kEntry = "entry";

// Field data.
inline const char* const kAbout = "about";
inline const char* const kGrid = "grid";
inline const char* const kSlotCentroid = "slot centroid";
inline const char* const kSlotVolume = "slot volume";
inline const char* const kSlotVisible = "slot visible";
inline const char* const kSlotCell = "slot cell";
inline const char* const kSlotSamples = "slot samples";
inline const char* const kSlotDynamicity = "slot dynamicity";
inline const std::string kSlotDeposits = "slot deposits ";  // and the number of the estimate
inline const char* const kSplitPlane = "split plane";
inline const char* const kSplitLinks = "split links";

}  // namespace clv::arrays
