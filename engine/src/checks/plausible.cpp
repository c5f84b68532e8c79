#include "checks/plausible.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "checks/closed_volumes.h"
#include "checks/joint_order.h"
#include "checks/loose_blocks.h"
#include "checks/strength_held.h"
#include "checks/water_levels.h"
#include "checks/water_warnings.h"
#include "measure/words.h"
#include "state/incidence.h"
#include "step/time_step.h"
#include "talus/angles.h"
#include "talus/wet_joint_name.h"

namespace talus::checks {
namespace {

// A block displaced by this share of its size has failed (quasi_static.h).
constexpr double kMostSink = 0.1;
// Water farther above or below a model than this many of its extents is an input error. (Ten: a wedge in an
// abutment may stand under a reservoir several times its own height.)
constexpr double kMostExtents = 10.0;
// Rounding up to the tolerance does not affect an answer; a few times that widens its bracket, and a warning
// says so. Beyond, rounding decides: a slab of 150 m far from the origin was right to four digits at 2.7
// times the tolerance. At 27 times it exceeded its upper bound, undecided.
constexpr double kMostRounding = 5.0;
constexpr double kSlowed = 10.0;  // times the median block's frequency: a warning

/// A joint derived from one of the file's ("default@18.5deg") is named as that one.
std::string fieldOf(const Joint& joint, std::string_view key) {
    return "joint." + joint.name.substr(0, joint.name.find('@')) + "." + std::string(key);
}

/// The stiffest joint of each block, by the given stiffness; -1 for blocks that touch nothing.
std::vector<std::int32_t> stiffestJoints(const State& state, double Joint::*stiffness) {
    const Interfaces& f = state.interfaces;
    const std::vector<Joint>& joints = state.geometry->model.joints;
    const auto of = [&](std::int32_t j) { return joints[static_cast<std::size_t>(j)].*stiffness; };
    std::vector<std::int32_t> stiffest(state.blocks.size(), -1);
    for (std::size_t i = 0; i < f.size(); ++i)
        for (const std::int32_t block : {f.block_a[i], f.block_b[i]}) {
            std::int32_t& best = stiffest[static_cast<std::size_t>(block)];
            if (best < 0 || of(f.joint[i]) > of(best)) best = f.joint[i];
        }
    return stiffest;
}

/// A block of height h sinks by rho g h / k_n. On a slope it shears by that times k_n / k_s before it slides.
/// As a share of its height, neither depends on its size.
void addSoftJoints(const State& state, double Joint::*stiffness, std::string_view key, const char* does,
                   std::vector<Error>& errors) {
    const Model& model = state.geometry->model;
    const std::vector<std::int32_t> stiffest = stiffestJoints(state, stiffness);
    std::vector<char> told(model.joints.size(), 0);
    for (std::size_t b = 0; b < stiffest.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free || stiffest[b] < 0) continue;
        const auto j = static_cast<std::size_t>(stiffest[b]);
        const Joint& joint = model.joints[j];
        const double weight = model.blocks[b].density * model.gravity.magnitude;  // of a cubic metre [N]
        if (!(weight > kMostSink * joint.*stiffness) || told[j]) continue;
        told[j] = 1;
        errors.push_back(
            {fieldOf(joint, key),
             "found " + formatted("%g", joint.*stiffness) + " Pa/m, on which block \"" +
                 model.blocks[b].name + "\" " + does + " by " + formatted("%.2g", weight / joint.*stiffness) +
                 " of its height under its own weight, allowed: at least " +
                 formatted("%.1e", weight / kMostSink) + " Pa/m there; is it in kPa/m or MPa/m?"});
    }
}

std::vector<Error> softJoints(const State& state) {
    std::vector<Error> errors;
    addSoftJoints(state, &Joint::normal_stiffness, "normal_stiffness", "sinks", errors);
    addSoftJoints(state, &Joint::shear_stiffness, "shear_stiffness", "shifts", errors);
    return errors;
}

double largestFactor(const AppliedLoad& load) {
    double most = load.factor.empty() ? 1 : 0;
    for (const LevelPoint& at : load.factor) most = std::max(most, std::abs(at.value));
    return most;
}

/// The entry of its table at which a joint is weakest; nothing where it has no table.
std::optional<LevelPoint> weakestTime(const Joint& joint) {
    const auto& table = joint.strength_over_time;
    const auto least = std::min_element(table.begin(), table.end(),
                                        [](const auto& a, const auto& b) { return a.value < b.value; });
    return least == table.end() ? std::nullopt : std::optional(*least);
}

double leastFriction(const Joint& joint) {
    const auto weakest = weakestTime(joint);
    return weakest ? strengthAt(joint, weakest->time).friction : joint.friction;
}

/// Why a joint's least friction is not that of the scenario: " where 58.5 % of the joint is wet".
std::string whyWeaker(const Joint& joint) {
    std::string why;
    if (const auto wet = readWetJointName(joint.name))
        why += " where " + formatted("%.3g", 100 * wet->share) + " % of the joint is wet";
    const auto weakest = weakestTime(joint);
    if (!weakest || weakest->value == 1) return why;
    // A storm holds one entry: its time is none of the scenario's.
    if (joint.strength_over_time.size() > 1) why += " at " + formatted("%g", weakest->time) + " s";
    return why + " with " + formatted("%g", weakest->value) + " times the strength";
}

/// A joint that dilates by more per slip than its friction resists gains work as it slides: it drives itself
/// downhill. (J. Vermeer and R. de Borst, Heron 29(3), 1984: the angle of dilation is well below that of
/// friction.) Where strength changes over time, the least friction counts.
std::vector<Error> dilatesTooMuch(const Model& model) {
    std::vector<Error> errors;
    for (const Joint& joint : model.joints) {
        const double friction = leastFriction(joint);
        if (joint.law == StrengthLaw::coulomb && joint.dilation > friction) {
            errors.push_back(
                {fieldOf(joint, "dilation_deg"),
                 "found " + formatted("%g", degrees(joint.dilation)) + " with a friction angle of " +
                     formatted("%g", degrees(friction)) + whyWeaker(joint) +
                     ": the joint would create energy as it slides, allowed: at most that friction angle"});
        }
    }
    return errors;
}

struct Heights {
    double low = kInfinity, high = -kInfinity;  ///< [m]

    void take(double height) {
        low = std::min(low, height);
        high = std::max(high, height);
    }
};

Vec3 upAt(double tilt) { return {std::sin(tilt), 0.0, std::cos(tilt)}; }

/// Of all corners of the model, along -g at a tilt.
Heights heightsOf(const Model& model, double tilt) {
    const Vec3 up = upAt(tilt);
    Heights heights;
    for (const Block& block : model.blocks)
        for (const Vec3& v : block.shape.vertices) heights.take(up.dot(v));
    return heights;
}

Heights levelsOf(const Water& water) {
    Heights levels;
    for (const LevelPoint& point : water.level) levels.take(point.value);
    if (water.kind == Water::Level::head)
        for (const double head : water.head) levels.take(head);
    return levels;
}

std::optional<Error> farAway(const Water& water, const Heights& model) {
    const Heights level = levelsOf(water);
    const double height = model.high - model.low, reach = kMostExtents * height;
    if (water.kind != Water::Level::elevation) {
        if (level.high <= reach + height) return std::nullopt;
        return Error{water.field, "found water " + formatted("%g", level.high) + " m deep in a model " +
                                      formatted("%.3g", height) + " m high, allowed: at most " +
                                      formatted("%.3g", reach) + " m above its top; is it in m?"};
    }
    if (level.high <= model.high + reach && level.high >= model.low - reach) return std::nullopt;
    return Error{water.field, "found an elevation of " + formatted("%g", level.high) +
                                  " m, allowed: near the model, which extends from " +
                                  formatted("%.4g", model.low) + " to " + formatted("%.4g", model.high) +
                                  " m"};
}

Heights levelsOf(const PhreaticSurface& table) {
    Heights levels;
    for (const PhreaticSurface::Point& point : table.line) levels.take(point.z);
    for (const Vec3& v : table.mesh.vertices) levels.take(v.z());
    return levels;
}

std::optional<Error> tableFarAway(const PhreaticSurface& table, const Heights& model) {
    const Heights level = levelsOf(table);
    const double reach = kMostExtents * (model.high - model.low);
    if (level.low <= model.high + reach && level.high >= model.low - reach) return std::nullopt;
    return Error{table.field + ".surface",
                 "found a water table at " + formatted("%g", level.low) + " to " +
                     formatted("%g", level.high) + " m, allowed: near the model, which extends from " +
                     formatted("%.4g", model.low) + " to " + formatted("%.4g", model.high) + " m"};
}

/// A fissure holds water to its top; a higher level is that of a reservoir.
std::vector<Error> highWater(const Model& model) {
    constexpr double kHigh = 2.0;  // times the model's own height
    std::vector<Error> doubts;
    const Heights heights = heightsOf(model, model.gravity.tilt);
    const double height = heights.high - heights.low;
    for (const Water& water : model.waters) {
        const double level = levelsOf(water).high;
        if (water.kind != Water::Level::elevation && level > kHigh * height) {
            doubts.push_back({water.field, "found water " + formatted("%g", level) + " m deep in a model " +
                                               formatted("%.3g", height) + " m high"});
        }
    }
    return doubts;
}

std::vector<Error> waterFarAway(const State& state) {
    const Model& model = state.geometry->model;
    if (!model.hasWater()) return {};
    const Heights heights = heightsOf(model, model.gravity.tilt);
    std::vector<Error> errors;
    if (model.phreatic) {
        if (auto fault = tableFarAway(*model.phreatic, heightsOf(model, 0)))
            errors.push_back(std::move(*fault));
    }
    for (const Water& water : model.waters)
        if (auto fault = farAway(water, heights)) errors.push_back(std::move(*fault));
    return errors;
}

/// Out-of-balance force of a block over its weight, by rounding of lengths as large as `reach`.
/// \pre gravity
double roundingOver(const State& state, double reach, double bound) {
    return std::numeric_limits<double>::epsilon() * reach * bound / state.geometry->model.gravity.magnitude;
}

/// The same of a free block by rounding of its own coordinates alone. \pre gravity
double roundingOf(const State& state, const std::vector<double>& bounds, std::size_t b) {
    if (state.blocks.motion[b] != Motion::free) return 0.0;
    const double reach = state.blocks.position.get(b).cwiseAbs().maxCoeff() + state.geometry->radius[b];
    return roundingOver(state, reach, bounds[b]);
}

std::optional<Error> roundingDecides(const State& state, double load_tolerance,
                                     const std::vector<double>& bounds) {
    const Model& model = state.geometry->model;
    if (!(model.gravity.magnitude > 0)) return std::nullopt;
    std::size_t worst = 0;
    for (std::size_t b = 1; b < bounds.size(); ++b)
        if (roundingOf(state, bounds, b) > roundingOf(state, bounds, worst)) worst = b;
    const double level = bounds.empty() ? 0.0 : roundingOf(state, bounds, worst);
    if (!(level > kMostRounding * load_tolerance)) return std::nullopt;
    const auto stiffest = std::max_element(
        model.joints.begin(), model.joints.end(),
        [](const Joint& a, const Joint& b) { return a.normal_stiffness < b.normal_stiffness; });
    return Error{fieldOf(*stiffest, "normal_stiffness"),
                 "found " + formatted("%g", stiffest->normal_stiffness) +
                     " Pa/m, at which rounding keeps the out-of-balance force of block \"" +
                     model.blocks[worst].name + "\" at " + formatted("%.2g", level) +
                     " of its weight; this tolerance requires less than " +
                     formatted("%.2g", kMostRounding * load_tolerance) + ", allowed: at most " +
                     formatted("%.1e", stiffest->normal_stiffness * kMostRounding * load_tolerance / level) +
                     " Pa/m, a wider tolerance, or no block as small (in a rock mass a larger min_thickness "
                     "merges such pieces with their neighbours)"};
}

/// The block whose stiffness for its mass makes a history's steps many times shorter than the median block
/// would.
std::optional<std::string> slowedByOne(const State& state, bool parallel) {
    const std::vector<double> bounds = frequencyBounds(state, parallel);
    const double median = medianBound(bounds);
    if (median == 0) return std::nullopt;
    const auto highest = std::max_element(bounds.begin(), bounds.end());
    const double times = std::sqrt(*highest / median);
    if (!(times > kSlowed)) return std::nullopt;
    const auto block = static_cast<std::size_t>(highest - bounds.begin());
    return "block \"" + state.geometry->model.blocks[block].name + "\" requires time steps " +
           formatted("%.0f", times) +
           " times shorter than the median block, so that a run takes that many times more steps. In a rock "
           "mass a larger min_thickness merges such pieces with their neighbours. Searches are not slowed";
}

}  // namespace

double roundingLevel(const State& state, const std::vector<double>& bounds) {
    if (!(state.geometry->model.gravity.magnitude > 0)) return 0.0;
    double level = 0;
    for (std::size_t b = 0; b < bounds.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const double reach = coordinateReach(state, state.blocks.position, b);
        level = std::max(level, roundingOver(state, reach, bounds[b]));
    }
    return level;
}

std::vector<std::size_t> splintersOfRounding(const State& state, double load_tolerance,
                                             const std::vector<double>& bounds) {
    if (!(state.geometry->model.gravity.magnitude > 0)) return {};
    std::vector<std::size_t> splinters;
    for (std::size_t b = 0; b < bounds.size(); ++b)
        if (roundingOf(state, bounds, b) > kMostRounding * load_tolerance) splinters.push_back(b);
    if (!areSplinters(state, splinters)) splinters.clear();
    return splinters;
}

std::vector<Error> strongLoads(const State& state) {
    const Model& model = state.geometry->model;
    const std::vector<std::int32_t> stiffest = stiffestJoints(state, &Joint::normal_stiffness);
    std::vector<Error> errors;
    for (const AppliedLoad& load : model.loads) {
        const bool is_force = load.kind == AppliedLoad::Kind::force;
        const double most =
            largestFactor(load) * (is_force ? load.force.stableNorm() : std::abs(load.pressure));
        for (std::size_t b = 0; b < stiffest.size(); ++b) {
            const bool loaded =
                load.kind == AppliedLoad::Kind::box || load.block == static_cast<std::int32_t>(b);
            if (!loaded || state.blocks.motion[b] != Motion::free || stiffest[b] < 0) continue;
            const Joint& joint = model.joints[static_cast<std::size_t>(stiffest[b])];
            const double area = is_force ? state.geometry->face_area[b] : 1.0, size = state.geometry->size[b];
            const double allowed = kMostSink * size * joint.normal_stiffness * area;
            if (!(most > allowed)) continue;
            const char* unit = is_force ? " N" : " Pa";
            errors.push_back({load.field + (is_force ? ".force" : ".pressure"),
                              "found " + formatted("%.3g", most) + unit + ", which presses block \"" +
                                  model.blocks[b].name + "\" into its joints by " +
                                  formatted("%.2g", kMostSink * most / allowed) +
                                  " of its size, allowed: at most " + formatted("%.1e", allowed) + unit +
                                  " there; is it in " + (is_force ? "N?" : "Pa?")});
            break;
        }
    }
    return errors;
}

std::optional<Error> nothingHolds(const Model& model) {
    const bool held = std::any_of(model.blocks.begin(), model.blocks.end(),
                                  [](const Block& block) { return block.motion != Motion::free; });
    if (held || model.blocks.empty() || !(model.gravity.magnitude > 0)) return std::nullopt;
    return Error{model.blocks[0].field,
                 "found no fixed or driven block in the model, so that all blocks fall, allowed: at least "
                 "one that supports the others (fixed = true, or [[rock_mass.fixed]])"};
}

std::vector<Error> implausible(const State& state) {
    std::vector<Error> errors = waterFarAway(state);
    if (errors.empty()) errors = openVolumes(state);
    return errors;
}

std::vector<std::string> doubts(const State& state, bool over_time) {
    const Model& model = state.geometry->model;
    std::vector<Error> all = softJoints(state);
    const auto add = [&](std::vector<Error> more) {
        std::move(more.begin(), more.end(), std::back_inserter(all));
    };
    add(strongLoads(state));
    add(dilatesTooMuch(model));
    add(dryWaters(state));
    add(levelsAboveJoints(state, over_time));
    add(highWater(model));
    if (auto falls = nothingHolds(model)) all.push_back(std::move(*falls));
    std::vector<std::string> told;
    told.reserve(all.size());
    for (const Error& doubt : all) told.push_back(doubt.field + ": " + doubt.message);
    return told;
}

std::vector<std::string> doubtsOfHistory(const State& state, bool parallel) {
    std::vector<std::string> told = doubts(state, true);
    if (auto slowed = slowedByOne(state, parallel)) told.push_back(std::move(*slowed));
    for (const Error& weaker : weakerLater(state)) told.push_back(weaker.field + ": " + weaker.message);
    for (const Error& stiff : stiffVolumes(state, parallel))
        told.push_back(stiff.field + ": " + stiff.message);
    if (auto held = wetJointsHeld(state.geometry->model)) told.push_back(std::move(*held));
    return told;
}

std::vector<Error> implausibleSearch(const State& state, double load_tolerance,
                                     const std::vector<double>& bounds) {
    std::vector<Error> errors = implausible(state);
    for (Error& error : softJoints(state)) errors.push_back(std::move(error));
    for (Error& error : strongLoads(state)) errors.push_back(std::move(error));
    for (Error& error : dilatesTooMuch(state.geometry->model)) errors.push_back(std::move(error));
    if (auto error = nothingHolds(state.geometry->model)) errors.push_back(std::move(*error));
    if (auto error = roundingDecides(state, load_tolerance, bounds)) errors.push_back(std::move(*error));
    return errors;
}

}  // namespace talus::checks
