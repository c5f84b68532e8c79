#include "checks/loose_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <unordered_set>
#include <utility>

#include "contacts/limits.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "talus/motion_roles.h"
#include "talus/polyhedron.h"

namespace talus::checks {
namespace {

/// New index of each block, -1 for removed ones.
std::vector<std::int32_t> renumbered(const std::vector<char>& gone) {
    std::vector<std::int32_t> index;
    std::int32_t next = 0;
    for (const char is_gone : gone) index.push_back(is_gone ? -1 : next++);
    return index;
}

bool renumber(std::int32_t& block, const std::vector<std::int32_t>& index) {
    block = index[static_cast<std::size_t>(block)];
    return block >= 0;
}

/// \return whether the water has a wall left
bool renumber(Water& water, const std::vector<std::int32_t>& index) {
    if (water.pair) return renumber(water.pair->first, index) && renumber(water.pair->second, index);
    std::erase_if(water.walls, [&](WetFace& wall) { return !renumber(wall.block, index); });
    return !water.walls.empty();
}

}  // namespace

std::vector<char> blocksNamed(const Model& model, const std::vector<std::string>& names) {
    const std::unordered_set<std::string> wanted(names.begin(), names.end());
    std::vector<char> marked;
    for (const Block& block : model.blocks) marked.push_back(wanted.count(block.name) > 0 ? 1 : 0);
    return marked;
}

std::vector<std::size_t> numbersOf(const Model& model, const std::vector<std::string>& names) {
    const std::vector<char> named = blocksNamed(model, names);
    std::vector<std::size_t> numbers;
    for (std::size_t b = 0; b < named.size(); ++b)
        if (named[b]) numbers.push_back(b);
    return numbers;
}

Model withoutBlocks(const Model& model, const std::vector<char>& gone) {
    Model left = model;
    const std::vector<std::int32_t> index = renumbered(gone);
    left.blocks.clear();
    for (std::size_t b = 0; b < gone.size(); ++b)
        if (!gone[b]) left.blocks.push_back(model.blocks[b]);
    left.pair_joints.clear();
    for (PairJoint pair : model.pair_joints)
        if (renumber(pair.block_a, index) && renumber(pair.block_b, index)) left.pair_joints.push_back(pair);
    left.waters.clear();
    for (Water water : model.waters)
        if (renumber(water, index)) left.waters.push_back(std::move(water));
    left.loads.clear();
    for (AppliedLoad load : model.loads)
        if (load.kind == AppliedLoad::Kind::box || renumber(load.block, index))
            left.loads.push_back(std::move(load));
    left.is_remainder = true;
    left.stack.reset();
    return left;
}

double looseShare(const Model& model, const std::vector<char>& gone) {
    double all = 0, loose = 0;
    for (std::size_t b = 0; b < gone.size(); ++b) {
        const Block& block = model.blocks[b];
        if (block.motion != Motion::free) continue;
        const double mass = block.density * massProperties(block.shape).volume;
        all += mass;
        if (gone[b]) loose += mass;
    }
    return all > 0 ? loose / all : 0.0;
}

bool touchesSomething(const State& state, std::size_t b) {
    for (auto k = state.incidence.interface_begin[b]; k < state.incidence.interface_begin[b + 1]; ++k) {
        const auto i = static_cast<std::size_t>(state.incidence.interface[static_cast<std::size_t>(k)]);
        if (relativePose(state, i).gap.x() <= kClosedGap * state.geometry->size[b]) return true;
    }
    return false;
}

double freeMass(const State& state) {
    double mass = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.motion[b] == Motion::free) mass += state.blocks.mass[b];
    return mass;
}

double massOf(const State& state, const std::vector<std::size_t>& blocks) {
    double mass = 0;
    for (const std::size_t b : blocks) mass += state.blocks.mass[b];
    return mass;
}

bool areSplinters(const State& state, const std::vector<std::size_t>& blocks) {
    constexpr double kMostSliverMass = 1e-3;
    return massOf(state, blocks) <= kMostSliverMass * freeMass(state);
}

bool areTied(const State& state, const std::vector<std::size_t>& blocks) {
    const auto are = [&](std::int32_t block) {
        return std::binary_search(blocks.begin(), blocks.end(), static_cast<std::size_t>(block));
    };
    return std::any_of(state.bolts.segments.begin(), state.bolts.segments.end(),
                       [&](const BoltSegment& tie) { return are(tie.block_a) || are(tie.block_b); });
}

std::vector<std::size_t> movingBlocks(const PositionArray& position, const QuaternionArray& orientation,
                                      const State& to) {
    std::vector<double> ways(to.blocks.size(), 0.0);
    for (std::size_t b = 0; b < ways.size(); ++b) {
        if (to.blocks.motion[b] == Motion::free) ways[b] = wayFrom(position, orientation, to, b);
    }
    const double farthest = *std::max_element(ways.begin(), ways.end());
    std::vector<std::size_t> moving;
    for (std::size_t b = 0; b < ways.size(); ++b)
        if (ways[b] > 0 && ways[b] >= MotionRule::kShare * farthest) moving.push_back(b);
    return moving;
}

}  // namespace talus::checks

namespace talus {

Model withoutBlocks(const Model& model, const std::vector<std::string>& names) {
    return checks::withoutBlocks(model, checks::blocksNamed(model, names));
}

}  // namespace talus
