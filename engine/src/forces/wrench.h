#pragma once
// Force and torque on a block.

#include "talus/polyhedron.h"

namespace talus {

/// About the block's centroid, model frame [N, N m].
struct Wrench {
    Vec3 force = Vec3::Zero();
    Vec3 torque = Vec3::Zero();

    Wrench& operator+=(const Wrench& other) {
        force += other.force;
        torque += other.torque;
        return *this;
    }
};

/// Forces F at points of a block that keep their direction while it turns. With r from the centroid to such a
/// point, in the block's own frame, the sum of r F^T is all that their torque, its change and their work
/// follow from:
///  - torque: sum of (R r) x F, the antisymmetric part of S = R sum(r F^T);
///  - for a small turn t: sum of (t x R r) x F = (S - trace(S) 1) t, by a x (b x c) = b (a c) - c (a b);
///  - work from one place to another: F du + trace of what S has changed by.
struct DeadForce {
    Vec3 force = Vec3::Zero();  ///< model frame [N]
    Mat3 arms = Mat3::Zero();   ///< sum of r F^T [N m]

    DeadForce& operator+=(const DeadForce& other) {
        force += other.force;
        arms += other.arms;
        return *this;
    }
    /// On a block with this orientation.
    Wrench at(const Mat3& turn) const {
        const Mat3 s = turn * arms;
        return {force, {s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0)}};
    }
    /// Derivative of the torque by a small turn [N m].
    Mat3 torqueByTurn(const Mat3& turn) const {
        const Mat3 s = turn * arms;
        return s - s.trace() * Mat3::Identity();
    }
};

}  // namespace talus
