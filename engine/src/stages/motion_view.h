#pragma once
// What the drift and the gather of a step read and write.

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

struct GatherView {
    // read, per block
    const std::int64_t* interface_begin;  ///< into `wrench`
    const double *mass, *inverse_mass;
    const std::uint8_t* free;
    simd::ConstVectors angular_velocity;
    // read
    const std::int32_t* wrench;  ///< Incidence::wrench
    const double* wrenches;      ///< nine numbers each, as InterfaceWrench
    // read and written
    simd::Vectors velocity, angular_momentum;
    // written
    simd::Vectors force, torque;

    double gravity[3];         ///< [m/s^2]
    double time_step;          ///< [s]
    double decay, spin_decay;  ///< as in MotionView
    double local_damping;      ///< share of the out-of-balance force that opposes the motion
};

/// Weight and interfaces of free blocks [begin, end), added up in stored order, into force and torque. Same bits from each.
void sumWrenchesScalar(const GatherView& view, std::size_t begin, std::size_t end);
void sumWrenchesAvx2(const GatherView& view, std::size_t begin, std::size_t end);
void sumWrenchesAvx512(const GatherView& view, std::size_t begin, std::size_t end);

/// Local damping and the second half kick of free blocks [begin, end). Same bits from each.
void kickScalar(const GatherView& view, std::size_t begin, std::size_t end);
void kickAvx2(const GatherView& view, std::size_t begin, std::size_t end);
void kickAvx512(const GatherView& view, std::size_t begin, std::size_t end);

}  // namespace talus::stages
