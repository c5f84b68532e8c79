#pragma once
// A scenario as it fails, at the load that a search has found. Its model is the search's, to the bit; its
// text describes the same model for readers of a kept run.

#include <string>

#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/result.h"

namespace talus::formats {

/// What a search changes in a scenario, and how its failure is continued.
struct FailingLoad {
    Varied varied = Varied::tilt;
    double value = 0;            ///< value of the varied quantity, in SI units
    double contact_damping = 0;  ///< Damping::contact [s]; all other damping is off
    double duration = 1;         ///< [s]
    double frame_interval = 0;   ///< [s]
};

/// The model at that load, in the bits of the search. Water levels over time stay at their value at time 0,
/// as in a search.
Model failingModel(Model model, const FailingLoad& load);

/// The same with its own text, which starts with `remark` as comment lines. It reads back as that model but
/// for the rounding of angles in degrees. The scenario's settings of searches stay valid. Errors: those of
/// reading the text, if the load is outside the allowed range of a scenario.
Result<Scenario> failingScenario(const Scenario& scenario, const FailingLoad& load,
                                 const std::string& remark);

}  // namespace talus::formats
