#include "checks/closed_volumes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "forces/closed_water.h"
#include "measure/words.h"
#include "model/over_time.h"
#include "step/time_step.h"
#include "talus/angles.h"

namespace talus::checks {
namespace {

// Share of the larger side by which the walls of the two sides may differ below the level. Joints cut block
// by block agree to some 1e-6; a neighbour that ends below the level differs by far more.
constexpr double kSameSides = 0.01;
// [deg] In a flatter joint the water surface is more than 5.7 times as wide as the opening. The volume then
// depends on small tilts of the table.
constexpr double kLeastDip = 10;

// Of the length scale and of the level: given to six digits it may stand so far above the walls' end.
constexpr double kSameLevel = 1e-6;

/// A volume that would run over before anything flows in: no level of a storm or a history is so high.
std::optional<Error> filledTooHigh(const State& state, const Water& water, const Enclosure& enclosure) {
    const double filled = levelAt(water, 0);
    const double same = kSameLevel * std::max(state.geometry->length_scale, std::abs(filled));
    if (filled <= enclosure.runs_over + same) return std::nullopt;
    const bool overflows = water.overflow <= enclosure.runs_over;
    const bool by_elevation = water.kind == Water::Level::elevation;
    return Error{water.field + (by_elevation ? ".elevation" : ".depth"),
                 "found a closed volume filled to " + formatted("%.7g", filled) + " m, " +
                     formatted("%.2g", filled - enclosure.runs_over) +
                     " m above the level at which it runs over, " +
                     (overflows ? "its overflow" : "where its walls end") + "; allowed: at most " +
                     formatted("%.7g", enclosure.runs_over) + " m"};
}

std::optional<Error> openVolume(const State& state, std::size_t index) {
    const Water& water = state.geometry->model.waters[index];
    const double filled = levelAt(water, 0);
    const bool runs_over = water.overflow < kInfinity && water.overflow > filled;
    const Enclosure enclosure = enclosureOf(state, index, runs_over ? water.overflow : filled);
    const double dip_deg = degrees(enclosure.dip);
    if (dip_deg < kLeastDip) {
        return Error{water.field + ".volume", "found a closed volume in a joint that dips by " +
                                                  formatted("%.3g", dip_deg) + " deg, allowed: at least " +
                                                  formatted("%g", kLeastDip) + " deg"};
    }
    const auto [less, more] = std::minmax(enclosure.below[0], enclosure.below[1]);
    if (more - less <= kSameSides * more) return filledTooHigh(state, water, enclosure);
    return Error{water.field + ".volume", "found a fissure that is not bounded: walls of " +
                                              formatted("%.4g", more) + " m2 on one side and of " +
                                              formatted("%.4g", less) + " m2 on the other, below the " +
                                              (runs_over ? "overflow" : "level") +
                                              "; allowed: a fissure with walls on both sides up to there"};
}

// Share of omega_max^2, which sets the stable time step. Steps take at most 0.85 of that one, so
// 1 / 0.85^2 - 1 = 0.38 more would make them unstable.
constexpr double kStiff = 0.1;

/// Sum of K / m over the blocks that bound a water. The level falls by a d / (b w) when one wall of area a
/// recedes by d, with the opening b and the width w of the fissure. So K = rho g a^2 / (b w) [1/s^2].
double waterFrequency(const State& state, std::size_t index) {
    const Water& water = state.geometry->model.waters[index];
    std::vector<double> walls(state.blocks.size(), 0.0);
    for (std::size_t w = state.wet.water_begin[index]; w < state.wet.water_begin[index + 1]; ++w)
        walls[static_cast<std::size_t>(state.wet.block[w])] += state.wet.moments[w].area;
    double sum = 0;
    for (std::size_t b = 0; b < walls.size(); ++b)
        if (state.blocks.motion[b] == Motion::free) sum += walls[b] * walls[b] / state.blocks.mass[b];
    return water.density * state.geometry->model.gravity.magnitude * sum /
           (water.opening * state.closed.width[index]);
}

}  // namespace

std::vector<Error> stiffVolumes(const State& state, bool parallel) {
    const Model& model = state.geometry->model;
    std::vector<Error> stiff;
    if (state.closed.size() == 0) return stiff;
    const std::vector<double> bounds = frequencyBounds(state, parallel);
    const double highest = bounds.empty() ? 0.0 : *std::max_element(bounds.begin(), bounds.end());
    for (std::size_t water = 0; water < model.waters.size(); ++water) {
        if (!model.waters[water].closed) continue;
        const double times = waterFrequency(state, water) / (kStiff * highest);
        if (!(times > 1)) continue;
        stiff.push_back({model.waters[water].field + ".opening",
                         "found " + formatted("%g", model.waters[water].opening) +
                             " m, with which the water is nearly as stiff as the joints, and the time step "
                             "may be too long for it; allowed: at least " +
                             formatted("%.1e", model.waters[water].opening * times) +
                             " m, or a shorter run.time_step_s"});
    }
    return stiff;
}

std::vector<Error> openVolumes(const State& state) {
    const Model& model = state.geometry->model;
    std::vector<Error> errors;
    if (model.is_remainder) return errors;
    for (std::size_t water = 0; water < model.waters.size(); ++water) {
        if (!model.waters[water].closed) continue;
        if (auto open = openVolume(state, water)) errors.push_back(std::move(*open));
    }
    return errors;
}

std::vector<Error> undampedVolumes(const Model& model) {
    if (model.damping.contact > 0 || model.damping.local > 0) return {};
    for (const Water& water : model.waters)
        if (water.closed)
            return {{"damping.contact",
                     "found 0 with the closed volume " + water.field +
                         ": friction amplifies the bouncing of blocks that slide, and they may slide farther "
                         "than energy allows; allowed without this warning: some 1e-6 to 1e-4 s"}};
    return {};
}

std::vector<Error> leaksWithoutPressure(const Model& model) {
    std::vector<Error> doubts;
    const auto leaks = [](const Water& water) { return water.closed && water.leak_aperture > 0; };
    if (model.phreatic || model.flow || !std::all_of(model.waters.begin(), model.waters.end(), leaks))
        return doubts;
    for (const Water& water : model.waters)
        doubts.push_back(
            {water.field + ".leak_aperture",
             "the joint through which the water leaks has no pressure and counts as dry, because "
             "no other [[water]] stands in it"});
    return doubts;
}

std::vector<std::string> levelsHeld(const Model& model) {
    std::vector<std::string> lines;
    for (const Water& water : model.waters) {
        if (!water.closed) continue;
        const char* what = water.kind == Water::Level::elevation ? " m of elevation" : " m";
        lines.push_back(water.field + ": the search holds the closed volume at the level it is filled to, " +
                        formatted("%.4g", levelAt(water, 0)) + what +
                        "; talus run shows how the level falls and whether the blocks stop");
    }
    return lines;
}

}  // namespace talus::checks
