#pragma once
// The directions that contacts leave to a body: all s with s.n >= 0 for the normals n into it. They form a
// convex cone.

#include <array>
#include <span>

#include "block_theory/slope.h"

namespace talus::keyblocks {

/// The point of the cone nearest to a force. By Moreau's theorem force = along - sum of N n with N >= 0, and
/// N only where along.n = 0: `along` is the driving part; the rest presses on at most two planes. These are
/// Warburton's modes (1981): with along = force the body falls; with one plane it slides along the force's
/// projection, with two along their line of intersection. With along = 0 it does not move.
struct Projection {
    Vec3 along = Vec3::Zero();           ///< [N]; zero where it is less than kNoForce of the force
    std::array<int, 2> pressed{-1, -1};  ///< contacts that `along` lies in; -1: none
};
Projection project(const Vec3& force, std::span<const Contact> contacts);

/// Whether any direction remains, so that the body is removable (Goodman and Shi: its joint pyramid is not
/// empty).
bool isRemovable(std::span<const Contact> contacts);

/// Unit direction of the cone near the outward normal of its free faces; zero where none remains.
Vec3 freeDirection(std::span<const Contact> contacts);

}  // namespace talus::keyblocks
