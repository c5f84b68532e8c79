#include "checks/loose_blocks.h"

#include <doctest/doctest.h>

#include "build/build.h"
#include "support/models.h"

using namespace talus;
using namespace talus::test;
using namespace talus::checks;

namespace {

Model row() {
    Model model = floorModel(30);
    addBox(model, "a", {0, 0, 0}, {1, 1, 1});
    addBox(model, "b", {2, 0, 0}, {1, 1, 1});
    addBox(model, "grain", {4, 0, 0}, {0.05, 0.05, 0.05});
    addBox(model, "hangs", {6, 0, 2}, {0.1, 0.1, 0.1});
    return model;
}

}  // namespace

TEST_SUITE("checks") {
    TEST_CASE("blocks are found by their names, and those that touch nothing are") {
        const Model model = row();
        const State state = *buildState(model, false);
        CHECK(numbersOf(model, {"grain", "a"}) == std::vector<std::size_t>{1, 3});
        CHECK(blocksNamed(model, {"b"}) == std::vector<char>{0, 0, 1, 0, 0});
        CHECK(touchesSomething(state, 1));
        CHECK_FALSE(touchesSomething(state, 4));
    }

    TEST_CASE("masses of free blocks: the ground has no share") {
        const Model model = row();
        const State state = *buildState(model, false);
        const double grain = 2700 * 0.05 * 0.05 * 0.05, hangs = 2.7;
        CHECK(freeMass(state) == doctest::Approx(5400 + grain + hangs));
        CHECK(massOf(state, {1, 3}) == doctest::Approx(2700 + grain));
        CHECK(looseShare(model, blocksNamed(model, {"a", "floor"})) ==
              doctest::Approx(2700 / (5400 + grain + hangs)));
        CHECK(areSplinters(state, {3}));
        CHECK_FALSE(areSplinters(state, {1}));
    }

    TEST_CASE("a block is removed with the joints and waters that belong to it alone") {
        Model model = row();
        model.joints.push_back(joint(20));
        model.pair_joints = {{0, 1, 1}, {0, 2, 1}};
        model.waters = {waterOn(model, 2, Vec3::UnitX(), 0.5)};
        const Model without = withoutBlocks(model, blocksNamed(model, {"b"}));
        CHECK(without.blocks.size() == 4);
        CHECK(without.pair_joints.size() == 1);
        CHECK(without.waters.empty());
        CHECK(without.blocks[2].name == "grain");
    }

    TEST_CASE("blocks move that come a fiftieth of the farthest one's displacement") {
        const State from = *buildState(row(), false);
        State to = from;
        to.blocks.position.set(1, to.blocks.position.get(1) + Vec3(-1e-2, 0, 0));
        to.blocks.position.set(2, to.blocks.position.get(2) + Vec3(-3e-4, 0, 0));
        to.blocks.position.set(3, to.blocks.position.get(3) + Vec3(-1e-4, 0, 0));
        CHECK(movingBlocks(from, to) == std::vector<std::size_t>{1, 2});
    }

    TEST_CASE("a bolt ties the blocks that it holds") {
        Model model = row();
        Bolt bolt;
        bolt.name = "B";
        bolt.head = {0.5, 0.5, 0.5};
        bolt.end = {0.5, 0.5, -0.5};
        bolt.area = 1e-4;
        bolt.modulus = 2e11;
        bolt.yield_force = 1e4;
        model.bolts = {bolt};
        const State state = *buildState(model, false);
        CHECK(areTied(state, {1}));
        CHECK_FALSE(areTied(state, {2, 3}));
    }
}
