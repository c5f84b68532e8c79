#pragma once
// What the drift and the gather of a step read and write, and their builds.

#include <cstddef>
#include <cstdint>

#include "simd/pointers.h"

namespace talus {

struct MotionView {
    // read, per block
    const std::int64_t* interface_begin;  ///< into `wrench`
    const double *mass, *inverse_mass;
    const std::uint8_t* free;  ///< 1: moves by its forces; 0: fixed, or driven at its velocity
    simd::ConstVectors inverse_inertia;
    // read
    const std::int32_t* wrench;  ///< Incidence::wrench
    const double* wrenches;      ///< nine numbers each, as InterfaceWrench
    // read and written, per block
    double *position, *orientation;  ///< four numbers a block (state/pose_arrays.h)
    simd::Vectors velocity, angular_momentum, force, torque, angular_velocity;

    double gravity[3];         ///< [m/s^2]
    double time_step;          ///< [s]
    double decay, spin_decay;  ///< of velocity and angular momentum by drag, over half a step
    double local_damping;      ///< share of the out-of-balance force that opposes the motion
};

/// A stage's work on blocks [begin, end).
using MotionKernel = void (*)(const MotionView& view, std::size_t begin, std::size_t end);

struct MotionKernels {
    /// weight and interfaces of free blocks, added up in stored order, into force and torque
    MotionKernel sum_wrenches;
    MotionKernel kick;            ///< local damping and the second half kick of free blocks
    MotionKernel drift;           ///< the first half kick and the motion of poses
    MotionKernel kick_and_drift;  ///< the two in one pass, from one step to the next
};

/// Same bits from each.
extern const MotionKernels kMotionScalar, kMotionAvx2, kMotionAvx512;

}  // namespace talus
