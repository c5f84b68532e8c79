#pragma once
// Every number that tunes the searches, in one place.

#include <span>

namespace talus {

/// The numbers of the path follower (engine/src/equilibrium, engine/src/search). Answers hardly depend on
/// them: `tests/physics/search_rules_test.cpp` halves and doubles each and reports the change of ten models'
/// answers. search_rules.cpp gives the effect of larger and smaller values, and the source of each.
struct SearchRules {
    // Equilibrium.
    double equilibrium_tolerance = 0.01;
    double newton_accuracy = 0.1;
    double newton_iterations = 16;
    double newton_halvings = 6;
    double newton_stalls = 8;
    double least_block_size = 0.25;
    double search_motion = 1e-5;
    double bond_release = 0.25;
    double on_arc = 0.2;
    double longest_correction = 2;
    double near_merit = 1e-2;
    double test_accuracy = 0.1;
    double merit_growth = 100;
    double stalled = 0.9;
    double floor_drag = 0.05;
    double local_others = 0.05;
    double local_rings = 2;
    double local_share = 0.25;
    // Steps along the path.
    double step_displacement = 1e-3;
    double step_tilt = 0.05;
    double step_factor = 0.25;
    double step_acceleration = 0.03;
    double first_step = 0.01;
    double near_secant = 1e-2;
    double longer_than_last = 1.4;
    double shorter_at_peak = 0.25;
    double wanted_iterations = 9;
    double shorter_start = 0.1;
    double longer_again = 3;
    double slow_steps = 3;
    double slow_gain = 0.1;
    double slow_parting = 0.03;
    // Peaks, and what happens beyond them.
    double rise = 1;
    double peak_accuracy = 0.25;
    double overload = 0.25;
    double release_drag = 1e-3;
    double relaxation_drag = 1e-5;
    double release_growth = 4;
    double release_slowed = 16;
    double release_looks = 3;
    double elastic_parting = 2;
    double creep = 1e-2;
    double work_beyond = 0.25;
    // Where a search begins.
    double weight_strength = 2;
    double more_strength = 1.25;
    double fallen = 0.1;
    double driving = 0.4;
    double jolt = 1e-3;
    // The lower end of the interval.
    double unloaded = 0.01;
    double carries_shear = 1e-3;
};

/// One of them, described.
struct SearchRule {
    const char* name;
    double SearchRules::*value;
    const char* unit;
    const char* meaning;  ///< what it is
    const char* effect;   ///< of larger and smaller values, and where this one comes from
};

std::span<const SearchRule> searchRules();

}  // namespace talus
