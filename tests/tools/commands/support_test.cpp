// talus support: pretension and number of bolts against the closed forms of sliding blocks.

#include <doctest/doctest.h>

#include <cmath>

#include "cli/text.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;

namespace {

const std::string kAnchored = TALUS_SOURCE_DIR "/bench/verification/hoek-bray-crack-2m-anchored.toml";

/// The Hoek-Bray slope with 2 m of water: the anchor's force for a factor of safety, by limit equilibrium
/// [N/m].
double anchorFor(double factor) {
    const double dip = talus::radians(35), tan_phi = std::tan(talus::radians(37)), unit = 9810;
    const double crack = 12 - 7.652010281, area = 7.652010281 / std::sin(dip);
    const double weight =
        0.5 * 26000 * 144 * ((1 - crack * crack / 144) / std::tan(dip) - 1 / std::tan(talus::radians(60)));
    const double uplift = 0.5 * unit * 2 * area, thrust = 0.5 * unit * 4;
    const double holds = 25e3 * area + (weight * std::cos(dip) - uplift - thrust * std::sin(dip)) * tan_phi;
    const double drives = weight * std::sin(dip) + thrust * std::cos(dip);
    const double to_plane = dip + talus::radians(15);
    return (factor * drives - holds) / (std::sin(to_plane) * tan_phi + factor * std::cos(to_plane));
}

nlohmann::json supportOf(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "support");
    arguments.insert(arguments.end(), {"--json", "--threads", "1"});
    const Outcome outcome = runTalus(arguments);
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    return outcome.json();
}

/// A block of 4 x `width` x 1 m, 2700 kg/m3, on a plane tilted by 30 degrees with 20 degrees of friction,
/// pinned to it by bolts of 20 kN normal to the plane.
std::string pinned(const std::string& width = "4", const std::string& spacing = "[1.0, 1.0]") {
    return "[gravity]\ntilt_deg = 30.0\n[material.rock]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness "
           "= "
           "1e10\nshear_stiffness = 1e10\nfriction_deg = 20.0\n"
           "[[block]]\nname = \"plane\"\nbox = { min = [-9, -2, -3], max = [9, 30, 0] }\nfixed = true\n"
           "[[block]]\nname = \"key\"\nbox = { min = [0, 0, 0], max = [4, " +
           width +
           ", 1] }\n"
           "[[bolt_pattern]]\nname = \"P\"\nbox = { min = [0, 0, 0.9], max = [4, 30, 1.1] }\nface = \"+z\"\n"
           "spacing = " +
           spacing +
           "\nlength = 3.0\nplunge_deg = 90\ntrend_deg = 0\nkind = \"anchored\"\n"
           "area = 1e-4\nmodulus = 2e11\nyield_force = 2e4\npretension = 2e4\n";
}

}  // namespace

TEST_CASE("support: the pretension that a factor of safety takes is that of limit equilibrium") {
    for (const double factor : {1.5, 1.7}) {
        const auto found = supportOf({kAnchored, "--factor", std::to_string(factor), "--set",
                                      "bolt[0].yield_force=400000", "--tolerance", "0.002"});
        const double least = found["answer"]["pretension_n"], below = found["too_little"]["pretension_n"];
        MESSAGE("factor ", factor, ": pretension ", least, " N, limit equilibrium ", anchorFor(factor));
        CHECK(found["status"] == "found");
        CHECK(least - below <= 0.002 * 4e5 * (1 + 1e-9));
        CHECK(least == doctest::Approx(anchorFor(factor)).epsilon(0.01));
        CHECK(found["answer"]["safety_factor"] >= factor);
        CHECK(found["too_little"]["safety_factor"] < factor);
        // What it says to write reads back as that factor.
        std::vector<std::string> again{"safety-factor", kAnchored, "--json", "--threads", "1"};
        for (const auto& set : found["set"]) again.insert(again.end(), {"--set", set.get<std::string>()});
        CHECK(runTalus(again).json()["safety_factor"] == found["answer"]["safety_factor"]);
    }
}

TEST_CASE("support: the number of bolts of a pattern") {
    const TemporaryFolder folder;
    const std::string path = folder.write("pinned.toml", pinned());
    const double weight = 2700 * 16 * 9.81, b = talus::radians(30), tan_phi = std::tan(talus::radians(20));
    for (const double factor : {0.7, 0.8, 1.1}) {
        // F = (W cos b + n T) tan(phi) / (W sin b)
        const double exact = (factor * weight * std::sin(b) / tan_phi - weight * std::cos(b)) / 2e4;
        const auto found = supportOf({path, "--factor", std::to_string(factor), "--by", "number"});
        CHECK(found["status"] == "found");
        const int bolts = found["answer"]["bolts"], fewer = found["too_little"]["bolts"];
        MESSAGE("factor ", factor, ": ", bolts, " bolts, with ", fewer, " too few; exactly ", exact);
        CHECK(bolts >= exact - 0.02);
        CHECK(fewer <= exact + 0.02);
        CHECK(bolts == (factor == 0.7 ? 4 : factor == 0.8 ? 6 : 16));  // of rows times columns, at most 4 x 4
        for (const auto& trial : found["trials"]) {
            const double n = trial["bolts"];
            CHECK(trial["safety_factor"].get<double>() ==
                  doctest::Approx((weight * std::cos(b) + n * 2e4) * tan_phi / (weight * std::sin(b)))
                      .epsilon(0.002));
        }
    }
}

TEST_CASE("support: a slice shows no spacing wider than itself, and what it shows holds on a wide slope") {
    const TemporaryFolder folder;
    const std::string wide = folder.write("wide.toml", pinned("24"));
    for (const std::string spacing : {"[3.0, 1.0]", "[1.0, 2.0]", "[0.7, 0.5]"})
        for (const double factor : {0.7, 0.8}) {
            CAPTURE(spacing);
            CAPTURE(factor);
            const std::string slice = folder.write("slice.toml", pinned("2", spacing));
            const auto found = supportOf({slice, "--factor", std::to_string(factor), "--by", "number"});
            REQUIRE(found["status"] == "found");
            CHECK(found["slice_width_m"].get<double>() == doctest::Approx(2));
            CHECK(found["bolts_count_as"] == "active");
            for (const auto& trial : found["trials"]) {
                if (trial["bolts"] == 0) continue;
                CHECK(trial["spacing_m"][0].get<double>() * trial["bolts_in_row"].get<int>() ==
                      doctest::Approx(2));
                CHECK(trial["spacing_m"][1].get<double>() <= 4 * (1 + 1e-9));
                CHECK(trial["yield_force_n_per_m"].get<double>() ==
                      doctest::Approx(trial["bolts"].get<int>() * 2e4 / 2));
            }
            const auto& answer = found["answer"];
            std::vector<std::string> again{"safety-factor", wide, "--json",
                                           "--threads",     "1",  "--no-interval"};
            for (const auto& set : found["set"]) again.insert(again.end(), {"--set", set.get<std::string>()});
            const double on_wide = runTalus(again).json()["safety_factor"];
            CHECK(on_wide == doctest::Approx(answer["safety_factor"].get<double>()).epsilon(0.002));
            CHECK(on_wide >= factor - 0.002);
        }
    const Outcome people = runTalus({"support", folder.write("slice.toml", pinned("2", "[3.0, 1.0]")), "--by",
                                     "number", "--factor", "0.7", "--quiet"});
    CAPTURE(people.out);
    CHECK(people.out.find(" 1 in a row 2.000 m wide, in all ") != std::string::npos);
    CHECK(people.out.find("a wider spacing along the face needs a wider slice") != std::string::npos);
    CHECK(people.out.find("active: the factor divides the strength of joints") != std::string::npos);
}

TEST_CASE("support: it warns of a strength that changes, which it takes at time 0") {
    const std::vector<std::string> asked{kAnchored, "--factor", "2.5"};
    CHECK(supportOf(asked)["warnings"].empty());
    const TemporaryFolder folder;
    std::string text = contentOf(kAnchored);
    const std::string joint = "[joint.plane]\n";
    REQUIRE(text.find(joint) != std::string::npos);
    text.insert(text.find(joint) + joint.size(), "strength_over_time = [[0, 1], [10, 0.4]]\n");
    const std::string weakens = folder.write("weakens.toml", text);
    const auto warnings = supportOf({weakens, "--factor", "2.5"})["warnings"];
    REQUIRE(warnings.size() == 1);
    const std::string told = "joint.plane.strength_over_time: this answer is for time 0";
    CHECK(warnings[0].get<std::string>().find(told) == 0);
    const Outcome people = runTalus({"support", weakens, "--factor", "2.5", "--quiet"});
    CHECK(people.out.find("warning           " + told) != std::string::npos);
}

TEST_CASE(
    "support: what is reached without bolts, or not with them, is a result; what is not there is refused") {
    const auto none = supportOf({kAnchored, "--factor", "1.3"});
    CHECK(none["status"] == "not_needed");
    CHECK(none["answer"].is_null());
    CHECK(none["trials"].size() == 1);
    const auto not_reached = supportOf({kAnchored, "--factor", "2.5"});
    CHECK(not_reached["status"] == "not_reached");
    CHECK(not_reached["too_little"]["safety_factor"].get<double>() == doctest::Approx(1.848).epsilon(0.01));
    const Outcome people = runTalus({"support", kAnchored, "--factor", "2.5", "--quiet"});
    CHECK(people.exit_code == 0);
    CHECK(people.out.find("not reached with 1 bolt of 200.00 kN") != std::string::npos);
    const Outcome absent = runTalus({"support", kAnchored, "--bolt", "B"});
    CHECK(absent.exit_code == 2);
    CHECK(absent.err.find("found 0 bolts called \"B\"") != std::string::npos);
    CHECK(runTalus({"support", kAnchored, "--by", "number"}).exit_code == 2);
    CHECK(runTalus({"support", kAnchored, "--factor", "0"}).exit_code == 2);
}
