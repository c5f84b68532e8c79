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

}  // namespace talus
