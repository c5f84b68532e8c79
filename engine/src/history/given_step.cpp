#include "history/given_step.h"

#include <algorithm>
#include <cstdio>
#include <numeric>

#include "measure/measure.h"
#include "step/energy_keeper.h"

namespace talus::history {
namespace {

constexpr double kMostOverBound = 2.0;
constexpr double kMostGained = 0.1;   // of the largest kinetic energy so far
constexpr double kNegligible = 1e-6;  // of the model's weight times the median block's size

/// Negligible energy [J].
double nothing(const State& state) {
    const std::vector<double>& mass = state.blocks.mass;
    return kNegligible * std::accumulate(mass.begin(), mass.end(), 0.0) *
           state.geometry->model.gravity.magnitude * state.geometry->length_scale;
}

}  // namespace

Error stepTooLong(const std::string& what, double step, double bound) {
    char text[160];
    std::snprintf(text, sizeof text,
                  " with a step of %g s; allowed: at most the stability bound of %.3g s (omit the key to "
                  "have the step chosen)",
                  step, bound);
    return {"run.time_step_s", what + text};
}

std::optional<Error> GivenStep::begin(const State& state, double step, double bound, bool parallel) {
    if (isLeftAlone(state)) {
        least_energy_ = std::min(least_energy_, totalEnergy(state, parallel));
        return std::nullopt;
    }
    if (step <= kMostOverBound * bound) return std::nullopt;
    return stepTooLong("loads, water, bolts or driven blocks would make the motion unstable", step, bound);
}

std::optional<Error> GivenStep::look(const State& state, double step, double bound, bool parallel) {
    if (!isLeftAlone(state)) return std::nullopt;
    const double energy = totalEnergy(state, parallel);
    least_energy_ = std::min(least_energy_, energy);
    most_kinetic_ = std::max(most_kinetic_, kineticEnergy(state));
    const double gained = energy - least_energy_;
    if (gained <= std::max(kMostGained * most_kinetic_, nothing(state))) return std::nullopt;
    char text[100];
    std::snprintf(text, sizeof text, "the blocks have gained %.2g J from numerical instability by t = %g s",
                  gained, state.time);
    return stepTooLong(text, step, bound);
}

}  // namespace talus::history
