#pragma once
// A scenario as it fails, at the load that a search has found. Its model is the search's, to
// the bit; its text says the same to whoever reads a kept run.

#include <string>

#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "talus/result.h"

namespace talus::formats {

/// What a search changes in a scenario, and how its failure is played on.
struct FailingLoad {
    Varied varied = Varied::tilt;
    double value = 0;            ///< of what is varied, in its SI unit
    double contact_damping = 0;  ///< Damping::contact [s]; all other damping is off
    double duration = 1;         ///< [s]
    double frame_interval = 0;   ///< [s]
};

/// The model at that load, in the bits of the search. Water levels over time stay at their value at time 0,
/// as in a search.
Model failingModel(Model model, const FailingLoad& load);

/// The same with a text of its own, which starts with `remark` as comment lines and reads back as that model
/// but for the rounding of angles in degrees. What the scenario says of searches stays true of it. Errors:
/// those of reading the text, should the load be outside of what a scenario may say.
Result<Scenario> failingScenario(const Scenario& scenario, const FailingLoad& load,
                                 const std::string& remark);

}  // namespace talus::formats
