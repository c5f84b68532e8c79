#pragma once
// Choices of a report: its search, and the face and friction angle of its stereonet.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answers/kinematics.h"
#include "talus/formats/scenario.h"
#include "talus/searches.h"

namespace talus::tools {

/// A choice, and the reason that the page states.
template <class T>
struct Chosen {
    T value{};
    std::string because{};
};

/// The search of a report. In this order: the given one; the one whose range or tolerance is given under
/// [analysis]; the critical angle of a scenario with gravity.tilt_deg; the factor of safety. Throws BadInput
/// for a name that is none. \param wish a search's name, or empty
Chosen<const LoadSearch*> analysisOf(const formats::Scenario& scenario, const std::string& wish);

/// The face that the stereonet tests: the one given ("65/270"), else that of the model (face.h). Nothing
/// where the model has no such faces. Throws BadInput.
std::optional<Chosen<kinematics::Face>> netFace(const formats::Scenario& scenario, const std::string& wish);

/// The least friction angle of the joints of the model that have friction [rad].
Chosen<double> netFriction(const Model& model);

/// XXH128 of the scenario's text and of each file that it names and that was read: {name, digest}.
std::vector<std::pair<std::string, std::string>> inputDigests(const formats::Scenario& scenario);

}  // namespace talus::tools
