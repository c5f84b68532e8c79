#include "forces/bolts.h"
#include "talus/bolts.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "step/step.h"
#include "step/time_step.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;

namespace {

Bolt anchorOf(const Vec3& head, const Vec3& end) {
    Bolt bolt;
    bolt.name = "A1";
    bolt.head = head;
    bolt.end = end;
    bolt.area = 1e-3;
    bolt.modulus = 2e11;
    bolt.yield_force = 4e5;
    bolt.field = "bolt[0]";
    return bolt;
}

Bolt groutedOf(const Vec3& head, const Vec3& end) {
    Bolt bolt = anchorOf(head, end);
    bolt.grouted = true;
    bolt.bond_stiffness = 1e8;
    bolt.bond_strength = 2e5;
    return bolt;
}

/// From the upper box into the lower one, along no axis.
Bolt slantedBolt(bool is_grouted) {
    const Vec3 head(0.9, 0.3, 1.9), end(0.2, 0.6, 0.2);
    Bolt bolt = is_grouted ? groutedOf(head, end) : anchorOf(head, end);
    bolt.pretension = 5e4;
    bolt.shear_stiffness = is_grouted ? 1e7 : 0;
    return bolt;
}

/// Two boxes of 1 m on a floor, side by side and on top of each other, and a bolt.
Model bolted(Bolt bolt) {
    Model model = floorModel(30);
    addBox(model, "low", {0, 0, 0}, {1, 1, 1});
    addBox(model, "high", {0, 0, 1}, {1, 1, 1});
    addBox(model, "beside", {1, 0, 0}, {1, 1, 1});
    model.bolts = {std::move(bolt)};
    return model;
}

std::string refused(Bolt bolt) {
    const auto errors = buildState(bolted(std::move(bolt)), false).errors();
    REQUIRE(errors.size() == 1);
    return errors[0].field + ": " + errors[0].message;
}

void move(State& state, std::size_t block, const Vec3& by, const Eigen::Quaterniond& turn) {
    state.blocks.position.set(block, state.blocks.position.get(block) + by);
    const Quaternion& q = state.blocks.orientation[block];
    const Eigen::Quaterniond turned = turn * Eigen::Quaterniond(q.w, q.x, q.y, q.z);
    state.blocks.orientation[block] = {turned.w(), turned.x(), turned.y(), turned.z()};
}

}  // namespace

TEST_SUITE("forces") {
    TEST_CASE("an anchored bolt ties the blocks of its head and its end; a grouted one all that it crosses") {
        const State anchored = *buildState(bolted(anchorOf({0.5, 0.5, 2}, {0.5, 0.5, -0.5})), false);
        REQUIRE(anchored.bolts.size() == 1);
        CHECK(anchored.bolts.segments[0].block_a == 2);
        CHECK(anchored.bolts.segments[0].block_b == 0);
        CHECK(anchored.bolts.segments[0].law.stiffness == doctest::Approx(2e8 / 2.5));
        CHECK(anchored.bolts.segments[0].length == doctest::Approx(2.5));

        const State grouted = *buildState(bolted(groutedOf({0.5, 0.5, 2}, {0.5, 0.5, -0.5})), false);
        REQUIRE(grouted.bolts.size() == 2);
        const double lambda = std::sqrt(1e8 / 2e8), endless = std::sqrt(1e8 * 2e8);
        const auto side = [&](double length) { return endless * std::tanh(lambda * length); };
        const auto series = [](double a, double b) { return a * b / (a + b); };
        const BoltLaw &upper = grouted.bolts.segments[0].law, &lower = grouted.bolts.segments[1].law;
        CHECK(upper.stiffness == doctest::Approx(series(side(1.0), side(1.5))));
        CHECK(lower.stiffness == doctest::Approx(series(side(2.0), side(0.5))));
        CHECK(upper.bond == doctest::Approx(2e5 * 1.0));
        CHECK(lower.bond == doctest::Approx(2e5 * 0.5));
    }

    TEST_CASE("a plate at the head holds what its grout does not") {
        Bolt bolt = groutedOf({0.5, 0.5, 2}, {0.5, 0.5, -0.5});
        bolt.plate = true;
        const State state = *buildState(bolted(bolt), false);
        CHECK(state.bolts.segments[0].law.bond == doctest::Approx(2e5 * 1.5));
        CHECK(state.bolts.segments[1].law.bond == doctest::Approx(2e5 * 0.5));
    }

    TEST_CASE("errors: head or end in no block, both in one, fixed blocks alone") {
        CHECK(refused(anchorOf({0.5, 0.5, 2.3}, {0.5, 0.5, -0.5}))
                  .starts_with("bolt[0].head: found (0.5, 0.5, 2.3)"));
        CHECK(refused(anchorOf({0.5, 0.5, 1.5}, {0.5, 3, 1.5}))
                  .starts_with("bolt[0].end: found (0.5, 3, 1.5)"));
        CHECK(refused(anchorOf({0.5, 0.5, 1.2}, {0.5, 0.5, 1.8})).find("both in block \"high\"") !=
              std::string::npos);
        Model fixed = bolted(anchorOf({0.5, 0.5, 2}, {0.5, 0.5, -0.5}));
        for (Block& block : fixed.blocks) block.motion = Motion::fixed;
        addBox(fixed, "free", {5, 0, 0}, {1, 1, 1});
        const auto errors = buildState(fixed, false).errors();
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].message.find("no free block") != std::string::npos);
    }

    TEST_CASE(
        "a bolt through a body of several parts: seams are no joints, and a notch with another block in it "
        "is") {
        const auto segmentsOf = [](const std::vector<Polyhedron>& parts, const Bolt& bolt, bool has_filling) {
            Model model = floorModel(30);
            Block& body = model.blocks.emplace_back(box("body", {0, 0, 0}, {1, 1, 1}));
            body.shape = *joinParts(parts);
            body.face_joint.assign(body.shape.faces.size(), 0);
            if (has_filling) addBox(model, "filling", {1, 0, 1}, {1, 1, 1});
            model.bolts = {bolt};
            const State state = *buildState(model, false);
            return state.bolts.segments;
        };
        const auto slab = [](double x) { return *makeBox({x, 0, 0}, {x + 1, 1, 1}); };
        const auto tower = [](double x) { return *makeBox({x, 0, 1}, {x + 1, 1, 2}); };
        const Bolt down = groutedOf({0.5, 0.5, 2}, {0.5, 0.5, -0.4});
        const auto parted = segmentsOf({slab(0), tower(0)}, down, false);
        const auto whole = segmentsOf({*makeBox({0, 0, 0}, {1, 1, 2})}, down, false);
        REQUIRE(parted.size() == 1);
        REQUIRE(whole.size() == 1);
        CHECK(parted[0].law.stiffness == doctest::Approx(whole[0].law.stiffness).epsilon(1e-12));
        CHECK(parted[0].law.bond == doctest::Approx(whole[0].law.bond).epsilon(1e-12));
        CHECK(parted[0].length == doctest::Approx(whole[0].length));

        // A U with a block between its arms: two joints, body to filling and filling to body.
        const Bolt across = groutedOf({0.2, 0.5, 1.5}, {2.8, 0.5, 1.5});
        const auto through = segmentsOf({slab(0), slab(1), slab(2), tower(0), tower(2)}, across, true);
        REQUIRE(through.size() == 2);
        CHECK(through[0].block_a == through[1].block_b);
        CHECK(through[0].block_b == through[1].block_a);
    }

    TEST_CASE("force and its opposite: no force and no torque in all, the pretension with the weight") {
        for (const bool is_grouted : {false, true}) {
            State state = *buildState(bolted(slantedBolt(is_grouted)), false);
            move(state, 2, {0.002, -0.001, 0.003}, turnAbout({1, 2, -1}, 0.02));
            state.load.gravity_share = 0.6;
            updateBlockForces(state);
            const Wrench low = blockForcesOn(state, 1), high = blockForcesOn(state, 2);
            CHECK(low.force.norm() > 1e4);
            CHECK((low.force + high.force).norm() < 1e-9 * low.force.norm());
            const Vec3 torque = low.torque + high.torque + state.blocks.position.get(1).cross(low.force) +
                                state.blocks.position.get(2).cross(high.force);
            CHECK(torque.norm() < 1e-9 * low.force.norm());
            CHECK(blockForcesOn(state, 3).force == Vec3::Zero());
            CHECK(outsideForcesOn(state, 1).force == Vec3::Zero());
        }
    }

    TEST_CASE("the implicit solve has the exact derivative: against differences of forces") {
        for (const bool is_grouted : {false, true}) {
            State state = *buildState(bolted(slantedBolt(is_grouted)), false);
            // Away from each other, so that no contact has a share in it.
            move(state, 2, {0.0005, -0.0002, 0.0008}, turnAbout({1, 2, -1}, 0.02));
            const TyingForce* tying = nullptr;
            eachBlockForce(state, [&](const BlockForce& force, const ForceParts&) {
                if (force.tying != nullptr) tying = force.tying;
            });
            REQUIRE(tying != nullptr);
            const auto poseOf = [&](std::size_t b) {
                return TiedPose{state.blocks.position.get(b), state.blocks.orientation.matrix(b)};
            };
            const Tie tie = tying->ties(state).at(0);
            const auto a = static_cast<std::size_t>(tie.a), b = static_cast<std::size_t>(tie.b);
            const auto wrenches = [&](const TiedPose& at_a, const TiedPose& at_b) {
                const TieForce found = tying->between(state, 0, at_a, at_b);
                Eigen::Matrix<double, 12, 1> all;
                const Wrench on_a = found.onA(at_a.position), on_b = found.onB(at_b.position);
                all << on_a.force, on_a.torque, on_b.force, on_b.torque;
                return all;
            };
            const TieRates rates = ratesOf(tying->between(state, 0, poseOf(a), poseOf(b)), poseOf(a).position,
                                           poseOf(b).position);
            Eigen::Matrix<double, 12, 12> exact;
            exact << rates.on_a, rates.on_b;
            constexpr double h = 1e-6;
            for (int k = 0; k < 12; ++k) {
                const auto moved = [&](double by) {
                    TiedPose at[2] = {poseOf(a), poseOf(b)};
                    TiedPose& pose = at[k / 6];
                    const Vec3 axis = Vec3::Unit(k % 3);
                    if (k % 6 < 3)
                        pose.position += by * axis;
                    else
                        pose.turn = Eigen::AngleAxisd(by, axis).toRotationMatrix() * pose.turn;
                    return wrenches(at[0], at[1]);
                };
                const Eigen::Matrix<double, 12, 1> difference = (moved(h) - moved(-h)) / (2 * h);
                CHECK((difference - exact.col(k)).norm() < 1e-5 * exact.norm());
            }
        }
    }

    TEST_CASE(
        "a block that hangs on a bolt: frequency within the stable bound, energy kept, yield accounted for") {
        // Weightless on a spring along z: k / m = omega^2, with a bolt alone (the block hangs below a fixed
        // one).
        for (const double yield : {1e9, 3e4}) {
            Model model = floorModel(30);
            addBox(model, "hanging", {0, 0, -2.5}, {1, 1, 1});
            model.gravity.magnitude = 9.81;
            Bolt bolt = anchorOf({0.5, 0.5, -0.5}, {0.5, 0.5, -2.0});
            bolt.yield_force = yield;
            model.bolts = {bolt};
            State state = *buildState(model, false);
            const double k = state.bolts.segments[0].law.stiffness, m = state.blocks.mass[1];
            const double bound = frequencyBounds(state, false)[1];
            CHECK(bound >= k / m);
            updateForces(state, false);
            const double before = kineticEnergy(state) + elasticEnergy(state) + gravityEnergy(state);
            double largest = 0;
            for (int n = 0; n < 4000; ++n) {
                advance(state, {1e-5, false}, 1);
                largest = std::max(largest, std::abs(state.blocks.velocity.z[1]));
            }
            CHECK(largest > 0.04);
            const double given = yield * state.bolts.memory[0].yielded;
            CHECK((state.bolts.memory[0].yielded > 0) == (yield < 1e8));
            const double after = kineticEnergy(state) + elasticEnergy(state) + gravityEnergy(state) + given;
            CHECK(std::abs(after - before) < 1e-5 * (0.5 * m * largest * largest + given));
        }
    }

    TEST_CASE("a pattern: one bolt for each field of the face, in order, dipping into the rock") {
        Model model = bolted({});
        model.bolts.clear();
        BoltPattern pattern;
        pattern.like = groutedOf(Vec3::Zero(), Vec3::UnitX());
        pattern.like.name = "P";
        pattern.box_min = {-0.1, -1, -0.1};
        pattern.box_max = {0.1, 2, 1.0};
        pattern.direction = -Vec3::UnitX();
        pattern.spacing_along = 0.4;
        pattern.spacing_up = 0.5;
        pattern.length = 1.5;
        pattern.plunge = radians(10);
        pattern.trend = radians(90);
        model.bolt_patterns = {pattern};
        REQUIRE(placeBoltPatterns(model).empty());
        REQUIRE(model.bolts.size() == 4);
        CHECK(model.bolts[0].name == "P-1");
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 head(0, 0.5 + (k % 2 == 0 ? 1 : -1) * 0.2, k < 2 ? 0.25 : 0.75);
            CHECK((model.bolts[k].head - head).norm() < 1e-9);
            const Vec3 way = model.bolts[k].end - model.bolts[k].head;
            CHECK((way - 1.5 * Vec3(std::cos(radians(10)), 0, -std::sin(radians(10)))).norm() < 1e-9);
        }
        CHECK(buildState(model, false).ok());
        model.bolts.clear();
        pattern.direction = Vec3::UnitX();  // there the joint with the block beside it is closed
        pattern.box_min.x() = 0.9, pattern.box_max.x() = 1.1;
        model.bolt_patterns = {pattern};
        const auto no_face = placeBoltPatterns(model);
        REQUIRE(no_face.size() == 1);
        CHECK(no_face[0].field == "bolt[0].box");
        pattern.direction = -Vec3::UnitX();
        pattern.box_min.x() = -0.1, pattern.box_max.x() = 0.1;
        pattern.spacing_up = 1e-9;
        model.bolt_patterns = {pattern};
        const auto too_many = placeBoltPatterns(model);
        REQUIRE(too_many.size() == 1);
        CHECK(too_many[0].field == "bolt[0].spacing");
    }
}
