#pragma once
// The factor of safety of a slope over hours or days in which its water rises and falls, or over seasons in
// which the strength of its joints changes.
//
// Levels follow from rain, inflow, leaks and overflow (forces/closed_water.h) or from tables over time, while
// the walls stand as built: a storm is so slow that blocks are in equilibrium at every moment. Strengths
// follow from tables over time (Joint::strength_over_time). Each time is then one search for the factor of
// safety with these levels and strengths held. Nothing in it depends on earlier ones.

#include <optional>
#include <string>
#include <vector>

#include "talus/analysis.h"
#include "talus/simulation.h"

namespace talus {

struct StormSettings {
    double step = 600;  ///< between two times of the answer, more than 0; times of tables come between [s]
    std::optional<double> duration{};  ///< more than 0 [s]; none: up to the end of the tables (stormDuration)
};

/// The factor of safety at one time.
struct StormPoint {
    double time = 0;                ///< [s]
    std::vector<double> levels;     ///< of StormResult::waters, as the scenario gives them [m]
    std::vector<double> strengths;  ///< factors of strength of StormResult::joints
    SearchStatus status = SearchStatus::undecided;
    double factor = 0;         ///< valid when found
    double low = 0, high = 0;  ///< its bracket; NaN where it is interpolated
    FailureMode mode = FailureMode::none;
    bool interpolated = false;  ///< between two searches, over the level or the strength
};

struct StormResult {
    std::vector<std::string> waters;  ///< those whose levels change, as messages call them: "water[0]"
    /// Names of joints whose strengths change; those that change alike are one entry: "ice, clay".
    std::vector<std::string> joints;
    std::vector<StormPoint> points;          ///< in the order of time
    std::optional<std::size_t> least;        ///< the point with the least factor; the first of equal ones
    std::optional<double> failure_time;      ///< when the factor falls below 1, linear between points [s]
    std::vector<std::string> moving_blocks;  ///< at the least factor; sorted
    std::vector<WaterReport> at_end;         ///< closed volumes at the end of the storm
    std::size_t searches = 0;
    double wall_seconds = 0;
    bool interrupted = false;           ///< points without a search are undecided
    std::vector<std::string> warnings;  ///< of its input, and of the search with the least factor
};

/// When the last table of the waters and strengths ends that change [s]; none where they have no table.
std::optional<double> stormDuration(const Model& model);

/// Levels and strengths over time, and the factor of safety at each. Where one of them alone changes, factors
/// between searches are interpolated over it where that is exact to within
/// AnalysisSettings::factor_tolerance. The least factor and both sides of a fall below 1 are always searched
/// for.
/// Errors: those of safetyFactor, neither water nor strength that changes, no end, a step or a duration that
/// is not positive and finite, more than kMostStormPoints steps, or as many times again of tables.
Result<StormResult> storm(const Model& model, const StormSettings& settings, const Control& control = {});

inline constexpr std::size_t kMostStormPoints = 20000;  ///< two weeks, minute by minute

}  // namespace talus
