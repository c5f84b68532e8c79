// Pressure of steady flow in snapshot files: of a run, and of the failure that a search keeps.

#include <doctest/doctest.h>

#include <algorithm>

#include "talus/formats/snapshot.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;

namespace {

/// A box of 2 m x 1 m on the floor, with heads at the ends of the joint below it.
std::string boxText(const std::string& more) {
    return "[run]\nduration_s = 0.002\nframe_interval_s = 0.001\n[material.rock]\ndensity = 2600.0\n"
           "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 30.0\n"
           "[[block]]\nname = \"floor\"\nfixed = true\nbox = { min = [-5, -5, -1], max = [5, 5, 0] }\n"
           "[[block]]\nname = \"box\"\nbox = { min = [0, 0, 0], max = [2, 1, 1] }\n" +
           more;
}

/// Heads of -1 m and 2 m: the joint is full, and its pressure rises from rho g (-1) to rho g 2.
const std::string kFlow =
    "[flow]\naperture = 1e-4\nfree_surface = false\n"
    "[[flow.boundary]]\nname = \"low\"\nface = \"-x\"\nhead = -1.0\n"
    "[[flow.boundary]]\nname = \"high\"\nface = \"+x\"\nhead = 2.0\n";

formats::SnapshotHeader headerIn(const std::string& file) {
    auto reader = formats::SnapshotReader::open(file);
    for (const Error& error : reader.errors()) FAIL_CHECK(error.message);
    REQUIRE(reader.ok());
    return reader->header();
}

void checkPressure(const formats::SnapshotHeader& header, double unit_weight) {
    REQUIRE(header.flow.has_value());
    const formats::SnapshotFlow& flow = *header.flow;
    REQUIRE(flow.joint.size() >= 2);
    double lowest = kInfinity, highest = -kInfinity;
    for (std::size_t n = 0; n < flow.pressure.size(); ++n) {
        CHECK(std::abs(flow.node.z[n]) < 1e-9);
        CHECK(flow.pressure[n] == doctest::Approx(unit_weight * (-1 + 1.5 * flow.node.x[n])).epsilon(1e-9));
        lowest = std::min(lowest, flow.pressure[n]), highest = std::max(highest, flow.pressure[n]);
    }
    CHECK(lowest == doctest::Approx(-unit_weight));
    CHECK(highest == doctest::Approx(2 * unit_weight));
}

}  // namespace

TEST_CASE("the file of a run has the pressure of its flow; without flow there is none") {
    const TemporaryFolder folder;
    const std::string dry = folder.write("dry.toml", boxText("")),
                      wet = folder.write("wet.toml", boxText(kFlow));
    for (const std::string& scenario : {dry, wet}) {
        const Outcome outcome = runTalus({"run", scenario, "-o", scenario + ".mcap", "--quiet"});
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
    }
    CHECK_FALSE(headerIn(dry + ".mcap").flow.has_value());
    checkPressure(headerIn(wet + ".mcap"), 1000 * 9.81);
    // A part of the run keeps it.
    const std::string page = folder / "wet.html";
    CHECK(runTalus({"replay", wet + ".mcap", "-o", page, "--every", "2", "--quiet"}).exit_code == 0);
}

TEST_CASE("a file of coupled flow has no pressure: that of the stated apertures does not act") {
    const TemporaryFolder folder;
    std::string text = boxText(kFlow);
    text.insert(text.find("aperture = "), "coupled = true\n");
    const std::string scenario = folder.write("coupled.toml", text), file = folder / "coupled.mcap";
    const Outcome outcome = runTalus({"run", scenario, "-o", file, "--quiet"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK_FALSE(headerIn(file).flow.has_value());
    CHECK(runTalus({"replay", file, "-o", folder / "coupled.html", "--quiet"}).exit_code == 0);
}

TEST_CASE("the failure that a search keeps has the pressure of its flow") {
    const TemporaryFolder folder;
    const std::string kept = folder / "kept.mcap";
    const Outcome outcome =
        runTalus({"safety-factor", folder.write("wet.toml", boxText(kFlow + "[gravity]\ntilt_deg = 5\n")),
                  "--keep-run", kept, "--keep-run-time", "0.01", "--json", "--quiet"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const formats::SnapshotHeader header = headerIn(kept);
    REQUIRE(header.flow.has_value());
    CHECK(*std::max_element(header.flow->pressure.begin(), header.flow->pressure.end()) > 1e4);
}

TEST_CASE("coupled flow: the failure that a search keeps plays, whose own history has no beginning") {
    const TemporaryFolder folder;
    std::string text = boxText(kFlow + "[gravity]\ntilt_deg = 35\n");
    text.insert(text.find("aperture = "), "coupled = true\n");
    const std::string scenario = folder.write("coupled.toml", text), kept = folder / "kept.mcap";
    const Outcome refused = runTalus({"run", scenario, "-o", folder / "run.mcap", "--quiet"});
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("flow.coupled: found no equilibrium") != std::string::npos);
    const Outcome outcome = runTalus(
        {"safety-factor", scenario, "--keep-run", kept, "--keep-run-time", "0.01", "--json", "--quiet"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json().at("kept_run").at("frames") > 1);
    CHECK(runTalus({"replay", kept, "--verify", "--quiet"}).exit_code == 0);
}

TEST_CASE("coupled flow: a failure at a tilt that has drained is found, and its kept run refused") {
    const TemporaryFolder folder;
    const std::string kept = folder / "kept.mcap";
    const std::string scenario = folder.write(
        "drained.toml", boxText("[flow]\naperture = 1e-4\ncoupled = true\n"
                                "[[flow.boundary]]\nname = \"low\"\nface = \"-x\"\noutlet = true\n"
                                "[[flow.boundary]]\nname = \"high\"\nface = \"+x\"\nhead = 0.5\n"));
    const Outcome outcome =
        runTalus({"critical-angle", scenario, "--keep-run", kept, "--no-range", "--json", "--quiet"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 2);
    const auto found = outcome.json();
    CHECK(found.at("critical_angle_deg").get<double>() == doctest::Approx(30).epsilon(1e-3));
    CHECK(found.at("kept_run").at("file").is_null());
    CHECK(found.at("kept_run").at("reason").get<std::string>().find("above its head") != std::string::npos);
}

TEST_CASE("the failing run of a search over tilt says that its flow is that of the failing tilt") {
    const TemporaryFolder folder;
    const std::string path = folder.write("wet.toml", boxText(kFlow));
    for (const char* search : {"critical-angle", "critical-acceleration"}) {
        CAPTURE(search);
        const Outcome outcome = runTalus({search, path, "--keep-run", folder / "kept.mcap", "--force",
                                          "--keep-run-time", "0.01", "--json", "--quiet"});
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        const std::string warnings = outcome.json().at("kept_run").at("warnings").dump();
        CHECK((warnings.find("failing tilt") != std::string::npos) ==
              (search == std::string("critical-angle")));
    }
}
