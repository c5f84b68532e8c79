#include "analysis/load_axis.h"

#include <algorithm>
#include <cmath>

#include "analysis/loose_blocks.h"
#include "law/joint_laws.h"

namespace talus::analysis {
namespace {

// Farthest load steps of the implicit solve: beyond, it may pass a failure and come to rest where the assembly stands again.
constexpr double kMostTilt = 6e-3, kMostOfFactor = 1.0 / 16, kMostAcceleration = 0.006;

double degrees(double radians) { return radians * 180.0 / M_PI; }

std::int64_t cellsOf(double load, const LoadAxis& axis) {
    return std::max<std::int64_t>(1, std::llround(load / axis.cell));
}

/// Halvings of `step` until it is no wider than the tolerance.
int halvings(double step, double tolerance) {
    return std::max(0, static_cast<int>(std::ceil(std::log2(step / tolerance) - 1e-9)));
}

/// Joints that have friction alone: in units of the factor at which the weakest has one of 80 degrees, and as many cells for
/// any friction up to 48 degrees. So whatever share of that strength the model gives, the search goes the same way to the bit,
/// and its answer is in proportion: another way may end in another frictional state, and more friction could give less safety.
LoadAxis axisOfFriction(const Model& model) {
    constexpr double kWidest = 0.2;
    LoadAxis axis;
    axis.unit = strongestFactor(model.joints);
    axis.start = 1;
    const int count = halvings(std::max(axis.unit, kWidest), model.analysis.factor_tolerance);
    axis.cell = 1 / static_cast<double>(std::int64_t{1} << count);
    axis.overload = 16;  // cells are half as wide for most friction
    axis.imbalance_tolerance = 0.1 * kWidest * axis.cell;
    axis.apply = [joints = strongest(model.joints)](State& state, double factor) {
        state.laws = jointLaws(joints, factor);
    };
    return axis;
}

LoadAxis axisOfStrength(const Model& model) {
    LoadAxis axis;
    axis.start = strongestFactor(model.joints);
    axis.cell = axis.start /
                static_cast<double>(std::int64_t{1} << halvings(axis.start, model.analysis.factor_tolerance));
    // The driving force is at most the weight, so a change of F by a cell is worth at most that share of it.
    axis.imbalance_tolerance = 0.1 * axis.cell;
    axis.apply = [&model](State& state, double factor) { state.laws = jointLaws(model.joints, factor); };
    return axis;
}

}  // namespace

LoadAxis tiltAxis(const Model& model) {
    LoadAxis axis;
    axis.start = model.analysis.start.value_or(model.gravity.tilt);
    const double step = (model.analysis.stop - axis.start) / 8;
    const std::int64_t cells = std::int64_t{1} << halvings(step, model.analysis.tolerance);
    axis.cell = step / static_cast<double>(cells);
    axis.stop = 8 * cells;
    axis.imbalance_tolerance = axis.cell;  // out-of-balance force over weight changes like the tilt [rad]
    axis.next = [cells](std::int64_t cell) { return cell + cells; };
    axis.farthest = [most = cellsOf(kMostTilt, axis)](std::int64_t cell) { return cell + most; };
    axis.apply = [](State& state, double tilt) { state.load.tilt = tilt; };
    axis.say = [](double tilt) { return formatted("tilt %.4f deg", degrees(tilt)); };
    return axis;
}

LoadAxis strengthAxis(const Model& model) {
    constexpr double kStop = 100;  // doubled from the start on until it fails or is beyond that
    LoadAxis axis = haveFrictionOnly(model.joints) ? axisOfFriction(model) : axisOfStrength(model);
    axis.strongest_at_start = true;
    const auto cells = static_cast<std::int64_t>(std::llround(axis.start / axis.cell));
    const int doublings =
        std::max(1, static_cast<int>(std::ceil(std::log2(kStop / (axis.unit * axis.start)))));
    axis.stop = ((std::int64_t{1} << doublings) - 1) * cells;
    axis.next = [cells](std::int64_t cell) { return 2 * cell + cells; };
    axis.farthest = [axis](std::int64_t cell) {
        return cell + cellsOf(kMostOfFactor * axis.load(cell), axis);
    };
    axis.say = [unit = axis.unit](double factor) { return formatted("factor %.4f", unit * factor); };
    return axis;
}

LoadAxis accelerationAxis(const Model& model) {
    constexpr double kStep = 0.1;  // then twice as far on until it fails
    constexpr int kDoublings = 10;
    LoadAxis axis;
    axis.start = model.seismic.horizontal;
    const std::int64_t cells = std::int64_t{1} << halvings(kStep, model.analysis.acceleration_tolerance);
    axis.cell = kStep / static_cast<double>(cells);
    axis.stop = ((std::int64_t{1} << kDoublings) - 1) * cells;
    axis.imbalance_tolerance = axis.cell;  // out-of-balance force over weight changes like the coefficient
    axis.next = [cells](std::int64_t cell) { return 2 * cell + cells; };
    axis.farthest = [most = cellsOf(kMostAcceleration, axis)](std::int64_t cell) { return cell + most; };
    axis.apply = [](State& state, double horizontal) { state.load.horizontal = horizontal; };
    axis.say = [](double horizontal) { return formatted("horizontal %.5f of the weight", horizontal); };
    return axis;
}

}  // namespace talus::analysis
