// --plot and --picture of the searches: files beside the answer, which stays the same.

#include <doctest/doctest.h>

#include <filesystem>

#include "tools/program.h"

using namespace talus::tools::testing;

namespace {

const char* const kQuickSearch = "[analysis]\nstart_deg = 15.0\nstop_deg = 25.0\n";

bool isSvg(const std::string& path) {
    const std::string content = contentOf(path);
    return content.starts_with("<?xml") && content.ends_with("</svg>\n");
}

}  // namespace

TEST_CASE("all searches draw curve and blocks, and say so") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("slides.toml", blockScenario(0, 20, kQuickSearch));
    const std::string plot = folder / "plot.svg", picture = folder / "picture.svg";
    for (const char* search : {"critical-angle", "safety-factor", "critical-acceleration"}) {
        CAPTURE(search);
        std::vector<std::string> call{search, scenario, "--json", "--quiet", "--set", "gravity.tilt_deg=10"};
        const auto plain = runTalus(call).json();
        call.insert(call.end(), {"--plot", plot, "--picture", picture});
        const Outcome outcome = runTalus(call);
        REQUIRE(outcome.exit_code == 0);
        CHECK(outcome.err.empty());
        const auto json = outcome.json();
        CHECK(json.at("plot") == nlohmann::json{{"file", plot}, {"reason", nullptr}});
        CHECK(json.at("picture").at("file") == picture);
        CHECK(json.at("state_hash") == plain.at("state_hash"));
        CHECK_FALSE(plain.contains("plot"));
        CHECK(isSvg(plot));
        CHECK(isSvg(picture));
        std::filesystem::remove(plot), std::filesystem::remove(picture);
    }
    const Outcome people = runTalus({"critical-angle", scenario, "--quiet", "--plot", plot});
    CHECK(people.out.find("plot              " + plot) != std::string::npos);
}

TEST_CASE("a file that cannot be written is refused before the search") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("slides.toml", blockScenario(0, 20, kQuickSearch));
    for (const char* option : {"--plot", "--picture"}) {
        CAPTURE(option);
        const Outcome nowhere = runTalus({"critical-angle", scenario, option, folder / "no/such.svg"});
        CHECK(nowhere.exit_code == 4);
        CHECK(nowhere.out.empty());
        CHECK(nowhere.err.find("no/such.svg") != std::string::npos);
        CHECK(nowhere.err.find("cannot be opened for writing") != std::string::npos);
        const Outcome ending = runTalus({"critical-angle", scenario, option, folder / "curve.png"});
        CHECK(ending.exit_code == 2);
        CHECK(ending.err.find("a name that ends in .svg") != std::string::npos);
        CHECK(runTalus({"critical-angle", scenario, option, folder.path()}).exit_code != 0);
    }
    const std::string same = folder / "same.svg";
    CHECK(runTalus({"critical-angle", scenario, "--plot", same, "--picture", same}).exit_code == 2);
    CHECK(folder.files() == 1);
}

TEST_CASE("what fails before the search has blocks to show and no curve") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("early.toml", blockScenario(0, 12, kQuickSearch));
    const Outcome outcome = runTalus({"critical-angle", scenario, "--json", "--quiet", "--plot",
                                      folder / "p.svg", "--picture", folder / "b.svg"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.json().at("plot").at("file").is_null());
    CHECK(outcome.json().at("plot").at("reason").is_string());
    CHECK(isSvg(folder / "b.svg"));
}

TEST_CASE("limit equilibrium is in the JSON: of theory where a formula applies, otherwise of block theory") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("slides.toml", blockScenario(0, 20, kQuickSearch));
    const auto json = runTalus({"critical-angle", scenario, "--json", "--quiet"}).json();
    CHECK(json.at("limit_equilibrium").at("value").get<double>() == doctest::Approx(20));
    CHECK(json.at("limit_equilibrium").at("kind") == "sliding on a plane");
    CHECK(json.at("limit_equilibrium").at("blocks") == nlohmann::json::array({"key"}));
    CHECK(json.at("failure_displacement_m").get<double>() ==
          doctest::Approx(0.5 * json.at("failure_displacement").get<double>()));
    const std::string pushed = folder.write(
        "pushed.toml",
        blockScenario(0, 20,
                      std::string(kQuickSearch) + "[[load]]\nblock = \"key\"\nforce = [0.0, 0.0, -1e3]\n"));
    const auto loaded = runTalus({"critical-angle", pushed, "--json", "--quiet"}).json();
    CHECK(loaded.at("limit_equilibrium").at("kind") == "sliding on one plane");
    CHECK(loaded.at("limit_equilibrium").at("value").get<double>() ==
          doctest::Approx(loaded.at("critical_angle_deg").get<double>()).epsilon(2e-3));
    CHECK(runTalus({"critical-angle", pushed, "--json", "--quiet", "--no-interval"})
              .json()
              .at("limit_equilibrium")
              .is_null());
}
