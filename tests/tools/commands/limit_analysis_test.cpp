// talus limit-analysis, and the upper bound beside the answer of a search.

#include <doctest/doctest.h>

#include "cli/text.h"
#include "support/wedged_columns.h"
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
          doctest::Approx(std::tan(20 * talus::kDegree)).epsilon(1e-6));
    CHECK(limitOf(level, "factor").at("status") == "stable_to_stop");
    CHECK(limitOf(level, "factor").at("upper").is_null());

    const std::string steep = folder.write("steep.toml", blockScenario(25, 20));
    const auto falls = limitOf(steep, "tilt");
    CHECK(falls.at("status") == "unstable_at_start");
    CHECK(falls.at("lower").is_null());
    CHECK(falls.at("moving_blocks") == nlohmann::json::array({"key"}));
    CHECK(limitOf(steep, "factor").at("upper").get<double>() ==
          doctest::Approx(std::tan(20 * talus::kDegree) / std::tan(25 * talus::kDegree)).epsilon(2e-4));
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

TEST_CASE("a search says how far its answer depends on the loading path, unless that is left out") {
    const TemporaryFolder folder;
    const std::string path = folder.write("s.toml", blockScenario(0, 20));
    const auto with = runTalus({"critical-angle", path, "--json"}).json();
    CHECK(with.at("range").is_null());
    CHECK(with.at("answer_interval")[0] == with.at("critical_angle_deg"));
    CHECK(with.at("range_reason") == with.at("answer_interval_reasons")[0]);
    for (const auto& [never, always] : {std::pair{"--no-range", "--range"}, {"--no-interval", "--interval"}})
        CHECK(runTalus({"critical-angle", path, never, always}).exit_code == 2);

    const std::string columns = folder.write("columns.toml", talus::test::wedgedColumns());
    const auto leaning = runTalus({"critical-angle", columns, "--json"}).json();
    const auto range = leaning.at("range");
    REQUIRE(range.is_array());
    CHECK(range.at(0).get<double>() < range.at(1).get<double>());
    CHECK(range.at(0) == leaning.at("answer_interval").at(0));
    CHECK(range.at(1) == leaning.at("critical_angle_deg"));
    CHECK(leaning.at("answer_interval").at(1).get<double>() >= range.at(1).get<double>());
    const auto without = runTalus({"critical-angle", columns, "--no-interval", "--json"}).json();
    CHECK(without.at("range").is_null());
    CHECK(without.at("critical_angle_deg") == leaning.at("critical_angle_deg"));
    const auto people = runTalus({"critical-angle", columns, "--quiet"}).out;
    CHECK(people.find("low: no friction on the ") != std::string::npos);
    CHECK(people.find("high: ") != std::string::npos);
}

TEST_CASE("a search has its upper bound beside the answer, unless it is left out") {
    const TemporaryFolder folder;
    const std::string path =
        folder.write("slides.toml", blockScenario(10, 20, "[analysis]\nstart_deg = 15.0\nstop_deg = 25.0\n"));
    const auto angle = runTalus({"critical-angle", path, "--json", "--threads", "1"}).json();
    CHECK(angle.at("ceiling").get<double>() == doctest::Approx(20).epsilon(1e-6));
    CHECK(angle.at("ceiling_reason").is_null());
    const auto factor = runTalus({"safety-factor", path, "--json", "--threads", "1"}).json();
    CHECK(factor.at("ceiling").get<double>() ==
          doctest::Approx(std::tan(20 * talus::kDegree) / std::tan(10 * talus::kDegree)).epsilon(2e-4));
    const auto without = runTalus({"critical-angle", path, "--no-ceiling", "--json"}).json();
    CHECK(without.at("ceiling").is_null());
    CHECK(without.at("upper_bound").is_null());
    CHECK(without.at("ceiling_reason") == "not computed (--no-upper-bound)");
    CHECK(angle.at("upper_bound") == angle.at("ceiling"));
    CHECK(angle.at("answer_interval")[1].get<double>() >= angle.at("critical_angle_deg").get<double>());
    for (const auto& [never, always] :
         {std::pair{"--no-ceiling", "--ceiling"}, {"--no-upper-bound", "--upper-bound"}})
        CHECK(runTalus({"critical-angle", path, never, always}).exit_code == 2);
}
