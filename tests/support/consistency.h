#pragma once
// Consistency of a model's answers: the three searches agree with each other, with limit analysis, with the
// closed formulas and with time histories.

#include <string>
#include <vector>

#include "talus/model.h"

namespace talus::test {

struct Consistency {
    double tilt_deg = 0;  ///< the critical angle; 0 where there is none
    std::string answers;  ///< in a line, for people
    std::vector<std::string> contradictions;
    std::vector<std::string> undecided;    ///< searches that end so
    std::vector<std::string> differences;  ///< answers that may differ, and do by more than 2 %
};

/// \param with_history  also runs the model just below and just above its critical angle
Consistency checkConsistency(const Model& model, bool with_history);

}  // namespace talus::test
