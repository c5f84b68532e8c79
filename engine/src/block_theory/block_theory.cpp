#include "talus/block_theory.h"

#include <algorithm>
#include <chrono>
#include <set>

#include "block_theory/body_maker.h"
#include "block_theory/cone.h"
#include "block_theory/groups.h"
#include "block_theory/warnings.h"
#include "build/wet_joints.h"
#include "checks/plausible.h"
#include "checks/water_levels.h"
#include "checks/water_warnings.h"
#include "measure/natural_order.h"
#include "model/over_time.h"
#include "state/caller.h"
#include "state/range.h"
#include "state/threads.h"

namespace talus {
namespace {

using namespace keyblocks;

/// \param joints  of the model, as strong as they are now
KeyBlock keyBlockOf(const Slope& slope, const Model& model, const std::vector<Joint>& joints,
                    std::size_t block) {
    KeyBlock key;
    key.name = model.blocks[block].name;
    key.volume = slope.volume[block];
    key.mass = slope.mass[block];
    const Body body{slope.force[block], slope.contactsOf(block)};
    key.sliding = judge(body, joints);
    key.free_direction =
        key.sliding.mode != SlidingMode::none ? key.sliding.direction : freeDirection(body.contacts);
    key.removable = key.free_direction.norm() > 0;
    return key;
}

std::vector<KeyBlock> keyBlocksOf(const Slope& slope, const Model& model, const std::vector<Joint>& joints,
                                  bool parallel) {
    constexpr std::size_t kGrain = 512;  // blocks
    std::vector<std::size_t> free;
    for (std::size_t b = 0; b < slope.size(); ++b)
        if (slope.free[b]) free.push_back(b);
    std::vector<KeyBlock> blocks(free.size());
    forRange(free.size(), kGrain, parallel, [&](Range range) {
        for (std::size_t k = range.begin; k < range.end; ++k)
            blocks[k] = keyBlockOf(slope, model, joints, free[k]);
    });
    return blocks;
}

std::vector<std::string> namesOf(const Model& model, const std::vector<std::size_t>& members) {
    std::vector<std::string> names;
    for (const std::size_t block : members) names.push_back(model.blocks[block].name);
    sortNaturally(names);
    return names;
}

std::vector<MovingGroup> movingGroups(const Slope& slope, const Model& model,
                                      const std::vector<Joint>& joints, const std::vector<Group>& groups) {
    BodyMaker maker(slope, joints);
    std::vector<MovingGroup> moving;
    for (const Group& group : groups) {
        moving.push_back({.blocks = namesOf(model, group.members),
                          .carries = namesOf(model, group.carried),
                          .sliding = maker.detailsOf(group.members),
                          .volume = group.volume,
                          .mass = group.mass});
    }
    return moving;
}

KeyBlockResult analyse(State& state, bool parallel, const Control& control,
                       const KeyBlockSettings& settings) {
    const Model& model = state.geometry->model;
    const std::vector<Joint> joints = strengthsAt(model.joints, state.load.time);
    const Slope slope = slopeOf(state);
    KeyBlockResult result;
    result.blocks = keyBlocksOf(slope, model, joints, parallel);
    const GroupSearch search =
        leastGroups(slope, joints, settings.most_groups, settings.factor_volume, parallel, control);
    result.groups = movingGroups(slope, model, joints, search.groups);
    result.factor_volume = movingGroups(slope, model, joints, search.curve);
    result.directions = search.directions;
    result.groups_judged = search.judged;
    result.interrupted = search.interrupted;
    result.warnings = warningsOf(state, slope, search);
    return result;
}

const char* kindOf(SlidingMode mode) {
    switch (mode) {
        case SlidingMode::falls:
            return "falling";
        case SlidingMode::slides:
            return "sliding on one plane";
        case SlidingMode::wedge:
            return "sliding along the line of two planes";
        case SlidingMode::none:
            break;
    }
    return "none";
}

}  // namespace

const char* toString(SlidingMode mode) {
    switch (mode) {
        case SlidingMode::falls:
            return "falls";
        case SlidingMode::slides:
            return "slides";
        case SlidingMode::wedge:
            return "wedge";
        case SlidingMode::none:
            break;
    }
    return "none";
}

Result<KeyBlockResult> keyBlocks(const Model& model, const Control& control,
                                 const KeyBlockSettings& settings) {
    const auto begin = std::chrono::steady_clock::now();
    return inArena(control.threads, [&]() -> Result<KeyBlockResult> {
        const bool parallel = control.threads != 1;
        Result<State> state = buildWithWetJoints(model, parallel, control);
        KeyBlockResult result;
        result.interrupted = isStopped(control);
        if (result.interrupted) return result;
        if (!state) return state.errors();
        std::vector<Error> errors = checks::implausible(*state);
        if (auto falls = checks::nothingHolds(model)) errors.push_back(std::move(*falls));
        if (!errors.empty()) return errors;
        result = analyse(*state, parallel, control, settings);
        for (const Error& doubt : checks::levelsAboveJoints(*state))
            result.warnings.push_back(doubt.field + ": " + doubt.message);
        if (auto stated = checks::flowAsStated(model, checks::kNothingOpens))
            result.warnings.push_back(std::move(*stated));
        result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        return result;
    });
}

Result<std::optional<LeastGroup>> leastGroup(const Model& model, const Control& control) {
    auto found = keyBlocks(model, control, {.factor_volume = false});
    if (!found) return found.errors();
    if (found->interrupted) return Error{"", "interrupted while groups of blocks were sought"};
    for (MovingGroup& group : found->groups)
        if (group.carries.empty())
            return std::optional<LeastGroup>{
                LeastGroup{group.sliding.factor, kindOf(group.sliding.mode), std::move(group.blocks)}};
    return std::optional<LeastGroup>{};
}

}  // namespace talus
