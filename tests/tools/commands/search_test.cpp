// talus critical-angle and safety-factor on one block whose answers are closed formulas.

#include <doctest/doctest.h>

#include <cmath>

#include "answers/search.h"
#include "cli/text.h"
#include "talus/formats/scenario.h"
#include "tools/program.h"

using namespace talus::tools;
using namespace talus::tools::testing;

namespace {

const char* const kQuickSearch = "[analysis]\nstart_deg = 15.0\nstop_deg = 25.0\n";

nlohmann::json bracketOf(const nlohmann::json& json) {
    return json.contains("bracket_deg") ? json.at("bracket_deg") : json.at("bracket");
}

bool isStateHash(const nlohmann::json& value) {
    const auto text = value.get<std::string>();
    return text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

/// An interval around an answer with a reason for each end, and the curve that led to the answer.
void checkInterval(const nlohmann::json& json) {
    const double answer = 0.5 * (bracketOf(json)[0].get<double>() + bracketOf(json)[1].get<double>());
    const auto interval = json.at("answer_interval");
    REQUIRE(interval.size() == 2);
    CHECK(interval[0].get<double>() <= answer * (1 + 1e-12));
    CHECK(interval[1].get<double>() >= answer * (1 - 1e-12));
    REQUIRE(json.at("answer_interval_reasons").size() == 2);
    for (const auto& reason : json.at("answer_interval_reasons")) CHECK(!reason.get<std::string>().empty());
    CHECK(json.at("failure_displacement").get<double>() == 3e-4);
    CHECK(json.at("answers_by_displacement").is_array());
    REQUIRE(json.at("path").size() == json.at("probe_list").size());
    CHECK(json.at("path")[0].at("displacement_m") == 0);
    CHECK(json.at("path").back().at("displacement_m").get<double>() > 0);
    CHECK(json.at("path").back().at("load").get<double>() == doctest::Approx(answer).epsilon(0.01));
}

void checkCommonKeys(const nlohmann::json& json) {
    for (const char* key :
         {"failure_mode", "moving_blocks", "theory", "probes", "steps", "wall_seconds", "state_hash",
          "probe_list", "evidence", "provenance", "warnings", "interrupted", "fallen_at_start",
          "moving_mass_share", "ceiling", "range", "search_rules", "failing_volume_m3", "failing_mass_kg"}) {
        CAPTURE(key);
        CHECK(json.contains(key));
    }
    CHECK(isStateHash(json.at("state_hash")));
    CHECK(json.at("probe_list").size() == json.at("probes").get<std::size_t>());
    CHECK(json.at("steps").get<long>() > 0);
    double spent = 0;
    for (const char* part : {"loading", "path", "beside"}) {
        CAPTURE(part);
        CHECK(json.at("time_s").at(part).get<double>() >= 0);
        spent += json.at("time_s").at(part).get<double>();
    }
    CHECK(spent > 0);
    CHECK(spent <= json.at("wall_seconds").get<double>());
    CHECK(json.at("factorisations").get<long>() > 0);
    checkInterval(json);
}

}  // namespace

TEST_CASE("critical-angle: a block slides at its friction angle, theory beside") {
    const TemporaryFolder folder;
    const std::string path = folder.write("slides.toml", blockScenario(0, 20, kQuickSearch));
    const Outcome outcome = runTalus({"critical-angle", path, "--json", "--threads", "1"});
    REQUIRE(outcome.exit_code == 0);
    const auto json = outcome.json();
    checkCommonKeys(json);
    CHECK(json.at("status") == "found");
    CHECK(std::abs(json.at("critical_angle_deg").get<double>() - 20) < 0.025);
    CHECK(json.at("theory_deg").get<double>() == doctest::Approx(20).epsilon(1e-10));
    const auto bracket = json.at("bracket_deg");
    CHECK(bracket[0].get<double>() < bracket[1].get<double>());
    CHECK(json["critical_angle_deg"].get<double>() ==
          doctest::Approx((bracket[0].get<double>() + bracket[1].get<double>()) / 2).epsilon(1e-9));
    CHECK(json.at("failure_mode") == "sliding");
    CHECK(json.at("moving_blocks") == nlohmann::json::array({"key"}));

    const Outcome people = runTalus({"critical-angle", path, "--quiet", "--verbose"});
    CHECK(people.exit_code == 0);
    CHECK(people.err.empty());
    CHECK(people.out.find("critical angle") != std::string::npos);
    CHECK(people.out.find("failing") != std::string::npos);  // the probes of --verbose
}

TEST_CASE("critical-angle: failing at the start and standing to the end are results") {
    const TemporaryFolder folder;
    const auto early =
        runTalus({"critical-angle", folder.write("a.toml", blockScenario(0, 12, kQuickSearch)), "--json"});
    CHECK(early.exit_code == 0);
    CHECK(early.json().at("status") == "unstable_at_start");
    CHECK(early.json().at("critical_angle_deg").is_null());
    CHECK(early.json().at("bracket_deg")[0].is_null());
    const auto late =
        runTalus({"critical-angle", folder.write("b.toml", blockScenario(0, 40, kQuickSearch)), "--json"});
    CHECK(late.exit_code == 0);
    CHECK(late.json().at("status") == "stable_to_stop");
    CHECK(late.json().at("critical_angle_deg").is_null());
    CHECK(late.json().at("bracket_deg")[1].is_null());
}

TEST_CASE("safety-factor: tan(phi) / tan(beta), theory beside") {
    const TemporaryFolder folder;
    const Outcome outcome =
        runTalus({"safety-factor", folder.write("f.toml", blockScenario(10, 20)), "--json"});
    REQUIRE(outcome.exit_code == 0);
    const auto json = outcome.json();
    checkCommonKeys(json);
    const double expected = std::tan(20 * 3.14159265358979 / 180) / std::tan(10 * 3.14159265358979 / 180);
    CHECK(json.at("status") == "found");
    CHECK(json.at("theory_factor").get<double>() == doctest::Approx(expected).epsilon(1e-7));
    CHECK(json.at("safety_factor").get<double>() == doctest::Approx(expected).epsilon(0.002));
    CHECK(json.at("bracket").size() == 2);
}

TEST_CASE(
    "critical-acceleration: tan(phi - beta), theory and ceiling beside, from the scenario's own upwards") {
    const TemporaryFolder folder;
    const std::string path = folder.write("k.toml", "[seismic]\nhorizontal = 0.05\n" + blockScenario(10, 20));
    const Outcome outcome = runTalus({"critical-acceleration", path, "--json"});
    REQUIRE(outcome.exit_code == 0);
    const auto json = outcome.json();
    checkCommonKeys(json);
    const double expected = std::tan(10 * 3.14159265358979 / 180);
    CHECK(json.at("status") == "found");
    CHECK(json.at("theory_k").get<double>() == doctest::Approx(expected).epsilon(1e-7));
    CHECK(std::abs(json.at("critical_k").get<double>() - expected) < 3e-4);
    CHECK(json.at("ceiling").get<double>() == doctest::Approx(expected).epsilon(1e-4));
    CHECK(json.at("bracket")[0].get<double>() >= 0.05);
    CHECK(json.at("bracket")[1].get<double>() - json.at("bracket")[0].get<double>() <= 1e-4);
    CHECK(json.at("probe_list")[0].at("horizontal").get<double>() == 0.05);
    const auto strong =
        runTalus({"critical-acceleration",
                  folder.write("s.toml", "[seismic]\nhorizontal = 0.3\n" + blockScenario(10, 20)), "--json"});
    CHECK(strong.json().at("status") == "unstable_at_start");
    CHECK(strong.json().at("critical_k").is_null());
}

TEST_CASE(
    "a small sliver that rounding would move is named and left out, and the other blocks get their answer") {
    const TemporaryFolder folder;
    // Cubes beside the block: of their weight rounding is eps x k / (rho g size), with 1e11 Pa/m from 20 um
    // on too much.
    const auto withCube = [&](const std::string& name, const std::string& place, const char* stiffness) {
        std::string text = blockScenario(
            10, 20, "[[block]]\nname = \"splinter\"\nbox = { min = [3, 0, 0], max = " + place + " }\n");
        return folder.write(name, text.replace(text.find("1e9"), 3, stiffness));
    };
    for (const char* search : {"critical-angle", "safety-factor", "critical-acceleration"}) {
        CAPTURE(search);
        const auto answerTo = [&](const std::string& path) {
            return runTalus({search, path, "--json", "--quiet", "--no-range"});
        };
        const std::string key = search == std::string("safety-factor")    ? "safety_factor"
                                : search == std::string("critical-angle") ? "critical_angle_deg"
                                                                          : "critical_k";
        const Outcome tiny = answerTo(withCube("tiny.toml", "[3.000002, 0.000002, 0.000002]", "1e11"));
        REQUIRE(tiny.exit_code == 0);
        const auto json = tiny.json();
        CHECK(json.at("status") == "found");
        CHECK(json.at("fallen_at_start") == nlohmann::json{"splinter"});
        CHECK(json.at("warnings").dump().find("ill-conditioned sliver") != std::string::npos);
        CHECK(json.at("ceiling").is_number());
        const auto small = answerTo(withCube("small.toml", "[3.1, 0.1, 0.1]", "1e11")).json();
        CHECK(small.at("fallen_at_start").empty());
        CHECK(json.at(key).get<double>() == doctest::Approx(small.at(key).get<double>()).epsilon(1e-3));
    }
    // Where it is more than a splinter, nothing is left out.
    const std::string large = withCube("large.toml", "[3.6, 0.5, 0.5]", "1e15");
    const Outcome alone =
        runTalus({"critical-angle", large, "--set", "analysis.tolerance_deg=1e-6", "--json", "--quiet"});
    CHECK(alone.exit_code == 2);
    CHECK(alone.out.find("of block \\\"splinter\\\" at ") != std::string::npos);
}

TEST_CASE("a search that rounding would decide, or in which nothing holds, is refused") {
    const TemporaryFolder folder;
    std::string stiff = blockScenario(0, 20, "[analysis]\ntolerance_deg = 1e-6\n");
    stiff.replace(stiff.find("1e9"), 3, "1e15");
    const Outcome rounding = runTalus({"critical-angle", folder.write("stiff.toml", stiff)});
    CHECK(rounding.exit_code == 2);
    CHECK(rounding.err.find("at which rounding keeps") != std::string::npos);

    std::string soft = blockScenario(0, 20);
    soft.replace(soft.find("1e9"), 3, "1e4");
    const Outcome sinking = runTalus({"critical-angle", folder.write("soft.toml", soft)});
    CHECK(sinking.exit_code == 2);
    CHECK(sinking.err.find("of its height under its own weight") != std::string::npos);

    std::string yielding = blockScenario(0, 20);
    yielding.replace(yielding.find("shear_stiffness = ") + 18, 3, "1e4");
    const Outcome shifting = runTalus({"critical-angle", folder.write("yielding.toml", yielding)});
    CHECK(shifting.exit_code == 2);
    CHECK(shifting.err.find("joint.default.shear_stiffness") != std::string::npos);
    CHECK(shifting.err.find("of its height under its own weight") != std::string::npos);

    std::string rising = blockScenario(0, 20);
    rising.insert(rising.find("friction_deg"), "dilation_deg = 25.0\n");
    const Outcome gaining = runTalus({"safety-factor", folder.write("rising.toml", rising)});
    CHECK(gaining.exit_code == 2);
    CHECK(gaining.err.find("at most that friction angle") != std::string::npos);

    std::string loose = blockScenario(0, 20);
    loose.replace(loose.find("fixed = true"), 12, "fixed = false");
    const Outcome falling = runTalus({"safety-factor", folder.write("loose.toml", loose)});
    CHECK(falling.exit_code == 2);
    CHECK(falling.err.find("no fixed or driven block") != std::string::npos);
}

TEST_CASE(
    "an answer that depends on cohesion lost at the first slip says so, with the one for cohesion that is "
    "kept") {
    const std::string slope = TALUS_SOURCE_DIR "/bench/verification/hoek-bray-crack-2m.toml";
    const auto answerOf = [&](std::vector<std::string> more) {
        more.insert(more.begin(),
                    {"safety-factor", slope, "--json", "--quiet", "--threads", "1", "--no-ceiling"});
        return runTalus(more).json();
    };
    const auto warningOf = [](const nlohmann::json& answer) -> std::string {
        for (const auto& warning : answer.at("warnings"))
            if (warning.get<std::string>().starts_with("the answer depends on cohesion")) return warning;
        return "";
    };
    const auto kept = answerOf({});  // residual_cohesion = cohesion
    CHECK(warningOf(kept).empty());
    const auto lost = answerOf({"--set", "joint.plane.residual_cohesion=0"});
    CHECK(lost.at("safety_factor").get<double>() < 0.95 * kept.at("safety_factor").get<double>());
    const std::string told = "the answer with cohesion kept: ";
    const std::string warning = warningOf(lost);
    CAPTURE(warning);
    REQUIRE(warning.find(told) != std::string::npos);
    CHECK(std::stod(warning.substr(warning.find(told) + told.size())) ==
          doctest::Approx(kept.at("safety_factor").get<double>()).epsilon(1e-3));
    // Not looked for where a search more is not wanted.
    const auto quick = answerOf({"--set", "joint.plane.residual_cohesion=0", "--no-range"});
    CHECK(!warningOf(quick).empty());
    CHECK(warningOf(quick).find(told) == std::string::npos);
    CHECK(quick.at("safety_factor") == lost.at("safety_factor"));
    // A block without any to lose has none to tell.
    const auto none =
        answerOf({"--set", "joint.plane.residual_cohesion=0", "--set", "joint.plane.cohesion=0"});
    CHECK(warningOf(none).empty());
}

TEST_CASE(
    "an answer that depends on tensile strength lost at once says so, with the one for strength that is "
    "kept") {
    const auto answerOf = [](const std::string& softening) {
        return runTalus({"safety-factor", TALUS_SOURCE_DIR "/bench/verification/bridge-in-tension.toml",
                         "--set", "joint.intact.softening_displacement=" + softening, "--json", "--quiet",
                         "--no-ceiling"})
            .json();
    };
    const auto warnings = [](const nlohmann::json& answer) { return answer.at("warnings").dump(); };
    const auto kept = answerOf("1.0"), lost = answerOf("0");
    CHECK(warnings(kept).find("depends on tensile strength") == std::string::npos);
    CHECK(lost.at("safety_factor").get<double>() < 0.98 * kept.at("safety_factor").get<double>());
    const std::string told = "the answer with tensile strength kept: ";
    const std::string warning = warnings(lost);
    REQUIRE(warning.find(told) != std::string::npos);
    CHECK(std::stod(warning.substr(warning.find(told) + told.size())) ==
          doctest::Approx(kept.at("safety_factor").get<double>()).epsilon(1e-3));
    CHECK(lost.at("kept_cohesion").is_null());
}

TEST_CASE(
    "an answer that depends on friction lost at the first slip says so, with the one for friction that is "
    "kept") {
    const TemporaryFolder folder;
    const std::string path = folder.write(
        "flat.toml",
        "[material.rock]\ndensity = 2650.0\n[joint.default]\nnormal_stiffness = 1e11\nshear_stiffness = "
        "1e11\n"
        "friction_deg = 30.0\n[[stack]]\ncolumns = 1\nrows = 1\nslices = 1\nblock = [10.0, 1.0, 0.9]\n");
    for (const auto& friction : {std::pair{29.0, 21.0}, {24.0, 21.3}, {40.0, 35.0}, {30.0, 30.0}}) {
        const double peak = friction.first;
        const double residual = friction.second;
        CAPTURE(peak);
        CAPTURE(residual);
        const auto answer = runTalus({"critical-angle", path, "--json", "--quiet", "--set",
                                      "joint.default.friction_deg=" + std::to_string(peak), "--set",
                                      "joint.default.residual_friction_deg=" + std::to_string(residual)})
                                .json();
        const double angle = answer.at("critical_angle_deg");
        CHECK(angle > residual - 0.02);
        CHECK(angle < peak + 0.02);
        const std::string warnings = answer.at("warnings").dump();
        const bool loses = residual < peak;
        CHECK((warnings.find("the answer depends on peak friction that is lost") != std::string::npos) ==
              loses);
        const std::string told = "the answer with peak friction kept: ";
        REQUIRE((warnings.find(told) != std::string::npos) == loses);
        if (!loses) continue;
        CHECK(std::stod(warnings.substr(warnings.find(told) + told.size())) ==
              doctest::Approx(peak).epsilon(1e-3));
        CHECK(answer.at("kept_cohesion").is_null());
    }
    // What softens over a way is not lost at the first slip.
    const auto softens = runTalus({"critical-angle", path, "--json", "--quiet", "--set",
                                   "joint.default.residual_friction_deg=20", "--set",
                                   "joint.default.softening_displacement=0.01"})
                             .json();
    CHECK(softens.at("warnings").dump().find("depends on peak friction") == std::string::npos);
}

TEST_CASE(
    "blocks that a level table pushes off at any strength are told, and a history whose water never drains") {
    const TemporaryFolder folder;
    // A wedge of rock on a joint that daylights, with water up to its crest.
    const std::string slope =
        "[material.rock]\ndensity = 2650.0\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
        "friction_deg = 30.0\n[run]\nduration_s = 2.0\nstart = \"unstressed\"\n"
        "[rock_mass]\nregion = { profile = [[0, -3], [20, -3], [20, 12], [6.9, 12], [0, 0]], y = [0, 1] }\n"
        "names = { slide = [6.0, 0.5, 8.0], base = [10.0, 0.5, 0.0] }\nfixed = [{ name = \"base\" }]\n"
        "[[single_joint]]\nname = \"plane\"\npoint = [0.0, 0.0, 0.0]\ndip_deg = 40\ndip_direction_deg = 270\n"
        "[[water]]\njoint = \"plane\"\nelevation = 14.0\n";
    const std::string path = folder.write("slope.toml", slope);
    const auto warns = [](const Outcome& outcome, const std::string& text) {
        const std::string all = outcome.json().at("warnings").dump();
        CAPTURE(all);
        return all.find(text) != std::string::npos;
    };
    const std::vector<std::string> quiet{"--json", "--quiet", "--threads", "1"};
    const auto with = [&](std::vector<std::string> words) {
        words.insert(words.end(), quiet.begin(), quiet.end());
        return runTalus(words);
    };
    CHECK(warns(with({"safety-factor", path}),
                "of the blocks that fall whatever the strength, \\\"slide\\\" with "));
    CHECK_FALSE(warns(with({"safety-factor", TALUS_SOURCE_DIR "/bench/verification/hoek-bray-crack-2m.toml"}),
                      "water pushes "));
    CHECK_FALSE(warns(with({"safety-factor", path, "--set", "water[0].elevation=1.0"}), "water pushes "));
    CHECK_FALSE(warns(with({"run", path}), "never drains"));  // at a millimetre, as rock does
    CHECK(runTalus({"run", path, "--quiet"})
              .out.find("water[0]: drains from joints that open wider than 0.001 m") != std::string::npos);
    const std::string undrained = folder.write(
        "box.toml",
        blockScenario(
            30, 20,
            "[run]\nduration_s = 1.0\n[[water]]\nbetween = [\"key\", \"floor\"]\nhead = [0.2, 0.1]\n"));
    CHECK(warns(with({"run", undrained}), "water[0] never drains: block \\\"key\\\" is displaced by"));
}

TEST_CASE("no answer exceeds an upper bound inside its bracket") {
    using namespace talus;
    const auto scenario = formats::parseScenario(blockScenario(0, 12), "block.toml");
    REQUIRE(scenario);
    const Common common;
    SearchResult result;
    result.status = SearchStatus::found;
    result.low = 0.06130, result.high = 0.06140, result.answer = 0.06135;
    result.answer_interval = std::pair(result.answer, result.answer);
    const auto text = [&](double bound) {
        SearchReport report{common, *scenario, *loadSearch("critical-acceleration"), result, std::nullopt};
        report.result.upper_bound.value = bound;
        return searchText(report, false);
    };
    const auto has = [](const std::string& text, const std::string& what) {
        CAPTURE(text);
        CHECK(text.find(what) != std::string::npos);
    };
    has(text(0.06134), "0.0613, interval 0.0613 to 0.0613  (stands at 0.0613, fails at 0.0614)");
    has(text(0.06134),
        "upper bound       0.0613  (limit analysis, joints that open as they slide; it lies in the answer's "
        "bracket)");
    has(text(0.0612), "0.0614, interval 0.0614 to 0.0614");
    has(text(0.0612),
        "0.0612  (limit analysis, joints that open as they slide; the answer is higher by 0.0002");
    for (const double bound : {0.061352, 0.07}) {
        has(text(bound), "0.0614, interval 0.0614 to 0.0614");
        has(text(bound), "joints that open as they slide)");
    }
}

TEST_CASE("a model in which no block can move has no answer: bad input, with the joints that cut nothing") {
    const TemporaryFolder folder;
    const std::string held = folder.write(
        "held.toml",
        "[material.rock]\ndensity = 2650.0\n[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 1e9\n"
        "friction_deg = 30.0\n[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [4, 2, 3] } }\n"
        "fixed = [{ boundary = \"-z\" }]\n[[single_joint]]\nname = \"A\"\npoint = [0, 0, 20]\ndip_deg = 48\n"
        "dip_direction_deg = 220\n[[single_joint]]\npoint = [0, 0, 20]\ndip_deg = 52\ndip_direction_deg = "
        "325\n");
    const std::string blocks = folder.write(
        "blocks.toml", blockScenario(0, 20).replace(blockScenario(0, 20).find("name = \"key\""), 0,
                                                    "driven = true\nvelocity = [0.1, 0, 0]\n"));
    for (const std::vector<std::string>& command : {std::vector<std::string>{"critical-angle"},
                                                    {"safety-factor"},
                                                    {"critical-acceleration"},
                                                    {"limit-analysis", "--for", "factor"}}) {
        CAPTURE(command[0]);
        auto words = command;
        words.insert(words.begin() + 1, held);
        const Outcome outcome = runTalus(words);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.out.empty());
        CHECK(outcome.err.find(
                  "held.toml:7:1: error: rock_mass: found no block that is free to move: the only block is "
                  "fixed; single_joint[0] (A) and single_joint[1] cut no block, allowed: ") !=
              std::string::npos);
        words[1] = blocks;
        CHECK(runTalus(words).err.find(
                  "all 2 blocks are fixed or driven, allowed: at least one free block") != std::string::npos);
    }
    const Outcome json = runTalus({"safety-factor", held, "--json", "--quiet"});
    CHECK(json.exit_code == 2);
    CHECK(json.json().at("ok") == false);
    CHECK(json.json().at("errors").size() == 1);
    CHECK(runTalus({"validate", held}).exit_code == 0);
    CHECK(runTalus({"safety-factor", held, "--quiet", "--set", "single_joint[0].point=[2.0, 0.0, 2.0]"})
              .exit_code == 0);
}

TEST_CASE("doubts of a scenario are reported with each result, in JSON, too") {
    const TemporaryFolder folder;
    const std::string path = folder.write("box.toml", blockScenario(12, 0.6, "[run]\nduration_s = 0.01\n"));
    for (const std::string command :
         {"critical-angle", "safety-factor", "critical-acceleration", "limit-analysis", "run", "validate"}) {
        CAPTURE(command);
        std::vector<std::string> words{command, path, "--json", "--quiet"};
        if (command == "limit-analysis") words.insert(words.end(), {"--for", "tilt"});
        const Outcome outcome = runTalus(words);
        CHECK(outcome.json().at("warnings").dump().find("is it in radians?") != std::string::npos);
    }
}

TEST_CASE("an answer for a small part of the slope says so, and how to search for the rest") {
    const TemporaryFolder folder;
    // A pebble on the steeper plane goes at tan(20)/tan(40), the block at tan(20)/tan(12).
    const auto slope = [&](const std::string& pebble) {
        return folder.write(
            "slope.toml",
            blockScenario(12, 20,
                          "[[block]]\nname = \"wedge\"\nfixed = true\nvertices = [[3,0,0],[4,0,0],"
                          "[4,0,0.5317094],[3,1,0],[4,1,0],[4,1,0.5317094]]\n" +
                              pebble));
    };
    const std::string pebble =
        "[[block]]\nname = \"pebble\"\nvertices = "
        "[[3.4,0.4,0.21268376],[3.6,0.4,0.31902564],[3.4,0.6,0.21268376],"
        "[3.6,0.6,0.31902564],[3.4,0.4,0.31268376],[3.6,0.4,0.41902564],[3.4,0.6,0.31268376],[3.6,0.6,0."
        "41902564]]\n";
    const std::string path = slope(pebble);
    const auto said = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"safety-factor", path, "--quiet", "--no-range"});
        return runTalus(more);
    };
    const auto json = said({"--json"}).json();
    CHECK(json.at("moving_blocks") == nlohmann::json{"pebble"});
    CHECK(json.at("moving_mass_share").get<double>() == doctest::Approx(0.004 / 0.504).epsilon(1e-6));
    CHECK(said({}).out.find("0.79 % of the free blocks' mass; --groups 4") != std::string::npos);
    slope(
        "[[block]]\nname = \"grain\"\nvertices = "
        "[[3.4,0.4,0.21268376],[3.42,0.4,0.223317948],[3.4,0.42,0.21268376],[3.42,0.42,0.223317948],"
        "[3.4,0.4,0.22268376],[3.42,0.4,0.233317948],[3.4,0.42,0.22268376],[3.42,0.42,0.233317948]]\n");
    CHECK(said({}).out.find("less than 0.01 % of the free blocks' mass") != std::string::npos);
    slope(pebble);
    const Outcome groups = said({"--groups", "2"});
    CHECK(groups.out.find("then fail") != std::string::npos);
    // Without an answer for a small part of the slope there is no advice.
    CHECK(groups.out.find("--groups 4") == std::string::npos);
    CHECK(said({"--set", "block[3].fixed=true"}).out.find("--groups 4") == std::string::npos);
    const Outcome rest = said({"--set", "analysis.least_mass_share=0.05"});
    CHECK(rest.exit_code == 0);
    CHECK(rest.out.find("factor of safety  1.71") != std::string::npos);
    CHECK(rest.out.find("removed before    between 0.433") != std::string::npos);
    CHECK(rest.out.find(": 1 with 0.79 % of the mass, 0.004 m3, ") != std::string::npos);
    const auto behind =
        runTalus({"safety-factor", path, "--json", "--set", "analysis.least_mass_share=0.05"}).json();
    CHECK(behind.at("moving_blocks") == nlohmann::json{"key"});
    const double without = std::tan(talus::radians(20)) / std::tan(talus::radians(12));
    CHECK(behind.at("ceiling").get<double>() == doctest::Approx(without).epsilon(0.001));
    CHECK(behind.at("range").is_null());
    REQUIRE(behind.at("let_go").size() == 1);
    CHECK(behind.at("removed_blocks") == behind.at("let_go"));
    const auto& gone = behind.at("let_go")[0];
    CHECK(gone.at("blocks") == nlohmann::json{"pebble"});
    CHECK(gone.at("mass_share").get<double>() == doctest::Approx(0.004 / 0.504).epsilon(1e-6));
    CHECK(gone.at("safety_factor").get<double>() ==
          doctest::Approx(std::tan(talus::radians(20)) / std::tan(talus::radians(40))).epsilon(0.002));
    CHECK(gone.at("bracket").at(0) < gone.at("safety_factor"));
    CHECK(gone.at("safety_factor") < gone.at("bracket").at(1));
    const Outcome wrong = said({"--set", "analysis.least_mass_share=1"});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.err.find("least_mass_share") != std::string::npos);
}
