#include "equilibrium/interface_response.h"

#include <Eigen/Geometry>

#include "equilibrium/point_response.h"

namespace talus::equilibrium {
namespace {

using Mat6x9 = Eigen::Matrix<double, 6, 9>;
using Mat6x12 = Eigen::Matrix<double, 6, 12>;
using Mat9x12 = Eigen::Matrix<double, 9, 12>;
using Mat3x12 = Eigen::Matrix<double, 3, 12>;

Mat3 crossMatrix(const Vec3& v) {
    Mat3 m;
    m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
    return m;
}

/// How b's material points lie over a's face. The coordinates of the point that belongs to (xi, eta) are affine:
/// e_k . (d + xi b1 + eta b2); slides and gap are they less xi, eta and the reference gap.
struct Lie {
    Mat3 axes;               ///< rows e1, e2, e3, model frame
    Vec3 arm_a, arm_b;       ///< from the centroids to the interface's origin on a [m]
    Vec3 d, b1, b2;          ///< from there to that on b [m]; b's tangents
    Vec3 at, by_xi, by_eta;  ///< the coordinates at the origin and their gradients
};

Lie lieOf(const InterfacePlace& place, const Placed& a, const Placed& b) {
    Lie lie;
    const Vec3 e1 = a.turn * place.e1_a, e2 = a.turn * place.e2_a;
    lie.axes << e1.transpose(), e2.transpose(), e1.cross(e2).transpose();
    lie.arm_a = a.turn * place.origin_a;
    lie.arm_b = lie.arm_a - (b.position - a.position);
    lie.d = b.turn * place.origin_b - lie.arm_b;
    lie.b1 = b.turn * place.e1_b;
    lie.b2 = b.turn * place.e2_b;
    lie.at = lie.axes * lie.d;
    lie.by_xi = lie.axes * lie.b1;
    lie.by_eta = lie.axes * lie.b2;
    return lie;
}

/// Slides and gap at a contact point [m].
Vec3 slidesAndGap(const Lie& lie, const Vec3& reference_gap, double xi, double eta) {
    return {lie.at.x() + xi * (lie.by_xi.x() - 1.0) + eta * lie.by_eta.x(),
            lie.at.y() + xi * lie.by_xi.y() + eta * (lie.by_eta.y() - 1.0),
            lie.at.z() - reference_gap.x() + xi * (lie.by_xi.z() - reference_gap.y()) +
                eta * (lie.by_eta.z() - reference_gap.z())};
}

/// Derivative of the nine affine coefficients by the motion of a and b (displacement, turn; twelve columns).
Mat9x12 coefficientRates(const Lie& lie) {
    Mat9x12 rates = Mat9x12::Zero();
    const Vec3 from_a = lie.arm_a + lie.d, from_b = lie.arm_b + lie.d;
    for (int k = 0; k < 3; ++k) {
        const Vec3 e = lie.axes.row(k);
        rates.block<1, 3>(k, 0) = -e.transpose();
        rates.block<1, 3>(k, 3) = -from_a.cross(e).transpose();
        rates.block<1, 3>(k, 6) = e.transpose();
        rates.block<1, 3>(k, 9) = from_b.cross(e).transpose();
        rates.block<1, 3>(3 + k, 9) = lie.b1.cross(e).transpose();
        rates.block<1, 3>(3 + k, 3) = -rates.block<1, 3>(3 + k, 9);
        rates.block<1, 3>(6 + k, 9) = lie.b2.cross(e).transpose();
        rates.block<1, 3>(6 + k, 3) = -rates.block<1, 3>(6 + k, 9);
    }
    return rates;
}

/// Force and moment about the interface's origin along e1, e2, e3, summed over the contact points, and their
/// derivative by the nine coefficients.
struct LocalSum {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    Mat6x9 rates = Mat6x9::Zero();

    /// The force acts where b's material point is projected to on a's plane: at (x, y).
    void add(const PointResponse& point, double x, double y) {
        force += point.force;
        moment += Vec3(y * point.force.z(), -x * point.force.z(), x * point.force.y() - y * point.force.x());
    }

    void addRates(const PointResponse& point, double xi, double eta, double x, double y) {
        if (point.open) return;
        const Mat3& k = point.stiffness;
        Eigen::Matrix<double, 6, 3> rate;
        rate.topRows<3>() = k;
        rate.row(3) = y * k.row(2);
        rate.row(4) = -x * k.row(2);
        rate.row(5) = x * k.row(1) - y * k.row(0);
        rate(3, 1) += point.force.z();
        rate(4, 0) -= point.force.z();
        rate(5, 0) += point.force.y();
        rate(5, 1) -= point.force.x();
        rates.leftCols<3>() += rate;
        rates.middleCols<3>(3) += xi * rate;
        rates.rightCols<3>() += eta * rate;
    }
};

template <class Each>
void forEachPoint(const InterfacePlace& place, const Lie& lie, const contact::JointLaw& joint,
                  std::span<const SolverPoint> points, double rounding, const Each& each) {
    for (std::size_t k = 0; k < points.size(); ++k) {
        const SolverPoint& p = points[k];
        const Vec3 at = slidesAndGap(lie, place.reference_gap, p.xi, p.eta);
        each(k, at, pointResponse(joint, p.area, at.x(), at.y(), at.z(), p.memory, rounding));
    }
}

InterfaceStiffness stiffnessOf(const Lie& lie, const LocalSum& sum, const Vec3& force, const Vec3& moment) {
    const Mat6x12 local = sum.rates * coefficientRates(lie);
    Mat3x12 of_force = lie.axes.transpose() * local.topRows<3>();
    Mat3x12 of_moment = lie.axes.transpose() * local.bottomRows<3>();
    // The frame turns with a, and with it force and moment.
    of_force.middleCols<3>(3) -= crossMatrix(force);
    of_moment.middleCols<3>(3) -= crossMatrix(moment);
    // About the centroids: arm x force + moment, where the arms change too.
    const Mat3 f = crossMatrix(force), arm_a = crossMatrix(lie.arm_a);
    of_moment.middleCols<3>(3) += f * arm_a;
    const Mat3x12 about_a = arm_a * of_force + of_moment;
    Mat3x12 about_b = crossMatrix(lie.arm_b) * of_force + of_moment;
    about_b.leftCols<3>() -= f;
    about_b.middleCols<3>(6) += f;
    InterfaceStiffness k;
    k.aa << -of_force.leftCols<6>(), -about_a.leftCols<6>();
    k.ab << -of_force.rightCols<6>(), -about_a.rightCols<6>();
    k.ba << of_force.leftCols<6>(), about_b.leftCols<6>();
    k.bb << of_force.rightCols<6>(), about_b.rightCols<6>();
    return k;
}

}  // namespace

InterfaceWrenches interfaceResponse(const InterfacePlace& place, const Placed& a, const Placed& b,
                                    const contact::JointLaw& joint, std::span<const SolverPoint> points,
                                    double rounding, InterfaceStiffness* stiffness) {
    const Lie lie = lieOf(place, a, b);
    LocalSum sum;
    forEachPoint(place, lie, joint, points, rounding,
                 [&](std::size_t k, const Vec3& at, const PointResponse& point) {
                     const double x = points[k].xi + at.x(), y = points[k].eta + at.y();
                     sum.add(point, x, y);
                     if (stiffness != nullptr) sum.addRates(point, points[k].xi, points[k].eta, x, y);
                 });
    const Vec3 force = lie.axes.transpose() * sum.force, moment = lie.axes.transpose() * sum.moment;
    if (stiffness != nullptr) *stiffness = stiffnessOf(lie, sum, force, moment);
    InterfaceWrenches wrenches;
    wrenches.on_a << -force, -(lie.arm_a.cross(force) + moment);
    wrenches.on_b << force, lie.arm_b.cross(force) + moment;
    return wrenches;
}

Vec3 slidesAndGap(const InterfacePlace& place, const Placed& a, const Placed& b, const SolverPoint& point) {
    return slidesAndGap(lieOf(place, a, b), place.reference_gap, point.xi, point.eta);
}

void commitSlides(const InterfacePlace& place, const Placed& a, const Placed& b,
                  const contact::JointLaw& joint, std::span<SolverPoint> points, double rounding) {
    forEachPoint(place, lieOf(place, a, b), joint, points, rounding,
                 [&](std::size_t k, const Vec3& at, const PointResponse& point) {
                     commitSlide(point, joint, points[k].area, at.x(), at.y(), points[k].memory);
                 });
}

}  // namespace talus::equilibrium
