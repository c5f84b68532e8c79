// The builds of the contact kernel against each other, to the bit, and against a plain sum over contact
// points, to rounding.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <random>

#include "build/build.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "law/points.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "step/motion.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using simd::InstructionSet;

namespace {

Joint frictional() {
    Joint strength = joint(25);
    strength.normal_stiffness = 1e8;
    strength.shear_stiffness = 5e7;
    return strength;
}

/// Stresses in these tests are some 10 Pa.
Joint curved(StrengthLaw law) {
    Joint strength = frictional();
    strength.law = law;
    strength.jrc = 12;
    strength.jcs = 30;
    strength.residual_friction = radians(20);
    strength.max_friction = radians(30);
    strength.a = 1.5;
    strength.b = 0.6;
    strength.shear_strength = {{0, 0}, {5, 3}, {5.02, 3.005}, {20, 8}};
    return strength;
}

/// Prisms of 3 to 7 sides and boxes on a floor, so that groups are of many shapes and not all full.
Model prisms(const PointRule& rule, const Joint& strength) {
    Model model = floorModel(25, 1e8);
    model.joints[0] = strength;
    model.joints.push_back(strength);
    model.joints[1].name = "other";
    if (strength.law == StrengthLaw::coulomb) model.joints[1].friction = radians(35);
    if (strength.law == StrengthLaw::power) model.joints[1] = frictional();
    model.points = rule;
    for (int k = 0; k < 23; ++k) {
        const double x = 2.5 * (k % 5), y = 2.1 * (k / 5) - 4;
        const int sides = 3 + k % 5;
        std::vector<Vec3> corners;
        for (int c = 0; c < sides; ++c)
            for (const double z : {0.0, 1.0})
                corners.push_back(
                    {x + std::cos(2 * M_PI * c / sides), y + std::sin(2 * M_PI * c / sides), z});
        if (rule.kind == PointRule::Kind::grid)
            addBox(model, "p" + std::to_string(k), {x, y, 0}, {1, 1, 1});
        else {
            Block block = box("p" + std::to_string(k), {0, 0, 0}, {1, 1, 1});
            block.shape = *convexHull(corners);
            block.face_joint.assign(block.shape.faces.size(), k % 2);
            model.blocks.push_back(std::move(block));
        }
    }
    return model;
}

Joint brittle() {
    Joint strength = joint(25);
    strength.normal_stiffness = 1e8;
    strength.shear_stiffness = 5e7;
    strength.cohesion = 20;
    strength.tensile_strength = 10;
    strength.residual_friction = radians(20);
    strength.dilation = radians(5);
    return strength;
}

Joint softening() {
    Joint strength = brittle();
    strength.softening_displacement = 5e-8;
    return strength;
}

/// What has been seen of the law in some steps of random motion; `then` is before the law, at the same place.
struct Seen {
    int stuck = 0, slipped = 0, open = 0, closed_again = 0, broken = 0;
};

void jolt(State& state, std::mt19937& random) {
    std::normal_distribution<double> gauss(0, 1);
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        const auto any = [&](double scale) -> Vec3 {
            return scale * Vec3(gauss(random), gauss(random), gauss(random));
        };
        state.blocks.position.set(b, state.geometry->initial_position.get(b) + any(2e-7));
        const QuaternionArray& start = state.geometry->initial_orientation;
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(2e-7 * gauss(random), any(1).normalized()) *
                                      Eigen::Quaterniond(start[b].w, start[b].x, start[b].y, start[b].z));
        state.blocks.orientation[b].w = turn.w();
        state.blocks.orientation[b].x = turn.x();
        state.blocks.orientation[b].y = turn.y();
        state.blocks.orientation[b].z = turn.z();
        state.blocks.velocity.set(b, any(1e-3));
        state.blocks.angular_momentum.set(b, any(1e-3));
    }
    updateSpin(state, {0, state.blocks.size()});
}

/// The wrench of interface i on b by a plain sum over its contact points, from what they remembered before
/// the step.
Wrench plainSum(const State& before, std::size_t i) {
    const RelativePose pose = relativePose(before, i);
    const auto b = static_cast<std::size_t>(before.interfaces.block_b[i]);
    const contact::JointLaw& law = before.laws[static_cast<std::size_t>(before.interfaces.joint[i])];
    Wrench sum;
    for (const ContactPoint& p : contactPoints(before, i)) {
        const auto at = [&](const Vec3& f) {
            return f.x() + f.y() * p.position.x() + f.z() * p.position.y();
        };
        const double slide_1 = at(pose.slide_1), slide_2 = at(pose.slide_2);
        contact::PointMemory memory = p.memory;
        const auto f = contact::contactLaw(law, p.area, p.gap, slide_1, slide_2, 1.0, memory);
        const Vec3 force = f.shear_1 * pose.e1 + f.shear_2 * pose.e2 + f.normal * pose.e3;
        const Vec3 place =
            pose.origin + (p.position.x() + slide_1) * pose.e1 + (p.position.y() + slide_2) * pose.e2;
        sum.force += force;
        sum.torque += (place - before.blocks.position.get(b)).cross(force);
    }
    return sum;
}

void count(const State& last, const State& before, const State& after, Seen& seen) {
    for (std::size_t i = 0; i < after.interfaces.size(); ++i) {
        const auto earlier = contactPoints(last, i), then = contactPoints(before, i),
                   now = contactPoints(after, i);
        for (std::size_t k = 0; k < now.size(); ++k) {
            const bool moved = now[k].memory.offset_1 != then[k].memory.offset_1;
            seen.open += now[k].force.open;
            seen.closed_again += earlier[k].force.open && !now[k].force.open;
            seen.slipped += !now[k].force.open && moved;
            seen.stuck += !now[k].force.open && !moved;
            seen.broken += now[k].memory.bond == 0;
        }
    }
}

/// Wrenches and memories; unused slots do not count.
bool sameBits(const State& a, const State& b) {
    for (std::size_t i = 0; i < a.interfaces.size(); ++i) {
        const InterfaceWrench of_a = a.interfaces.wrench(i), of_b = b.interfaces.wrench(i);
        for (const auto vector : kWrenchVectors)
            if (of_a.*vector != of_b.*vector) return false;
        const auto in_a = contactPoints(a, i), in_b = contactPoints(b, i);
        for (std::size_t k = 0; k < in_a.size(); ++k) {
            const contact::PointMemory &m = in_a[k].memory, &n = in_b[k].memory;
            if (m.offset_1 != n.offset_1 || m.offset_2 != n.offset_2 || m.bond != n.bond ||
                m.dilation != n.dilation)
                return false;
        }
    }
    return true;
}

Seen compare(const PointRule& rule, const Joint& strength, double contact_damping) {
    State scalar = *buildState(prisms(rule, strength), false);
    scalar.damping.contact = contact_damping;
    scalar.instructions = InstructionSet::scalar;
    std::mt19937 random(7);
    Seen seen;
    for (int step = 0; step < 40; ++step) {
        const State last = scalar;
        jolt(scalar, random);
        const State before = scalar;
        updateForces(scalar, false);
        for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
            if (!simd::isAvailable(set)) continue;
            State lanes = before;
            lanes.instructions = set;
            updateForces(lanes, false);
            CHECK(sameBits(scalar, lanes));
        }
        count(last, before, scalar, seen);
        if (contact_damping > 0) continue;
        double error = 0;
        for (std::size_t i = 0; i < scalar.interfaces.size(); ++i) {
            const Wrench sum = plainSum(before, i);
            const InterfaceWrench kernel = scalar.interfaces.wrench(i);
            error = std::max({error, (sum.force - kernel.force).norm() / (1 + sum.force.norm()),
                              (sum.torque - kernel.moment_b).norm() / (1 + sum.torque.norm())});
        }
        CHECK(error < 1e-10);
    }
    return seen;
}

constexpr PointRule kVertex{PointRule::Kind::vertex, 0}, kDistributed{PointRule::Kind::distributed, 0},
    kCorner{PointRule::Kind::corner, 0}, kQuarter{PointRule::Kind::quarter, 0},
    kGrid{PointRule::Kind::grid, 3};

}  // namespace

TEST_SUITE("forces") {
    TEST_CASE("contact kernel: every build gives the same bits, and the plain sum over Lps to rounding") {
        if (simd::bestInstructionSet() == InstructionSet::scalar)
            MESSAGE("this processor has no AVX2: the scalar build is compared with itself");
        const auto seenAll = [](const Seen& seen) {
            INFO("stuck " << seen.stuck << ", slipped " << seen.slipped << ", open " << seen.open
                          << ", closed again " << seen.closed_again << ", broken " << seen.broken);
            CHECK(std::min({seen.stuck, seen.slipped, seen.open, seen.closed_again}) > 0);
        };
        for (const PointRule& rule : {kVertex, kDistributed, kCorner, kQuarter, kGrid})
            for (const double damping : {0.0, 1e-5}) {
                seenAll(compare(rule, frictional(), damping));
                const Seen rich = compare(rule, brittle(), damping);
                seenAll(rich);
                CHECK(rich.broken > 0);
                const Seen soft = compare(rule, softening(), damping);
                seenAll(soft);
                CHECK(soft.broken > 0);
                for (const StrengthLaw law :
                     {StrengthLaw::barton_bandis, StrengthLaw::envelope, StrengthLaw::power}) {
                    Joint strength = curved(law);
                    seenAll(compare(rule, strength, damping));
                    strength.dilation = radians(5);
                    seenAll(compare(rule, strength, damping));
                }
            }
    }

    TEST_CASE("interfaces of one shape lie side by side, and each slot belongs to one corner or Lp") {
        const State state = *buildState(prisms(kVertex, frictional()), false);
        const Interfaces& f = state.interfaces;
        std::vector<int> owners(state.points.memory.slots(), 0);
        for (std::size_t i = 0; i < f.size(); ++i) {
            CHECK(f.pointCount(i) == 2 * f.cornerCount(i) + 1);
            CHECK(patchOutline(f, i).size() == f.cornerCount(i));
            for (std::size_t k = 0; k < f.pointCount(i); ++k) ++owners[f.pointSlot(i, k)];
        }
        CHECK(*std::max_element(owners.begin(), owners.end()) == 1);
        CHECK(std::count(owners.begin(), owners.end(), 1) ==
              static_cast<std::ptrdiff_t>(state.points.size()));
        std::size_t next = 0;
        for (const InterfaceGroup& group : f.groups) {
            CHECK(static_cast<std::size_t>(group.begin) == next);
            next += static_cast<std::size_t>(group.size);
        }
        CHECK(next == f.size());
    }

    TEST_CASE("drift: every build gives the same bits; fixed blocks stay, driven ones keep their velocity") {
        Model model = prisms(kVertex, frictional());
        model.blocks[3].motion = Motion::driven;
        model.blocks[3].velocity = {0.1, 0, 0};
        State scalar = *buildState(model, false);
        std::mt19937 random(11);
        jolt(scalar, random);
        scalar.damping = {.mass = 3.0, .rotation = 2.0};
        scalar.instructions = InstructionSet::scalar;
        const State start = scalar;
        for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
            if (!simd::isAvailable(set)) continue;
            State lanes = start;
            lanes.instructions = set;
            scalar = start;
            for (int step = 0; step < 100; ++step) {
                advance(scalar, {1e-4, false});
                advance(lanes, {1e-4, false});
            }
            REQUIRE(isFinite(scalar));
            CHECK(scalar.blocks.position == lanes.blocks.position);
            CHECK(scalar.blocks.orientation == lanes.blocks.orientation);
            CHECK(scalar.blocks.angular_momentum.z == lanes.blocks.angular_momentum.z);
            CHECK(scalar.blocks.angular_velocity.z == lanes.blocks.angular_velocity.z);
            CHECK(lanes.blocks.position.get(0) == lanes.geometry->initial_position.get(0));
            CHECK(lanes.blocks.position[3].x ==
                  doctest::Approx(lanes.geometry->initial_position[3].x + 0.1 * 100 * 1e-4));
            CHECK(lanes.blocks.orientation[3].w == lanes.geometry->initial_orientation[3].w);
        }
    }
}
