#pragma once
// Colours of blocks by how they move: those of the replay page (Okabe and Ito's, safe for colour-blind
// readers).

#include <array>
#include <cstdint>

#include "talus/formats/export.h"

namespace talus::formats {

using RoleColour = std::array<std::uint8_t, 3>;  ///< sRGB

constexpr RoleColour colourOf(Motion motion, FailureMode role) {
    if (motion != Motion::free) return {180, 180, 180};
    switch (role) {
        case FailureMode::sliding:
            return {230, 159, 0};
        case FailureMode::toppling:
            return {122, 47, 107};
        case FailureMode::mixed:
            return {0, 158, 115};
        case FailureMode::none:
            break;
    }
    return {225, 222, 214};
}

}  // namespace talus::formats
