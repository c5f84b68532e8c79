// A run that goes on from a full frame ends in the bits of a run that was never interrupted.

#include <doctest/doctest.h>

#include "build/build.h"
#include "frame/frame.h"
#include "support/models.h"
#include "support/snapshots.h"

using namespace talus;
using namespace talus::test;

namespace {

Model scenarioModel(const std::string& text) { return formats::parseScenario(text, "test.toml")->model; }

/// Light frames of `resumed` are those of `whole` after the one it went on from, bit for bit.
bool sameFrames(const Recorded& resumed, const Recorded& whole, std::int64_t after) {
    std::size_t k = 0;
    for (const LightFrame& frame : whole.lights) {
        if (frame.step <= after) continue;
        if (k >= resumed.lights.size()) return false;
        const LightFrame& other = resumed.lights[k++];
        if (other.step != frame.step || other.time != frame.time || other.state_hash != frame.state_hash ||
            other.displacement.x != frame.displacement.x || other.kinetic_energy != frame.kinetic_energy)
            return false;
    }
    return k == resumed.lights.size();
}

void checkRestarts(const Model& model, int frames_per_full) {
    const Recorded whole = record(model, frames_per_full);
    REQUIRE(whole.result.ok());
    REQUIRE(whole.fulls.size() >= 3);
    for (const FullFrame& from : whole.fulls)
        for (const int threads : {1, 3}) {
            CAPTURE(from.step);
            CAPTURE(threads);
            const Recorded resumed = record(model, frames_per_full, &from, {.threads = threads});
            REQUIRE(resumed.result.ok());
            CHECK(resumed.result->state_hash == whole.result->state_hash);
            CHECK(resumed.result->steps == whole.result->steps);
            CHECK(resumed.result->warnings == whole.result->warnings);
            CHECK(sameFrames(resumed, whole, from.step));
        }
}

}  // namespace

TEST_SUITE("determinism") {
    TEST_CASE("restart: sliding, breaking bonds, dilation, water that rises and drains, uplift, damping") {
        checkRestarts(scenarioModel(runScenarioText()), 8);
    }

    TEST_CASE("restart: a closed volume of water that falls, is filled and runs over") {
        const Model model = scenarioModel(
            "[gravity]\ntilt_deg = 14.0\n[run]\nduration_s = 0.04\nframe_interval_s = 0.001\n"
            "[damping]\ncontact = 1e-5\n[material.rock]\ndensity = 2700.0\n"
            "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nfriction_deg = 15.0\n"
            "[[stack]]\ncolumns = 2\nrows = 3\nslices = 2\nblock = [0.2, 0.1, 0.1]\n"
            "[[water]]\nfissure = 1\ndepth = 0.25\nvolume = \"closed\"\nopening = 0.001\n"
            "inflow = [[0.0, 0.0], [0.01, 0.0], [0.02, 0.05]]\noverflow = 0.25\n");
        const Recorded whole = record(model, 8);
        REQUIRE(whole.result.ok());
        REQUIRE(whole.result->waters.size() == 1);
        CHECK(whole.result->waters[0].run_over > 0);
        const auto& lights = whole.lights;
        CHECK(lights[8].water.level[0] < 0.9999 * lights[0].water.level[0]);
        checkRestarts(model, 8);
    }

    TEST_CASE("restart: a crack that rain fills, that leaks and runs over") {
        const Model model = scenarioModel(
            "[gravity]\ntilt_deg = 14.0\n[run]\nduration_s = 0.02\nframe_interval_s = 0.001\n"
            "[damping]\ncontact = 1e-5\n[material.rock]\ndensity = 2700.0\n"
            "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nfriction_deg = 15.0\n"
            "[[stack]]\ncolumns = 2\nrows = 3\nslices = 2\nblock = [0.2, 0.1, 0.1]\n"
            "[[water]]\nfissure = 1\ndepth = 0.2\nvolume = \"closed\"\nopening = 0.001\n"
            "rain = [[0.0, 0.0], [0.005, 1000.0], [0.02, 2500.0]]\ncatchment = 90.0\noverflow = 0.21\n"
            "leak_aperture = 1e-3\nleak_length = 0.5\n");
        const Recorded whole = record(model, 8);
        REQUIRE(whole.result.ok());
        CHECK(whole.result->waters[0].run_over > 0);
        CHECK(whole.result->waters[0].leaked > 0);
        checkRestarts(model, 8);
    }

    TEST_CASE("restart: steady flow in the joints of a slope that slides") {
        checkRestarts(
            scenarioModel("[gravity]\ntilt_deg = 25.0\n[run]\nduration_s = 0.04\nframe_interval_s = 0.001\n"
                          "[damping]\ncontact = 1e-5\n[material.rock]\ndensity = 2700.0\n"
                          "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\n"
                          "friction_deg = 15.0\n[flow]\naperture = 1e-4\n"
                          "[[flow.boundary]]\nface = \"+x\"\nhead = 0.4\n"
                          "[[flow.boundary]]\nface = \"-x\"\noutlet = true\n"
                          "[[stack]]\ncolumns = 3\nrows = 3\nslices = 2\nblock = [0.2, 0.1, 0.1]\n"),
            8);
    }

    TEST_CASE("restart: flow that follows the joints to the start of a history") {
        const Model model = scenarioModel(
            "[gravity]\ntilt_deg = 10.0\n[run]\nduration_s = 0.03\nframe_interval_s = 0.001\n"
            "[damping]\ncontact = 1e-5\n[material.rock]\ndensity = 2700.0\n"
            "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\n"
            "friction_deg = 30.0\n[flow]\naperture = 1e-4\ncoupled = true\n"
            "[[flow.boundary]]\nface = \"+x\"\nhead = 0.3\n"
            "[[flow.boundary]]\nface = \"-x\"\noutlet = true\n"
            "[[load]]\nblock = \"c3r3s1\"\nforce = [-500.0, 0.0, 0.0]\n"
            "factor = [[0.0, 0.0], [0.01, 1.0]]\n"
            "[[stack]]\ncolumns = 3\nrows = 3\nslices = 2\nblock = [0.2, 0.1, 0.1]\n");
        const Recorded whole = record(model, 8);
        REQUIRE(whole.result.ok());
        const bool begins_at_rest = whole.result->start == InitialState::equilibrium;
        CHECK(begins_at_rest);
        checkRestarts(model, 8);
    }

    TEST_CASE("restart: cubes that tumble onto each other by their edges and corners") {
        Model model = floorModel(30, 1e8);
        for (int k = 0; k < 6; ++k)
            addTurnedCube(model, "cube" + std::to_string(k), turnAbout({1, 2.0 * k, 3}, 20 + 35 * k),
                          0.11 * (k % 2), 0.07 * (k % 3), 0.01 + 0.3 * k);
        model.damping.contact = 1e-4;
        model.run.duration = 0.5;
        model.run.frame_interval = 0.01;
        checkRestarts(model, 12);
    }

    TEST_CASE("restart: joints that lose and regain strength with time, bonded and curved ones") {
        const Model model = scenarioModel(
            "[gravity]\ntilt_deg = 32.0\n[run]\nduration_s = 0.04\nframe_interval_s = 0.001\n"
            "[damping]\ncontact = 1e-5\n[material.rock]\ndensity = 2700.0\n"
            "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nfriction_deg = 40.0\n"
            "cohesion = 2e3\ntensile_strength = 1e3\nresidual_friction_deg = 25.0\n"
            "strength_over_time = [[0.0, 1.2], [0.02, 0.2], [0.03, 0.2], [0.04, 0.7]]\n"
            "[joint.power]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nlaw = \"power\"\na = 1.1\nb = "
            "0.9\nstrength_over_time = [[0.01, 1.0], [0.02, 0.3]]\n"
            "[[stack]]\ncolumns = 3\nrows = 3\nslices = 2\nblock = [0.2, 0.1, 0.1]\nbed_joint = \"power\"\n");
        checkRestarts(model, 8);
    }

    TEST_CASE("restart: joints of every law, their strength reduced") {
        Model model = scenarioModel(
            "[gravity]\ntilt_deg = 32.0\n[run]\nduration_s = 0.04\nframe_interval_s = 0.001\n"
            "[damping]\ncontact = 1e-5\n[material.rock]\ndensity = 2700.0\n"
            "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nlaw = \"barton-bandis\"\n"
            "jrc = 8.0\njcs = 1e5\nresidual_friction_deg = 15.0\nstrength_factor = 0.8\n"
            "[joint.table]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nlaw = \"envelope\"\n"
            "shear_strength = [[0.0, 0.0], [2e3, 1e3], [1e4, 3e3]]\n"
            "[joint.power]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nlaw = \"power\"\na = 1.1\nb = "
            "0.9\n"
            "dilation_deg = 3.0\n"
            "[[stack]]\ncolumns = 3\nrows = 3\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
            "joint = \"power\"\nside_joint = \"power\"\n"
            "[[interface]]\nbetween = [\"c2r1s1\", \"floor\"]\njoint = \"table\"\n");
        for (Joint& joint : model.joints) joint = reduced(std::move(joint), 1.3);
        model.run.start = RunSettings::Start::unstressed;
        checkRestarts(model, 8);
    }

    TEST_CASE("restart: bolts that yield, slip, shear and break in a shaken slope with a water table") {
        Model model = scenarioModel(
            "[gravity]\ntilt_deg = 25.0\n[run]\nduration_s = 0.06\nframe_interval_s = 0.001\n"
            "[damping]\ncontact = 1e-5\n[material.rock]\ndensity = 2700.0\n"
            "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nfriction_deg = 10.0\n"
            "[[stack]]\ncolumns = 3\nrows = 3\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
            "[[bolt]]\nkind = \"grouted\"\nhead = [0.02, 0.05, 0.28]\nend = [0.18, 0.05, -0.1]\narea = 1e-6\n"
            "modulus = 2e11\nyield_force = 8.0\nbond_stiffness = 1e7\nbond_strength = 60.0\n"
            "shear_stiffness = 1e5\n"
            "[[bolt]]\nkind = \"anchored\"\nhead = [0.42, 0.05, 0.28]\nend = [0.58, 0.05, -0.1]\narea = "
            "1e-6\n"
            "modulus = 2e11\nyield_force = 30.0\npretension = 10.0\nrupture_strain = 0.0001\n"
            "[[water]]\nsurface = [[-1.0, 0.0], [0.3, 0.12], [2.0, 0.25]]\ndrains_at_aperture = 0.0001\n");
        model.ground_motion = {{0.0, 0.01, 0.02, 0.02, 0.045},
                               {{0, 0, 0}, {9, 2, 0}, {-5, 0, 3}, {6, 0, 0}, {0, 0, 0}}};
        const Recorded whole = record(model, 8);
        REQUIRE(whole.result.ok());
        const std::vector<SupportReport>& bolts = whole.result->supports.at(0).reports;
        for (const SupportSign& sign : bolts[0].signs) CHECK_MESSAGE(sign.is, sign.text);
        CHECK(bolts[1].broken);
        const ForceArray& drained = whole.fulls.back().memory.at(0);
        CHECK(drained.name == "phreatic.drained");
        CHECK(std::count(drained.values.begin(), drained.values.end(), 1) > 0);
        checkRestarts(model, 8);

        // What forces remember comes from files: nothing of it may be missing, too much, out of order or no
        // number.
        const FullFrame good = whole.fulls.back();
        const auto isRefused = [&](const auto& damage) {
            FullFrame bad = good;
            damage(bad.memory);
            State state = *buildState(model, false);
            const auto errors = restoreFrame(bad, state);
            return errors.size() == 1 && errors[0].field == "full.memory";
        };
        using Memory = std::vector<ForceArray>;
        CHECK(isRefused([](Memory& memory) { memory.clear(); }));
        for (std::size_t k = 0; k < good.memory.size(); ++k) {
            CAPTURE(good.memory[k].name);
            CHECK(isRefused([&](Memory& memory) { memory.erase(memory.begin() + static_cast<long>(k)); }));
            CHECK(isRefused([&](Memory& memory) { memory.push_back(memory[k]); }));
            CHECK(isRefused([&](Memory& memory) { memory[k].name += "?"; }));
            CHECK(isRefused([&](Memory& memory) { memory[k].values.push_back(0); }));
            CHECK(isRefused([&](Memory& memory) { memory[k].values.pop_back(); }));
            CHECK(isRefused([&](Memory& memory) { memory[k].values[0] = kInfinity; }));
        }
    }

    TEST_CASE(
        "restart: a water table, heads of a joint and of two blocks in one slope that runs dry as it opens") {
        Model model = scenarioModel(
            "[run]\nduration_s = 0.4\nframe_interval_s = 0.01\nstart = \"unstressed\"\n[damping]\ncontact = "
            "1e-5\n"
            "[material.rock]\ndensity = 2650.0\n"
            "[joint.default]\nnormal_stiffness = 1e8\nshear_stiffness = 1e8\nfriction_deg = 20.0\n"
            "[rock_mass]\nregion = { profile = [[0, -3], [20, -3], [20, 12], [6.9, 12], [0, 0]], y = [0, 2] "
            "}\n"
            "names = { upper = [9.0, 1.0, 11.0], base = [15.0, 1.0, -1.0] }\nfixed = [{ name = \"base\" }]\n"
            "[[single_joint]]\nname = \"plane\"\npoint = [0.0, 0.0, 0.0]\ndip_deg = 35\ndip_direction_deg = "
            "270\n"
            "[[joint_set]]\nname = \"cross\"\ndip_deg = 80\ndip_direction_deg = 90\nspacing = 4.0\n"
            "[[water]]\nsurface = [[0.0, 0.5], [10.0, 6.0], [20.0, 8.0]]\n"
            "[[water]]\njoint = \"cross\"\nplane = 2\nhead = [0.5, 1.5]\n");
        const Recorded whole = record(model, 5);
        REQUIRE(whole.result.ok());
        const ForceArray& drained = whole.fulls.back().memory.at(0);
        CHECK(std::count(drained.values.begin(), drained.values.end(), 1) > 0);
        CHECK(std::count(drained.values.begin(), drained.values.end(), 0) > 0);
        checkRestarts(model, 5);
    }

    TEST_CASE("restart: blocks that fly, hit and turn") {
        Model model = floorModel(30, 1e7);
        addBox(model, "falling", {0, 0, 0.02}, {0.3, 0.3, 0.3});
        addBox(model, "resting", {1, 0, 0}, {0.3, 0.3, 0.3});
        addBox(model, "thrown", {0.5, 0, 0.001}, {0.2, 0.3, 0.3});
        model.blocks.back().velocity = {3, 0, 0};
        model.run.duration = 0.1;
        model.run.frame_interval = 0.002;
        checkRestarts(model, 7);
    }

    TEST_CASE("restart: an earthquake, gravity askew, loads that grow on blocks that slide and turn") {
        Model model = stackModel(3, 3, 1, 20, {0.2, 0.1, 0.1}, 1e8);
        model.gravity.direction = Vec3(-0.2, 0.05, -1);
        model.seismic = {.horizontal = 0.3, .azimuth = 4.5, .vertical = 0.1};
        model.loads = {{.kind = AppliedLoad::Kind::force,
                        .block = 3,
                        .force = {-40, 5, 10},
                        .point = Vec3(0, 0, 0.3),
                        .factor = {{0, 0}, {0.05, 1}},
                        .field = "load[0]"},
                       {.kind = AppliedLoad::Kind::box,
                        .pressure = 500,
                        .box_min = {0.1, 0, 0.25},
                        .box_max = {0.5, 1, 0.4},
                        .field = "load[1]"}};
        model.run.duration = 0.1;
        model.run.frame_interval = 0.002;
        checkRestarts(model, 9);
    }

    TEST_CASE("restart: a slope wide enough to be cut among threads") {
        Model model = stackModel(12, 10, 13, 15, {0.2, 0.1, 0.1}, 1e8);
        model.gravity.tilt = radians(24);
        model.run.start = RunSettings::Start::unstressed;
        model.run.duration = 0.005;
        REQUIRE(buildState(model, false)->interfaces.size() >= 4096);  // less runs on one thread
        model.run.frame_interval = 0.0005;
        checkRestarts(model, 4);
    }

    TEST_CASE("restart: interrupted at any time, the run continues from its last frame") {
        const Model model = scenarioModel(runScenarioText());
        const std::uint64_t whole = record(model).result->state_hash;
        for (const std::size_t stop_after : {1, 2, 13, 30}) {
            std::atomic<bool> stop = false;
            Control control;
            control.stop = &stop;
            std::size_t lights = 0;
            FullFrame last;
            RunOutput output;
            output.light = [&](LightFrame&&) { stop = ++lights >= stop_after; };
            output.full = [&](FullFrame&& frame) { last = std::move(frame); };
            REQUIRE(run(model, control, output)->interrupted);
            CHECK(record(model, 10, &last).result->state_hash == whole);
        }
    }
}
