#include "equilibrium/interface_response.h"

#include <Eigen/Geometry>
#include <array>

#include "equilibrium/point_response.h"
#include "forces/tie.h"

namespace talus::equilibrium {
namespace {

/// How b's material points lie over a's face. The coordinates of the point that belongs to (xi, eta) are affine:
/// e_k . (d + xi b1 + eta b2), d from the origin to that on b, b1 and b2 b's tangents; slides and gap are they less xi, eta and the
/// reference gap.
struct Lie {
    Mat3 axes;               ///< rows e1, e2, e3, model frame
    Vec3 arm_a, arm_b;       ///< from the centroids to the interface's origin on a [m]
    Vec3 at, by_xi, by_eta;  ///< the coordinates at the origin and their gradients
};

Lie lieOf(const InterfacePlace& place, const Placed& a, const Placed& b) {
    Lie lie;
    const Vec3 e1 = a.turn * place.e1_a, e2 = a.turn * place.e2_a;
    lie.axes << e1.transpose(), e2.transpose(), e1.cross(e2).transpose();
    lie.arm_a = a.turn * place.origin_a;
    lie.arm_b = lie.arm_a - (b.position - a.position);
    lie.at = lie.axes * (b.turn * place.origin_b - lie.arm_b);
    lie.by_xi = lie.axes * (b.turn * place.e1_b);
    lie.by_eta = lie.axes * (b.turn * place.e2_b);
    return lie;
}

/// Slides and gap at a contact point [m].
Vec3 slidesAndGap(const Lie& lie, const Vec3& reference_gap, double xi, double eta) {
    return {lie.at.x() + xi * (lie.by_xi.x() - 1.0) + eta * lie.by_eta.x(),
            lie.at.y() + xi * lie.by_xi.y() + eta * (lie.by_eta.y() - 1.0),
            lie.at.z() - reference_gap.x() + xi * (lie.by_xi.z() - reference_gap.y()) +
                eta * (lie.by_eta.z() - reference_gap.z())};
}

/// Of a relative motion of b against a, displacement at the interface's origin and turn, both along e1, e2, e3: force and moment
/// about the origin, summed over the contact points, and their derivative.
struct LocalSum {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    Mat6 rates = Mat6::Zero();
    bool closed = false;

    /// The force acts where b's material point is projected to on a's plane: at (x, y).
    void add(const PointResponse& point, double x, double y) {
        force += point.force;
        moment += Vec3(y * point.force.z(), -x * point.force.z(), x * point.force.y() - y * point.force.x());
        closed = true;
    }

    /// The material point, at p from the origin, goes with the motion by displacement + turn x p.
    void addRates(const PointResponse& point, const Vec3& p) {
        const Mat3& k = point.stiffness;
        Eigen::Matrix<double, 6, 3> rate;
        rate.topRows<3>() = k;
        rate.row(3) = p.y() * k.row(2);
        rate.row(4) = -p.x() * k.row(2);
        rate.row(5) = p.x() * k.row(1) - p.y() * k.row(0);
        rate(3, 1) += point.force.z();
        rate(4, 0) -= point.force.z();
        rate(5, 0) += point.force.y();
        rate(5, 1) -= point.force.x();
        rates.leftCols<3>() += rate;
        rates.col(3) += p.y() * rate.col(2) - p.z() * rate.col(1);
        rates.col(4) += p.z() * rate.col(0) - p.x() * rate.col(2);
        rates.col(5) += p.x() * rate.col(1) - p.y() * rate.col(0);
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

/// m [v]x, and [v]x m: by columns and by rows.
Mat3 timesCross(const Mat3& m, const Vec3& v) {
    Mat3 product;
    product << v.z() * m.col(1) - v.y() * m.col(2), v.x() * m.col(2) - v.z() * m.col(0),
        v.y() * m.col(0) - v.x() * m.col(1);
    return product;
}
Mat3 crossTimes(const Vec3& v, const Mat3& m) {
    Mat3 product;
    product << v.y() * m.row(2) - v.z() * m.row(1), v.z() * m.row(0) - v.x() * m.row(2),
        v.x() * m.row(1) - v.y() * m.row(0);
    return product;
}

/// By the displacement and turn of a block whose centroid the interface's origin is `arm` away from.
struct ByBlock {
    Mat3 force_by_shift, force_by_turn, moment_by_shift, moment_by_turn;
};

/// The relative motion at the origin is shift + turn x arm.
ByBlock byBlock(const std::array<Mat3, 4>& k, const Vec3& arm) {
    return {k[0], k[1] - timesCross(k[0], arm), k[2], k[3] - timesCross(k[2], arm)};
}

/// Of a wrench whose moment is taken about a centroid `arm` before the interface's origin.
Mat6 about(const Vec3& arm, const ByBlock& by) {
    Mat6 k;
    k << by.force_by_shift, by.force_by_turn, by.moment_by_shift + crossTimes(arm, by.force_by_shift),
        by.moment_by_turn + crossTimes(arm, by.force_by_turn);
    return k;
}

InterfaceStiffness stiffnessOf(const Lie& lie, const LocalSum& sum, const Vec3& force, const Vec3& moment) {
    const auto in_model = [&](const Mat3& local) -> Mat3 { return lie.axes.transpose() * local * lie.axes; };
    const std::array<Mat3, 4> k{
        in_model(sum.rates.topLeftCorner<3, 3>()), in_model(sum.rates.topRightCorner<3, 3>()),
        in_model(sum.rates.bottomLeftCorner<3, 3>()), in_model(sum.rates.bottomRightCorner<3, 3>())};
    const ByBlock by_b = byBlock(k, lie.arm_b);
    ByBlock by_a = byBlock(k, lie.arm_a);
    // The frame turns with a, and with it force and moment; the origin goes with a, and with it the arms.
    const Mat3 f = crossMatrixOf(force);
    by_a.force_by_turn += f;
    by_a.moment_by_turn += crossMatrixOf(moment) - timesCross(f, lie.arm_a);
    InterfaceStiffness stiffness;
    stiffness.aa = about(lie.arm_a, by_a);
    stiffness.ab = -about(lie.arm_a, by_b);
    stiffness.ba = -about(lie.arm_b, by_a);
    stiffness.bb = about(lie.arm_b, by_b);
    stiffness.ba.bottomLeftCorner<3, 3>() -= f;
    stiffness.bb.bottomLeftCorner<3, 3>() += f;
    return stiffness;
}

}  // namespace

InterfaceWrenches interfaceResponse(const InterfacePlace& place, const Placed& a, const Placed& b,
                                    const contact::JointLaw& joint, std::span<const SolverPoint> points,
                                    double rounding, InterfaceStiffness* stiffness) {
    const Lie lie = lieOf(place, a, b);
    LocalSum sum;
    forEachPoint(place, lie, joint, points, rounding,
                 [&](std::size_t k, const Vec3& at, const PointResponse& point) {
                     if (point.open) return;
                     const SolverPoint& p = points[k];
                     const double x = p.xi + at.x(), y = p.eta + at.y();
                     sum.add(point, x, y);
                     const double z = lie.at.z() + p.xi * lie.by_xi.z() + p.eta * lie.by_eta.z();
                     if (stiffness != nullptr) sum.addRates(point, {x, y, z});
                 });
    if (!sum.closed) return {};
    const Vec3 force = lie.axes.transpose() * sum.force, moment = lie.axes.transpose() * sum.moment;
    if (stiffness != nullptr) *stiffness = stiffnessOf(lie, sum, force, moment);
    InterfaceWrenches wrenches{.carries = true};
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
