#include "forces/contact_forces.h"

#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include <random>

#include "build/build.h"
#include "forces/sum.h"
#include "step/motion.h"
#include "step/step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A 0.4 x 0.2 x 0.1 m box on the floor, closed joint with k_n = 1e10, k_s = 4e9, bonded so that nothing
/// opens.
State bondedBox() {
    Model model = floorModel(40);
    model.joints[0].shear_stiffness = 4e9;
    model.joints[0].cohesion = model.joints[0].tensile_strength = 1e12;
    addBox(model, "box", {0, 0, 0}, {0.4, 0.2, 0.1});
    model.gravity.magnitude = 0;
    return *buildState(model, false);
}

void turn(State& state, std::size_t b, const Eigen::AngleAxisd& rotation) {
    const Eigen::Quaterniond q(state.blocks.orientation[b].w, state.blocks.orientation[b].x,
                               state.blocks.orientation[b].y, state.blocks.orientation[b].z);
    const Eigen::Quaterniond turned(Eigen::Quaterniond(rotation) * q);
    state.blocks.orientation[b].w = turned.w();
    state.blocks.orientation[b].x = turned.x();
    state.blocks.orientation[b].y = turned.y();
    state.blocks.orientation[b].z = turned.z();
}

Wrench contactWrench(State& state, std::size_t b) {
    updateForces(state, false);
    return outOfBalance(state, b, Vec3::Zero());
}

}  // namespace

TEST_SUITE("forces") {
    TEST_CASE("closed stiffness is that of the distributed joint: k_n A, k_s A") {
        State state = bondedBox();
        const Vec3 u(3e-7, -2e-7, 1e-7);
        state.blocks.position.set(1, state.blocks.position.get(1) + u);
        const Wrench wrench = contactWrench(state, 1);
        CHECK(wrench.force.x() == doctest::Approx(-4e9 * 0.08 * u.x()).epsilon(1e-6));
        CHECK(wrench.force.y() == doctest::Approx(-4e9 * 0.08 * u.y()).epsilon(1e-6));
        CHECK(wrench.force.z() == doctest::Approx(-1e10 * 0.08 * u.z()).epsilon(1e-6));
    }

    TEST_CASE(
        "closed rotational stiffness is exact: k_n I about the patch's axes, k_s I_p about its normal") {
        const double t = 1e-6, h = 0.05;
        State about_y = bondedBox();
        turn(about_y, 1, Eigen::AngleAxisd(t, Vec3::UnitY()));
        // k_n b a^3 / 12, and the shear at the base, a half height below the centroid.
        CHECK(contactWrench(about_y, 1).torque.y() ==
              doctest::Approx(-t * (1e10 * 0.2 * std::pow(0.4, 3) / 12 + 4e9 * 0.08 * h * h)).epsilon(1e-5));
        State about_z = bondedBox();
        turn(about_z, 1, Eigen::AngleAxisd(t, Vec3::UnitZ()));
        CHECK(contactWrench(about_z, 1).torque.z() ==
              doctest::Approx(-t * 4e9 * 0.08 / 12 * (0.4 * 0.4 + 0.2 * 0.2)).epsilon(1e-5));
    }

    TEST_CASE("action and reaction: force and moment of the two blocks add up to nothing") {
        Model model = floorModel(30);
        model.joints[0].cohesion = model.joints[0].tensile_strength = 1e12;
        addBox(model, "a", {0, 0, 5}, {0.4, 0.2, 0.1});
        addBox(model, "b", {0.1, 0.05, 5.1}, {0.4, 0.2, 0.1});
        State state = *buildState(model, false);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> jitter(-1e-5, 1e-5);
        for (std::size_t b : {std::size_t{1}, std::size_t{2}}) {
            state.blocks.position.set(
                b, state.blocks.position.get(b) + Vec3(jitter(random), jitter(random), jitter(random)));
            turn(state, b, Eigen::AngleAxisd(jitter(random), Vec3(1, 2, 3).normalized()));
        }
        const Wrench a = contactWrench(state, 1), b = contactWrench(state, 2);
        CHECK(a.force.norm() > 1);
        CHECK((a.force + b.force).norm() < 1e-12 * a.force.norm());
        const Vec3 moment = a.torque + b.torque + state.blocks.position.get(1).cross(a.force) +
                            state.blocks.position.get(2).cross(b.force);
        CHECK(moment.norm() < 1e-11 * a.force.norm());
    }

    TEST_CASE("forces turn with the model: a rigid motion of all blocks changes nothing else") {
        Model model = stackModel(2, 2, 1, 30);
        for (Block& block : model.blocks) block.motion = Motion::free;
        State still = *buildState(model, false);
        std::mt19937 random(5);
        std::uniform_real_distribution<double> jitter(-1e-7, 1e-7);
        for (std::size_t b = 0; b < still.blocks.size(); ++b)
            still.blocks.position.set(
                b, still.blocks.position.get(b) + Vec3(jitter(random), jitter(random), jitter(random)));
        State turned = still;
        const Eigen::AngleAxisd rotation(0.7, Vec3(1, -2, 0.5).normalized());
        for (std::size_t b = 0; b < turned.blocks.size(); ++b) {
            turned.blocks.position.set(b, rotation * still.blocks.position.get(b));
            turn(turned, b, rotation);
        }
        for (std::size_t b = 1; b < still.blocks.size(); ++b) {
            const Wrench before = contactWrench(still, b), after = contactWrench(turned, b);
            CHECK((rotation * before.force - after.force).norm() < 1e-5 * before.force.norm());
            CHECK((rotation * before.torque - after.torque).norm() < 1e-5 * before.force.norm());
        }
    }

    TEST_CASE("the gap does not depend on how far the block has slid, nor does the normal force") {
        Model model = floorModel(0);
        addBox(model, "box", {0, 0, 0}, {0.4, 0.2, 0.1});
        State state = *buildState(model, false);
        state.blocks.position[1].z -= 1e-6;
        turn(state, 1, Eigen::AngleAxisd(2e-6, Vec3::UnitY()));
        const double before = contactWrench(state, 1).force.z();
        state.blocks.position[1].x += 0.05;
        CHECK(contactWrench(state, 1).force.z() == doctest::Approx(before).epsilon(1e-12));
    }

    TEST_CASE("contact damping: k A times c times the closing speed, never tension, none in sliding shear") {
        Model model = floorModel(20);
        addBox(model, "box", {0, 0, 0}, {0.4, 0.2, 0.1});
        model.gravity.magnitude = 0;
        model.damping.contact = 1e-4;
        State state = *buildState(model, false);
        state.blocks.position[1].z -= 1e-6;  // spring: 800 N
        state.blocks.velocity.z[1] = -0.005;
        CHECK(contactWrench(state, 1).force.z() == doctest::Approx(800 + 1e-4 * 8e8 * 0.005));
        state.blocks.velocity.z[1] = 1.0;
        CHECK(contactWrench(state, 1).force.z() == doctest::Approx(0));
        state.blocks.velocity.set(1, {0.1, 0, 0});
        state.blocks.position[1].x += 1e-3;
        CHECK(contactWrench(state, 1).force.x() == doctest::Approx(-800 * std::tan(radians(20))));
    }

    TEST_CASE("one range or many: the same bits") {
        Model model = stackModel(3, 3, 2, 30);
        State whole = *buildState(model, false);
        State cut = whole;
        updateContacts(whole, {0, whole.interfaces.groups.size()});
        for (std::size_t g = cut.interfaces.groups.size(); g-- > 0;) updateContacts(cut, {g, g + 1});
        CHECK(whole.interfaces.wrenches == cut.interfaces.wrenches);
        CHECK(whole.points.memory == cut.points.memory);
    }
}
