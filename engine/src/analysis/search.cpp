// Critical angle, factor of safety, critical acceleration: what each goes up, and in which cells.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "analysis/loose_blocks.h"
#include "analysis/search_of_the_rest.h"
#include "analysis/search_warnings.h"
#include "law/joint_laws.h"
#include "talus/analysis.h"

namespace talus {
namespace {

double degrees(double radians) { return radians * 180.0 / M_PI; }

/// Halvings of `step` until it is no wider than the tolerance.
int halvings(double step, double tolerance) {
    return std::max(0, static_cast<int>(std::ceil(std::log2(step / tolerance) - 1e-9)));
}

/// Joints that have friction alone: in units of the factor at which the weakest has one of 80 degrees, and as many cells for
/// any friction up to 48 degrees. So whatever share of that strength the model gives, the search goes the same way to the bit,
/// and its answer is in proportion: another way may end in another frictional state, and more friction could give less safety.
analysis::LoadAxis axisOfFriction(const Model& model) {
    constexpr double kWidest = 0.2;
    analysis::LoadAxis axis;
    axis.unit = analysis::strongestFactor(model.joints);
    axis.start = 1;
    const int count = halvings(std::max(axis.unit, kWidest), model.analysis.factor_tolerance);
    axis.cell = 1 / static_cast<double>(std::int64_t{1} << count);
    axis.overload = 16;  // cells are half as wide for most friction
    axis.imbalance_tolerance = 0.1 * kWidest * axis.cell;
    axis.apply = [joints = analysis::strongest(model.joints)](State& state, double factor) {
        state.laws = jointLaws(joints, factor);
    };
    return axis;
}

analysis::LoadAxis axisOfStrength(const Model& model) {
    analysis::LoadAxis axis;
    axis.start = analysis::strongestFactor(model.joints);
    axis.cell = axis.start /
                static_cast<double>(std::int64_t{1} << halvings(axis.start, model.analysis.factor_tolerance));
    // The driving force is at most the weight, so a change of F by a cell is worth at most that share of it.
    axis.imbalance_tolerance = 0.1 * axis.cell;
    axis.apply = [&model](State& state, double factor) { state.laws = jointLaws(model.joints, factor); };
    return axis;
}

using Find = Result<SearchResult> (*)(const Model&, const Control&, const QuasiStatic&);

// A search with cohesion kept takes as long as the first, or ten times as long: it is made up to a fifteenth of the contact points up
// to which other loading histories are looked at.
constexpr std::size_t kDearerThanRange = 15;

// As limit equilibrium has it: what slips or tears keeps its strength.
void keepCohesion(Joint& joint) {
    joint.residual_cohesion = std::max(joint.residual_cohesion, joint.cohesion);
}
void keepTension(Joint& joint) {
    if (joint.tensile_strength > 0)
        joint.softening_displacement = propertyOf(&Joint::softening_displacement).allowed.max;
}

/// To the warning of an answer that hangs on cohesion or tensile strength lost at the first slip or opening adds the answer for
/// strength that is kept, in small models.
void tellKeptStrength(Find find, const Model& model, const Control& control, const QuasiStatic& settings,
                      const std::function<std::string(double)>& say, SearchResult& result) {
    const auto warning =
        std::find_if(result.warnings.begin(), result.warnings.end(), [](const std::string& text) {
            return text.starts_with(analysis::kHangsOnCohesion) ||
                   text.starts_with(analysis::kHangsOnTension);
        });
    if (warning == result.warnings.end() || result.status != SearchStatus::found ||
        result.contact_points > control.most_points_of_range / kDearerThanRange)
        return;
    const bool is_cohesion = warning->starts_with(analysis::kHangsOnCohesion);
    Model kept = model;
    for (Joint& joint : kept.joints) is_cohesion ? keepCohesion(joint) : keepTension(joint);
    Control alone = control;
    alone.keep_failing_state = false;
    alone.groups = 1;
    alone.most_points_of_range = 0;
    const Result<SearchResult> found = find(kept, alone, settings);
    if (!found) return;
    result.wall_seconds += found->wall_seconds;
    if (found->status != SearchStatus::found) return;
    if (is_cohesion) result.kept_cohesion = found->answer;
    *warning += std::string("; the answer with ") + (is_cohesion ? "cohesion" : "tensile strength") +
                " kept: " + say(found->answer);
}

// Farthest load steps of the implicit solve: beyond, it may pass a failure and come to rest where the assembly stands again.
constexpr double kMostTilt = 6e-3, kMostOfFactor = 1.0 / 16, kMostAcceleration = 0.006;

std::int64_t cellsOf(double load, const analysis::LoadAxis& axis) {
    return std::max<std::int64_t>(1, std::llround(load / axis.cell));
}

}  // namespace

Result<SearchResult> criticalAngle(const Model& model, const Control& control, const QuasiStatic& settings) {
    analysis::LoadAxis axis;
    axis.start = model.analysis.start.value_or(model.gravity.tilt);
    const double step = (model.analysis.stop - axis.start) / 8;
    const std::int64_t cells = std::int64_t{1} << halvings(step, model.analysis.tolerance);
    axis.cell = step / static_cast<double>(cells);
    axis.stop = 8 * cells;
    axis.imbalance_tolerance = axis.cell;  // out-of-balance force over weight changes like the tilt [rad]
    axis.next = [cells](std::int64_t cell) { return cell + cells; };
    axis.farthest = [most = cellsOf(kMostTilt, axis)](std::int64_t cell) { return cell + most; };
    axis.apply = [](State& state, double tilt) { state.load.tilt = tilt; };
    axis.say = [](double tilt) { return analysis::formatted("tilt %.4f deg", degrees(tilt)); };
    Result<SearchResult> result = analysis::searchOfTheRest(model, axis, control, settings);
    if (result) tellKeptStrength(criticalAngle, model, control, settings, axis.say, *result);
    return result;
}

Result<SearchResult> safetyFactor(const Model& model, const Control& control, const QuasiStatic& settings) {
    constexpr double kStop = 100;  // doubled from the start on until it fails or is beyond that
    analysis::LoadAxis axis =
        analysis::haveFrictionOnly(model.joints) ? axisOfFriction(model) : axisOfStrength(model);
    axis.strongest_at_start = true;
    const auto cells = static_cast<std::int64_t>(std::llround(axis.start / axis.cell));
    const int doublings =
        std::max(1, static_cast<int>(std::ceil(std::log2(kStop / (axis.unit * axis.start)))));
    axis.stop = ((std::int64_t{1} << doublings) - 1) * cells;
    axis.next = [cells](std::int64_t cell) { return 2 * cell + cells; };
    axis.farthest = [axis](std::int64_t cell) {
        return cell + cellsOf(kMostOfFactor * axis.load(cell), axis);
    };
    axis.say = [unit = axis.unit](double factor) {
        return analysis::formatted("factor %.4f", unit * factor);
    };
    Result<SearchResult> result = analysis::searchOfTheRest(model, axis, control, settings);
    if (result) analysis::addGroups(model, axis, control, settings, *result);
    const auto say = [](double factor) { return analysis::formatted("factor %.4f", factor); };
    if (result) tellKeptStrength(safetyFactor, model, control, settings, say, *result);
    return result;
}

Result<SearchResult> criticalAcceleration(const Model& model, const Control& control,
                                          const QuasiStatic& settings) {
    constexpr double kStep = 0.1;  // then twice as far on until it fails
    constexpr int kDoublings = 10;
    analysis::LoadAxis axis;
    axis.start = model.seismic.horizontal;
    const std::int64_t cells = std::int64_t{1} << halvings(kStep, model.analysis.acceleration_tolerance);
    axis.cell = kStep / static_cast<double>(cells);
    axis.stop = ((std::int64_t{1} << kDoublings) - 1) * cells;
    axis.imbalance_tolerance = axis.cell;  // out-of-balance force over weight changes like the coefficient
    axis.next = [cells](std::int64_t cell) { return 2 * cell + cells; };
    axis.farthest = [most = cellsOf(kMostAcceleration, axis)](std::int64_t cell) { return cell + most; };
    axis.apply = [](State& state, double horizontal) { state.load.horizontal = horizontal; };
    axis.say = [](double horizontal) {
        return analysis::formatted("horizontal %.5f of the weight", horizontal);
    };
    Result<SearchResult> result = analysis::searchOfTheRest(model, axis, control, settings);
    if (result) tellKeptStrength(criticalAcceleration, model, control, settings, axis.say, *result);
    return result;
}

}  // namespace talus
