#include "checks/water_levels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "forces/water_level.h"
#include "measure/words.h"
#include "talus/angles.h"

namespace talus::checks {
namespace {

// Of the joint's height and of the elevation: a level given to six digits may stand so far above its end.
constexpr double kSameLevel = 1e-6;

double above(const JointLevel& water) { return water.table - water.high; }

double same(const JointLevel& water) {
    return kSameLevel * std::max({water.high - water.low, std::abs(water.high), std::abs(water.level)});
}

bool isAbove(const JointLevel& water) { return above(water) > same(water); }

/// Whether another joint holds water as high: the two may be connected.
bool mayFeed(const JointLevel& other, const JointLevel& water) {
    return !isAbove(other) && other.table >= water.table - same(water);
}

/// A pressure on a level bed is given as a depth: the bed has no height for water to stand in.
bool isLevel(const State& state, const JointLevel& water) {
    return water.high - water.low < kSameLevel * state.geometry->length_scale;
}

/// Water that stands outside the joints, or a table in all of them, may feed any of them.
bool hasOpenWater(const Model& model, const std::vector<std::optional<JointLevel>>& levels) {
    if (model.phreatic) return true;
    for (std::size_t w = 0; w < levels.size(); ++w)
        if (!levels[w] && !isNothing(model.waters[w])) return true;
    return false;
}

std::string textOf(const State& state, const JointLevel& water, bool is_depth) {
    const auto metres = [](double length) {
        return formatted("%.7g", std::abs(length) < 1e-9 ? 0.0 : length) + " m";
    };
    const double tilt_deg = degrees(state.geometry->model.gravity.tilt);
    return std::string("found a ") + (is_depth ? "depth" : "level") + " of " + metres(water.level) +
           ", so that the water stands " + formatted("%.4g", above(water)) + " m" +
           " above the joint's upper end: at " + metres(water.table) + " instead of at most " +
           metres(water.high) +
           (tilt_deg == 0 ? ""
                          : " (heights along gravity at a tilt of " + formatted("%.4g", tilt_deg) + " deg)") +
           "; a joint that is open there runs over, and its pressure is lower";
}

}  // namespace

bool isNothing(const Water& water) {
    if (water.kind == Water::Level::head) return water.head[0] == 0 && water.head[1] == 0;
    return water.kind == Water::Level::depth &&
           std::all_of(water.level.begin(), water.level.end(),
                       [](const LevelPoint& point) { return point.value == 0; });
}

std::vector<Error> levelsAboveJoints(const State& state, bool over_time) {
    const Model& model = state.geometry->model;
    std::vector<std::optional<JointLevel>> levels;
    for (std::size_t w = 0; w < model.waters.size(); ++w) levels.push_back(jointLevel(state, w, over_time));
    std::vector<Error> doubts;
    if (model.is_remainder || !(model.gravity.magnitude > 0) || hasOpenWater(model, levels)) return doubts;
    for (std::size_t w = 0; w < levels.size(); ++w) {
        if (!levels[w] || isLevel(state, *levels[w]) || !isAbove(*levels[w])) continue;
        const auto feeds = [&](const auto& other) { return other && mayFeed(*other, *levels[w]); };
        if (std::any_of(levels.begin(), levels.end(), feeds)) continue;
        const bool is_depth = model.waters[w].kind == Water::Level::depth;
        doubts.push_back({model.waters[w].field, textOf(state, *levels[w], is_depth)});
    }
    return doubts;
}

}  // namespace talus::checks
