#pragma once
// What a run tells of its closed volumes of water.

#include <string>

namespace talus {

/// A water whose level follows from its volume (Water::closed), at the end of a step.
struct WaterReport {
    std::string name;     ///< as messages call it: "water[0]"
    double level = 0;     ///< depth or elevation, as the scenario gives it [m]
    double volume = 0;    ///< [m^3]
    double run_over = 0;  ///< in all, above its overflow [m^3]
    double leaked = 0;    ///< in all, through its foot [m^3]
};

}  // namespace talus
