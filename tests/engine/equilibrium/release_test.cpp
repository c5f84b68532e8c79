#include "equilibrium/release.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "checks/loose_blocks.h"
#include "law/joint_laws.h"
#include "measure/measure.h"
#include "step/step.h"
#include "support/paths.h"
#include "support/slower.h"
#include "support/structures.h"
#include "support/verification.h"

using namespace talus;
using namespace talus::test;
using namespace talus::equilibrium;

namespace {

Model slab(double friction_deg) {
    Model model = floorModel(friction_deg, 1e10);
    addBox(model, "slab", {0, 0, 0}, {1, 1, 0.3});
    return model;
}

Released releasedAt(EquilibriumPath& path, double tilt, double leaves = 3e-3) {
    return release(path, tilt, path.parting(), leaves);
}

/// Under its weight alone, from as built.
Released underWeight(const Model& model, bool from_held_joints = false) {
    const search::LoadAxis weight = search::weightAxis(1e-4);
    EquilibriumPath path(unloaded(model), {}, false, nullptr);
    path.vary(weight.loading, 0);
    const Parting since = path.parting();
    return from_held_joints ? releaseFromHeldJoints(path, 1, since, 0.1) : release(path, 1, since, 0.1);
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("a block released below its friction angle reaches equilibrium, above it leaves") {
        for (const double friction : {10.0, 20.0, 35.0})
            for (const double beyond : {-1.0, -0.01, 0.01, 1.0, 20.0}) {
                CAPTURE(friction);
                CAPTURE(beyond);
                LoadedPath loaded(slab(friction));
                const Parting since = loaded.path.parting();
                const Released released = releasedAt(loaded.path, radians(friction + beyond));
                CHECK((released == (beyond < 0 ? Released::rests : Released::left)));
                if (beyond < 0) {
                    CHECK(loaded.path.load() == radians(friction + beyond));
                    CHECK(loaded.path.isBalanced());
                    CHECK(loaded.path.partedSince(since) < 1e-4);
                } else {
                    CHECK(loaded.path.partedSince(since) > 3e-3);
                }
            }
    }

    TEST_CASE("equilibrium is that of the engine's own forces") {
        LoadedPath loaded(stackModel(3, 4, 1, 30));
        REQUIRE((releasedAt(loaded.path, radians(10)) == Released::rests));
        State state = loaded.path.state();
        updateForces(state, false);
        CHECK(outOfBalanceRatio(state) < 1e-5);
        CHECK(outOfBalanceRatio(state) == doctest::Approx(loaded.path.outOfBalance()).epsilon(1e-9));
    }

    TEST_CASE(
        "a slab that slides against a stop reaches equilibrium there, within the allowed displacement") {
        constexpr double kGap = 2e-3, kSize = 0.3;
        Model model = slab(20);
        model.blocks.push_back(box("stop", {-0.3, 0, 0}, {-kGap, 1, 0.3}, 2700, Motion::fixed));
        for (const bool may : {false, true}) {
            CAPTURE(may);
            LoadedPath loaded(model);
            const Parting since = loaded.path.parting();
            const double leaves = (may ? 2.0 : 0.5) * kGap / kSize;
            const Released released = releasedAt(loaded.path, radians(25), leaves);
            CHECK((released == (may ? Released::rests : Released::left)));
            if (may) CHECK(kSize * loaded.path.partedSince(since) == doctest::Approx(kGap).epsilon(0.01));
        }
    }

    TEST_CASE("a release that is given up is lost, and goes no farther") {
        LoadedPath loaded(slab(20));
        const Parting since = loaded.path.parting();
        constexpr double kFar = 0.01;
        const auto is_far = [&] { return loaded.path.partedSince(since) > kFar; };
        CHECK((release(loaded.path, radians(25), since, 1.0, is_far) == Released::lost));
        CHECK(loaded.path.partedSince(since) > kFar);
        CHECK(loaded.path.partedSince(since) < 2 * kFar);
    }

    TEST_CASE("equal columns jam in exact geometry; they overturn where each of them does") {
        for (const int columns : {2, 3, 5}) {
            CAPTURE(columns);
            const Vec3 size(0.3, 0.1, 0.8);
            const double exact = std::atan(size.x() / size.z());
            LoadedPath loaded(stackModel(columns, 1, 1, 40, size));
            CHECK((releasedAt(loaded.path, 0.99 * exact) == Released::rests));
            CHECK((releasedAt(loaded.path, 1.01 * exact) == Released::left));
        }
    }

    TEST_CASE("a semicircular arch of 27 voussoirs is stable at a thickness of 1.2 m, and not at 0.9 m") {
        CHECK((underWeight(archModel(27, 10, 1.2, 35, 1e11)) == Released::rests));
        CHECK((underWeight(archModel(27, 10, 0.9, 35, 1e11)) != Released::rests));
        CHECK((underWeight(archModel(27, 10, 1.2, 35, 1e11), true) == Released::rests));
    }

    TEST_CASE("a row that few blocks leave because nothing holds them has left") {
        Model model = kTriesFew ? stackModel(4, 4, 4, 30) : stackModel(6, 5, 5, 30);
        for (Vec3& vertex : model.blocks.back().shape.vertices) vertex.x() += 0.11;  // by more than its half
        CHECK((underWeight(model) == Released::left));
    }
}

TEST_SUITE("slow: equilibrium") {
    TEST_CASE("rock masses of many blocks reach equilibrium under their weight on joints that hold well") {
        for (const std::string name : {"rock-slope-842", "random-slope-513"}) {
            if (kTriesFew && name == "rock-slope-842") continue;
            CAPTURE(name);
            Model model = verification(name);
            for (Joint& joint : model.joints) joint = reduced(joint, 0.1);
            CHECK((underWeight(model) == Released::rests));
        }
    }
}
