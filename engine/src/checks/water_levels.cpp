#include "checks/water_levels.h"

#include <algorithm>
#include <optional>
#include <string>

#include "forces/water_level.h"
#include "measure/words.h"
#include "talus/angles.h"

namespace talus::checks {
namespace {

// Of the joint's height: a level given to six digits may stand so far above the joint's end.
constexpr double kSameLevel = 1e-6;

double above(const JointLevel& water) { return water.table - water.high; }

bool isAbove(const JointLevel& water) { return above(water) > kSameLevel * (water.high - water.low); }

/// Whether another joint holds water as high: the two may be connected.
bool mayFeed(const JointLevel& other, const JointLevel& water) {
    const double same = kSameLevel * (water.high - water.low);
    return !isAbove(other) && other.table >= water.table - same;
}

std::string textOf(const State& state, const JointLevel& water, bool is_depth) {
    const auto metres = [](double length) { return formatted("%.4g", length) + " m"; };
    const double tilt_deg = degrees(state.geometry->model.gravity.tilt);
    return std::string("found a ") + (is_depth ? "depth" : "level") + " of " + metres(water.level) +
           ", so that the water stands " + metres(above(water)) + " above the joint's upper end: at " +
           metres(water.table) + " instead of at most " + metres(water.high) +
           (tilt_deg == 0 ? ""
                          : " (heights along gravity at a tilt of " + formatted("%.4g", tilt_deg) + " deg)") +
           "; a joint that is open there runs over, and its pressure is lower";
}

}  // namespace

std::vector<Error> levelsAboveJoints(const State& state) {
    const Model& model = state.geometry->model;
    std::vector<std::optional<JointLevel>> levels;
    for (std::size_t w = 0; w < model.waters.size(); ++w) levels.push_back(jointLevel(state, w));
    std::vector<Error> doubts;
    if (model.is_remainder || !(model.gravity.magnitude > 0)) return doubts;
    for (std::size_t w = 0; w < levels.size(); ++w) {
        if (!levels[w] || !isAbove(*levels[w])) continue;
        const auto feeds = [&](const auto& other) { return other && mayFeed(*other, *levels[w]); };
        if (std::any_of(levels.begin(), levels.end(), feeds)) continue;
        const bool is_depth = model.waters[w].kind == Water::Level::depth;
        doubts.push_back({model.waters[w].field, textOf(state, *levels[w], is_depth)});
    }
    return doubts;
}

}  // namespace talus::checks
