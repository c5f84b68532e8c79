#pragma once
// The searches for the load at which an assembly fails, each described once. Commands, sweeps, batches, kept
// runs and inspection read this list. A new search is an entry in engine/src/search/searches.cpp and a file
// with its function.
//
// Names, units and help texts stand beside the function that they describe. Commands, batches, pages and
// Python all show them, and an answer whose unit or key differed between two of these would be wrong.

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "talus/analysis.h"
#include "talus/theory.h"

namespace talus {

/// A search's answer by the closed formulas.
struct TheoryFigure {
    double value = 0;  ///< in the load's SI unit
    theory::Prediction prediction;
};

/// The scenario key of a number, and its value in a model, in the scenario's unit; nothing where that
/// scenario lacks it.
struct ScenarioNumber {
    const char* section;
    const char* key;
    int element;  ///< of an array; -1: the number itself
    std::optional<double> (*value)(const Model& model);
};

/// The quantity that an analysis varies: its names, units, and how it is put on a model and written into a
/// scenario. An entry of engine/src/search/searches.cpp.
struct VariedQuantity {
    Varied varied;
    const char* name;    ///< on the command line: "tilt"
    const char* limit;   ///< the greatest one: "critical angle"
    const char* text;    ///< before a figure in text: "tilt", "strengths divided by"
    const char* key;     ///< in JSON and in a sweep's [report]: "tilt_deg"
    const char* unit;    ///< in text, and behind keys: "deg"; "" without one
    const char* of;      ///< behind a figure in text instead of a unit: "of the weight"
    double scale;        ///< one unit in SI
    int decimals;        ///< of a figure for people
    int limit_decimals;  ///< of one of limit analysis
    /// How far an answer with elastic joints may exceed the limit of rigid ones; a share of it, or in SI
    double give;
    bool give_is_share;
    void (*apply)(Model& model, double value);
    bool divides_strengths;                   ///< of all joints, at each place of a scenario
    std::span<const ScenarioNumber> written;  ///< else: the scenario's text at such a load
};

const VariedQuantity& quantityOf(Varied varied);
std::span<const VariedQuantity> variedQuantities();

struct LoadSearch {
    const char* name;                 ///< on the command line and in files: "critical-angle"
    const char* about;                ///< one sentence, without its full stop
    const char* details;              ///< more of them, for a help text
    const char* answer;               ///< what is found: "critical angle"
    const char* answer_key;           ///< the same in JSON and CSV: "critical_angle_deg"
    const char* theory_key;           ///< the closed formulas' value: "theory_deg"
    const VariedQuantity* load;       ///< what is varied, and with it the answer's unit
    double lowest, highest;           ///< allowed range of a threshold, in the unit
    std::optional<double> threshold;  ///< default threshold of a sweep, in the unit
    bool follows_groups;              ///< finds successive failure groups, too (Control::groups)
    Result<SearchResult> (*find)(const Model& model, const Control& control, const SearchRules& rules);
    /// Nothing where no formula applies, or when stopped: it takes many seconds for 100,000 blocks.
    std::optional<TheoryFigure> (*theory)(const Model& model, const std::atomic<bool>* stop);

    /// "bracket" -> "bracket_deg"
    std::string keyInUnit(std::string_view key) const;
};

/// All of them.
std::span<const LoadSearch> loadSearches();

/// The one of this name; nullptr when there is none.
const LoadSearch* loadSearch(std::string_view name);

/// Blocks removed before the answer: those that fell at the start, and small failures.
std::vector<std::string> leftOut(const SearchResult& result);

/// Share of the free blocks' mass that the named blocks have, 0..1: tells a slope failure from that of a
/// small block.
double massShare(const Model& model, const std::vector<std::string>& blocks);

/// The model at this load.
void putUnderLoad(Model& model, Varied load, double value);

}  // namespace talus
