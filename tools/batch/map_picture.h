#pragma once
// A map of failure as a picture: the face seen from the front, its cells in colours.

#include <array>
#include <cstdint>
#include <string>

#include "batch/failure_map.h"

namespace talus::tools::batch {

enum class MapQuantity : std::uint8_t {
    probability,
    volume_per_area  ///< expected failing volume per m2
};

/// Pale yellow to dark red; grey for 0. \param share of the scale, 0..1
std::array<std::uint8_t, 3> mapColour(double share);

std::string hexColour(const std::array<std::uint8_t, 3>& colour);  ///< "#ffeda0"

std::string scaleTitle(MapQuantity quantity);

/// The scale's upper end: the largest value, rounded up to 1, 2 or 5 times a power of ten.
double scaleEnd(const FailureMap& map, MapQuantity quantity);

/// Largest number of cells that a page can show.
inline constexpr std::size_t kMostDrawnCells = 20'000;

/// An SVG file. Each cell tells its numbers under the pointer.
std::string mapSvg(const FailureMap& map, MapQuantity quantity);

/// From where it is seen, for a caption.
std::string viewText(const FailureMap& map);

}  // namespace talus::tools::batch
