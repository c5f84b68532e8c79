#pragma once
// Notes on the results, with figures taken from them.

#include <optional>
#include <string>
#include <vector>

#include "reproduction/results.h"

namespace talus::tools {

/// The outcome in one or two sentences, for the head of the page.
std::string mainResult(const PaperResults& results);

struct Note {
    std::string title, text;  ///< plain text
};

/// Differences between the laboratory, the paper's own DEM and this model, and possible reasons.
std::vector<Note> differenceNotes(const PaperResults& results);

/// Misprints in the paper and how they were read.
std::vector<Note> errata();

/// The friction angle at which the exact limit gives a measured angle: the joints' strength by that test
/// [deg]. Nothing when the case's model is not a stack.
std::optional<double> impliedFrictionDeg(const PaperCase& what, double measured_deg);

/// The water depth at which the exact limit gives a measured angle, at the case's friction [m].
std::optional<double> impliedDepth(const PaperCase& what, double measured_deg);

}  // namespace talus::tools
