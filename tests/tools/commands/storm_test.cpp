// talus storm: what it prints and writes, and what it does not take.

#include <doctest/doctest.h>

#include <algorithm>

#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;

namespace {

/// Two columns of three blocks; the crack between them fills to its top in half an hour.
std::string rainy(const std::string& water =
                      "rain = [[0, 60], [1800, 60], [1810, 0], [3600, 0]]\n"
                      "catchment = 0.03\nleak_aperture = 1e-4\nleak_length = 3.0\n") {
    return "[gravity]\ntilt_deg = 12.0\n[material.rock]\ndensity = 2700.0\n[joint.default]\n"
           "normal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 19.5\n"
           "[[stack]]\ncolumns = 2\nrows = 3\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
           "[[water]]\nfissure = 1\ndepth = 0.0\nvolume = \"closed\"\nopening = 0.002\n" +
           water;
}

}  // namespace

TEST_CASE("storm: as JSON, as a table of CSV and as a picture") {
    const TemporaryFolder folder;
    const std::string slope = folder.write("rain.toml", rainy());
    const std::string plot = folder.path() + "/storm.svg", csv = folder.path() + "/storm.csv";
    const Outcome outcome = runTalus(
        {"storm", slope, "--step-s", "300", "--json", "--plot", plot, "--csv", csv, "--threads", "1"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const nlohmann::json json = outcome.json();
    CHECK(json.at("status") == "found");
    CHECK(json.at("waters") == nlohmann::json::array({"water[0]"}));
    const auto& times = json.at("times");
    REQUIRE(times.size() == 14);  // 1810 s, a time of the table, among them
    CHECK(times[0].at("time_s") == 0);
    CHECK(times[0].at("level_m") == 0);
    CHECK(times[7].at("time_s") == 1810);
    CHECK(times[13].at("time_s") == 3600);
    CHECK(times[6].at("level_m").get<double>() > times[13].at("level_m").get<double>());
    CHECK(times[6].at("safety_factor").get<double>() < times[0].at("safety_factor").get<double>());
    const auto& least = json.at("least");
    for (const auto& point : times)
        CHECK(least.at("safety_factor").get<double>() <= point.at("safety_factor").get<double>());
    CHECK(json.at("at_end")[0].at("leaked_m3").get<double>() > 0);
    CHECK(json.at("interrupted") == false);

    const std::string table = contentOf(csv);
    CHECK(table.find("\ntime_s,water[0].level_m,safety_factor,low,high,status,failure_mode,from\n") !=
          std::string::npos);
    CHECK(std::count(table.begin(), table.end(), '\n') >= 15);
    const std::string drawn = contentOf(plot);
    CHECK(drawn.find("factor of safety") != std::string::npos);
    CHECK(drawn.find("water level (m)") != std::string::npos);
}

TEST_CASE("storm: for people") {
    const TemporaryFolder folder;
    const std::string slope = folder.write("rain.toml", rainy());
    const Outcome people = runTalus({"storm", slope, "--step-s", "900", "--quiet"});
    CHECK(people.exit_code == 0);
    CHECK(people.err.empty());
    for (const char* text : {"least factor", "falls below 1", "leaked", "searches", "water[0].level_m"}) {
        CAPTURE(text);
        CHECK(people.out.find(text) != std::string::npos);
    }
}

TEST_CASE("storm: joints that lose strength over time, without water") {
    const TemporaryFolder folder;
    const std::string slope =
        folder.write("thaw.toml",
                     "[gravity]\ntilt_deg = 12.0\n[material.rock]\ndensity = 2700.0\n[joint.default]\n"
                     "normal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 30.0\n"
                     "strength_over_time = [[0, 1], [3600, 0.25]]\n"
                     "[[stack]]\ncolumns = 2\nrows = 2\nslices = 1\nblock = [0.2, 0.1, 0.1]\n");
    const std::string plot = folder.path() + "/storm.svg", csv = folder.path() + "/storm.csv";
    const Outcome outcome = runTalus({"storm", slope, "--json", "--plot", plot, "--csv", csv});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const nlohmann::json json = outcome.json();
    CHECK(json.at("waters").empty());
    CHECK(json.at("joints") == nlohmann::json::array({"default"}));
    REQUIRE(json.at("times").size() == 7);
    CHECK(json.at("times")[6].at("strengths") == nlohmann::json::array({0.25}));
    CHECK(json.at("times")[6].at("level_m").is_null());
    CHECK(json.at("least").at("time_s") == 3600);
    CHECK(json.at("failure_time_s").is_number());
    CHECK(contentOf(csv).find("\ntime_s,strength of default,safety_factor,low") != std::string::npos);
    CHECK(contentOf(plot).find("factor of strength") != std::string::npos);
    const Outcome people = runTalus({"storm", slope, "--quiet"});
    CHECK(people.exit_code == 0);
    CHECK(people.out.find("after 1.00 h, with 0.250 times the strength of default (") != std::string::npos);
}

TEST_CASE("storm: the line of the least factor names the joints whose strength is not 1, the least first") {
    const TemporaryFolder folder;
    std::string slope =
        "[gravity]\ntilt_deg = 20.0\n[material.rock]\ndensity = 2700.0\n"
        "[[block]]\nname = \"floor\"\nbox = { min = [-2, 0, -1], max = [9, 1, 0] }\nfixed = true\n";
    int at = 0;
    const auto add = [&](const std::string& joint, const std::string& last) {
        slope += "[joint." + joint +
                 "]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\nfriction_deg = 30.0\n"
                 "strength_over_time = [[0, 1], [100, " +
                 last + "]]\n";
        if (joint == "default") return;
        slope += "[[block]]\nname = \"on " + joint + "\"\njoint = \"" + joint + "\"\nbox = { min = [" +
                 std::to_string(2 * at) + ", 0, 0], max = [" + std::to_string(2 * at + 1) + ", 1, 0.5] }\n";
        ++at;
    };
    const auto least = [&] {
        const Outcome people =
            runTalus({"storm", folder.write("s.toml", slope), "--step-s", "50", "--quiet"});
        CAPTURE(people.err);
        REQUIRE(people.exit_code == 0);
        return people.out;
    };
    add("default", "0.99");
    add("clay", "0.4");
    CHECK(least().find("h, with 0.400 times the strength of clay, 0.990 of default (") != std::string::npos);
    add("ice", "0.7");
    add("marl", "0.8");
    CHECK(least().find("0.400 times the strength of clay, 0.700 of ice, 0.800 of marl and 1 more (") !=
          std::string::npos);
}

TEST_CASE("storm: what it does not take") {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& text, std::vector<std::string> options, const char* message) {
        options.insert(options.begin(), {"storm", folder.write("s.toml", text)});
        const Outcome outcome = runTalus(options);
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(message) != std::string::npos);
    };
    refused(rainy("rain = 10\n"), {}, "found rain without catchment");
    refused(rainy("rain = 10\ncatchment = 5\n"), {}, "--duration-s: found no table over time");
    refused(rainy("rain = [[0, -1], [9, 0]]\ncatchment = 5\n"), {}, "found -1, allowed: at least 0");
    refused(rainy(), {"--step-s", "0"}, "--step-s");
    refused(rainy(), {"--step-s", "0.01"}, "allowed: at least");
    refused(rainy(), {"--plot", folder.path() + "/storm.png"}, "a name that ends in .svg");
    refused(rainy(), {"--csv", folder.path() + "/storm.txt"}, "a name that ends in .csv");
    std::string held = rainy("");
    held.replace(held.find("volume = \"closed\"\nopening = 0.002\n"), 34, "");
    refused(held, {}, "found no water whose level changes");
}
