#include "search/filling.h"

#include <algorithm>
#include <cmath>

#include "forces/closed_water.h"
#include "state/caller.h"

namespace talus::search {
namespace {

// [s] Rain gauges report once a minute at most, and a leak is steady within a step (forces/leak.h).
constexpr double kLongestStep = 10;
// Of the time between two answers, however short that is.
constexpr double kFewestSteps = 20;

void fillUntil(State& state, double time) {
    const double from = state.load.time;
    const double steps = std::max(kFewestSteps, std::ceil((time - from) / kLongestStep));
    for (double k = 1; k <= steps; ++k) {
        state.load.time = k < steps ? from + (time - from) * k / steps : time;
        updateClosedWater(state);
    }
}

std::vector<double> levelsOf(const State& state) {
    std::vector<double> levels(state.geometry->model.waters.size());
    for (std::size_t water = 0; water < levels.size(); ++water)
        levels[water] = levelNow(state, water, state.load.time);
    return levels;
}

}  // namespace

bool changes(const Water& water) { return water.closed || water.level.size() > 1; }

std::vector<std::vector<double>> levelsOver(State& state, const std::vector<double>& times,
                                            const Control& control) {
    std::vector<std::vector<double>> levels;
    state.load.time = 0;
    beginClosedWater(state);
    for (const double time : times) {
        if (isStopped(control)) break;
        if (time > state.load.time) fillUntil(state, time);
        levels.push_back(levelsOf(state));
    }
    return levels;
}

}  // namespace talus::search
