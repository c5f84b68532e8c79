#include "stages/contacts.h"

namespace talus::stages {

namespace {

/// What an interface's Lps add up to: force on b and moment about the interface's origin, in the frame e1, e2, e3.
struct PatchSum {
    double force_1 = 0, force_2 = 0, force_3 = 0;
    double moment_1 = 0, moment_2 = 0, moment_3 = 0;

    void add(double xi, double eta, double shear_1, double shear_2, double normal) {
        force_1 += shear_1;
        force_2 += shear_2;
        force_3 += normal;
        moment_1 += eta * normal;
        moment_2 -= xi * normal;
        moment_3 += xi * shear_2 - eta * shear_1;
    }
};

double affine(const Vec3& f, double xi, double eta) { return f.x() + xi * f.y() + eta * f.z(); }

/// Velocity of b relative to a at the interface's origin and its gradients, as for the slides.
struct RelativeVelocity {
    Vec3 normal, tangent_1, tangent_2;
};

RelativeVelocity relativeVelocity(const State& state, std::size_t i, const RelativePose& pose) {
    const auto a = static_cast<std::size_t>(state.interfaces.block_a[i]);
    const auto b = static_cast<std::size_t>(state.interfaces.block_b[i]);
    const Vec3 spin_a = angularVelocity(state.blocks, a), spin_b = angularVelocity(state.blocks, b);
    const Vec3 v = state.blocks.velocity.get(b) + spin_b.cross(pose.origin - state.blocks.position.get(b)) -
                   state.blocks.velocity.get(a) - spin_a.cross(pose.origin - state.blocks.position.get(a));
    const Vec3 spin = spin_b - spin_a;
    const Vec3 v_xi = spin.cross(pose.e1), v_eta = spin.cross(pose.e2);
    return {{v.dot(pose.e3), v_xi.dot(pose.e3), v_eta.dot(pose.e3)},
            {v.dot(pose.e1), v_xi.dot(pose.e1), v_eta.dot(pose.e1)},
            {v.dot(pose.e2), v_xi.dot(pose.e2), v_eta.dot(pose.e2)}};
}

/// The viscous term c_k of eqs (3)-(4) beside the spring: acts while the Lp is closed, along the surface only while it
/// sticks, and never turns the normal force into tension beyond the joint's strength.
void addDashpot(const contact::JointLaw& law, double area, double contact_damping, double bond, double v_n,
                double v_1, double v_2, contact::PointForce& total) {
    if (total.open) return;
    const double tension_limit = bond * law.tensile_strength * area;
    total.normal =
        std::max(total.normal - contact_damping * law.normal_stiffness * area * v_n, -tension_limit);
    if (total.slips) return;
    total.shear_1 -= contact_damping * law.shear_stiffness * area * v_1;
    total.shear_2 -= contact_damping * law.shear_stiffness * area * v_2;
}

template <bool Damped, bool Dilates>
PatchSum sumPoints(State& state, std::size_t i, const RelativePose& pose) {
    ContactPoints& points = state.points;
    const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
    RelativeVelocity velocity;
    if constexpr (Damped) velocity = relativeVelocity(state, i, pose);
    PatchSum sum;
    const auto end = static_cast<std::size_t>(state.interfaces.point_begin[i + 1]);
    for (auto p = static_cast<std::size_t>(state.interfaces.point_begin[i]); p < end; ++p) {
        const double xi = points.xi[p], eta = points.eta[p], area = points.area[p];
        contact::PointMemory memory{points.offset_1[p], points.offset_2[p], points.bond[p], 0.0};
        if constexpr (Dilates) memory.dilation = points.dilation[p];
        const double slide_1 = affine(pose.slide_1, xi, eta), slide_2 = affine(pose.slide_2, xi, eta);
        contact::PointForce force = contact::contactLaw(law, area, affine(pose.gap, xi, eta), slide_1,
                                                        slide_2, state.release, memory);
        points.offset_1[p] = memory.offset_1;
        points.offset_2[p] = memory.offset_2;
        points.bond[p] = memory.bond;
        if constexpr (Dilates) points.dilation[p] = memory.dilation;
        points.normal[p] = force.normal;
        points.shear_1[p] = force.shear_1;
        points.shear_2[p] = force.shear_2;
        if constexpr (Damped)
            addDashpot(law, area, state.damping.contact, memory.bond, affine(velocity.normal, xi, eta),
                       affine(velocity.tangent_1, xi, eta), affine(velocity.tangent_2, xi, eta), force);
        sum.add(xi + slide_1, eta + slide_2, force.shear_1, force.shear_2, force.normal);
    }
    return sum;
}

template <bool Damped, bool Dilates>
void updateRange(State& state, Range range) {
    Interfaces& interfaces = state.interfaces;
    for (std::size_t i = range.begin; i < range.end; ++i) {
        const RelativePose pose = relativePose(state, i);
        const PatchSum sum = sumPoints<Damped, Dilates>(state, i, pose);
        const Vec3 force = sum.force_1 * pose.e1 + sum.force_2 * pose.e2 + sum.force_3 * pose.e3;
        const Vec3 moment = sum.moment_1 * pose.e1 + sum.moment_2 * pose.e2 + sum.moment_3 * pose.e3;
        const Vec3 arm_a =
            pose.origin - state.blocks.position.get(static_cast<std::size_t>(interfaces.block_a[i]));
        const Vec3 arm_b =
            pose.origin - state.blocks.position.get(static_cast<std::size_t>(interfaces.block_b[i]));
        interfaces.force.set(i, force);
        interfaces.moment_a.set(i, -(arm_a.cross(force) + moment));
        interfaces.moment_b.set(i, arm_b.cross(force) + moment);
    }
}

}  // namespace

Vec3 angularVelocity(const Blocks& blocks, std::size_t block) {
    const Mat3 r = blocks.orientation.matrix(block);
    return r *
           blocks.inverse_inertia.get(block).cwiseProduct(r.transpose() * blocks.angular_momentum.get(block));
}

// Gap and slide are those of b's material points over a's plane, so the gap does not depend on how far b has slid and
// clipping the patch again does not change it. The reference face is the fixed or the larger one: the patch goes with b.
RelativePose relativePose(const State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    const auto a = static_cast<std::size_t>(f.block_a[i]);
    const auto b = static_cast<std::size_t>(f.block_b[i]);
    const Mat3 turn_a = state.blocks.orientation.matrix(a);
    const Mat3 turn_b = state.blocks.orientation.matrix(b);
    RelativePose pose;
    pose.e1 = turn_a * f.e1_a.get(i);
    pose.e2 = turn_a * f.e2_a.get(i);
    pose.e3 = pose.e1.cross(pose.e2);
    pose.origin = state.blocks.position.get(a) + turn_a * f.origin_a.get(i);
    const Vec3 b1 = turn_b * f.e1_b.get(i);
    const Vec3 b2 = turn_b * f.e2_b.get(i);
    const Vec3 d = state.blocks.position.get(b) + turn_b * f.origin_b.get(i) - pose.origin;
    pose.gap = Vec3(d.dot(pose.e3), b1.dot(pose.e3), b2.dot(pose.e3)) - f.reference_gap.get(i);
    pose.slide_1 = {d.dot(pose.e1), b1.dot(pose.e1) - 1.0, b2.dot(pose.e1)};
    pose.slide_2 = {d.dot(pose.e2), b1.dot(pose.e2), b2.dot(pose.e2) - 1.0};
    return pose;
}

void updateContacts(State& state, Range range) {
    const bool damped = state.damping.contact > 0;
    const bool dilates = !state.points.dilation.empty();
    if (damped)
        return dilates ? updateRange<true, true>(state, range) : updateRange<true, false>(state, range);
    return dilates ? updateRange<false, true>(state, range) : updateRange<false, false>(state, range);
}

}  // namespace talus::stages
