// [flow] as scenarios say it, and what is refused.

#include <doctest/doctest.h>

#include <string>

#include "faults.h"
#include "talus/formats/overrides.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::formats;

namespace {

const std::string kBlocks =
    "[material.rock]\ndensity = 2700.0\n"
    "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 30.0\n"
    "[joint.bedding]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 25.0\n"
    "[[stack]]\ncolumns = 3\nrows = 2\nslices = 1\nblock = [1.0, 1.0, 1.0]\nbed_friction_deg = [20.0, 22.0]\n"
    "bed_joint = \"bedding\"\n";
const std::string kHeads =
    "[[flow.boundary]]\nface = \"-x\"\nhead = 2.0\n[[flow.boundary]]\nname = \"toe\"\nface = \"+x\"\noutlet "
    "= "
    "true\n";

std::string flow(const std::string& keys, const std::string& tables = kHeads) {
    return "[flow]\n" + keys + tables;
}

std::string refused(const std::string& section) { return refusalOf(kBlocks + section); }

void checkStart(const std::string& text, const std::string& with) {
    CAPTURE(text);
    CHECK(text.starts_with(with));
}

}  // namespace

TEST_CASE("flow: what a scenario says of it") {
    const auto scenario =
        parseScenario(kBlocks + flow("aperture = 1e-4\nviscosity = 1e-3\ndensity = 1020\nfree_surface = "
                                     "false\nrefinements = 2\n[flow.joint.bedding]\naperture = 2e-4\n",
                                     kHeads + "[[flow.boundary]]\njoint = \"bedding\"\nbox = { min = [0, 0, "
                                              "0], max = [1, 1, 1] }\nhead = 1.5\n"),
                      "slope.toml");
    REQUIRE(scenario.ok());
    REQUIRE(scenario->model.flow);
    const Flow& read = *scenario->model.flow;
    CHECK(read.aperture == 1e-4);
    CHECK(read.viscosity == 1e-3);
    CHECK(read.density == 1020);
    CHECK_FALSE(read.free_surface);
    CHECK(read.refinements == 2);
    CHECK_FALSE(read.refines);
    REQUIRE(read.boundaries.size() == 3);
    CHECK(read.boundaries[0].kind == FlowBoundary::Kind::head);
    CHECK(read.boundaries[0].head == 2);
    CHECK(*read.boundaries[0].face == -Vec3::UnitX());
    CHECK(read.boundaries[0].name == "boundary1");
    CHECK(read.boundaries[1].kind == FlowBoundary::Kind::outlet);
    CHECK(read.boundaries[1].name == "toe");
    CHECK_FALSE(read.boundaries[2].face);
    CHECK(read.boundaries[2].box_max == Vec3(1, 1, 1));
}

TEST_CASE("flow: what is said of a joint holds for those made from it") {
    const auto scenario = parseScenario(
        kBlocks + flow("aperture = 1e-4\n[flow.joint.bedding]\naperture = 2e-4\n"), "slope.toml");
    REQUIRE(scenario.ok());
    std::size_t count = 0;
    for (const auto& [joint, aperture] : scenario->model.flow->joint_apertures) {
        CHECK(scenario->model.joints[static_cast<std::size_t>(joint)].name.starts_with("bedding"));
        CHECK(aperture == 2e-4);
        ++count;
    }
    CHECK(count == scenario->model.joints.size() - 1);
    CHECK(count > 1);
}

TEST_CASE("flow: defaults are water at 10 degrees with a free surface") {
    const auto scenario = parseScenario(kBlocks + flow("aperture = 1e-4\n"), "slope.toml");
    REQUIRE(scenario.ok());
    CHECK(scenario->model.flow->viscosity == 1.307e-3);
    CHECK(scenario->model.flow->density == 1000);
    CHECK(scenario->model.flow->free_surface);
    CHECK(scenario->warnings.empty());
}

TEST_CASE("flow: what is refused, with its place") {
    checkStart(refused(flow("")), "flow.aperture: missing");
    checkStart(refused(flow("aperture = 0\n")), "flow.aperture: found 0");
    checkStart(refused(flow("aperture = -1e-4\n")), "flow.aperture: found -0.0001");
    checkStart(refused(flow("aperture = 1e-4\n", "")),
               "flow.boundary: found no [[flow.boundary]] with a head");
    checkStart(refused(flow("aperture = 1e-4\n[flow.joint.cleats]\naperture = 1e-4\n")),
               "flow.joint.cleats: found the unknown joint \"cleats\"");
    checkStart(refused(flow("aperture = 1e-4\n[flow.joint.bedding]\naperture = 0\n")),
               "flow.joint.bedding.aperture: found 0");
    checkStart(
        refused(flow("aperture = 1e-4\n", kHeads + "[[flow.boundary]]\njoint = \"cleats\"\nhead = 1\n")),
        "flow.boundary[2].joint: found the unknown joint \"cleats\"");
    checkStart(refused(flow("aperture = 1e-4\n", kHeads + "[[flow.boundary]]\nhead = 1\n")),
               "flow.boundary[2].face: missing");
    checkStart(refused(flow("aperture = 1e-4\n", kHeads + "[[flow.boundary]]\nface = \"+z\"\n")),
               "flow.boundary[2]");
    checkStart(refused(flow("aperture = 1e-4\n",
                            kHeads + "[[flow.boundary]]\nface = \"+z\"\nhead = 1\noutlet = true\n")),
               "flow.boundary[2]");
    checkStart(refused(flow("aperture = 1e-4\nrefinements = 9\n")), "flow.refinements: found 9");
}

TEST_CASE("flow: an aperture in millimetres is warned of, and a sweep can vary its numbers") {
    const auto scenario = parseScenario(kBlocks + flow("aperture = 0.05\n"), "slope.toml");
    REQUIRE(scenario.ok());
    CHECK(scenario->warnings.size() == 1);
    CHECK(canOverride(*scenario, "flow.aperture"));
    CHECK(canOverride(*scenario, "flow.viscosity"));
}

TEST_CASE("flow: finite joints are refused whose cuts go on through intact rock, bridged or not") {
    const auto slopeWith = [](const std::string& bridge, const std::string& extent) {
        return "[material.rock]\ndensity = 2700.0\n"
               "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 30.0\n"
               "[joint.intact]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 50.0\n"
               "cohesion = 1e7\ntensile_strength = 3e6\n"
               "[rock_mass]\nregion = { y = [0, 1], profile = [[0, 0], [10, 0], [10, 6], [0, 6]] }\n"
               "fixed = [{ boundary = \"-z\" }]\n" +
               bridge +
               "[[single_joint]]\nname = \"finite\"\njoint = \"default\"\npoint = [5, 0.5, 3]\n"
               "dip_deg = 0\ndip_direction_deg = 270\n" +
               extent + flow("aperture = 1e-4\n");
    };
    const std::string bridged = "bridge = \"intact\"\n";
    for (const std::string& bridge : {std::string(), bridged}) {
        const auto scenario = parseScenario(slopeWith(bridge, "radius = 2.0\n"), "slope.toml");
        REQUIRE_FALSE(scenario.ok());
        const Error& error = scenario.errors().front();
        CHECK(error.field == "flow");
        CHECK(error.line > 0);
        checkStart(error.message, "found finite joints whose cuts go on through intact rock");
        CHECK(parseScenario(slopeWith(bridge, "radius = 20.0\n"), "slope.toml").ok());
        CHECK(parseScenario(slopeWith(bridge, ""), "slope.toml").ok());
    }
}

TEST_CASE("flow: faces of boundaries turn with the profile, as those of fixed blocks do; boxes do not") {
    const auto boundaryOf = [](const std::string& azimuth) {
        const auto scenario = parseScenario(
            "[material.rock]\ndensity = 2700.0\n"
            "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 30.0\n"
            "[rock_mass]\nregion = { " +
                azimuth +
                "y = [0, 1], profile = [[0, 0], [10, 0], [10, 6], [4, 6]] }\n"
                "fixed = [{ boundary = \"-z\" }]\n"
                "[[joint_set]]\ndip_deg = 20\ndip_direction_deg = 180\nspacing = 1.0\n" +
                flow("aperture = 1e-4\n",
                     "[[flow.boundary]]\nface = \"-x\"\nhead = 4.0\n"
                     "box = { min = [0, 1, 2], max = [3, 4, 5] }\n"),
            "slope.toml");
        REQUIRE(scenario.ok());
        return scenario->model.flow->boundaries[0];
    };
    // A profile whose low side is at -x looks west until it is turned.
    CHECK((*boundaryOf("").face + Vec3::UnitX()).norm() == 0);
    CHECK((*boundaryOf("slope_azimuth_deg = 270, ").face + Vec3::UnitX()).norm() < 1e-12);
    CHECK((*boundaryOf("slope_azimuth_deg = 180, ").face + Vec3::UnitY()).norm() < 1e-12);
    CHECK(boundaryOf("slope_azimuth_deg = 180, ").box_min == Vec3(0, 1, 2));
}

TEST_CASE("flow: whether it is coupled, and how well") {
    const auto plain = parseScenario(kBlocks + flow("aperture = 1e-4\n"), "slope.toml");
    REQUIRE(plain.ok());
    CHECK_FALSE(plain->model.flow->coupled);
    const auto scenario =
        parseScenario(kBlocks + flow("aperture = 1e-4\ncoupled = true\nresidual_aperture_share = 0.2\n"
                                     "coupling_tolerance = 1e-4\ncoupling_passes = 5\n"),
                      "slope.toml");
    REQUIRE(scenario.ok());
    const Flow& read = *scenario->model.flow;
    CHECK(read.coupled);
    CHECK(read.refines);
    const auto given =
        parseScenario(kBlocks + flow("aperture = 1e-4\ncoupled = true\nrefinements = 0\n"), "slope.toml");
    REQUIRE(given.ok());
    CHECK_FALSE(given->model.flow->refines);
    CHECK(read.residual_share == 0.2);
    CHECK(read.coupling_tolerance == 1e-4);
    CHECK(read.coupling_passes == 5);
}

TEST_CASE("flow: what coupling cannot be") {
    const auto with = [](const std::string& keys) { return refused(flow("aperture = 1e-4\n" + keys)); };
    checkStart(with("coupled = 1\n"), "flow.coupled: ");
    checkStart(with("coupled = true\ncoupling_tolerance = 0.0\n"), "flow.coupling_tolerance: found 0");
    checkStart(with("coupled = true\ncoupling_tolerance = -1e-3\n"), "flow.coupling_tolerance: found -0.001");
    checkStart(with("coupled = true\ncoupling_passes = 0\n"), "flow.coupling_passes: found 0");
    checkStart(with("coupled = true\ncoupling_passes = 2.5\n"), "flow.coupling_passes: found a number 2.5");
    checkStart(with("coupled = true\nresidual_aperture_share = 1.5\n"),
               "flow.residual_aperture_share: found 1.5");
    for (const char* key :
         {"coupling_tolerance = 1e-3", "coupling_passes = 3", "residual_aperture_share = 0.1"})
        CHECK(with(std::string(key) + "\n").ends_with("found without coupled = true, allowed: only with it"));
}
