#pragma once
// Limit equilibrium of one body in translation: mode, direction, factor of safety.

#include <span>
#include <vector>

#include "block_theory/slope.h"
#include "talus/block_theory.h"

namespace talus::keyblocks {

/// A body: one block, or several that move as one.
struct Body {
    Vec3 force = Vec3::Zero();          ///< resultant of all but its contacts with others [N]
    std::span<const Contact> contacts;  ///< with others, all held still
};

/// Warburton's mode and direction s (block_theory/cone.h), and the factor by which strengths can be divided
/// until the body slides:
///
///     F = sum of tau(N / A) A over the contacts with s.n = 0, over force.s
///
/// Equilibrium across s gives N. One plane that presses has all of it, two have their components. Where s
/// lies in more than two planes, statics leaves N open. Of all N >= 0 in equilibrium those with the least
/// friction count, so F is the least that is statically admissible. (That N lies on two planes: a linear
/// programme with two equations.) Contacts of one orientation share their N by their areas, as under a
/// uniform stress. Cohesion counts on every face that s lies in, tension nowhere.
Sliding judge(const Body& body, const std::vector<Joint>& joints);

/// The same without planes and joints, for many bodies.
Sliding judgeBriefly(const Body& body, const std::vector<Joint>& joints);

}  // namespace talus::keyblocks
