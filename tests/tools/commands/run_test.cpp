// talus run: the history file, its protection, and what is left of an interrupted run.

#include <doctest/doctest.h>

#include <algorithm>

#include "tools/program.h"

using namespace talus::tools::testing;

namespace {

std::string slidingScenario(const std::string& duration) {
    return blockScenario(
        30, 20, "[run]\nduration_s = " + duration + "\nframe_interval_s = 0.01\nwatch = [\"key\"]\n");
}

std::vector<std::string> dataLines(const std::string& csv) {
    std::vector<std::string> lines;
    std::istringstream text(csv);
    for (std::string line; std::getline(text, line);)
        if (!line.starts_with("#")) lines.push_back(line);
    return lines;
}

}  // namespace

TEST_CASE("a run writes its history and reports the watched blocks") {
    const TemporaryFolder folder;
    const std::string path = folder.write("run.toml", slidingScenario("0.05")), csv = folder / "history.csv";
    const Outcome outcome = runTalus({"run", path, "-o", csv, "--json", "--quiet"});
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    const auto json = outcome.json();
    for (const char* key :
         {"steps", "simulated_seconds", "time_step_s", "blocks", "interfaces", "contact_points",
          "kinetic_energy_j", "state_hash", "wall_seconds", "watch", "provenance"}) {
        CAPTURE(key);
        CHECK(json.contains(key));
    }
    CHECK(json.at("simulated_seconds").get<double>() == doctest::Approx(0.05).epsilon(1e-3));
    const auto key = json.at("watch").at("key");
    CHECK(key.at("position_m").size() == 3);
    CHECK(key.at("velocity_m_s")[0].get<double>() < 0);  // downhill is -x
    CHECK(key.contains("rotation_deg"));

    const std::string text = contentOf(csv);
    CHECK(text.starts_with("# talus history\n"));
    CHECK(text.find("# git_hash: ") != std::string::npos);
    CHECK(text.ends_with("# end: finished\n"));
    const auto lines = dataLines(text);
    REQUIRE(lines.size() >= 1 + 6);  // the columns' names, then the start, every frame and the end
    CHECK(lines[0].starts_with("time_s,"));
    CHECK(lines[0].find("key.x_m") != std::string::npos);
    const auto commas = std::count(lines[0].begin(), lines[0].end(), ',');
    for (const std::string& line : lines) CHECK(std::count(line.begin(), line.end(), ',') == commas);
}

TEST_CASE("a finished history, another file and the scenario itself are not overwritten") {
    const TemporaryFolder folder;
    const std::string path = folder.write("run.toml", slidingScenario("0.01")), csv = folder / "history.csv";
    REQUIRE(runTalus({"run", path, "-o", csv}).exit_code == 0);
    const std::string before = contentOf(csv);
    CHECK(runTalus({"run", path, "-o", csv}).exit_code == 2);
    CHECK(contentOf(csv) == before);
    CHECK(runTalus({"run", path, "-o", csv, "--force"}).exit_code == 0);

    const std::string notes = folder.write("notes.txt", "not a history\n");
    CHECK(runTalus({"run", path, "-o", notes}).exit_code == 2);
    CHECK(contentOf(notes) == "not a history\n");
    CHECK(runTalus({"run", path, "-o", path, "--force"}).exit_code == 2);
    CHECK(contentOf(path) == slidingScenario("0.01"));
}

TEST_CASE("an unfinished history may be replaced") {
    const TemporaryFolder folder;
    const std::string csv = folder.write("history.csv", "# talus history\ntime_s,step\n0,0\n");
    CHECK(runTalus({"run", folder.write("run.toml", slidingScenario("0.01")), "-o", csv}).exit_code == 0);
    CHECK(contentOf(csv).ends_with("# end: finished\n"));
}

TEST_CASE("a full disk and a missing folder are the file system's refusal") {
    const TemporaryFolder folder;
    const std::string path = folder.write("run.toml", slidingScenario("0.05"));
    const Outcome full = runTalus({"run", path, "-o", "/dev/full", "--json"});
    CHECK(full.exit_code == 4);
    CHECK(full.json().at("ok") == false);
    CHECK(full.err.find("/dev/full") != std::string::npos);
    CHECK(runTalus({"run", path, "-o", folder / "no/such/folder.csv"}).exit_code == 4);
}

TEST_CASE("bad input leaves no history behind") {
    const TemporaryFolder folder;
    const std::string inside =
        "[[block]]\nname = \"inside\"\nbox = { min = [0.2, 0.2, 0.1], max = [0.8, 0.8, 0.4] }\n";
    const std::string path = folder.write("overlap.toml", blockScenario(10, 20, inside));
    CHECK(runTalus({"run", path, "-o", folder / "history.csv"}).exit_code == 2);
    CHECK_FALSE(std::filesystem::exists(folder / "history.csv"));
}

TEST_CASE("a step far above the stability bound ends the run as soon as blocks gain energy") {
    const TemporaryFolder folder;
    for (const std::string water : {"", "[[water]]\nblock = \"key\"\nface = \"+x\"\ndepth = 0.3\n"}) {
        const auto runWith = [&](const std::string& step) {
            const std::string path = folder.write(
                "run.toml",
                blockScenario(10, 20, "[run]\nduration_s = 0.3\ntime_step_s = " + step + "\n" + water));
            return runTalus({"run", path, "-o", folder / "h.csv", "--force"});
        };
        CHECK(runWith("1e-5").exit_code == 0);
        const Outcome outcome = runWith("8e-3");
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find("run.time_step_s") != std::string::npos);
        CHECK(outcome.err.find(water.empty() ? "numerical instability" : "unstable") != std::string::npos);
        CHECK(outcome.err.find("at most the stability bound") != std::string::npos);
    }
}

TEST_CASE("SIGINT and SIGTERM end a run with 130 and keep its rows; killed, the rows are there as well") {
    const TemporaryFolder folder;
    const std::string path = folder.write("long.toml", slidingScenario("10000.0"));
    for (const int number : {SIGINT, SIGTERM, SIGKILL}) {
        CAPTURE(number);
        const std::string csv = folder / ("history" + std::to_string(number) + ".csv");
        Program program({"run", path, "-o", csv, "--json"});
        REQUIRE(waitFor([&] { return dataLines(contentOf(csv)).size() > 5; }));
        program.signal(number);
        const Outcome outcome = program.outcome();
        const std::string text = contentOf(csv);
        CHECK(dataLines(text).size() > 5);
        if (number == SIGKILL) {
            CHECK(outcome.exit_code == 128 + SIGKILL);
            CHECK_FALSE(text.ends_with("# end: finished\n"));
        } else {
            CHECK(outcome.exit_code == 130);
            CHECK(outcome.json().at("interrupted") == true);
            CHECK(outcome.json().at("steps").get<long>() > 0);
            CHECK(text.ends_with("# end: interrupted\n"));
        }
    }
}

TEST_CASE("the page of a run: displacements over time above the record, and every block's at the end") {
    const TemporaryFolder folder;
    const std::string page = folder / "motion.html";
    const Outcome outcome = runTalus({"run", TALUS_SOURCE_DIR "/bench/verification/newmark-block.toml",
                                      "--report", page, "--json", "--quiet"});
    REQUIRE(outcome.exit_code == 0);
    const double slip = outcome.json().at("largest_displacement").at("displacement_m");
    const std::string text = contentOf(page), open = "<script id=\"report\" type=\"application/json\">";
    const std::size_t from = text.find(open) + open.size();
    const auto report = nlohmann::json::parse(text.substr(from, text.find("</script>", from) - from));
    const auto& plots = report.at("sections")[0].at("blocks");
    REQUIRE(plots.size() == 2);
    for (const auto& series : plots[0].at("series")) {  // the largest, and the watched block, which it is
        CHECK(series.at("rows").back()[0].get<double>() == doctest::Approx(1.6));
        CHECK(series.at("rows").back()[1].get<double>() == doctest::Approx(slip).epsilon(1e-6));
    }
    REQUIRE(plots[1].at("series").size() == 1);  // along x alone
    CHECK(plots[1].at("series")[0].at("rows")[5][1] == 4.0);
    CHECK(plots[1].at("series")[0].at("rows").back()[1] == 0.0);
    const auto& table = report.at("sections")[1].at("blocks")[0];
    REQUIRE(table.at("rows").size() == 1);
    CHECK(table.at("rows")[0][0] == "block");
    CHECK(table.at("rows")[0][1].get<double>() == doctest::Approx(slip));

    const std::string path = folder.write("run.toml", slidingScenario("0.05"));
    CHECK(runTalus({"run", path, "--report", folder / "motion.pdf"}).exit_code == 2);
    CHECK(runTalus({"run", "--resume", folder / "run.mcap", "--report", page}).exit_code == 2);
}

namespace {

/// Some 17,000 blocks, fewer where the program is slower: a second and more to build and bring to rest.
std::string largeStack() {
    const int columns = static_cast<int>(30 / kSlower);
    return "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 35\n"
           "[material.rock]\ndensity = 2600.0\n[run]\nduration_s = 1.0\n"
           "[[stack]]\nrows = 24\nslices = 24\nblock = [0.2, 0.1, 0.1]\ncolumns = " +
           std::to_string(columns) + "\n";
}

}  // namespace

TEST_CASE("Ctrl-C ends a run on the way to its start, too, within half a second, and says so") {
    const TemporaryFolder folder;
    const std::string path = folder.write("large.toml", largeStack());
    for (const double begun : {0.6, 1.0, 1.6, 2.4}) {
        CAPTURE(begun);
        Program program({"run", path, "-o", folder / "run.mcap", "--threads", "1"});
        REQUIRE(waitFor([&] { return program.hasBegun(begun); }));
        program.signal(SIGINT);
        CHECK(program.endsWithin(kSlower * 0.5));
        const Outcome outcome = program.outcome();
        CHECK(outcome.exit_code == 130);
        CHECK((outcome.out + outcome.err).find("interrupted") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(folder / "run.mcap"));
    }
}
