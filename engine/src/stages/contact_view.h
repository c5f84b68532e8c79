#pragma once
// What the contact kernel reads and writes.

#include <cstddef>
#include <cstdint>

#include "contact/law.h"
#include "simd/pointers.h"
#include "state/interface_group.h"

namespace talus::stages {

using simd::ConstQuaternions, simd::ConstVectors, simd::Vectors;

/// Where the kernel has the Lps' positions and areas from.
enum class PointPlaces : std::uint8_t { vertex, corner, stored };

struct ContactView {
    // read, per block
    ConstVectors position;
    ConstQuaternions orientation;
    ConstVectors velocity, angular_velocity;  ///< with contact damping only
    // read, per interface
    const InterfaceGroup* groups;
    const std::int32_t *block_a, *block_b, *joint;
    ConstVectors origin_a, e1_a, e2_a, origin_b, e1_b, e2_b, reference_gap;
    const double* patch_area;
    const double *patch_xi, *patch_eta;
    // read, per joint
    const contact::JointLaw* laws;
    // read, per Lp
    const double *xi, *eta, *area;  ///< `stored` only
    // read and written, per Lp
    double *offset_1, *offset_2;
    double *bond, *dilation;  ///< null when no joint has memory
    // written, per interface
    Vectors force, moment_a, moment_b;

    double release;
    double contact_damping;
    PointPlaces places;
};

/// Groups [begin, end). Same bits from both.
void updateContactsScalar(const ContactView& view, std::size_t begin, std::size_t end);
void updateContactsAvx2(const ContactView& view, std::size_t begin, std::size_t end);

}  // namespace talus::stages
