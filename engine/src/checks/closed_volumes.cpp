#include "checks/closed_volumes.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "forces/closed_water.h"
#include "measure/words.h"
#include "model/over_time.h"

namespace talus::checks {
namespace {

// Of the larger side: by how much the walls of both sides may differ below the level. Joints of rock masses
// that are cut block by block agree to some 1e-6; a neighbour that ends below the level lacks far more.
constexpr double kSameSides = 0.01;
// [deg] In a flatter joint the surface of the water is more than six times as wide as its opening, and the
// volume hangs on how level the table is.
constexpr double kLeastDip = 10;

std::optional<Error> openVolume(const State& state, std::size_t index) {
    const Water& water = state.geometry->model.waters[index];
    const double filled = levelAt(water, 0);
    const bool runs_over = water.overflow < kInfinity && water.overflow > filled;
    const Enclosure enclosure = enclosureOf(state, index, runs_over ? water.overflow : filled);
    const double dip_deg = enclosure.dip * 180 / std::numbers::pi;
    if (dip_deg < kLeastDip)
        return Error{water.field + ".volume", "found a closed volume in a joint that dips by " +
                                                  formatted("%.3g", dip_deg) + " deg, allowed: at least " +
                                                  formatted("%g", kLeastDip) + " deg"};
    const auto [less, more] = std::minmax(enclosure.below[0], enclosure.below[1]);
    if (more - less <= kSameSides * more) return std::nullopt;
    return Error{water.field + ".volume", "found a fissure that is not bounded: walls of " +
                                              formatted("%.4g", more) + " m2 on one side and of " +
                                              formatted("%.4g", less) + " m2 on the other, below the " +
                                              (runs_over ? "overflow" : "level") +
                                              "; allowed: a fissure with walls on both sides up to there"};
}

}  // namespace

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
