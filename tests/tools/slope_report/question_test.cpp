// Which search a report is about, and what it was made from.

#include "slope_report/question.h"

#include <doctest/doctest.h>

#include "cli/failures.h"
#include "cli/input_hash.h"
#include "cli/text.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools;
using namespace talus::tools::testing;

namespace {

formats::Scenario withKeys(std::initializer_list<const char*> keys) {
    formats::Scenario scenario;
    for (const char* key : keys) scenario.places[key] = {1, 1};
    return scenario;
}

std::string chosen(std::initializer_list<const char*> keys, const std::string& wish = "") {
    return analysisOf(withKeys(keys), wish).value->name;
}

}  // namespace

TEST_CASE("report: the analysis is the given one, that of [analysis], or that of the tilt") {
    CHECK(chosen({}) == "safety-factor");
    CHECK(chosen({"gravity.tilt_deg"}) == "critical-angle");
    CHECK(chosen({"gravity.tilt_deg", "analysis.factor_tolerance"}) == "safety-factor");
    CHECK(chosen({"analysis.stop_deg"}) == "critical-angle");
    CHECK(chosen({"analysis.acceleration_tolerance"}) == "critical-acceleration");
    CHECK(chosen({"analysis.stop_deg"}, "critical-acceleration") == "critical-acceleration");
    CHECK(analysisOf(withKeys({"gravity.tilt_deg"}), "").because.find("gravity.tilt_deg") !=
          std::string::npos);
    CHECK_THROWS_AS(analysisOf(withKeys({}), "angle"), BadInput);
}

TEST_CASE("report: the face that is given, and faults of it") {
    const formats::Scenario none;
    const auto face = netFace(none, "65/-90");
    REQUIRE(face);
    CHECK(degrees(face->value.dip) == doctest::Approx(65));
    CHECK(degrees(face->value.dip_direction) == doctest::Approx(270));
    for (const char* wrong : {"65", "0/270", "91/270", "65/400", "x/y"})
        CHECK_THROWS_AS(netFace(none, wrong), BadInput);
    CHECK(!netFace(none, ""));
}

TEST_CASE("report: the least friction of the joints") {
    Model model;
    model.joints.resize(3);  // the last one has none
    model.joints[0].friction = radians(40), model.joints[1].friction = radians(30);
    model.joints[1].name = "bedding";
    CHECK(netFriction(model).value == doctest::Approx(radians(30)));
    CHECK(netFriction(model).because.find("bedding") != std::string::npos);
}

TEST_CASE("report: the digests are those of the scenario and of the files that it names") {
    const std::string quarry = TALUS_SOURCE_DIR "/bench/examples/quarry.toml";
    const auto scenario = formats::readScenario(quarry);
    REQUIRE(scenario.ok());
    const auto digests = inputDigests(*scenario);
    REQUIRE(digests.size() == 2);
    CHECK(digests[0] == std::pair<std::string, std::string>{"quarry.toml", xxh128(contentOf(quarry))});
    CHECK(digests[1] == std::pair<std::string, std::string>{
                            "quarry.asc", xxh128(contentOf(TALUS_SOURCE_DIR "/bench/examples/quarry.asc"))});
}
