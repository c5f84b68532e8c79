#include "checks/water_levels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "forces/closed_water.h"
#include "forces/water_level.h"
#include "measure/words.h"
#include "talus/angles.h"

namespace talus::checks {
namespace {

// Of the joint's height and of the elevation: a level given to six digits may stand so far above its end.
constexpr double kSameLevel = 1e-6;
constexpr const char* kAboveUpperEnd = "above the joint's upper end";

/// A water that stands in its joint at one time, by its number.
struct Stand {
    std::size_t water = 0;
    JointHeights joint{};
    double time = 0;   ///< [s]
    double level = 0;  ///< a depth or an elevation [m]

    double table() const { return joint.table.at(level); }
    double above() const { return table() - joint.high; }
    double same() const {
        return kSameLevel * std::max({joint.high - joint.low, std::abs(joint.high), std::abs(level)});
    }
    bool isAbove() const { return above() > same(); }
    /// Whether another joint's water stands as high: the two may be connected.
    bool mayBeFedBy(const Stand& other) const {
        return !other.isAbove() && other.table() >= table() - same();
    }
};

Stand atTime(const State& state, Stand stand, double time) {
    stand.time = time;
    stand.level = levelNow(state, stand.water, time);
    return stand;
}

/// Each water that stands in a joint, at time 0.
std::vector<Stand> standing(const State& state) {
    std::vector<Stand> all;
    for (std::size_t water = 0; water < state.geometry->model.waters.size(); ++water)
        if (const auto joint = jointHeights(state, water)) all.push_back(atTime(state, {water, *joint}, 0));
    return all;
}

/// A pressure on a level bed is given as a depth: the bed has no height for water to stand in.
bool isLevel(const State& state, const Stand& stand) {
    return stand.joint.high - stand.joint.low < kSameLevel * state.geometry->length_scale;
}

/// Water that stands outside the joints, or a table in all of them, may feed any of them.
bool hasOpenWater(const Model& model, const std::vector<Stand>& in_joints) {
    if (model.phreatic) return true;
    std::vector<char> outside(model.waters.size(), 1);
    for (const Stand& stand : in_joints) outside[stand.water] = 0;
    for (std::size_t water = 0; water < outside.size(); ++water)
        if (outside[water] != 0 && !isNothing(model.waters[water])) return true;
    return false;
}

/// The stand of a water, at one time of its own, that is farthest above its joint; nothing where none is
/// above, or another feeds it then. \param times  ascending
std::optional<Stand> farthestAbove(const State& state, const std::vector<Stand>& all, const Stand& of,
                                   const std::vector<double>& times) {
    std::optional<Stand> farthest;
    for (const double time : times) {
        const Stand now = atTime(state, of, time);
        if (!now.isAbove() || (farthest && now.above() <= farthest->above())) continue;
        const bool is_fed = std::any_of(all.begin(), all.end(), [&](const Stand& other) {
            return now.mayBeFedBy(atTime(state, other, time));
        });
        if (!is_fed) farthest = now;
    }
    return farthest;
}

/// Times of a water's table; 0 where it has none, or where only that counts.
std::vector<double> timesOf(const Water& water, bool over_time) {
    if (!over_time || water.level.size() < 2) return {0};
    std::vector<double> times;
    for (const LevelPoint& point : water.level) times.push_back(point.time);
    return times;
}

std::string textOf(const State& state, const Stand& stand, bool over_time) {
    const auto metres = [](double length) {
        return formatted("%.7g", std::abs(length) < 1e-9 ? 0.0 : length) + " m";
    };
    const Model& model = state.geometry->model;
    const Water& water = model.waters[stand.water];
    const double tilt_deg = degrees(model.gravity.tilt);
    return std::string("found a ") + (water.kind == Water::Level::depth ? "depth" : "level") + " of " +
           metres(stand.level) +
           (over_time && water.level.size() > 1 ? " at " + formatted("%g", stand.time) + " s" : "") +
           ", so that the water stands " + formatted("%.4g", stand.above()) + " m " + kAboveUpperEnd +
           ": at " + metres(stand.table()) + " instead of at most " + metres(stand.joint.high) +
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
    if (model.is_remainder || !(model.gravity.magnitude > 0)) return {};
    const std::vector<Stand> all = standing(state);
    std::vector<Error> doubts;
    if (hasOpenWater(model, all)) return doubts;
    for (const Stand& stand : all) {
        if (isLevel(state, stand)) continue;
        const Water& water = model.waters[stand.water];
        if (const auto farthest = farthestAbove(state, all, stand, timesOf(water, over_time)))
            doubts.push_back({water.field, textOf(state, *farthest, over_time)});
    }
    return doubts;
}

bool isOfLevelAboveJoint(const std::string& warning, const Water& water) {
    return warning.starts_with(water.field + ": ") && warning.find(kAboveUpperEnd) != std::string::npos;
}

}  // namespace talus::checks
