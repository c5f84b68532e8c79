// talus limit-analysis, and the ceiling beside the answer of a search.

#include <doctest/doctest.h>

#include "answers/ceiling.h"
#include "cli/text.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;

namespace {

const std::string kVerification = TALUS_SOURCE_DIR "/bench/verification/";

nlohmann::json limitOf(const std::string& path, const std::string& load) {
    const Outcome outcome = runTalus({"limit-analysis", path, "--for", load, "--json", "--threads", "1"});
    REQUIRE(outcome.exit_code == 0);
    return outcome.json();
}

SearchResult standsAt(double load) {
    SearchResult result;
    result.status = SearchStatus::found;
    result.low = load;
    return result;
}

}  // namespace

TEST_CASE("limit-analysis: tilt, factor and horizontal load of one block") {
    const TemporaryFolder folder;
    const std::string level = folder.write("level.toml", blockScenario(0, 20));
    const auto tilt = limitOf(level, "tilt");
    CHECK(tilt.at("status") == "found");
    CHECK(tilt.at("unit") == "deg");
    CHECK(tilt.at("lower").get<double>() == doctest::Approx(20).epsilon(1e-6));
    CHECK(tilt.at("upper").get<double>() == doctest::Approx(20).epsilon(1e-6));
    CHECK(tilt.at("moving_blocks") == nlohmann::json::array({"key"}));
    CHECK(tilt.at("mechanism").size() == 1);
    CHECK(tilt.at("mechanism")[0].at("moving") == true);
    CHECK(limitOf(level, "horizontal").at("upper").get<double>() ==
          doctest::Approx(std::tan(20 * tools::kDegree)).epsilon(1e-6));
    CHECK(limitOf(level, "factor").at("status") == "stable_to_stop");
    CHECK(limitOf(level, "factor").at("upper").is_null());

    const std::string steep = folder.write("steep.toml", blockScenario(25, 20));
    const auto falls = limitOf(steep, "tilt");
    CHECK(falls.at("status") == "unstable_at_start");
    CHECK(falls.at("lower").is_null());
    CHECK(falls.at("moving_blocks") == nlohmann::json::array({"key"}));
    CHECK(limitOf(steep, "factor").at("upper").get<double>() ==
          doctest::Approx(std::tan(20 * tools::kDegree) / std::tan(25 * tools::kDegree)).epsilon(2e-4));
}

TEST_CASE(
    "limit-analysis: a model that nothing holds, or with water far from it, is an error as in a search") {
    const TemporaryFolder folder;
    std::string text = blockScenario(0, 20);
    for (std::size_t at = text.find("fixed = true"); at != std::string::npos; at = text.find("fixed = true"))
        text.replace(at, 12, "");
    const std::string loose = folder.write("loose.toml", text);
    const std::string drowned =
        folder.write("drowned.toml",
                     blockScenario(0, 20, "[[water]]\nblock = \"key\"\nface = \"+x\"\nelevation = 500.0\n"));
    for (const char* load : {"tilt", "factor", "horizontal"}) {
        const Outcome falls = runTalus({"limit-analysis", loose, "--for", load});
        CHECK(falls.exit_code == 2);
        CHECK(falls.err.find("no fixed or driven block") != std::string::npos);
        const Outcome far = runTalus({"limit-analysis", drowned, "--for", load});
        CHECK(far.exit_code == 2);
        CHECK(far.err.find("500") != std::string::npos);
    }
}

TEST_CASE("limit-analysis: for people, and what it does not take") {
    const std::string arch = kVerification + "arch-27-1.5m.toml";
    const Outcome people = runTalus({"limit-analysis", arch, "--for", "tilt", "--quiet"});
    CHECK(people.exit_code == 0);
    CHECK(people.out.find("8.269") != std::string::npos);
    CHECK(people.err.empty());
    CHECK(runTalus({"limit-analysis", arch}).exit_code == 2);
    CHECK(runTalus({"limit-analysis", arch, "--for", "rain"}).exit_code == 2);
    const Outcome large = runTalus({"limit-analysis", arch, "--for", "tilt", "--max-points", "10", "--json"});
    CHECK(large.exit_code == 2);
    CHECK(large.json().at("errors")[0].at("message").get<std::string>().find("allowed: at most 10") !=
          std::string::npos);
}

TEST_CASE("a search says whether its answer depends on the loading history, unless that is left out") {
    const TemporaryFolder folder;
    const std::string path = folder.write("s.toml", blockScenario(0, 20));
    const auto with = runTalus({"critical-angle", path, "--json"}).json();
    CHECK(with.at("range").is_null());
    CHECK(with.at("range_reason") == "weight brought on at that load fails in the same place");
    CHECK(runTalus({"critical-angle", path, "--no-range", "--json"}).json().at("range_reason").is_null());
    CHECK(runTalus({"critical-angle", path, "--no-range", "--range"}).exit_code == 2);

    const std::string columns =
        folder.write("columns.toml",
                     "[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 38\n"
                     "[material.rock]\ndensity = 2700.0\n"
                     "[[stack]]\ncolumns = 3\nrows = 7\nslices = 1\nblock = [0.2, 0.1, 0.1]\n");
    const auto range = runTalus({"critical-angle", columns, "--json"}).json().at("range");
    REQUIRE(range.is_array());
    CHECK(range.at(0).get<double>() < range.at(1).get<double>());
}

TEST_CASE("a search has its ceiling beside the answer, unless it is left out") {
    const TemporaryFolder folder;
    const std::string path =
        folder.write("slides.toml", blockScenario(10, 20, "[analysis]\nstart_deg = 15.0\nstop_deg = 25.0\n"));
    const auto angle = runTalus({"critical-angle", path, "--json", "--threads", "1"}).json();
    CHECK(angle.at("ceiling").get<double>() == doctest::Approx(20).epsilon(1e-6));
    CHECK(angle.at("ceiling_reason").is_null());
    const auto factor = runTalus({"safety-factor", path, "--json", "--threads", "1"}).json();
    CHECK(factor.at("ceiling").get<double>() ==
          doctest::Approx(std::tan(20 * tools::kDegree) / std::tan(10 * tools::kDegree)).epsilon(2e-4));
    const auto without = runTalus({"critical-angle", path, "--no-ceiling", "--json"}).json();
    CHECK(without.at("ceiling").is_null());
    CHECK(without.at("ceiling_reason") == "not wanted (--no-ceiling)");
    CHECK(runTalus({"critical-angle", path, "--no-ceiling", "--ceiling"}).exit_code == 2);
}

TEST_CASE("an answer above its ceiling is undecided and says both") {
    const Ceiling ceiling{1.2, ""};
    SearchResult below = standsAt(1.2);
    tools::holdUnder(ceiling, Varied::factor, below);
    CHECK((below.status == SearchStatus::found));
    CHECK(below.warnings.empty());

    SearchResult above = standsAt(1.21);
    tools::holdUnder(ceiling, Varied::factor, above);
    CHECK((above.status == SearchStatus::undecided));
    REQUIRE(above.warnings.size() == 1);
    CHECK(above.warnings[0].find("1.2100") != std::string::npos);
    CHECK(above.warnings[0].find("1.2000") != std::string::npos);

    SearchResult unlimited = standsAt(100);
    tools::holdUnder({}, Varied::factor, unlimited);
    CHECK((unlimited.status == SearchStatus::found));
}
