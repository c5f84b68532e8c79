#pragma once
// What the drift of a step reads and writes.

#include <cstddef>
#include <cstdint>

#include "simd/pointers.h"

namespace talus::stages {

struct MotionView {
    // read, per block
    simd::ConstVectors force, torque, inverse_inertia;
    const double* inverse_mass;
    const std::uint8_t* free;  ///< 1: moves by its forces; 0: fixed, or driven at its velocity
    // read and written
    double *position, *orientation;  ///< four numbers a block (state/pose_arrays.h)
    simd::Vectors velocity, angular_momentum;
    // written
    simd::Vectors angular_velocity;

    double time_step;          ///< [s]
    double decay, spin_decay;  ///< of velocity and angular momentum by drag, over half a step
};

/// Half kick and drift of blocks [begin, end). Same bits from each.
void driftScalar(const MotionView& view, std::size_t begin, std::size_t end);
void driftAvx2(const MotionView& view, std::size_t begin, std::size_t end);
void driftAvx512(const MotionView& view, std::size_t begin, std::size_t end);

}  // namespace talus::stages
