#include "checks/water_warnings.h"

#include <algorithm>

#include "forces/sum.h"
#include "measure/words.h"
#include "state/block_motion.h"

namespace talus::checks {
namespace {

constexpr double kPushed = 0.05;  // of a block's weight: less water does not move it

/// Of all water on a block, over its weight. \pre forces are up to date
double waterShare(const State& state, std::size_t block) {
    const double weight = state.blocks.mass[block] * state.geometry->model.gravity.magnitude;
    return weight > 0 ? turningForcesOn(state, block).force.norm() / weight : 0.0;
}

/// The first that never drains of those that wet a block.
std::optional<std::string> undrainedOn(const State& state, std::size_t block) {
    const Model& model = state.geometry->model;
    const double never = state.geometry->length_scale;  // a joint that opens so wide is none
    for (std::size_t w = 0; w < state.wet.size(); ++w) {
        const Water& water = model.waters[static_cast<std::size_t>(state.wet.water[w])];
        if (state.wet.block[w] == static_cast<std::int32_t>(block) && water.drains_at_aperture >= never)
            return water.field;
    }
    if (model.phreatic && model.phreatic->drains_at_aperture >= never) return model.phreatic->field;
    return std::nullopt;
}

}  // namespace

std::optional<std::string> pushedByWater(const State& built, const std::vector<std::size_t>& falling) {
    if (!built.geometry->model.hasWater() || falling.empty()) return std::nullopt;
    State wet = built;
    wet.load.water_share = 1;
    updateBlockForces(wet);
    std::size_t count = 0, worst = 0;
    double most = 0;
    for (const std::size_t block : falling) {
        const double share = waterShare(wet, block);
        if (share < kPushed) continue;
        ++count;
        if (share > most) most = share, worst = block;
    }
    if (count == 0) return std::nullopt;
    return std::to_string(count) + " of the blocks that fall whatever the strength are pushed by water, \"" +
           wet.geometry->model.blocks[worst].name + "\" by " + formatted("%.2g", most) +
           " times its weight: a level table presses in full to where its joints daylight; in a slope that "
           "drains it falls "
           "towards the face ([[water]] surface), or has a factor below 1";
}

std::optional<std::string> pushedAway(const State& state) {
    if (!state.geometry->model.hasWater()) return std::nullopt;
    std::optional<State>
        before;  // as they lay at the start: by now they may be far from the water that pushed them
    for (std::size_t block = 0; block < state.blocks.size(); ++block) {
        if (state.blocks.motion[block] != Motion::free) continue;
        const Vec3 way = state.blocks.position.get(block) - state.geometry->initial_position.get(block);
        if (way.norm() < 0.5 * state.geometry->size[block]) continue;
        const auto water = undrainedOn(state, block);
        if (!water) continue;
        if (!before) {
            before = state;
            before->blocks.position = state.geometry->initial_position;
            before->blocks.orientation = state.geometry->initial_orientation;
            updateBlockForces(*before);
        }
        if (waterShare(*before, block) < kPushed) continue;
        return *water + " never drains: block \"" + state.geometry->model.blocks[block].name +
               "\" has gone " + formatted("%.2g", way.norm()) +
               " m and the water of its closed joints pushed on; with drains_at_aperture (0.001 m, say) "
               "joints "
               "run dry as they open";
    }
    return std::nullopt;
}

}  // namespace talus::checks
