#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "geometry/pressure.h"
#include "law/closed_part.h"
#include "measure/measure.h"
#include "state/incidence.h"
#include "state/point_layout.h"
#include "validate/findings.h"
#include "validate/validate.h"

namespace talus {
namespace {

constexpr double kSumRounding = 1e-9;  // of the sum of magnitudes
constexpr double kPlace = 1e-10;  // of the patch's size: rounding of places, which stiffness makes a force

/// Sums over the contact points of an interface.
struct PointSum {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  ///< on b; about the interface's origin [N, N m]
    double magnitude = 0;                              ///< of the forces, all of one sign [N]
    double energy = 0;                                 ///< of the springs' lengths [J]
    double rounding = 0;                               ///< of that, from the rounding of places [J]
    bool dilates = false;  ///< it may have slipped, which affects the next call of the law
};

double affineAt(const Vec3& f, const Eigen::Vector2d& at) { return f.x() + at.x() * f.y() + at.y() * f.z(); }

/// Energy to bring a closed contact point's springs to their lengths [J], independent of their forces, which
/// elasticEnergy uses. Where strength limits a force, the limit gives the length. A bond that is being
/// released holds shear while its point is apart, and nothing is pressed.
double normalEnergy(const contact::JointLaw& law, const ContactPoint& point) {
    const contact::PointForce& force = point.force;
    if (force.open) return 0;
    if (force.normal < 0)
        return contact::storedEnergy(law, point.area, point.memory.bond, {.normal = force.normal});
    return contact::energyToPress(law, point.area, 0.0, std::max(0.0, point.memory.dilation - point.gap));
}

double shearEnergy(const contact::JointLaw& law, const RelativePose& pose, const ContactPoint& point) {
    const contact::PointForce& force = point.force;
    if (force.open) return 0;
    const double slid = force.slips
                            ? contact::offsetFor(law, point.area, std::hypot(force.shear_1, force.shear_2))
                            : std::hypot(point.memory.offset_1 - affineAt(pose.slide_1, point.position),
                                         point.memory.offset_2 - affineAt(pose.slide_2, point.position));
    return 0.5 * contact::stiffnessOf(law).shear * point.area * slid * slid;
}

/// Of the springs of a patch on its closed part [J]: k_n/2 int o^2 dA, with the overlap o affine. Over a
/// triangle of area A int o^2 dA = A/12 ((sum o)^2 + sum o^2), sums over its corners.
double energyOfClosedPart(const State& state, std::size_t i, const contact::JointLaw& law, const Vec3& gap) {
    Polygon patch;
    for (const Vec2& corner : patchOutline(state.interfaces, i)) patch.push(corner);
    const LinearPressure overlap{-gap.x(), {-gap.y(), -gap.z()}};
    const Polygon closed = wetPart(patch, overlap);
    const auto at = [&](std::size_t k) { return std::max(0.0, overlap.at(closed[k])); };
    double squared = 0;
    for (std::size_t k = 2; k < closed.size(); ++k) {
        const Vec2 b = closed[k - 1] - closed[0], c = closed[k] - closed[0];
        const double area = 0.5 * (b.x() * c.y() - b.y() * c.x()), sum = at(0) + at(k - 1) + at(k);
        squared += area / 12 * (sum * sum + at(0) * at(0) + at(k - 1) * at(k - 1) + at(k) * at(k));
    }
    return 0.5 * contact::stiffnessOf(law).normal * squared;
}

PointSum sumOver(const State& state, std::size_t i, const RelativePose& pose) {
    PointSum sum;
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
    const bool has_arms = state.springs == Springs::keep_energy;
    const Vec3 height = has_arms ? Vec3(pose.gap + state.interfaces.frame(i).reference_gap) : Vec3::Zero();
    double normal_energy = 0;
    bool shares_pressure = isDistributed(state) && state.interfaces.cornerCount(i) > 1;
    for (const ContactPoint& point : contactPoints(state, i)) {
        const Vec3 shear = point.force.shear_1 * pose.e1 + point.force.shear_2 * pose.e2;
        const Vec3 force = shear + point.force.normal * pose.e3;
        const Vec3 place = (point.position.x() + affineAt(pose.slide_1, point.position)) * pose.e1 +
                           (point.position.y() + affineAt(pose.slide_2, point.position)) * pose.e2;
        sum.force += force;
        sum.moment += place.cross(force) + affineAt(height, point.position) * pose.e3.cross(shear);
        sum.magnitude += force.norm();
        normal_energy += normalEnergy(law, point);
        sum.energy += shearEnergy(law, pose, point);
        sum.dilates = sum.dilates || (contact::dilates(law) && point.memory.dilation > 0);
        shares_pressure = shares_pressure && contact::followsShare<double>(law, point.memory.bond) == 1;
    }
    sum.energy += shares_pressure ? energyOfClosedPart(state, i, law, pose.gap) : normal_energy;
    return sum;
}

void checkInterface(const State& state, std::size_t i, PointSum& all, Findings& findings) {
    const Interfaces& f = state.interfaces;
    const RelativePose pose = relativePose(state, i);
    const PointSum sum = sumOver(state, i, pose);
    all.energy += sum.energy;
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[i])];
    const double stiffness = contact::largestStiffness(law) * f.area[i];
    all.rounding += stiffness * kPlace * kPlace * f.area[i];
    all.dilates = all.dilates || sum.dilates;
    if (isIdle(f, i)) findings.expect(sum.magnitude == 0, "interface", i, "it is idle and carries something");
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    const InterfaceWrench& wrench = f.wrench(i);
    const Vec3 x_a = state.blocks.position.get(a), x_b = state.blocks.position.get(b);
    const double length = std::sqrt(f.area[i]),
                 reach = (pose.origin - x_a).norm() + (pose.origin - x_b).norm() + length;
    const double balance =
        kSumRounding * (wrench.force.norm() * reach + wrench.moment_a.norm() + wrench.moment_b.norm());
    findings.expect((wrench.moment_a + wrench.moment_b + (x_b - x_a).cross(wrench.force)).norm() <= balance,
                    "interface", i, "its wrenches on the two blocks are not opposite");
    if (state.damping.contact > 0 || state.damping.restitution || sum.dilates) return;
    const double rounding = kSumRounding * sum.magnitude + kPlace * stiffness * length;
    findings.expect((wrench.force - sum.force).norm() <= rounding, "interface", i,
                    "its force is not the sum over its contact points");
    const Vec3 moment_b = (pose.origin - x_b).cross(sum.force) + sum.moment;
    findings.expect((wrench.moment_b - moment_b).norm() <= rounding * reach, "interface", i,
                    "its moment is not the sum over its contact points");
}

}  // namespace

std::vector<std::string> validateForces(const State& state) {
    Findings findings;
    PointSum all;
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) checkInterface(state, i, all, findings);
    const double elastic = elasticEnergy(state);
    findings.expect(kineticEnergy(state) >= 0 && elastic >= 0, "an energy is negative");
    if (!all.dilates)
        findings.expect(
            std::abs(elastic - all.energy - tieEnergy(state)) <= kSumRounding * elastic + all.rounding,
            "the elastic energy is not that of the springs");
    return findings.take();
}

}  // namespace talus
