#pragma once
// The searches for the load at which an assembly fails, each described once. Commands, sweeps, batches, kept
// runs and inspection read this list and know no search by name: a new one is an entry in
// engine/src/search/searches.cpp, and a file for how it is made.

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

/// What the closed formulas say of a search's answer.
struct TheoryFigure {
    double value = 0;  ///< in the load's SI unit
    theory::Prediction prediction;
};

/// Where a scenario says a number, and which that is of a model, in the scenario's unit; nothing where such a
/// scenario does not say it.
struct ScenarioNumber {
    const char* section;
    const char* key;
    int element;  ///< of an array; -1: the number itself
    std::optional<double> (*value)(const Model& model);
};

/// What an analysis varies, described once: how it is called, told, put on a model and written into a
/// scenario. An entry of engine/src/search/searches.cpp.
struct VariedQuantity {
    Varied varied;
    const char* name;    ///< on the command line: "tilt"
    const char* limit;   ///< the greatest one: "critical angle"
    const char* text;    ///< before a figure for people: "tilt", "strengths divided by"
    const char* key;     ///< in JSON and in a sweep's [report]: "tilt_deg"
    const char* unit;    ///< where people see it, and behind keys: "deg"; "" without one
    const char* of;      ///< behind a figure for people instead of a unit: "of the weight"
    double scale;        ///< one unit in SI
    int decimals;        ///< of a figure for people
    int limit_decimals;  ///< of one of limit analysis
    /// By how much joints that give a little may stand above the limit of those that do not; a share of it,
    /// or in SI
    double give;
    bool give_is_share;
    void (*apply)(Model& model, double value);
    bool divides_strengths;                   ///< of all joints, wherever a scenario says one
    std::span<const ScenarioNumber> written;  ///< else: what a scenario at such a load says
};

const VariedQuantity& quantityOf(Varied varied);
std::span<const VariedQuantity> variedQuantities();

struct LoadSearch {
    const char* name;                 ///< on the command line and in files: "critical-angle"
    const char* about;                ///< one sentence for people, without its full stop
    const char* details;              ///< more of them, for a help text
    const char* answer;               ///< what is found: "critical angle"
    const char* answer_key;           ///< the same in JSON and CSV: "critical_angle_deg"
    const char* theory_key;           ///< what the closed formulas say of it: "theory_deg"
    const VariedQuantity* load;       ///< what is varied, and with it the answer's unit
    double lowest, highest;           ///< loads between which a threshold may be asked for, in the unit
    std::optional<double> threshold;  ///< that is asked for unless a sweep names others, in the unit
    bool follows_groups;              ///< finds who goes next, too (Control::groups)
    Result<SearchResult> (*find)(const Model& model, const Control& control, const SearchRules& rules);
    /// Nothing where no formula applies, or where it is stopped: of 100,000 blocks it takes many seconds.
    std::optional<TheoryFigure> (*theory)(const Model& model, const std::atomic<bool>* stop);

    /// "bracket" -> "bracket_deg"
    std::string keyInUnit(std::string_view key) const;
};

/// All of them.
std::span<const LoadSearch> loadSearches();

/// The one of this name; nullptr when there is none.
const LoadSearch* loadSearch(std::string_view name);

/// Blocks that the answer is not for: those that fell at the start and those let go before.
std::vector<std::string> leftOut(const SearchResult& result);

/// Share of the free blocks' mass that those of these names have, 0..1: whether an answer is one of the slope
/// or of a small block.
double massShare(const Model& model, const std::vector<std::string>& blocks);

/// The model as it is at this load.
void putUnderLoad(Model& model, Varied load, double value);

}  // namespace talus
