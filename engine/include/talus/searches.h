#pragma once
// The searches for the load at which an assembly fails, each described once. Commands, sweeps, batches, kept runs and
// inspection read this list and know no search by name: a new one is an entry in engine/src/analysis/searches.cpp, and a
// file for how it is made.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "talus/analysis.h"
#include "talus/theory.h"

namespace talus {

/// What the closed formulas say of a search's answer.
struct TheoryFigure {
    double value = 0;  ///< in the load's SI unit
    theory::Prediction prediction;
};

struct LoadSearch {
    const char* name;        ///< on the command line and in files: "critical-angle"
    const char* about;       ///< one sentence for people, without its full stop
    const char* details;     ///< more of them, for a help text
    const char* answer;      ///< what is found: "critical angle"
    const char* answer_key;  ///< the same in JSON and CSV: "critical_angle_deg"
    const char* theory_key;  ///< what the closed formulas say of it: "theory_deg"
    Varied load;
    const char* load_text;  ///< before a load's figure: "tilt", "strengths divided by"
    const char* load_key;   ///< in JSON and in a sweep's [report]: "tilt_deg"
    const char* unit;  ///< of answer and load where people see them, and behind keys: "deg"; "" without one
    double scale;      ///< one unit in SI
    int decimals;      ///< of a figure for people
    double lowest, highest;           ///< loads between which a threshold may be asked for, in the unit
    std::optional<double> threshold;  ///< that is asked for unless a sweep names others, in the unit
    Result<SearchResult> (*find)(const Model& model, const Control& control, const QuasiStatic& settings);
    std::optional<TheoryFigure> (*theory)(const Model& model);  ///< nothing where no formula applies

    /// "bracket" -> "bracket_deg"
    std::string keyInUnit(std::string_view key) const;
};

/// All of them.
std::span<const LoadSearch> loadSearches();

/// The one of this name; nullptr when there is none.
const LoadSearch* loadSearch(std::string_view name);

/// The model with its gravity or its joints as they are at this load.
void putUnderLoad(Model& model, Varied load, double value);

}  // namespace talus
