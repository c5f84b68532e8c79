#pragma once
// What the contact kernel reads and writes.

#include <cstddef>
#include <cstdint>

#include "law/law.h"
#include "simd/pointers.h"
#include "state/interface_group.h"

namespace talus {

using simd::ConstVectors;

/// Source of the contact points' positions and areas.
enum class PointPlaces : std::uint8_t { vertex, corner, stored };

struct ContactView {
    // read, per block
    const double *position, *orientation;     ///< four numbers a block (state/pose_arrays.h)
    ConstVectors velocity, angular_velocity;  ///< with contact damping or restitution only
    // read, per interface
    const InterfaceGroup* groups;
    const std::int32_t *block_a, *block_b, *joint;
    const double* frames;  ///< slot by slot (state/interface_frame.h), as all that follow
    const double* corners;
    const double* patch_area;  ///< by interface
    // read, per joint
    const contact::JointLaw* laws;
    // read, per contact point
    const double* point_places;  ///< `stored` only
    // read and written, per contact point
    double* memory;
    // written, per interface
    double* wrenches;  ///< slot by slot, each nine numbers side by side

    bool remembers;     ///< whether contact points have bond and dilation in their memory
    bool curved;        ///< whether the strength of some joint is a curve
    bool keeps_energy;  ///< whether shear forces act where their slide is measured (PointLoop)
    /// whether the arrays exceed the cache: groups are then prefetched
    bool beyond_caches;
    double release;
    double contact_damping;
    bool restitution;  ///< whether contact points lose force as they part
    PointPlaces places;
    /// Whether points share the closed part of a patch that is partly open (law/closed_part.h).
    bool distributed;
};

/// Groups [begin, end). Same bits from each.
void updateContactsScalar(const ContactView& view, std::size_t begin, std::size_t end);
void updateContactsAvx2(const ContactView& view, std::size_t begin, std::size_t end);
void updateContactsAvx512(const ContactView& view, std::size_t begin, std::size_t end);

}  // namespace talus
