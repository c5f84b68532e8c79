#pragma once
// What the figures say, in words, with the figures taken from the results.

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

/// Where laboratory, the paper's own DEM and this model differ, and what that may rest on.
std::vector<Note> differenceNotes(const PaperResults& results);

/// What is wrong in the paper's print and how it was read.
std::vector<Note> errata();

/// The friction angle at which the exact limit gives a measured angle: what a test says of its own joints
/// [deg]. Nothing when the case's model is not a stack.
std::optional<double> impliedFrictionDeg(const PaperCase& what, double measured_deg);

/// The water depth at which the exact limit gives a measured angle, at the case's friction [m].
std::optional<double> impliedDepth(const PaperCase& what, double measured_deg);

}  // namespace talus::tools
