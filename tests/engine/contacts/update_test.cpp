#include "contacts/update.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "build/build.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "geometry/separation.h"
#include "measure/measure.h"
#include "state/incidence.h"
#include "state/placed_shape.h"
#include "step/motion.h"
#include "step/step.h"
#include "support/models.h"
#include "support/slower.h"
#include "support/validated.h"

using namespace talus;
using namespace talus::test;

namespace {

double totalArea(const State& state) {
    return std::accumulate(state.interfaces.area.begin(), state.interfaces.area.end(), 0.0);
}

double lowestVertex(const State& state, std::size_t block) {
    double lowest = kInfinity;
    for (const Vec3& v : placedShape(state, block).vertices) lowest = std::min(lowest, v.z());
    return lowest;
}

std::int32_t jointBetween(const Model& model, std::size_t a, std::size_t b) {
    return JointChoice(model).between(a, 0, b, 0);
}

/// Which of the old pairs of faces this one was; their number: none.
std::size_t sameFaces(const Interfaces& f, std::size_t i, const Interfaces& old) {
    std::size_t o = 0;
    while (o < old.size() &&
           (isVertexEdge(old, o) || old.block_a[o] != f.block_a[i] || old.block_b[o] != f.block_b[i] ||
            old.face_a[o] != f.face_a[i] || old.face_b[o] != f.face_b[i]))
        ++o;
    return o;
}

/// All that touches by a search of everything touches here, with the same forces. Patches that have slid less
/// than the limit are as they were: that is a tenth of a force at most.
void checkAgainstWholeSearch(const State& state) {
    State here = state, anew = state;
    REQUIRE(findInterfaces(anew, false, false).empty());
    updateForces(anew, false);
    updateForces(here, false);
    for (std::size_t b = 1; b < state.blocks.size(); ++b) {
        const double weight = state.blocks.mass[b] * state.geometry->model.gravity.magnitude;
        const Vec3 force = outOfBalance(here, b, Vec3::Zero()).force;
        const Vec3 wanted = outOfBalance(anew, b, Vec3::Zero()).force;
        REQUIRE((force - wanted).norm() < 0.2 * (weight + wanted.norm()));
    }
}

/// A stack whose contacts are pressed, differently.
State pressedStack() {
    State state = *buildState(stackModel(4, 3, 2, 30, {0.2, 0.1, 0.1}, 1e9), false);
    for (std::size_t b = 1; b < state.blocks.size(); ++b)
        state.blocks.position[b].z -= 1e-6 * static_cast<double>(b);
    updateForces(state, false);
    return state;
}

}  // namespace

TEST_SUITE("contacts") {
    TEST_CASE("a stack has the interfaces one counts by hand") {
        // 7 x 5 x 3: 6*5*3 across, 7*4*3 between rows, 7*3 on the floor, 7*5*2 between slices.
        const State state = *buildState(stackModel(7, 5, 3, 30), false);
        CHECK(state.interfaces.size() == 90 + 84 + 21 + 70);
        CHECK(state.points.size() == 9 * state.interfaces.size());
        CHECK(totalArea(state) == doctest::Approx(90 * 0.01 + 105 * 0.02 + 70 * 0.02));
        double point_area = 0;
        for (std::size_t i = 0; i < state.interfaces.size(); ++i)
            for (const ContactPoint& point : contactPoints(state, i)) point_area += point.area;
        CHECK(point_area == doctest::Approx(totalArea(state)));
    }

    TEST_CASE("a block over two others has a patch with each") {
        Model model = floorModel(30);
        addBox(model, "a", {0, 0, 0}, {1, 1, 1});
        addBox(model, "b", {1, 0, 0}, {1, 1, 1});
        addBox(model, "c", {0.3, 0, 1}, {1, 1, 1});
        const State state = *buildState(model, false);
        CHECK(state.interfaces.size() == 5);
        CHECK(totalArea(state) == doctest::Approx(1 + 1 + 1 + 0.7 + 0.3));
    }

    TEST_CASE("the reference face is the fixed block's") {
        Model model = floorModel(30);
        addBox(model, "a", {0, 0, 0}, {30, 3, 1});
        const State state = *buildState(model, false);
        CHECK(state.interfaces.block_a[0] == 0);
        CHECK(relativePose(state, 0).e3.z() == doctest::Approx(1));
    }

    TEST_CASE("small gaps and overlaps count as closed and unstressed, larger ones as open or as an error") {
        const auto buildAt = [](double z) {
            Model model = floorModel(30);
            addBox(model, "box", {0, 0, z}, {1, 1, 1});
            return buildState(model, false);
        };
        for (const double z : {0.9e-4, -0.9e-4}) {
            State state = *buildAt(z);
            updateForces(state, false);
            CHECK(contactPoints(state, 0)[0].memory.bond == 1);
            CHECK(contactPoints(state, 0)[0].force.normal == doctest::Approx(0));
            state.blocks.position[1].z -= 1e-6;
            updateForces(state, false);
            CHECK(outOfBalance(state, 1, Vec3::Zero()).force.z() == doctest::Approx(1e4).epsilon(1e-6));
        }
        State apart = *buildAt(2e-4);
        updateForces(apart, false);
        CHECK(relativePose(apart, 0).gap.x() == doctest::Approx(2e-4));
        CHECK(outOfBalance(apart, 1, Vec3::Zero()).force.z() == 0);
        const auto deep = buildAt(-2e-4);
        REQUIRE_FALSE(deep.ok());
        CHECK(deep.errors()[0].message.find("\"floor\" and \"box\" overlap") != std::string::npos);
    }

    TEST_CASE("blocks that cross without faces against each other overlap too") {
        Model model;
        model.joints = {joint(30)};
        model.blocks = {box("a", {-1, -0.1, -0.1}, {1, 0.1, 0.1}),
                        box("b", {-0.1, -1, -0.05}, {0.1, 1, 0.05})};
        CHECK_FALSE(buildState(model, false).ok());
    }

    TEST_CASE("joints: less friction wins, the first on ties, a pair's own before both") {
        Model model = floorModel(30);
        Joint weak = joint(20), other = joint(30);
        model.joints = {joint(30), weak, other};
        addBox(model, "a", {0, 0, 0}, {1, 1, 1});
        addBox(model, "b", {0, 0, 1}, {1, 1, 1});
        model.blocks[2].face_joint.assign(6, 1);
        CHECK(jointBetween(model, 1, 2) == 1);
        model.blocks[2].face_joint.assign(6, 2);
        CHECK(jointBetween(model, 2, 1) == 0);
        model.joints[2].strength_over_time = {{0, 0.9}, {1, 2}};  // at time 0
        CHECK(jointBetween(model, 2, 1) == 2);
        model.pair_joints = {{2, 1, 2, true, "interface[0]"}};
        CHECK(jointBetween(model, 1, 2) == 2);
        CHECK(buildState(model, false).ok());
        model.pair_joints[0].block_a = 0;
        model.pair_joints[0].block_b = 2;
        const auto apart = buildState(model, false);
        REQUIRE_FALSE(apart.ok());
        CHECK(apart.errors()[0].field == "interface[0].between");
    }

    TEST_CASE("grid N refuses patches that are not rectangles") {
        Model model = floorModel(30);
        model.points = {PointRule::Kind::grid, 3};
        model.blocks.push_back(box("prism", {0, 0, 0}, {1, 1, 1}));
        model.blocks[1].shape =
            *convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
        model.blocks[1].face_joint.assign(5, 0);
        const auto built = buildState(model, false);
        REQUIRE_FALSE(built.ok());
        CHECK(built.errors()[0].field == "contact.points");
    }

    TEST_CASE("clipping again after a slide keeps the normal force and the shear force") {
        Model model = floorModel(30, 1e9);
        addBox(model, "box", {0, 0, 0}, {1, 1, 1});
        State state = *buildState(model, false);
        state.blocks.position[1].z -= 1e-5;  // 10 kN
        updateForces(state, false);
        for (int k = 0; k < 200; ++k) {  // slides 20 mm with full friction, under a steady load
            state.blocks.position[1].x -= 1e-4;
            updateForces(state, false);
        }
        const Vec3 before = outOfBalance(state, 1, Vec3::Zero()).force;
        CHECK(before.x() == doctest::Approx(1e4 * std::tan(radians(30))));
        REQUIRE(refreshInterfaces(state, false, 0));
        checkValid(state, true);
        CHECK(relativePose(state, 0).slide_1.head<1>().norm() < 1e-12);
        updateForces(state, false);
        const Vec3 after = outOfBalance(state, 1, Vec3::Zero()).force;
        CHECK((after - before).norm() < 1e-9 * before.norm());
    }

    TEST_CASE("nothing is searched again while nothing moves") {
        State state = *buildState(stackModel(3, 3, 1, 30), false);
        CHECK_FALSE(refreshInterfaces(state, false, 0));
        checkValid(state);
        state.blocks.position[1].x += 1e-6;
        CHECK_FALSE(refreshInterfaces(state, false, 0));
        checkValid(state);
    }

    TEST_CASE(
        "faces that turn parallel have their patch from a search, and till then, where it may wait, their "
        "vertices") {
        Model model = floorModel(30, 1e9);
        addBox(model, "box", {0, 0, 0}, {1, 1, 1});
        State state = *buildState(model, false);
        const auto lean = [&](double angle) {  // about y, the lower edge pressed by 10 um
            state.blocks.orientation[1] = {std::cos(0.5 * angle), 0, std::sin(0.5 * angle), 0};
            state.blocks.position[1].z = 0.5 * (std::cos(angle) + std::sin(angle)) - 1e-5;
        };
        const auto refresh = [&](bool may_wait) {
            const bool searched = refreshInterfaces(state, false, 0, nullptr, {1, 1}, may_wait);
            updateForces(state, false);
            checkValid(state, true);
            return searched;
        };
        const auto isOnFaces = [&] {
            const auto& kind = state.interfaces.kind;
            return std::count(kind.begin(), kind.end(), InterfaceKind::faces) > 0;
        };
        const auto push = [&] { return outOfBalance(state, 1, Vec3::Zero()).force.z(); };
        lean(0.0505);
        REQUIRE(refresh(true));  // it has moved too far: that never waits
        CHECK_FALSE(isOnFaces());
        const double on_vertices = push();
        CHECK(on_vertices > 0);
        lean(0.0495);
        CHECK_FALSE(refresh(true));
        CHECK_FALSE(isOnFaces());
        CHECK(push() == doctest::Approx(on_vertices).epsilon(1e-6));
        REQUIRE(refresh(false));
        CHECK(isOnFaces());
        lean(0.0505);
        CHECK_FALSE(refresh(true));
        CHECK(isOnFaces());
        REQUIRE(refresh(false));
        CHECK_FALSE(isOnFaces());
    }

    TEST_CASE(
        "a search around the blocks that have moved far leaves others as they are, and misses nothing") {
        // Columns on a steep floor: the front ones slide off and topple, the ones behind them follow.
        Model model = stackModel(4, 3, 2, 20, {0.2, 0.1, 0.1}, 1e8);
        model.gravity.tilt = radians(35);
        State state = *buildState(model, false);
        state.searches_around = true;
        state.damping.local = 0.3;
        State twin = state;  // on several threads
        const double dt = 1e-4;
        int whole = 0, around = 0;
        std::size_t kept = 0;
        for (int look = 0; look < (kTriesFew ? 300 : 900); ++look) {
            for (int step = 0; step < 10; ++step) {
                advance(state, {dt, false});
                advance(twin, {dt, true});
            }
            const PositionArray before = state.search_position;
            const Interfaces old = state.interfaces;
            refreshInterfaces(twin, true, 10 * dt);
            if (!refreshInterfaces(state, false, 10 * dt)) continue;
            checkValid(state, true);
            const auto isFar = [&](std::int32_t block) {
                const auto b = static_cast<std::size_t>(block);
                return before.get(b) == state.search_position.get(b);
            };
            bool is_around = false;
            for (std::int32_t b = 1; b < static_cast<std::int32_t>(before.size()); ++b)
                is_around = is_around || isFar(b);
            ++(is_around ? around : whole);
            if (whole + around == 1) CHECK(whole == 1);  // blocks that touch as built meet elsewhere then
            for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
                if (isVertexEdge(state.interfaces, i) || !isFar(state.interfaces.block_a[i]) ||
                    !isFar(state.interfaces.block_b[i]))
                    continue;
                const std::size_t o = sameFaces(state.interfaces, i, old);
                REQUIRE(o < old.size());
                REQUIRE(old.frame(o).origin_a == state.interfaces.frame(i).origin_a);
                ++kept;
            }
            checkAgainstWholeSearch(state);
        }
        CHECK(around > 20);
        CHECK(whole > 0);
        CHECK(kept > 0);
        CHECK(stateHash(twin) == stateHash(state));
    }

    TEST_CASE("a falling block meets the floor; none is missed however fast") {
        for (const double speed : {0.5, 20.0}) {
            Model model = floorModel(30, 1e8);
            addBox(model, "box", {0, 0, 0.4}, {0.2, 0.2, 0.2});
            model.gravity.magnitude = 0;
            State state = *buildState(model, false);
            CHECK(state.interfaces.size() == 0);
            state.blocks.velocity.z[1] = -speed;
            const double dt = 1e-5;
            double lowest = 1;
            for (int k = 0; state.blocks.velocity.z[1] < 0 && k < 2'000'000; ++k) {
                advance(state, {dt, false});
                if (k % 10 == 0 && refreshInterfaces(state, false, 10 * dt)) checkValid(state, true);
                lowest = std::min(lowest, state.blocks.position[1].z - 0.1);
            }
            CHECK(state.interfaces.size() == 1);
            // Stopped within v sqrt(m / (k A)).
            CHECK(lowest > -1.02 * speed * std::sqrt(2700 * 0.008 / (1e8 * 0.04)));
        }
    }

    TEST_CASE(
        "faces that turn towards each other have an interface before they touch, so that none counts its gap "
        "from an overlap") {
        for (const double side : {0.2, 5.0})
            for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(1, 1, 0), Vec3(2, 1, 0.5)}) {
                CAPTURE(side);
                CAPTURE(axis.transpose());
                constexpr double kFirst = 0.0575, kLast = 0.0495;  // [rad]: faces meet as faces below 0.05
                const auto turned = [&](double angle) { return turnAbout(axis, degrees(angle)); };
                Model model = floorModel(30, 1e8);
                addTurnedCube(model, "cube", turned(kFirst), 0, 0, 2.2e-3 * side, side);
                State state = *buildState(model, false);
                state.springs = Springs::keep_energy;
                const Vec3 start = state.blocks.position.get(1);
                const double lowest_first = lowestVertex(state, 1);
                REQUIRE(lowest_first == doctest::Approx(2.2e-3 * side));
                const Eigen::Quaterniond first(state.blocks.orientation.matrix(1));
                constexpr int kTurning = 80, kLooks = 140;
                const double step = 2e-5 * side;
                for (int k = 1; k <= kLooks; ++k) {
                    const double share = std::min(1.0, static_cast<double>(k) / kTurning);
                    const Eigen::Quaterniond q =
                        turned(kFirst + share * (kLast - kFirst)) * turned(kFirst).conjugate() * first;
                    state.blocks.orientation[1] = {q.w(), q.x(), q.y(), q.z()};
                    state.blocks.position.set(1, start);
                    const double height = 2.2e-3 * side - step * k;
                    state.blocks.position[1].z += height - lowestVertex(state, 1);
                    refreshInterfaces(state, false, 0.0, nullptr,
                                      {0.0, step + (share < 1 ? (kFirst - kLast) / kTurning * side : 0.0)});
                    for (std::size_t i = 0; i < state.interfaces.size(); ++i)
                        if (!isIdle(state.interfaces, i)) CHECK(state.interfaces.referenceGap(i, 0) == 0.0);
                }
                updateForces(state, false);
                CHECK(outOfBalance(state, 1, Vec3::Zero()).force.z() > 0);
            }
    }

    TEST_CASE("blocks whose faces meet by a sliver do not sink into each other") {
        Model model = floorModel(30, 1e8);
        model.gravity.magnitude = 0;
        addBox(model, "below", {0, 0, 5}, {1, 1, 1});
        addBox(model, "above", {0.99, 0, 6.001}, {1, 1, 1});
        model.blocks[1].motion = Motion::fixed;
        State state = *buildState(model, false);
        state.blocks.velocity.z[2] = -0.1;
        const double dt = 1e-5;
        double deepest = 0;
        for (int k = 0; k < 5000; ++k) {
            advance(state, {dt, false});
            if (k % 10 != 0) continue;
            if (refreshInterfaces(state, false, 10 * dt))
                checkValid(state, true);
            else
                checkValid(state);
            deepest = std::max(deepest, -separation(placedShape(state, 1), placedShape(state, 2)));
        }
        // On four vertices' areas v sqrt(m / k) = 6.4e-4 m, with a quarter of the mass, for it turns away;
        // and what it sinks until they take over. The sliver's hundredth of a face alone takes 3.1e-3 m.
        CHECK(deepest > 6e-4);
        CHECK(deepest < 1.5e-3);
    }

    TEST_CASE("blocks that are taken out touch nothing any more, and contacts of others stay to the bit") {
        const State before = pressedStack();
        for (const std::vector<std::size_t>& out :
             {std::vector<std::size_t>{1}, {5}, {3, 4, 24}, {1, 2, 3, 4, 5, 6}}) {
            CAPTURE(out.size());
            State after = before;
            takeOut(after, out, false);
            checkValid(after, true);
            const auto isOut = [&](std::int32_t block) {
                return std::count(out.begin(), out.end(), static_cast<std::size_t>(block)) > 0;
            };
            std::size_t left = 0;
            double pressed = 0;
            for (std::size_t o = 0; o < before.interfaces.size(); ++o)
                left += isOut(before.interfaces.block_a[o]) || isOut(before.interfaces.block_b[o]) ? 0 : 1;
            CHECK(after.interfaces.size() == left);
            for (std::size_t i = 0; i < after.interfaces.size(); ++i) {
                const std::size_t o = sameFaces(after.interfaces, i, before.interfaces);
                REQUIRE(o < before.interfaces.size());
                CHECK(after.interfaces.wrench(i).force == before.interfaces.wrench(o).force);
                pressed += after.interfaces.wrench(i).force.norm();
            }
            CHECK(pressed > 0);
            for (const std::size_t b : out) CHECK(after.blocks.isRemoved(b));
            State anew = after;  // nor do later searches find them
            REQUIRE(findInterfaces(anew, false, false).empty());
            for (std::size_t i = 0; i < anew.interfaces.size(); ++i)
                CHECK_FALSE((isOut(anew.interfaces.block_a[i]) || isOut(anew.interfaces.block_b[i])));
        }
    }
}
