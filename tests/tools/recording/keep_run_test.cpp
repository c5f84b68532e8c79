// --keep-run of critical-angle and safety-factor: the failing run is a snapshot file like any other, and the
// search's result does not depend on it.

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;
using formats::SnapshotReader;
using nlohmann::json;

namespace {

const char* const kQuickSearch = "[analysis]\nstart_deg = 15.0\nstop_deg = 25.0\n";
constexpr double kDegree = 0.017453292519943295;

/// What a search says, without what differs from call to call.
json withoutTimes(json result) {
    result.erase("wall_seconds");
    result.erase("time_s");
    result.erase("provenance");
    result.erase("kept_run");
    return result;
}

/// A column of two blocks, twice as high as wide, that topples at atan(1/4) before it slides.
const char* const kColumn =
    "[analysis]\nstart_deg = 6.0\nstop_deg = 18.0\n[material.rock]\ndensity = 2600.0\n"
    "[joint.default]\nnormal_stiffness = 1e11\nshear_stiffness = 1e11\nfriction_deg = 40.0\n"
    "[[stack]]\ncolumns = 1\nrows = 2\nslices = 1\nblock = [0.25, 1.0, 0.5]\n";

double farthest(const LightFrame& frame) {
    double most = 0;
    for (std::size_t b = 0; b < frame.displacement.x.size(); ++b)
        most = std::max(
            most, Vec3(frame.displacement.x[b], frame.displacement.y[b], frame.displacement.z[b]).norm());
    return most;
}

}  // namespace

TEST_CASE(
    "the failing run of a sliding block: the same search, and a file for replay, inspect and --verify") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("slides.toml", blockScenario(0, 20, kQuickSearch));
    const std::string file = folder / "failing.mcap";
    const json plain = runTalus({"critical-angle", scenario, "--json", "--quiet"}).json();
    const Outcome outcome = runTalus({"critical-angle", scenario, "--keep-run", file, "--json", "--quiet"});
    REQUIRE(outcome.exit_code == 0);
    CHECK(withoutTimes(outcome.json()) == withoutTimes(plain));
    CHECK_FALSE(plain.contains("kept_run"));
    const json kept = outcome.json().at("kept_run");
    CHECK(kept.at("file") == file);
    CHECK(kept.at("slides") == json::array({"key"}));
    CHECK(kept.at("topples").empty());

    auto reader = SnapshotReader::open(file);
    REQUIRE(reader.ok());
    CHECK(reader->verify().empty());
    REQUIRE(reader->end().has_value());
    CHECK(reader->end()->ended == "finished");
    CHECK(reader->frames().size() > 50);
    CHECK(reader->frames().front().full.has_value());
    CHECK(reader->frames().back().full.has_value());
    const formats::SnapshotHeader& header = reader->header();
    REQUIRE(header.failure.has_value());
    CHECK(header.failure->analysis == "critical-angle");
    CHECK((header.failure->mode == FailureMode::sliding));
    CHECK(header.failure->roles == std::vector{FailureMode::none, FailureMode::sliding});  // floor, key
    CHECK(header.failure->load / kDegree == doctest::Approx(kept.at("tilt_deg").get<double>()));
    CHECK(header.failure->load / kDegree >= plain.at("bracket_deg")[1].get<double>() * (1 - 1e-12));
    CHECK(header.failure->load / kDegree < plain.at("bracket_deg")[1].get<double>() + 0.1);

    // At rest at first, then down the slope by its own height, which is its smallest extent.
    const LightFrame first = *reader->frame(0), last = *reader->frame(reader->frames().size() - 1);
    CHECK(first.kinetic_energy == 0);
    CHECK(first.tilt == doctest::Approx(header.failure->load).epsilon(1e-12));
    CHECK(farthest(first) < 5e-4);  // where it last stood
    CHECK(farthest(last) >= 0.5);
    CHECK(farthest(*reader->frame(reader->frames().size() - 2)) < 0.5 + farthest(first));
    CHECK(last.displacement.x[1] < 0);

    const Outcome verified = runTalus({"replay", file, "--verify", "--json", "--quiet"});
    CHECK(verified.exit_code == 0);
    CHECK(verified.json().at("equal") == true);
    CHECK(verified.json().at("frames") == reader->frames().size() - 1);  // all but the one it starts from
    CHECK(runTalus({"inspect", file, "--json"}).json().at("failure").at("mode") == "sliding");
    CHECK(runTalus({"replay", file, "-o", folder / "page.html", "--quiet"}).exit_code == 0);
    CHECK(runTalus({"export", file, "--vtk", folder / "vtk", "--quiet"}).exit_code == 0);
}

TEST_CASE(
    "a kept run goes on from any of its full states to the same bits; its scenario is the failing one") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("column.toml", kColumn);
    const std::string file = folder / "failing.mcap";
    REQUIRE(runTalus({"critical-angle", scenario, "--keep-run", file, "--quiet"}).exit_code == 0);
    auto reader = SnapshotReader::open(file);
    REQUIRE(reader.ok());
    const formats::SnapshotHeader& header = reader->header();
    CHECK((header.failure->mode == FailureMode::toppling));
    CHECK(header.failure->roles ==
          std::vector{FailureMode::none, FailureMode::toppling, FailureMode::toppling});
    const auto as_it_fails = formats::parseScenario(header.scenario_text, header.scenario_path);
    REQUIRE(as_it_fails.ok());
    const Model& model = as_it_fails->model;
    CHECK(model.gravity.tilt == doctest::Approx(header.failure->load).epsilon(1e-12));
    CHECK(model.analysis.start.value_or(0) ==
          doctest::Approx(6 * kDegree));  // the same search is found in it
    CHECK(model.damping.contact > 0);

    const LightFrame end = *reader->frame(reader->frames().size() - 1);
    for (const std::size_t from : {std::size_t{0}, reader->fulls() - 2}) {
        if (test::kTriesFew && from == 0) continue;
        const FullFrame full = *reader->full(from);
        const test::Recorded again = test::record(model, 20, &full);
        REQUIRE(again.result.ok());
        // The kept run ended when the column was down far enough; this one goes on, past a frame of that
        // instant.
        bool met = false;
        for (const LightFrame& frame : again.lights)
            met = met || (frame.step == end.step && frame.state_hash == end.state_hash);
        CHECK(met);
    }
}

TEST_CASE("safety-factor: the kept run has the reduced strengths") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("f.toml", blockScenario(10, 20));
    const std::string file = folder / "failing.mcap";
    const Outcome outcome = runTalus(
        {"safety-factor", scenario, "--keep-run", file, "--keep-run-time", "0.2", "--json", "--quiet"});
    REQUIRE(outcome.exit_code == 0);
    const double factor = outcome.json().at("kept_run").at("factor");
    CHECK(factor >= outcome.json().at("bracket")[1].get<double>());
    auto reader = SnapshotReader::open(file);
    REQUIRE(reader.ok());
    CHECK(reader->header().failure->analysis == "safety-factor");
    CHECK(reader->header().failure->load == doctest::Approx(factor));
    CHECK(std::tan(reader->header().joints[0].friction) ==
          doctest::Approx(std::tan(20 * kDegree) / factor).epsilon(1e-12));
    CHECK(reader->frames().back().time == doctest::Approx(0.2));
    CHECK(reader->frames().size() == 201);
    CHECK((*reader->frame(200)).tilt == doctest::Approx(10 * kDegree));
    CHECK(runTalus({"replay", file, "--verify", "--quiet"}).exit_code == 0);
}

TEST_CASE(
    "a kept run of joints that water weakens goes on from its file, as wet as its own tilt makes them") {
    const TemporaryFolder folder;
    const std::string scenario =
        folder.write("wet.toml",
                     "[analysis]\nstart_deg = 10.0\n[material.rock]\ndensity = 2700.0\n"
                     "[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 25.0\n"
                     "wet_strength_factor = 0.6\n"
                     "[[stack]]\ncolumns = 2\nrows = 2\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
                     "[[water]]\nbetween = [\"c1r1s1\", \"floor\"]\nelevation = 0.02\n");
    const std::string file = folder / "failing.mcap";
    const Outcome outcome = runTalus({"critical-angle", scenario, "--keep-run", file, "--json", "--quiet"});
    REQUIRE(outcome.exit_code == 0);
    auto reader = SnapshotReader::open(file);
    REQUIRE(reader.ok());
    const formats::SnapshotHeader& header = reader->header();
    REQUIRE(header.joints.size() == 2);
    CHECK(header.joints[1].name.ends_with("wet"));
    const auto read = formats::parseScenario(header.scenario_text, header.scenario_path);
    REQUIRE(read.ok());
    REQUIRE(reader->fulls() >= 3);
    const FullFrame from = *reader->full(1);
    const talus::test::Recorded resumed = talus::test::record(read->model, 1000, &from);
    REQUIRE(resumed.result.ok());
    REQUIRE(reader->frameOf(1).has_value());
    const std::size_t next = *reader->frameOf(1) + 1;
    for (std::size_t k = 0; next + k < reader->frames().size(); ++k)
        CHECK(resumed.lights.at(k).state_hash == reader->frame(next + k)->state_hash);
}

TEST_CASE("a slope that stands keeps nothing and says so; nothing finished is replaced unasked") {
    const TemporaryFolder folder;
    const std::string stands = folder.write("stands.toml", blockScenario(0, 40, kQuickSearch));
    const std::string slides = folder.write("slides.toml", blockScenario(0, 20, kQuickSearch));
    const std::string file = folder / "failing.mcap";
    const Outcome nothing = runTalus({"critical-angle", stands, "--keep-run", file, "--json", "--quiet"});
    CHECK(nothing.exit_code == 0);
    CHECK(nothing.json().at("kept_run").at("file").is_null());
    CHECK(nothing.json().at("kept_run").at("reason") == "the slope is stable up to the largest load tried");
    CHECK_FALSE(std::filesystem::exists(file));
    CHECK(runTalus({"critical-angle", stands, "--keep-run", file, "--quiet"})
              .out.find("kept run          none: ") != std::string::npos);

    REQUIRE(runTalus({"critical-angle", slides, "--keep-run", file, "--keep-run-time", "0.05", "--quiet"})
                .exit_code == 0);
    const std::string before = contentOf(file);
    const Outcome again = runTalus({"critical-angle", slides, "--keep-run", file, "--quiet"});
    CHECK(again.exit_code == 2);
    CHECK(again.err.find("--keep-run: holds a finished snapshot file; --force replaces it") !=
          std::string::npos);
    CHECK(contentOf(file) == before);
    CHECK(runTalus({"critical-angle", stands, "--keep-run", file, "--force", "--quiet"}).exit_code == 0);
    CHECK(contentOf(file) == before);  // nothing failed: what was there stays
    CHECK(runTalus({"critical-angle", slides, "--keep-run", folder / "failing.csv", "--quiet"}).exit_code ==
          2);
    CHECK(
        runTalus({"critical-angle", slides, "--keep-run", folder / "no/such/f.mcap", "--quiet"}).exit_code ==
        4);
    CHECK(runTalus({"critical-angle", slides, "--keep-run-time", "1"}).exit_code == 2);
}

TEST_CASE("critical-acceleration: the kept run is shaken by more than the slope withstands") {
    const TemporaryFolder folder;
    const std::string file = folder / "failing.mcap";
    const Outcome outcome = runTalus({"critical-acceleration", folder.write("k.toml", blockScenario(10, 20)),
                                      "--keep-run", file, "--keep-run-time", "0.2", "--json", "--quiet"});
    REQUIRE(outcome.exit_code == 0);
    const double horizontal = outcome.json().at("kept_run").at("horizontal");
    CHECK(horizontal >= outcome.json().at("bracket")[1].get<double>());
    auto reader = SnapshotReader::open(file);
    REQUIRE(reader.ok());
    CHECK(reader->header().failure->analysis == "critical-acceleration");
    const auto as_it_fails =
        formats::parseScenario(reader->header().scenario_text, reader->header().scenario_path);
    REQUIRE(as_it_fails.ok());
    CHECK(as_it_fails->model.seismic.horizontal == doctest::Approx(horizontal).epsilon(1e-12));
    // It goes down the slope with what drives it less its friction: v = (k W cos + W sin - N tan(phi)) t / m.
    const double b = 10 * kDegree, tan_phi = std::tan(20 * kDegree), g = 9.81;
    const double a =
        g * (horizontal * std::cos(b) + std::sin(b) - (std::cos(b) - horizontal * std::sin(b)) * tan_phi);
    const LightFrame end = *reader->frame(reader->frames().size() - 1);
    CHECK(-end.velocity.x.back() == doctest::Approx(0.2 * a).epsilon(0.05));
}

TEST_CASE("a failing run without disk space ends with 4, not as an interruption") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("slides.toml", blockScenario(0, 20, kQuickSearch));
    const std::string whole = folder / "whole.mcap";
    REQUIRE(runTalus({"critical-angle", scenario, "--keep-run", whole, "--quiet"}).exit_code == 0);
    const std::uintmax_t size = std::filesystem::file_size(whole);
    constexpr std::size_t kMostText = 8192;
    for (std::size_t kib = 1; kib * 1024 < size; kib = kib * 4 / 3 + 1) {
        CAPTURE(kib);
        const std::string file = folder / (std::to_string(kib) + ".mcap");
        const Outcome outcome =
            Program(Room{kib}, {"critical-angle", scenario, "--keep-run", file, "--json", "--quiet"})
                .outcome();
        CHECK(outcome.exit_code == 4);
        if (kib * 1024 < kMostText) continue;  // what it prints finds no room either
        CHECK(outcome.json().at("kept_run").at("reason").is_string());
        CHECK(outcome.json().at("status") == "found");
        CHECK_FALSE(outcome.json().at("interrupted").get<bool>());
    }
}
