#pragma once
// The directions that contacts leave to a body: all s with s.n >= 0 for the normals n into it. They form a
// convex cone.

#include <array>
#include <span>

#include "block_theory/slope.h"

namespace talus::keyblocks {

/// The point of the cone nearest to a force. By Moreau's theorem force = along - sum of N n with N >= 0, and
/// N only where along.n = 0: `along` is what drives, the rest presses on at most two planes of the cone's
/// corner. That is Warburton's choice (1981): along = force is falling, one plane sliding along the force's
/// projection, two planes sliding along their line of intersection, along = 0 no motion.
struct Projection {
    Vec3 along = Vec3::Zero();           ///< [N]; zero where it is less than kNoForce of the force
    std::array<int, 2> pressed{-1, -1};  ///< contacts that `along` lies in; -1: none
};
Projection project(const Vec3& force, std::span<const Contact> contacts);

/// Whether some direction other than none is left, that is whether the body is removable (Goodman and Shi:
/// its joint pyramid is not empty).
bool isRemovable(std::span<const Contact> contacts);

/// Unit direction of the cone near to where its free faces look; zero where none is left.
Vec3 freeDirection(std::span<const Contact> contacts);

}  // namespace talus::keyblocks
