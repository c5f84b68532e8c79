#pragma once
// Impacts of rocks: drawn at random, run to their separation, with the sources of added energy.

#include <random>

#include "state/arrays.h"
#include "talus/model.h"

namespace talus::test {

/// The convex hull of some points as a block of rock.
Block hullBlock(const std::string& name, const std::vector<Vec3>& points, Motion motion = Motion::free);

/// A rock of eight points of some 1 m over a slope of 40 degrees that ends in a valley.
Model rockOverSlope(double stiffness, double contact_damping, double friction_deg);

/// What flies: hulls of random points, or bodies of two to five parallelepipeds grown face by face.
enum class Rocks : bool { convex, bodies };

/// A rock that flies onto a floor under gravity, or two that fly into each other: random hulls and spins on
/// joints of 1e8 to 1e11 Pa/m, half of them without friction, half of them without dashpots.
struct RandomImpact {
    Model model;
    std::vector<Vec3> spin;  ///< of each block at the start [rad/s]
    bool two_free = false;
};
RandomImpact randomImpact(unsigned seed, Rocks rocks = Rocks::convex);

/// Gives blocks a spin.
void setSpin(State& state, const std::vector<Vec3>& spin);

/// What total energy rose by [J], in all, by where it came in, without what a history takes back between
/// steps.
struct ImpactGains {
    double largest_kinetic = 0, largest_elastic = 0;
    double steps = 0;     ///< over all steps
    double searches = 0;  ///< over all searches: areas, faces for vertices, frames, shear that is handed on
    double looks = 0;     ///< over all looks between them: vertices that take over, gaps that recover
    double above_least = 0;  ///< most above any earlier energy, as a history with what it takes back has it
    double momentum_drift = 0;  ///< of all free blocks, over the sum of their momenta
    double angular_drift = 0;   ///< likewise, about the model's origin
};

enum class TakeBack : bool { no, yes };

/// Runs until the blocks have parted for `parted` seconds, with the steps a history takes.
ImpactGains runImpact(State state, TakeBack take_back, double parted = 0.02);

}  // namespace talus::test
