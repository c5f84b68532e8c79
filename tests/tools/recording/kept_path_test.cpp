// The curve of a search travels with the run that it keeps.

#include <doctest/doctest.h>

#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;
using nlohmann::json;

TEST_CASE("a kept run has the search's curve and its answer; a run that no search keeps has none") {
    const TemporaryFolder folder;
    const std::string scenario =
        folder.write("slides.toml", blockScenario(0, 20, "[analysis]\nstart_deg = 15.0\nstop_deg = 25.0\n"));
    const std::string file = folder / "failing.mcap";
    const json found = runTalus({"critical-angle", scenario, "--keep-run", file, "--json", "--quiet"}).json();
    auto reader = formats::SnapshotReader::open(file);
    REQUIRE(reader.ok());
    REQUIRE(reader->header().failure.has_value());
    const formats::SnapshotFailure& failure = *reader->header().failure;
    constexpr double kDegree = 0.017453292519943295;
    CHECK(failure.answer / kDegree == doctest::Approx(found.at("critical_angle_deg").get<double>()));
    CHECK(failure.stands / kDegree == doctest::Approx(found.at("bracket_deg")[0].get<double>()));
    CHECK(failure.fails / kDegree == doctest::Approx(found.at("bracket_deg")[1].get<double>()));
    REQUIRE(failure.path.size() == found.at("path").size());
    for (std::size_t k = 0; k < failure.path.size(); ++k) {
        CHECK(failure.path[k].load / kDegree == doctest::Approx(found["path"][k].at("load").get<double>()));
        CHECK(failure.path[k].displacement == found["path"][k].at("displacement_m").get<double>());
    }
    const json shown = runTalus({"inspect", file, "--json"}).json();
    CHECK(shown.at("failure").at("path").size() == failure.path.size());
    CHECK(shown.at("failure").at("answer").get<double>() == doctest::Approx(failure.answer / kDegree));

    const std::string run = folder / "run.mcap";
    REQUIRE(runTalus({"run", scenario, "-o", run, "--set", "run.duration_s=0.001", "--quiet"}).exit_code ==
            0);
    CHECK_FALSE(formats::SnapshotReader::open(run)->header().failure.has_value());
}
