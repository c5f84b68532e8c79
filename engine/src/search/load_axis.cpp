#include "search/load_axis.h"

#include <cmath>

#include "law/joint_laws.h"
#include "measure/words.h"

namespace talus::search {
namespace {

constexpr double kInDegrees = 180.0 / M_PI;
// The driving force is at most the weight, and usually a few tenths of it. So a relative change of strength
// is equivalent to at least a tenth of that share of the weight.
constexpr double kLeastDriving = 0.1;
constexpr double kMostFactor = 100;  // no larger factor is searched for
constexpr double kMostAcceleration = 100;
constexpr double kShareCell = 1e-3;  // of weight and water: their paths have no answer of their own

LoadAxis shareAxis(double imbalance, const char* say, double Load::*share) {
    LoadAxis axis;
    axis.loading.apply = [share](State& state, double load) { state.load.*share = load; };
    axis.loading.cell = kShareCell;
    axis.loading.imbalance = imbalance;
    axis.stop = 1;
    axis.longest_step = 1;
    axis.say = [say](double load) { return formatted(say, 100 * load); };
    return axis;
}

}  // namespace

LoadAxis tiltAxis(const Model& model, const SearchRules& rules) {
    LoadAxis axis;
    axis.start = model.analysis.start.value_or(model.gravity.tilt);
    axis.stop = model.analysis.stop;
    axis.loading.cell = model.analysis.tolerance;
    axis.loading.imbalance = axis.loading.cell;  // forces over weight change like the tilt [rad]
    axis.loading.apply = [](State& state, double tilt) { state.load.tilt = tilt; };
    axis.longest_step = rules.step_tilt;
    axis.say = [](double tilt) { return formatted("tilt %.4f deg", kInDegrees * tilt); };
    return axis;
}

LoadAxis strengthAxis(const Model& model, const SearchRules& rules) {
    LoadAxis axis;
    axis.start = 1;
    axis.stop = kMostFactor;
    axis.loading.cell = model.analysis.factor_tolerance;
    axis.loading.imbalance = kLeastDriving * axis.loading.cell;
    axis.loading.changes_strength = true;
    axis.loading.apply = [&model](State& state, double factor) {
        state.laws = jointLaws(model.joints, factor);
    };
    axis.longest_step = rules.step_factor;
    axis.longest_is_share = true;
    axis.say = [](double factor) { return formatted("factor %.4f", factor); };
    return axis;
}

LoadAxis accelerationAxis(const Model& model, const SearchRules& rules) {
    LoadAxis axis;
    axis.start = model.seismic.horizontal;
    axis.stop = kMostAcceleration;
    axis.loading.cell = model.analysis.acceleration_tolerance;
    axis.loading.imbalance = axis.loading.cell;  // forces over weight change like the coefficient
    axis.loading.apply = [](State& state, double horizontal) { state.load.horizontal = horizontal; };
    axis.longest_step = rules.step_acceleration;
    axis.say = [](double horizontal) { return formatted("horizontal %.5f of the weight", horizontal); };
    return axis;
}

LoadAxis weightAxis(double imbalance) {
    return shareAxis(imbalance, "%.0f %% of the weight", &Load::gravity_share);
}

LoadAxis waterAxis(double imbalance) {
    return shareAxis(imbalance, "%.0f %% of the water", &Load::water_share);
}

}  // namespace talus::search
