// talus flow: what it prints, and the files it writes.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "support/files.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;

namespace {

const std::string kSlope = TALUS_SOURCE_DIR "/bench/examples/seepage.toml";

}  // namespace

TEST_CASE("flow: a slope as JSON and as text") {
    const Outcome outcome = runTalus({"flow", kSlope, "--json"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto found = outcome.json();
    CHECK(found.at("warnings").empty());
    REQUIRE(found.at("boundaries").size() == 3);
    CHECK(found.at("boundaries")[0].at("name") == "behind");
    CHECK(found.at("boundaries")[1].at("inflow_m3_s") == 0);
    const double inflow = found.at("inflow_m3_s"), outflow = found.at("outflow_m3_s");
    CHECK(inflow > 0);
    CHECK(outflow == doctest::Approx(inflow).epsilon(1e-9));
    CHECK(found.at("imbalance_m3_s").get<double>() < 1e-12 * inflow);
    CHECK(found.at("unreached_patches") == 0);
    const auto& mesh = found.at("mesh");
    CHECK(mesh.at("refinements") == 1);
    CHECK(mesh.at("triangles") == 4 * found.at("triangles").get<int>());
    CHECK(std::abs(mesh.at("inflow_change").get<double>()) < 0.05);
    CHECK(found.at("boundaries")[0].at("mesh_change") == mesh.at("inflow_change"));
    CHECK(found.at("boundaries")[2].at("mesh_change").is_null());  // dry
    const auto& surface = found.at("free_surface");
    CHECK(surface.at("highest_m").get<double>() <= 8.5);
    CHECK(surface.at("lowest_m").get<double>() < surface.at("highest_m").get<double>());
    const Outcome text = runTalus({"flow", kSlope});
    REQUIRE(text.exit_code == 0);
    for (const char* part :
         {"behind", "face", "inflow", "with refinements = 1", "largest pressure", "free surface"})
        CHECK(text.out.find(part) != std::string::npos);
}

TEST_CASE("flow: files for ParaView, of a table, of a picture") {
    const test::TemporaryFolder folder;
    const std::string vtk = folder / "flow.vtp", csv = folder / "flow.csv", svg = folder / "flow.svg";
    const Outcome outcome =
        runTalus({"flow", kSlope, "-o", vtk, "--csv", csv, "--picture", svg, "--json", "--quiet"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const std::size_t triangles = outcome.json().at("triangles");
    const std::string table = test::contentOf(csv), drawing = test::contentOf(svg),
                      poly = test::contentOf(vtk);
    const auto rows = static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')) -
                      static_cast<std::size_t>(std::count(table.begin(), table.end(), '#'));
    CHECK(rows == triangles + 1);
    CHECK(table.find("pressure_pa") != std::string::npos);
    const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
    const std::size_t names = table.find("x_m,"), values = table.find('\n', names) + 1;
    CHECK(table.substr(names, values - 1 - names).ends_with(",aperture_m"));
    CHECK(commas(table.substr(names, values - names)) ==
          commas(table.substr(values, table.find('\n', values) - values)));
    CHECK(drawing.find("<svg") != std::string::npos);
    CHECK(poly.find("NumberOfPolys=\"" + std::to_string(triangles) + "\"") != std::string::npos);
    for (const char* name : {"head", "pressure", "discharge", "wet_share"})
        CHECK(poly.find("Name=\"" + std::string(name) + "\"") != std::string::npos);
}

TEST_CASE("flow: coupled, it is the flow of an equilibrium, and searches say how well it converged") {
    const std::string coupled = TALUS_SOURCE_DIR "/bench/examples/coupled-flow.toml";
    const Outcome outcome = runTalus({"flow", coupled, "--json"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto json = outcome.json();
    const auto& found = json.at("coupling");
    CHECK(found.at("converged") == true);
    CHECK(found.at("passes").get<int>() > 0);
    CHECK(found.at("flows").get<int>() > found.at("passes").get<int>());
    CHECK(found.at("last_change").get<double>() <= 1e-3);
    CHECK(found.at("largest_change") == 0);
    CHECK(runTalus({"flow", coupled}).out.find("apertures") != std::string::npos);
    CHECK(runTalus({"flow", kSlope, "--json"}).json().at("coupling").is_null());
    const Outcome searched = runTalus({"safety-factor", coupled, "--json", "--no-range"});
    REQUIRE(searched.exit_code == 0);
    CHECK(searched.json().at("flow_coupling").at("converged") == true);
    const Outcome text = runTalus({"safety-factor", coupled, "--no-range"});
    CHECK(text.out.find("coupled flow") != std::string::npos);
    CHECK(text.out.find("left out: it opens no joints") != std::string::npos);
}

TEST_CASE("flow: coupled, blocks that fall at the start are named") {
    const TemporaryFolder folder;
    const std::string beside =
        "\n[[block]]\nname = \"loose\"\nmaterial = \"rock\"\njoint = \"default\"\n"
        "box = { min = [1.0, 1.0, 0.4], max = [1.5, 1.5, 1.0] }\n";
    const std::string path =
        folder.write("loose.toml", contentOf(TALUS_SOURCE_DIR "/bench/examples/coupled-flow.toml") + beside);
    const Outcome outcome = runTalus({"flow", path, "--json"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json().at("fallen_at_start") == nlohmann::json{"loose"});
    CHECK(outcome.json().at("warnings").size() == 1);
    CHECK(runTalus({"flow", path}).out.find("fallen at start   1: loose\n") != std::string::npos);
}

TEST_CASE("flow: a scenario without [flow], or a file of another kind, is refused") {
    CHECK(runTalus({"flow", TALUS_SOURCE_DIR "/bench/examples/uplift.toml"}).exit_code == 2);
    CHECK(runTalus({"flow", kSlope, "--picture", "picture.png"}).exit_code == 2);
}

TEST_CASE("flow: apertures so unequal that rounding hides the flow are refused") {
    const Outcome outcome =
        runTalus({"flow", kSlope, "--set", "flow.aperture=1e-2", "--set", "flow.joint.bedding.aperture=1e-8",
                  "--set", "flow.free_surface=false"});
    CHECK(outcome.exit_code == 2);
    CAPTURE(outcome.err);
    CHECK(outcome.err.find("found no heads that balance the flow") != std::string::npos);
    CHECK(outcome.err.find("the largest is 1e+06 times the smallest") != std::string::npos);
}
