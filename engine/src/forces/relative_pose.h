#pragma once
// How two faces lie to each other, from the poses of their blocks.

#include "simd/scalar.h"

namespace talus {

/// A block where it is now.
template <class V>
struct PoseOf {
    simd::Triple<V> position;
    simd::Rotation<V> turn;
};

/// An interface's frames in the own frames of its two blocks (see Interfaces), and the gap that counts as
/// none.
template <class V>
struct FramesOf {
    simd::Triple<V> origin_a, e1_a, e2_a;
    simd::Triple<V> origin_b, e1_b, e2_b;
    simd::Triple<V> reference_gap;
};

/// A quantity that is affine over a patch: its value at the interface's origin (x) and its gradients along
/// e1, e2 (y, z).
template <class V>
TALUS_KERNEL V affine(const simd::Triple<V>& f, V xi, V eta) {
    return f.x + xi * f.y + eta * f.z;
}

/// Gap at an interface, less the reference gap, and slide of b over a, affine over the patch [m].
template <class V>
struct RelativePoseOf {
    simd::Triple<V> gap;
    simd::Triple<V> slide_1, slide_2;  ///< along e1, e2
    simd::Triple<V> arm_a, arm_b;      ///< from the two centroids to the interface's origin, model frame [m]
    simd::Triple<V> e1, e2, e3;        ///< model frame
};

/// Gap and slide are those of b's material points over a's plane. So the gap does not depend on the slide of
/// b, and clipping the patch again does not change it. The reference face is the fixed or the larger one: the
/// patch goes with b. Only differences of positions enter, so distance from the origin adds no rounding
/// beyond that of the positions.
template <class V>
TALUS_KERNEL RelativePoseOf<V> relativePoseOf(const FramesOf<V>& f, const PoseOf<V>& a, const PoseOf<V>& b) {
    using simd::cross, simd::dot;
    RelativePoseOf<V> pose;
    pose.e1 = a.turn * f.e1_a;
    pose.e2 = a.turn * f.e2_a;
    pose.e3 = cross(pose.e1, pose.e2);
    pose.arm_a = a.turn * f.origin_a;
    const simd::Triple<V> apart = b.position - a.position;
    pose.arm_b = pose.arm_a - apart;
    const simd::Triple<V> d = b.turn * f.origin_b - pose.arm_b;
    const simd::Triple<V> b1 = b.turn * f.e1_b, b2 = b.turn * f.e2_b;
    pose.gap = simd::Triple<V>{dot(d, pose.e3), dot(b1, pose.e3), dot(b2, pose.e3)} - f.reference_gap;
    pose.slide_1 = {dot(d, pose.e1), dot(b1, pose.e1) - 1.0, dot(b2, pose.e1)};
    pose.slide_2 = {dot(d, pose.e2), dot(b1, pose.e2), dot(b2, pose.e2) - 1.0};
    return pose;
}

}  // namespace talus
