// talus kinematics: its keys, notations, scenarios, pictures and faults.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "cli/json.h"
#include "tools/program.h"

using namespace talus::tools;
using namespace talus::tools::testing;

namespace {

constexpr double kDeg = std::numbers::pi / 180;
/// By dip and dip direction: of the first set three slide out of 70/180 at 30 degrees, of the second two
/// topple.
constexpr std::pair<double, double> kPlanes[] = {{44, 178}, {48, 186}, {39, 172}, {25, 181},
                                                 {81, 352}, {76, 4},   {40, 5}};

std::string rows(const std::string& header, const auto& row) {
    std::string text = header + "\n";
    for (const auto& [dip, direction] : kPlanes) text += row(dip, direction) + "\n";
    return text;
}

std::string values(std::initializer_list<double> list) {
    std::string text;
    for (const double value : list) {
        char buffer[40];
        std::snprintf(buffer, sizeof buffer, "%.17g", value);
        text += (text.empty() ? "" : ",") + std::string(buffer);
    }
    return text;
}

const std::string kByDip = rows("dip_deg,dip_direction_deg,set", [](double dip, double to) {
    return values({dip, to}) + (to > 100 && to < 300 ? ",J1" : ",J2");
});

Outcome of(const std::string& file, std::vector<std::string> more = {}) {
    std::vector<std::string> all{"kinematics", file, "--slope", "70/180", "--friction", "30", "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return runTalus(all);
}

Json jsonOf(const std::string& file, std::vector<std::string> more = {}) {
    more.emplace_back("--json");
    const Outcome outcome = of(file, more);
    REQUIRE_MESSAGE(outcome.exit_code == 0, outcome.err);
    return Json::parse(outcome.out);
}

constexpr const char* kRock =
    "[material.granite]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e10\n"
    "shear_stiffness = 1e10\nfriction_deg = 30.0\n[rock_mass]\nregion = { box = { min = [0, 0, 0], max = "
    "[10, 10, 10] } }\n[[joint_set]]\nname = \"J1\"\ndip_deg = 45\ndip_direction_deg = 180\nspacing = 2.0\n"
    "[[joint_set]]\nname = \"J2\"\ndip_deg = 80\ndip_direction_deg = 0\nspacing = 3.0\n";

}  // namespace

TEST_CASE("kinematics: the keys, with counts done by hand") {
    const TemporaryFolder folder;
    const Json result = jsonOf(folder.write("poles.csv", kByDip));
    CHECK(result.at("poles") == 7);
    CHECK(result.at("slope").dump() == R"({"dip_deg":70.0,"dip_direction_deg":180.0})");
    CHECK(result.at("friction_deg").dump() == "30.0");  // as it was given
    CHECK(result.at("planar").at("critical") == 3);
    CHECK(result.at("planar").at("total") == 7);
    CHECK(result.at("planar").at("percent").get<double>() == doctest::Approx(300.0 / 7));
    CHECK(result.at("flexural_toppling").at("critical") == 2);
    CHECK(result.at("wedge").at("total") == 21);
    CHECK(result.at("direct_toppling").at("total") == 21);
    CHECK(result.at("direct_toppling").at("base_planes").at("critical") == 4);
    const Json& wedge = result.at("wedge");
    CHECK(wedge.at("critical") == wedge.at("primary").get<int>() + wedge.at("secondary").get<int>());
    CHECK(wedge.at("critical") ==
          wedge.at("on_one_plane").get<int>() + wedge.at("on_both_planes").get<int>());
    REQUIRE(result.at("sets").size() == 2);
    const Json& set = result.at("sets")[0];
    CHECK(set.at("name") == "J1");
    CHECK(set.at("poles") == 4);
    CHECK(set.at("planar").at("critical") == 3);
    CHECK(set.at("planar").at("total") == 4);
    CHECK(set.at("dip_deg").get<double>() == doctest::Approx(39).epsilon(0.02));
    CHECK(set.at("dip_direction_deg").get<double>() == doctest::Approx(179.4).epsilon(0.01));
    CHECK(set.at("fisher_k_95")[0].get<double>() < set.at("fisher_k").get<double>());
    CHECK(set.at("fisher_k_95")[1].get<double>() > set.at("fisher_k").get<double>());
    CHECK(set.at("mean_plane").at("planar") == true);
    CHECK(result.at("set_pairs").size() == 3);
    CHECK(result.at("weights").is_null());
    CHECK(result.at("provenance").at("scenario").get<std::string>().ends_with("poles.csv"));
    const std::string people = of(folder / "poles.csv").out;
    CHECK(people.find("planar sliding") != std::string::npos);
    CHECK(people.find("3 of 7 ") != std::string::npos);
}

TEST_CASE("kinematics: four notations, one result") {
    const TemporaryFolder folder;
    const auto counts = [](const Json& result) {
        return Json{result.at("planar"), result.at("wedge"), result.at("direct_toppling"),
                    result.at("flexural_toppling")};
    };
    const Json first = counts(jsonOf(folder.write("a.csv", kByDip)));
    const Json strike =
        counts(jsonOf(folder.write("b.csv", rows("strike_deg,dip_deg", [](double dip, double to) {
                                       return values({to - 90, dip});
                                   }))));
    const Json pole =
        counts(jsonOf(folder.write("c.txt", rows("plunge_deg,trend_deg", [](double dip, double to) {
                                       return values({90 - dip, to - 180});
                                   }))));
    const Json normal = counts(jsonOf(
        folder.write("d.csv", rows("nx,ny,nz", [](double dip, double to) {
                         return values({std::sin(dip * kDeg) * std::sin(to * kDeg),
                                        std::sin(dip * kDeg) * std::cos(to * kDeg), std::cos(dip * kDeg)});
                     }))));
    CHECK(strike == first);
    CHECK(pole == first);
    CHECK(normal == first);
}

TEST_CASE("kinematics: sets that are found, weights beside the counts") {
    const TemporaryFolder folder;
    const std::string file = folder.write("poles.csv", kByDip);
    const Json found = jsonOf(file, {"--sets", "2"});
    CHECK(found.at("sets_found") == true);
    CHECK(found.at("sets")[0].at("name") == "1");
    CHECK(found.at("sets")[0].at("poles") == 4);
    CHECK(found.at("sets")[1].at("poles") == 3);
    const Json plain = jsonOf(file), weighed = jsonOf(file, {"--scanline", "180/5", "--bias-limit", "10"});
    CHECK(weighed.at("planar").at("critical") == plain.at("planar").at("critical"));
    CHECK(weighed.at("weights").at("by") == "terzaghi");
    CHECK(weighed.at("weights").at("bias_limit_deg").get<double>() == doctest::Approx(10));
    // A line to the south meets the steep planes of J2 at large angles, those of J1 at smaller ones, so J1
    // weighs more.
    CHECK(weighed.at("planar").at("weighted_percent").get<double>() >
          plain.at("planar").at("percent").get<double>());
    double sum = 0;
    for (const Json& set : weighed.at("sets")) sum += set.at("weighted").at("poles").get<double>();
    CHECK(sum == doctest::Approx(7));
    CHECK(of(file, {"--sets", "8"}).exit_code == 2);
}

TEST_CASE(
    "kinematics: of a scenario each plane that cuts is a pole, turned upright where the model is tilted") {
    const TemporaryFolder folder;
    const Json result = jsonOf(folder.write("rock.toml", kRock));
    const Json& sets = result.at("sets");
    REQUIRE(sets.size() == 2);
    CHECK(sets[0].at("name") == "J1");
    CHECK(sets[0].at("fisher_k").is_null());  // parallel planes
    CHECK(result.at("planar").at("critical") == sets[0].at("poles"));
    CHECK(result.at("flexural_toppling").at("critical") == sets[1].at("poles"));
    CHECK(result.at("turned_upright") == false);
    const int j1 = sets[0].at("poles"), j2 = sets[1].at("poles");
    CHECK(result.at("parallel_pairs") == j1 * (j1 - 1) / 2 + j2 * (j2 - 1) / 2);
    CHECK(result.at("wedge").at("total") == j1 * j2);
    const Json tilted = jsonOf(folder / "rock.toml", {"--set", "gravity.tilt_deg=20"});
    CHECK(tilted.at("turned_upright") == true);
    // About north: 45/180 gets cos(dip) = cos 45 cos 20.
    CHECK(tilted.at("sets")[0].at("dip_deg").get<double>() ==
          doctest::Approx(std::acos(std::cos(45 * kDeg) * std::cos(20 * kDeg)) / kDeg));
}

TEST_CASE("kinematics: 200 poles and their 19,900 lines take well under a second") {
    const TemporaryFolder folder;
    std::string text = "dip,dd\n";
    for (int k = 0; k < 200; ++k) text += values({double(7 * k % 90), double(37 * k % 360)}) + "\n";
    const std::string file = folder.write("many.csv", text);
    Program program({"kinematics", file, "--slope", "70/180", "--friction", "30", "--json", "--quiet"});
    CHECK(program.endsWithin(20 * kSlower));
    const Json result = Json::parse(program.outcome().out);
    CHECK(result.at("wedge").at("total").get<int>() + result.at("parallel_pairs").get<int>() == 19900);
}

TEST_CASE("kinematics: pictures are whole files with what they show") {
    const TemporaryFolder folder;
    const std::string file = folder.write("poles.csv", kByDip), poles = folder / "poles.svg",
                      lines = folder / "lines.svg";
    CHECK(of(file, {"--stereonet", poles}).exit_code == 0);
    CHECK(of(file, {"--stereonet", lines, "--view", "intersections", "--net", "equal-angle"}).exit_code == 0);
    const std::string shown = contentOf(poles), other = contentOf(lines);
    for (const char* part :
         {"</svg>", "planar sliding: 3 of 7 poles (42.9 %)", "flexural toppling: 2 of 7", "face 70/180",
          "friction cone 30", "daylight envelope", "lateral limits 20", "slip limit 40", "J1: 4 poles, mean",
          "equal-area", "class=\"slides\"", "per 1 % of the area"})
        CHECK_MESSAGE(shown.find(part) != std::string::npos, part);
    for (const char* part : {"</svg>", "wedge sliding", "secondary zone", "direct toppling", "equal-angle"})
        CHECK_MESSAGE(other.find(part) != std::string::npos, part);
    for (const std::string& svg : {shown, other}) {
        CHECK(svg.find("nan") == std::string::npos);
        CHECK(svg.find("href") == std::string::npos);
    }
    CHECK(of(file, {"--stereonet", poles, "--contours", "none"}).exit_code == 0);
    CHECK(contentOf(poles).find("per 1 % of the area") == std::string::npos);
}

TEST_CASE("kinematics: pictures at the ends of all ranges have places for everything") {
    const TemporaryFolder folder;
    const std::string one = folder.write("one.csv", "dip,dd\n0,0\n"), net = folder / "net.svg";
    for (const std::string& file : {folder.write("poles.csv", kByDip), one}) {
        for (const char* slope : {"90/0", "0.1/360", "45/-90"}) {
            for (const char* friction : {"0", "90"}) {
                for (const char* view : {"poles", "intersections"}) {
                    const Outcome outcome =
                        runTalus({"kinematics", file, "--slope", slope, "--friction", friction, "--lateral",
                                  friction, "--stereonet", net, "--view", view, "--quiet"});
                    CHECK_MESSAGE(outcome.exit_code == 0, outcome.err);
                    CHECK(contentOf(net).find("nan") == std::string::npos);
                    CHECK(contentOf(net).find("inf") == std::string::npos);
                }
            }
        }
    }
    const Json result = jsonOf(one);
    CHECK(result.at("wedge").at("total") == 0);
    CHECK(result.at("wedge").at("percent") == 0);
    CHECK(result.at("sets")[0].at("fisher_k").is_null());
    CHECK(result.at("sets")[0].at("cone_95_deg").is_null());
}

TEST_CASE("kinematics: bad input is reported with its place") {
    const TemporaryFolder folder;
    const std::string file = folder.write("poles.csv", kByDip);
    const auto refused = [&](std::vector<std::string> arguments, const std::string& fragment) {
        arguments.insert(arguments.begin(), "kinematics");
        const Outcome outcome = runTalus(arguments);
        CHECK(outcome.exit_code == 2);
        CHECK_MESSAGE(outcome.err.find(fragment) != std::string::npos, outcome.err);
    };
    refused({file, "--friction", "30"}, "--slope is required");
    refused({file, "--slope", "70", "--friction", "30"}, "--slope: found \"70\", allowed: DIP/DIPDIRECTION");
    refused({file, "--slope", "95/180", "--friction", "30"},
            "found a dip of 95, allowed: greater than 0 and at most 90");
    refused({file, "--slope", "0/180", "--friction", "30"}, "found a dip of 0");
    refused({file, "--slope", "1e-9/180", "--friction", "30"},
            "found a dip of 1e-09, allowed: greater than 0");
    refused({file, "--slope", "70/nan", "--friction", "30"}, "--slope: found \"70/nan\"");
    refused({file, "--slope", "70/180", "--friction", "91"}, "--friction");
    refused({file, "--slope", "70/180", "--friction", "30", "--lateral", "-1"}, "--lateral");
    refused({file, "--slope", "70/180", "--friction", "30", "--set", "gravity.tilt_deg=1"}, "--set");
    refused({file, "--slope", "70/180", "--friction", "30", "--bias-limit", "10"}, "found no scanline");
    refused({file, "--slope", "70/180", "--friction", "30", "--scanline", "10/95"}, "-90 to 90");
    refused({file, "--slope", "70/180", "--friction", "30", "--stereonet", folder / "a.png"}, ".svg");
    refused({folder / "none.csv", "--slope", "70/180", "--friction", "30"},
            "none.csv: error: cannot be opened");
    refused({folder.write("bad.csv", "dip,dd\n95,10\n"), "--slope", "70/180", "--friction", "30"},
            "bad.csv:2:1: error: found dip \"95\"");
    const std::string rock = folder.write("rock.toml", kRock);
    refused({rock, "--slope", "70/180", "--friction", "30", "--scanline", "10/5"},
            "not measured along a scanline");
    refused({folder.write("block.toml", blockScenario(0, 30)), "--slope", "70/180", "--friction", "30"},
            "found no joint set in");
    const Outcome json = runTalus({"kinematics", file, "--slope", "95/180", "--friction", "30", "--json"});
    CHECK(Json::parse(json.out).at("ok") == false);
}
