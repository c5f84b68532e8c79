#include "contacts/energy_balance.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "contacts/limits.h"
#include "state/incidence.h"

namespace talus {
namespace {

using BlockPair = std::pair<std::int32_t, std::int32_t>;

constexpr double kEnergyRounding = 1e-14;  // of an energy
constexpr int kHalvings = 60;

/// Energy of its springs [J]. Bonded interfaces are left out: they may be in tension, and move too little to
/// change.
double energyOf(const Contacts& contacts, std::size_t i) {
    const Interfaces& f = contacts.interfaces;
    if (isIdle(f, i)) return 0.0;
    if (contacts.laws[static_cast<std::size_t>(f.joint[i])].bonded)
        for (std::size_t k = 0; k < f.pointCount(i); ++k)
            if (contacts.points.memoryAt(f.pointSlot(i, k)).bond > 0) return 0.0;
    return storedEnergy(contacts, i);
}

BlockPair pairOf(const Interfaces& f, std::size_t i) { return std::minmax(f.block_a[i], f.block_b[i]); }

/// The interfaces of two blocks that hold energy.
struct PairContacts {
    std::vector<std::size_t> interfaces{};
    double energy = 0;
};

std::map<BlockPair, PairContacts> contactsByPair(const Contacts& contacts) {
    std::map<BlockPair, PairContacts> pairs;
    for (std::size_t i = 0; i < contacts.interfaces.size(); ++i) {
        const double energy = energyOf(contacts, i);
        if (!(energy > 0)) continue;
        PairContacts& of_pair = pairs[pairOf(contacts.interfaces, i)];
        of_pair.interfaces.push_back(i);
        of_pair.energy += energy;
    }
    return pairs;
}

double energyOf(const State& state, const PairContacts& pair) {
    double sum = 0;
    for (const std::size_t i : pair.interfaces) sum += energyOf(contactsOf(state), i);
    return sum;
}

/// Changes a pair's contacts by put(share), with the largest share at which they hold no more than `energy`.
/// Their energy grows with the share, and at 0 is within that.
template <class Put>
void putWithin(const State& state, PairContacts& pair, double energy, const Put& put) {
    put(1.0);
    if (energyOf(state, pair) > energy) {
        double within = 0, beyond = 1;
        for (int k = 0; k < kHalvings && within < beyond; ++k) {
            const double middle = 0.5 * (within + beyond);
            put(middle);
            (energyOf(state, pair) > energy ? beyond : within) = middle;
        }
        put(within);
    }
    pair.energy = energyOf(state, pair);
}

std::vector<double> referenceGaps(const State& state, const PairContacts& pair) {
    std::vector<double> gaps;
    for (const std::size_t i : pair.interfaces) gaps.push_back(state.interfaces.referenceGap(i, 0));
    return gaps;
}

/// How deep the deepest contact point of a pair is pressed [m].
double deepest(const State& state, const PairContacts& pair) {
    double depth = 0;
    for (const std::size_t i : pair.interfaces) {
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
        for (const ContactPoint& point : contactPoints(state, i))
            depth = std::max(depth, contact::overlapFor(law, point.area, point.force.normal));
    }
    return depth;
}

/// Counts the gap from less deep.
void unload(State& state, PairContacts& pair, double energy) {
    const std::vector<double> gaps = referenceGaps(state, pair);
    const double depth = deepest(state, pair);
    putWithin(state, pair, energy, [&](double share) {
        for (std::size_t k = 0; k < gaps.size(); ++k)
            state.interfaces.referenceGap(pair.interfaces[k], 0) = gaps[k] - (1.0 - share) * depth;
    });
}

/// Restores overlap taken off so, down to what touching faces may have at the start.
void reload(State& state, PairContacts& pair, double energy) {
    const Geometry& geometry = *state.geometry;
    const std::vector<double> gaps = referenceGaps(state, pair);
    const auto least = [&](std::size_t block) { return -kClosedGap * geometry.size[block]; };
    const double recovered =
        std::max(least(static_cast<std::size_t>(state.interfaces.block_a[pair.interfaces[0]])),
                 least(static_cast<std::size_t>(state.interfaces.block_b[pair.interfaces[0]])));
    if (std::none_of(gaps.begin(), gaps.end(), [&](double gap) { return gap < recovered; })) return;
    putWithin(state, pair, energy, [&](double share) {
        for (std::size_t k = 0; k < gaps.size(); ++k)
            state.interfaces.referenceGap(pair.interfaces[k], 0) =
                gaps[k] + share * std::max(0.0, recovered - gaps[k]);
    });
}

}  // namespace

std::vector<PairEnergy> energyOfPairs(const Contacts& contacts) {
    std::vector<PairEnergy> energies;
    for (const auto& [blocks, pair] : contactsByPair(contacts)) energies.push_back({blocks, pair.energy});
    return energies;
}

void balanceEnergy(State& state, const std::vector<PairEnergy>& before) {
    std::map<BlockPair, double> held;
    for (const PairEnergy& pair : before) held[pair.blocks] = pair.energy;
    std::map<BlockPair, PairContacts> pairs = contactsByPair(contactsOf(state));
    // Energy that the contacts of each free block have lost [J].
    std::map<std::int32_t, double> released;
    const auto isFree = [&](std::int32_t b) {
        return state.blocks.motion[static_cast<std::size_t>(b)] == Motion::free;
    };
    for (const auto& [blocks, energy] : held) {
        const auto found = pairs.find(blocks);
        if (found != pairs.end() && found->second.energy < energy) reload(state, found->second, energy);
        const double lost = found == pairs.end() ? energy : std::max(0.0, energy - found->second.energy);
        const bool both = isFree(blocks.first) && isFree(blocks.second);
        for (const std::int32_t b : {blocks.first, blocks.second})
            if (isFree(b)) released[b] += both ? 0.5 * lost : lost;
    }
    for (auto& [blocks, pair] : pairs) {
        const auto found = held.find(blocks);
        double lacking = pair.energy - (found == held.end() ? 0.0 : found->second);
        for (const std::int32_t b : {blocks.first, blocks.second}) {
            if (!isFree(b)) continue;
            const double taken = std::clamp(lacking, 0.0, released[b]);
            lacking -= taken;
            released[b] -= taken;
        }
        if (lacking > kEnergyRounding * pair.energy) unload(state, pair, pair.energy - lacking);
    }
}

}  // namespace talus
