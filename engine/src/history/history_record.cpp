#include "history/history_record.h"

#include "forces/closed_water.h"
#include "forces/ground_motion.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "state/block_motion.h"

namespace talus::history {

BlockReport reportOn(const State& state, std::size_t b) {
    BlockReport report;
    report.name = state.geometry->model.blocks[b].name;
    report.position = state.geometry->origin + state.blocks.position.get(b);
    report.velocity = state.blocks.velocity.get(b);
    report.displacement = state.blocks.position.get(b) - state.geometry->initial_position.get(b);
    report.rotation = rotationFrom(state.geometry->initial_orientation, state.blocks.orientation, b);
    return report;
}

std::vector<std::size_t> watchedBlocks(const Model& model) {
    std::vector<std::size_t> watched;
    for (const std::string& name : model.run.watch) {
        for (std::size_t b = 0; b < model.blocks.size(); ++b)
            if (model.blocks[b].name == name) watched.push_back(b);
    }
    return watched;
}

HistoryRecord recordOf(const State& state, const std::vector<std::size_t>& watched) {
    HistoryRecord record;
    record.time = state.time;
    record.step = state.step;
    record.kinetic_energy = kineticEnergy(state);
    record.elastic_energy = elasticEnergy(state);
    record.gravity_energy = gravityEnergy(state);
    record.out_of_balance = outOfBalanceRatio(state);
    for (std::size_t b : watched) record.watch.push_back(reportOn(state, b));
    record.supports = supportReports(state);
    record.waters = closedWaterReports(state);
    if (state.load.shaken) record.ground_acceleration = groundAcceleration(state);
    return record;
}

}  // namespace talus::history
