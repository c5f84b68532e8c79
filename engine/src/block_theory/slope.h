#pragma once
// A slope for block theory: its blocks, the forces on them, and their contacts at the start.

#include <cstdint>
#include <span>
#include <vector>

#include "state/arrays.h"

namespace talus::keyblocks {

/// A contact from the side of one of its two blocks.
struct Contact {
    std::int32_t other = 0;       ///< the block beyond it
    std::int32_t joint = 0;       ///< of the model's
    Vec3 normal = Vec3::UnitZ();  ///< unit, into the block that sees it
    double area = 0;              ///< of its closed contact points [m^2]
    bool is_patch = true;  ///< of two faces; else of a vertex or two edges, which have no area for cohesion
};

struct Slope {
    std::vector<std::size_t> begin;  ///< first contact of each block; one more at the end
    std::vector<Contact> contacts;
    std::vector<Vec3>
        force;  ///< resultant of all but contacts on each block: weight, earthquake, water, loads, bolts [N]
    std::vector<double> mass, volume;  ///< [kg, m^3]
    std::vector<char> free;            ///< others are held: fixed and driven ones
    Vec3 acceleration = Vec3::Zero();  ///< of the body force [m/s^2]

    std::size_t size() const { return mass.size(); }
    std::span<const Contact> contactsOf(std::size_t block) const {
        return {contacts.data() + begin[block], begin[block + 1] - begin[block]};
    }
};

/// Of a state as `buildState` gives it, under its whole load. Forces of the state are brought up to date.
Slope slopeOf(State& state);

}  // namespace talus::keyblocks
