#pragma once
// Forces between two blocks beside contacts, and their derivative by the poses of both.

#include <Eigen/Core>
#include <cstdint>

#include "forces/wrench.h"

namespace talus {

using Mat3x12 = Eigen::Matrix<double, 3, 12>;
using Mat6x12 = Eigen::Matrix<double, 6, 12>;

/// Two tied blocks.
struct Tie {
    std::int32_t a = 0, b = 0;
};

/// A tie at its limit: it pulls its blocks together at a place, up to its strength.
struct TieLimit {
    Tie between;
    Vec3 place = Vec3::Zero();   ///< at b's material point, in the state's coordinates [m]
    Vec3 along = Vec3::UnitZ();  ///< from a to b
    double strength = 0;         ///< [N]
};

/// Where a block is: its centroid [m] and the turn from its own frame to the model's.
struct TiedPose {
    Vec3 position = Vec3::Zero();
    Mat3 turn = Mat3::Identity();
};

/// A force on b at a place, and its opposite on a there.
struct TieForce {
    Vec3 force = Vec3::Zero();      ///< on b [N]
    Vec3 place = Vec3::Zero();      ///< at b's material point, in the state's coordinates [m]
    Mat3 stiffness = Mat3::Zero();  ///< minus its derivative by b's displacement, model frame [N/m]

    Wrench onA(const Vec3& centroid) const { return {-force, (place - centroid).cross(-force)}; }
    Wrench onB(const Vec3& centroid) const { return {force, (place - centroid).cross(force)}; }
};

inline Mat3 crossMatrixOf(const Vec3& v) {
    Mat3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

/// Derivatives of the two wrenches by displacement and small turn of a, then of b. The force is a function of
/// the place of b's point in a's own frame, and turns with a.
struct TieRates {
    Mat6x12 on_a, on_b;
};

inline TieRates ratesOf(const TieForce& tie, const Vec3& centroid_a, const Vec3& centroid_b) {
    const Mat3 arm_a = crossMatrixOf(tie.place - centroid_a), arm_b = crossMatrixOf(tie.place - centroid_b);
    const Mat3 one = Mat3::Identity(), f = crossMatrixOf(tie.force);
    Mat3x12 arm, seen, force;  // of b's point: from a's centroid; the same as a sees it
    arm << -one, Mat3::Zero(), one, -arm_b;
    seen << -one, arm_a, one, -arm_b;
    force = -tie.stiffness * seen;
    force.middleCols<3>(3) -= f;
    TieRates rates;
    rates.on_b << force, arm_b * force;
    rates.on_b.block<3, 3>(3, 9) += f * arm_b;
    rates.on_a << -force, f * arm - arm_a * force;
    return rates;
}

}  // namespace talus
