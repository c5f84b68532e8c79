#pragma once
// Sensitivity of an answer to friction, the horizontal seismic coefficient and stiffness: the same search
// with each slightly smaller and larger.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report/figures.h"
#include "talus/formats/scenario.h"
#include "talus/searches.h"

namespace talus::tools {

/// One search of a changed model.
struct SensitivityTrial {
    std::string what;  ///< "-10 %", "k = 0.05"
    SearchStatus status = SearchStatus::undecided;
    double answer = 0;  ///< SI; valid when found
    FailureMode mode = FailureMode::none;
    double volume = 0, mass = 0;  ///< of what fails [m^3, kg]
};

/// Both sides of one quantity.
struct Sensitivity {
    std::string quantity;  ///< "friction"
    std::string change;    ///< exact description of the change
    SensitivityTrial less, more;
};

/// A quantity and its change in a model.
struct ChangedQuantity {
    std::string quantity, change, less_text, more_text;
    std::function<void(Model&)> less, more;
};

/// Friction and stiffness by `share` each way, the coefficient by kSeismicStep; not the coefficient where
/// the search itself varies it.
std::vector<ChangedQuantity> changedQuantities(const Model& model, Varied varied, double share);
inline constexpr double kMostShare = 0.9;
/// Whether a share is allowed: more than 0, at most kMostShare.
inline bool isSensitivity(double share) { return share > 0 && share <= kMostShare; }
inline constexpr double kSeismicStep = 0.05;  ///< of the weight

/// Nothing once `control` asks to stop.
std::optional<std::vector<Sensitivity>> sensitivities(const formats::Scenario& scenario,
                                                      const LoadSearch& search, double share,
                                                      const Control& control);

/// "1.234 deg", or why there is none.
std::string trialText(const LoadSearch& search, const SensitivityTrial& trial);

std::string sensitivityCsv(const std::vector<Sensitivity>& list, const LoadSearch& search,
                           const std::string& comments);

/// Nothing where no trial has an answer. \param answer  of the model as it is, SI; nothing: not found
std::optional<Plot> sensitivityPlot(const std::vector<Sensitivity>& list, const LoadSearch& search,
                                    std::optional<double> answer, const std::string& scenario);

}  // namespace talus::tools
