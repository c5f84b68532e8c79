#pragma once
// Input and output of the response kernel: wrenches of interfaces at trial poses and their exact derivative
// by the poses of both blocks, without any commit.

#include <cstddef>
#include <cstdint>

#include "forces/contact_view.h"

namespace talus::equilibrium {

/// An interface's stiffness: four 6 x 6 blocks, one after the other, 36 numbers column by column each: of the
/// wrench on a by the motion of a and of b, then of that on b, those of a wrench by the other block's motion
/// negated. Wrenches are force and moment about the centroid over the block's radius; motions displacement
/// and small turn times it. Model frame.
inline constexpr std::size_t kStiffnessBlock = 36;
inline constexpr std::size_t kStiffnessQuantities = 4 * kStiffnessBlock;

struct ResponseView {
    // read, as in ContactView
    const double *position, *orientation;  ///< trial poses
    const InterfaceGroup* groups;
    const std::int32_t *block_a, *block_b, *joint;
    const double* frames;
    const double* corners;
    const double* patch_area;
    const contact::JointLaw* laws;
    const double* point_places;
    const double* memory;          ///< of the last committed step
    const double* inverse_radius;  ///< by block [1/m]
    // written, slot by slot
    double* wrenches;  ///< of all groups, nine numbers each: force on b, moment on a and on b [N, N m]
    double* carries;   ///< likewise: 1 where a contact point is closed, else 0
    double*
        stiffness;  ///< from the first group asked for on, where the interface carries; null when not wanted

    bool remembers;  ///< as in ContactView
    bool curved;     ///< likewise
    PointPlaces places;
    bool distributed;  ///< likewise
};

/// Groups [begin, end). Same bits from each.
using ResponseKernel = void (*)(const ResponseView&, std::size_t begin, std::size_t end);
extern const ResponseKernel kRespondScalar, kRespondAvx2, kRespondAvx512;

}  // namespace talus::equilibrium
