#pragma once
// What each interface's slot in memory holds (state/lane_array.h), in the order in which the kernels read it.

#include <array>
#include <cstddef>

#include "state/lane_array.h"
#include "state/slot_sizes.h"
#include "talus/polyhedron.h"

namespace talus {

/// How two faces lie against each other. The reference face belongs to block `a`; e1, e2 span it and e3 = e1
/// x e2 points from a to b. The origin is the patch's centroid at its last clipping, as a material point of
/// each of the two blocks.
struct InterfaceFrame {
    Vec3 origin_a = Vec3::Zero();  ///< in a's own frame [m]
    Vec3 e1_a = Vec3::Zero(), e2_a = Vec3::Zero();
    /// in b's own frame: b's face plane; e1 and e2 of the last clipping, projected into b's plane along e3,
    /// so longer than one where it is tilted
    Vec3 origin_b = Vec3::Zero();
    Vec3 e1_b = Vec3::Zero(), e2_b = Vec3::Zero();
    /// gap [m] and its two slopes along e1, e2 that count as closed and unstressed
    Vec3 reference_gap = Vec3::Zero();
};
inline constexpr std::array<Vec3 InterfaceFrame::*, 7> kFrameVectors{
    &InterfaceFrame::origin_a,     &InterfaceFrame::e1_a, &InterfaceFrame::e2_a,
    &InterfaceFrame::origin_b,     &InterfaceFrame::e1_b, &InterfaceFrame::e2_b,
    &InterfaceFrame::reference_gap};

/// Forces of springs and dashpots.
struct InterfaceWrench {
    Vec3 force = Vec3::Zero();     ///< on b [N]
    Vec3 moment_a = Vec3::Zero();  ///< on a about a's centroid [N m]
    Vec3 moment_b = Vec3::Zero();  ///< on b about b's centroid [N m]
    friend bool operator==(const InterfaceWrench&, const InterfaceWrench&) = default;
};
inline constexpr std::array<Vec3 InterfaceWrench::*, 3> kWrenchVectors{
    &InterfaceWrench::force, &InterfaceWrench::moment_a, &InterfaceWrench::moment_b};

static_assert(kFrameQuantities == 3 * kFrameVectors.size() && kWrenchQuantities == 3 * kWrenchVectors.size());
static_assert(sizeof(InterfaceWrench) == kWrenchQuantities * sizeof(double));  // as the kernel writes it

inline Vec3 vectorAt(const LaneArray& values, std::size_t slot, std::size_t vector) {
    return {values.get(slot, 3 * vector), values.get(slot, 3 * vector + 1), values.get(slot, 3 * vector + 2)};
}
inline void setVectorAt(LaneArray& values, std::size_t slot, std::size_t vector, const Vec3& v) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        values.set(slot, 3 * vector + axis, v[static_cast<Eigen::Index>(axis)]);
}

inline InterfaceFrame frameAt(const LaneArray& frames, std::size_t slot) {
    InterfaceFrame frame;
    for (std::size_t k = 0; k < kFrameVectors.size(); ++k)
        frame.*kFrameVectors[k] = vectorAt(frames, slot, k);
    return frame;
}
inline void setFrameAt(LaneArray& frames, std::size_t slot, const InterfaceFrame& frame) {
    for (std::size_t k = 0; k < kFrameVectors.size(); ++k)
        setVectorAt(frames, slot, k, frame.*kFrameVectors[k]);
}
}  // namespace talus
