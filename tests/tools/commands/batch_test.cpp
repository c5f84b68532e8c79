// talus batch as a user runs it: results, restart, interruption, kill -9, full disk, two processes, shards.

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "cli/text.h"
#include "tools/batch_folder.h"

namespace talus::tools::testing {

namespace {

std::string cellOf(const std::string& path, int run, const std::string& column) {
    const auto lines = linesOf(path);
    const Row header = csvFields(lines.at(0));
    const auto index = std::find(header.begin(), header.end(), column) - header.begin();
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const Row cells = csvFields(lines[i]);
        if (cells[0] == std::to_string(run)) return cells.at(static_cast<std::size_t>(index));
    }
    return "no such run";
}

}  // namespace

TEST_CASE("a grid of friction angles slides at each of them") {
    const BatchFolder batch(kGrid);
    const Outcome outcome = batch.run();
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json()["runs"] == 2);
    CHECK(outcome.json()["done"] == 2);
    CHECK(outcome.json()["failed"] == 0);
    CHECK(outcome.json()["wall_seconds"] > 0);
    const std::string results = batch.out() + "/results.csv";
    CHECK(std::stod(cellOf(results, 0, "critical_angle_deg")) == doctest::Approx(10).epsilon(0.001));
    CHECK(std::stod(cellOf(results, 1, "critical_angle_deg")) == doctest::Approx(15).epsilon(0.001));
    CHECK(cellOf(results, 1, "failure_mode") == "sliding");
    const auto metadata = nlohmann::json::parse(contentOf(results + "-metadata.json"));
    CHECK(metadata["tableSchema"]["columns"].size() == csvFields(linesOf(results)[0]).size());
    CHECK(metadata["tableSchema"]["columns"][3]["schema:unitText"] == "deg");
    CHECK(contentOf(batch.out() + "/report.html").find("</html>") != std::string::npos);
}

TEST_CASE("a sample without free blocks counts as stable, and says so") {
    const BatchFolder batch(
        "[[grid]]\nfield = \"single_joint[0].point[2]\"\nvalues = [1.0, 200.0]\n", "safety-factor",
        "[material.rock]\ndensity = 2650.0\n[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 1e9\n"
        "friction_deg = 20.0\n[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [2, 1, 2] } }\n"
        "fixed = [{ boundary = \"-z\" }]\n[[single_joint]]\nname = \"A\"\npoint = [1.0, 0.5, 1.0]\ndip_deg = "
        "30\n"
        "dip_direction_deg = 270\n");
    const Outcome outcome = batch.run();
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json()["failed"] == 0);
    const std::string results = batch.out() + "/results.csv";
    CHECK(std::stod(cellOf(results, 0, "safety_factor")) ==
          doctest::Approx(std::tan(20 * kDegree) / std::tan(30 * kDegree)).epsilon(0.002));
    CHECK(cellOf(results, 0, "reason").find("no block") == std::string::npos);
    CHECK(cellOf(results, 1, "status") == "stable_to_stop");
    CHECK(cellOf(results, 1, "reason")
              .find("found no block that is free to move: the only block is fixed; "
                    "single_joint[0] (A) cuts no block") != std::string::npos);
}

TEST_CASE("a batch tells the warnings of its inputs and of its runs") {
    std::string scenario = blockScenario(5, 20);
    scenario.insert(scenario.find("friction_deg"), "cohesion = 9e3\nresidual_cohesion = 2e3\n");
    const BatchFolder batch("[[grid]]\nfield = \"joint.default.cohesion\"\nvalues = [0, 1e3, 9e3]\n",
                            "safety-factor", scenario);
    const Outcome text = runTalus({"batch", batch.path, "-o", batch.out(), "--quiet"});
    REQUIRE(text.exit_code == 0);
    const std::string said = "joint.default.residual_cohesion: 2000 is more than cohesion, ";
    CHECK(text.out.find("warning: 2 of 3 runs, with the numbers of run 0: " + said + "0: ") !=
          std::string::npos);
    const nlohmann::json warnings = batch.run().json()["warnings"];
    REQUIRE_FALSE(warnings.empty());  // that of lost cohesion comes after it
    CHECK(warnings[0]["runs"] == 2);
    CHECK(warnings[0]["first_run"] == 0);
    CHECK(warnings[0]["numbers_differ"] == true);
    CHECK(nlohmann::json::parse(contentOf(batch.out() + "/summary.json"))["warnings"] == warnings);
    CHECK(contentOf(batch.out() + "/report.html").find(said) != std::string::npos);
    const std::string results = batch.out() + "/results.csv";
    CHECK(cellOf(results, 1, "warnings").find(said + "1000: ") == 0);
    CHECK(cellOf(results, 2, "warnings").find(said) == std::string::npos);
}

TEST_CASE("the rows are those of the single commands, for any number of threads") {
    const BatchFolder batch(draws(6));
    REQUIRE(batch.run({"--threads", "1"}).exit_code == 0);
    const auto one = rowsOf(batch.out() + "/results.csv");
    REQUIRE(
        runTalus({"batch", batch.path, "-o", batch.folder / "two", "--threads", "3", "--quiet"}).exit_code ==
        0);
    CHECK(rowsOf(batch.folder / "two" + "/results.csv") == one);
    const std::string scenario = batch.folder / "run4.toml";
    REQUIRE(runTalus({"sample", batch.path, "4", "-o", scenario}).exit_code == 0);
    const auto alone = runTalus({"critical-angle", scenario, "--json", "--quiet"}).json();
    CHECK(alone["state_hash"] == cellOf(batch.out() + "/results.csv", 4, "state_hash"));
}

TEST_CASE("a batch that tries other loading histories has the ranges of the single commands") {
    // Columns of unequal heights, which stand in more than one way.
    const auto stack = [](const std::string& heights) {
        return "[material.rock]\ndensity = 2650.0\n[joint.default]\nnormal_stiffness = 1e11\n"
               "shear_stiffness = 1e11\nfriction_deg = 28.0\n[[stack]]\ncolumns = 3\nrows = 6\n"
               "heights = " +
               heights + "\nslices = 1\nblock = [1.0, 1.0, 0.6]\n";
    };
    const std::string sweep =
        "range = true\nsamples = 4\n[[random]]\nfield = \"joint.default.friction_deg\"\n"
        "distribution = \"uniform\"\nmin = 22\nmax = 32\n[report]\ntilt_deg = [16.0]\n";
    int ranges = 0;
    for (const std::string heights : {"[6, 2, 6]", "[3, 6, 2]"}) {
        if (test::kTriesFew && ranges > 0) continue;
        const BatchFolder batch(sweep, "critical-angle", stack(heights));
        REQUIRE(batch.run().exit_code == 0);
        const std::string results = batch.out() + "/results.csv";
        for (int run = 0; run < 4; ++run) {
            const std::string path = batch.folder / ("run" + std::to_string(run) + ".toml");
            REQUIRE(runTalus({"sample", batch.path, std::to_string(run), "-o", path}).exit_code == 0);
            const auto alone = runTalus({"critical-angle", path, "--json", "--quiet"}).json();
            CHECK(alone["range_reason"] == cellOf(results, run, "range_reason"));
            for (const auto& [key, end] : {std::pair{"interval_low_deg", 0}, {"interval_high_deg", 1}})
                CHECK(std::stod(cellOf(results, run, key)) ==
                      alone["answer_interval"][static_cast<std::size_t>(end)].get<double>());
            for (const char* key : {"failing_volume_m3", "failing_mass_kg"})
                CHECK(std::stod(cellOf(results, run, key)) == alone[key].get<double>());
            const std::string low = cellOf(results, run, "range_low_deg");
            REQUIRE(low.empty() == alone["range"].is_null());
            CHECK(std::stod(cellOf(results, run, "moving_mass_share")) ==
                  doctest::Approx(alone["moving_mass_share"].get<double>()));
            if (low.empty()) continue;
            ++ranges;
            CHECK(std::stod(low) == alone["range"][0].get<double>());
            CHECK(std::stod(cellOf(results, run, "range_high_deg")) == alone["range"][1].get<double>());
        }
        const auto summary = nlohmann::json::parse(contentOf(batch.out() + "/summary.json"))["all"];
        CHECK(summary["failure_at_range_low"][0]["failed"] >= summary["failure"][0]["failed"]);
    }
    CHECK(ranges > 0);
    const BatchFolder history("range = true\n" + kGrid, "run",
                              blockScenario(20, 12, "[run]\nduration_s = 0.01\n"));
    const Outcome refused = history.run();
    CHECK(refused.exit_code == 2);
    CHECK(refused.err.find("sweep.toml:3:9: error: range: found with analysis = \"run\"") !=
          std::string::npos);
}

TEST_CASE("safety factors, histories, and their probabilities") {
    const BatchFolder factor(draws(40) + "[report]\nfactor = [1.0]\n", "safety-factor",
                             blockScenario(11, 12));
    REQUIRE(factor.run().exit_code == 0);
    const auto summary = nlohmann::json::parse(contentOf(factor.out() + "/summary.json"));
    // F = tan(phi) / tan(11 deg), phi uniform in 10..14: less than 1 with probability 1/4.
    const auto failure = summary["all"]["failure"][0];
    CHECK(failure["of"] == 40);
    CHECK(failure["interval"][0] < 0.25);
    CHECK(failure["interval"][1] > 0.25);
    CHECK(summary["sensitivity"][0]["rank_correlation"] > 0.999);
    const std::string factors = factor.out() + "/results.csv";
    CHECK(std::stod(cellOf(factors, 3, "theory_factor")) ==
          doctest::Approx(std::stod(cellOf(factors, 3, "safety_factor"))).epsilon(0.001));

    const BatchFolder history(kGrid, "run",
                              blockScenario(20, 12, "[run]\nduration_s = 0.01\nwatch = [\"key\"]\n"));
    REQUIRE(history.run().exit_code == 0);
    const std::string results = history.out() + "/results.csv";
    CHECK(cellOf(results, 1, "status") == "finished");
    // s = g (sin 20 - cos 20 tan phi) t^2 / 2; the elastic start costs a little.
    const double exact = 0.5 * 9.81 * (0.342020 - 0.939693 * 0.176327) * 1e-4;
    CHECK(std::stod(cellOf(results, 0, "key.displacement_m")) == doctest::Approx(exact).epsilon(0.1));
}

TEST_CASE("the same command repeats nothing, and continues with more samples") {
    const BatchFolder batch(draws(4));
    REQUIRE(batch.run().json()["computed"] == 4);
    const std::string before = contentOf(batch.out() + "/results.csv");
    const Outcome again = batch.run();
    CHECK(again.exit_code == 0);
    CHECK(again.json()["computed"] == 0);
    CHECK(again.json()["done"] == 4);
    CHECK(contentOf(batch.out() + "/results.csv") == before);
    batch.folder.write("sweep.toml", "scenario = \"block.toml\"\nanalysis = \"critical-angle\"\n" + draws(7));
    CHECK(batch.run().json()["computed"] == 3);
    CHECK(rowsOf(batch.out() + "/results.csv").size() == 7);
}

TEST_CASE("with fewer samples the rows of a larger batch stay, and nothing counts them") {
    // Each run has a warning.
    std::string scenario = blockScenario(5, 20);
    scenario.insert(scenario.find("friction_deg"), "residual_cohesion = 2e3\n");
    const BatchFolder batch(draws(7), "safety-factor", scenario);
    REQUIRE(batch.run().json()["rows_beyond"] == 0);
    const std::string results = batch.out() + "/results.csv", before = contentOf(results);
    const auto sweepOf = [&](int samples) {
        batch.folder.write("sweep.toml",
                           "scenario = \"block.toml\"\nanalysis = \"safety-factor\"\n" + draws(samples));
    };
    sweepOf(3);
    const Outcome text = runTalus({"batch", batch.path, "-o", batch.out(), "--quiet"});
    CHECK(text.exit_code == 0);
    CHECK(text.out.find("3 of 3 runs done; 0 computed") == 0);
    CHECK(text.out.find("\n4 rows of a batch with more samples stay in " + results + " and do not count\n") !=
          std::string::npos);
    CHECK(text.out.find("warning: 3 of 3 runs") != std::string::npos);
    CHECK(batch.run().json()["rows_beyond"] == 4);
    CHECK(contentOf(results) == before);
    const auto summary = nlohmann::json::parse(contentOf(batch.out() + "/summary.json"));
    CHECK(summary["runs"] == 3);
    CHECK(summary["done"] == 3);
    CHECK(summary["rows_beyond"] == 4);
    CHECK(summary["all"]["decided"] == 3);
    CHECK(contentOf(batch.out() + "/report.html").find("4 rows of a batch with more") != std::string::npos);
    // They count again once the sweep has as many samples.
    sweepOf(7);
    const Outcome again = batch.run();
    CHECK(again.json()["computed"] == 0);
    CHECK(again.json()["done"] == 7);
    CHECK(again.json()["rows_beyond"] == 0);
    CHECK(contentOf(results) == before);
}

TEST_CASE("the results of another sweep are not touched") {
    const BatchFolder batch(draws(2));
    REQUIRE(batch.run().exit_code == 0);
    const std::string before = contentOf(batch.out() + "/results.csv");
    batch.folder.write("block.toml", blockScenario(0, 12, "velocity = [0, 0, 0]\n"));
    const Outcome other = batch.run();
    CHECK(other.exit_code == 2);
    CHECK(other.err.find("another sweep") != std::string::npos);
    CHECK(contentOf(batch.out() + "/results.csv") == before);
}

TEST_CASE("rows with other columns, of another version, are not touched") {
    const BatchFolder batch(draws(2));
    REQUIRE(batch.run().exit_code == 0);
    const std::string results = batch.out() + "/results.csv", description = batch.out() + "/batch.json";
    const std::string before = contentOf(results);
    auto info = nlohmann::json::parse(contentOf(description));
    info["columns"].erase(info["columns"].size() - 2);
    std::ofstream(description) << info.dump();
    const Outcome other = batch.run();
    CHECK(other.exit_code == 2);
    CHECK(other.err.find("other columns") != std::string::npos);
    CHECK(contentOf(results) == before);
}

TEST_CASE("a failed run is a row with its reason, the batch continues, and --retry computes it again") {
    // Normal deviates below zero are no friction angles.
    const BatchFolder batch(
        "samples = 12\nseed = 2\n[[random]]\nfield = \"joint.default.friction_deg\"\ndistribution = "
        "\"normal\"\nmean "
        "= 2\nsd = 4\n");
    const Outcome outcome = batch.run();
    CHECK(outcome.exit_code == 3);
    const int failed = outcome.json()["failed"];
    CHECK(failed > 0);
    CHECK(failed < 12);
    CHECK(outcome.json()["done"] == 12);
    int rows = 0;
    for (int run = 0; run < 12; ++run) {
        if (cellOf(batch.out() + "/results.csv", run, "status") != "failed") continue;
        CHECK(
            cellOf(batch.out() + "/results.csv", run, "reason").find("joint.default.friction_deg: found -") ==
            0);
        ++rows;
    }
    CHECK(rows == failed);
    CHECK(batch.run().json()["computed"] == 0);
    CHECK(batch.run({"--retry"}).json()["computed"] == failed);
}

TEST_CASE("Ctrl-C keeps the rows so far, and the same command finishes them") {
    const BatchFolder batch(draws(3000));
    Program program(batch.command({"--threads", "2"}));
    const std::string results = batch.out() + "/results.csv";
    REQUIRE(waitFor([&] { return rowCount(results) > 20; }));
    program.signal(SIGINT);
    const Outcome outcome = program.outcome();
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.json()["interrupted"] == true);
    const auto rows = rowsOf(results);
    CHECK(rows.size() == outcome.json()["done"]);
    CHECK(rows.size() < 3000);
}

TEST_CASE("after kill -9 and a torn row the batch ends as if nothing had happened") {
    const BatchFolder batch(draws(60));
    Program program(batch.command({"--threads", "1"}));
    const std::string results = batch.out() + "/results.csv";
    REQUIRE(waitFor([&] { return rowCount(results) > 5; }));
    program.signal(SIGKILL);
    CHECK(program.outcome().exit_code == 128 + SIGKILL);
    std::ofstream(results, std::ios::app) << "59,59,0,12.3";
    REQUIRE(batch.run().exit_code == 0);
    REQUIRE(runTalus({"batch", batch.path, "-o", batch.folder / "whole", "--quiet"}).exit_code == 0);
    CHECK(rowsOf(results) == rowsOf(batch.folder / "whole" + "/results.csv"));
}

TEST_CASE("two processes on one folder share the work") {
    const BatchFolder batch(draws(300));
    Program first(batch.command({"--threads", "1"})), second(batch.command({"--threads", "1"}));
    const auto one = first.outcome(), two = second.outcome();
    CHECK(one.exit_code == 0);
    CHECK(two.exit_code == 0);
    CHECK(int(one.json()["computed"]) + int(two.json()["computed"]) == 300);
    CHECK(int(one.json()["computed"]) > 0);
    CHECK(int(two.json()["computed"]) > 0);
    CHECK(rowsOf(batch.out() + "/results.csv").size() == 300);
}

TEST_CASE("shards add up to the whole, again and again") {
    std::string other = draws(5);
    other.replace(other.find("joint.default.friction_deg"), 26, "material.rock.density");
    const BatchFolder batch(other + kGrid);
    std::size_t rows = 0;
    for (const std::string shard : {"1/3", "2/3", "3/3", "2/3"}) {
        const Outcome outcome = batch.run({"--shard", shard});
        CHECK(outcome.exit_code == 0);
        rows += static_cast<std::size_t>(outcome.json()["computed"]);
    }
    CHECK(rows == 10);
    REQUIRE(runTalus({"merge", batch.out(), "-o", batch.folder / "merged"}).exit_code == 0);
    REQUIRE(runTalus({"batch", batch.path, "-o", batch.folder / "whole", "--quiet"}).exit_code == 0);
    CHECK(rowsOf(batch.folder / "merged" + "/results.csv") ==
          rowsOf(batch.folder / "whole" + "/results.csv"));
    CHECK(batch.run({"--shard", "0/3"}).exit_code == 2);
    CHECK(batch.run({"--shard", "4/3"}).exit_code == 2);
    CHECK(batch.run({"--shard", "half"}).exit_code == 2);
}

TEST_CASE("a merge says what is missing and refuses another sweep's results") {
    const BatchFolder batch(draws(4));
    REQUIRE(batch.run({"--shard", "1/2"}).exit_code == 0);
    const Outcome half = runTalus({"merge", batch.out(), "--json"});
    CHECK(half.exit_code == 3);
    CHECK(half.json()["missing"] == 2);
    const BatchFolder other(draws(5) + "mode = 3\n");
    CHECK(other.run().exit_code == 2);  // no such key in a uniform distribution
    const BatchFolder stranger("seed = 9\n" + draws(4));
    REQUIRE(stranger.run().exit_code == 0);
    CHECK(runTalus({"merge", batch.out(), stranger.out()}).exit_code == 2);
    CHECK(runTalus({"merge", batch.folder / "nowhere"}).exit_code == 2);
}

TEST_CASE("a full disk ends the batch with what was written") {
    const BatchFolder batch(draws(4));
    // /dev/full takes no byte; as the results file it stands for a disk without room.
    REQUIRE(::mkdir(batch.out().c_str(), 0700) == 0);
    std::filesystem::create_symlink("/dev/full", batch.out() + "/results.csv");
    const Outcome outcome = batch.run();
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.err.find("No space left on device") != std::string::npos);
}

TEST_CASE("--plan counts and computes nothing") {
    const BatchFolder batch(kGrid);
    const Outcome outcome = runTalus({"batch", batch.path, "--plan", "--json"});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.json()["runs"] == 2);
    CHECK(outcome.json()["first"][1]["joint.default.friction_deg"] == "15");
    CHECK(runTalus({"batch", batch.path}).exit_code == 2);
}

TEST_CASE("a foreign results.csv is left as it is, its torn last line too") {
    const BatchFolder batch(kGrid);
    std::filesystem::create_directory(batch.out());
    const std::string foreign = "depth,result\n1.0,ok\n2.0,tor";
    const std::string path = batch.folder.write("out/results.csv", foreign);
    const Outcome outcome = batch.run();
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find("not a table of this sweep's results") != std::string::npos);
    CHECK(contentOf(path) == foreign);
    CHECK_FALSE(std::filesystem::exists(batch.out() + "/batch.json"));
}

TEST_CASE("a merge does not replace results that others are still adding to, nor those of others") {
    const BatchFolder batch(draws(100000));
    Program program(batch.command());
    REQUIRE(waitFor([&] {
        return std::filesystem::exists(batch.out() + "/results.csv") &&
               contentOf(batch.out() + "/results.csv").size() > 1000;
    }));
    CHECK(runTalus({"merge", batch.out()}).exit_code == 4);
    program.signal(SIGINT);
    CHECK(program.outcome().exit_code == 130);
    std::filesystem::create_directory(batch.folder / "other");
    const std::string foreign = batch.folder.write("other/results.csv", "a,b\n1,2\n");
    CHECK(runTalus({"merge", batch.out(), "-o", batch.folder / "other"}).exit_code == 2);
    CHECK(contentOf(foreign) == "a,b\n1,2\n");
}

TEST_CASE("reports that are of no batch are left as they are") {
    const BatchFolder batch(kGrid);
    REQUIRE(batch.run().exit_code == 0);
    for (const std::string name : {"summary.json", "report.json", "report.html"}) {
        CAPTURE(name);
        const std::string folder = batch.folder / "foreign";
        std::filesystem::create_directory(folder);
        const std::string path = batch.folder.write("foreign/" + name, "mine");
        CHECK(runTalus({"merge", batch.out(), "-o", folder}).exit_code == 2);
        CHECK(runTalus({"batch", batch.path, "-o", folder}).exit_code == 2);
        CHECK(contentOf(path) == "mine");
        CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
        std::filesystem::remove_all(folder);
    }
}

TEST_CASE("a batch and a merge write into no link, whatever of theirs it stands for") {
    const BatchFolder batch(kGrid);
    REQUIRE(batch.run().exit_code == 0);
    const std::string victim = batch.folder.write("victim", "kept");
    for (const std::string name : {"batch.json", "results.csv", "results.csv-metadata.json", ".lock",
                                   "summary.json", "report.json", "report.html"})
        for (const bool leads_somewhere : {true, false}) {
            CAPTURE(name);
            CAPTURE(leads_somewhere);
            const std::string folder = batch.folder / "linked", link = folder + "/" + name;
            std::filesystem::create_directory(folder);
            std::filesystem::create_symlink(leads_somewhere ? victim : batch.folder / "nowhere", link);
            CHECK(runTalus({"merge", batch.out(), "-o", folder}).exit_code == 2);
            const Outcome outcome = runTalus({"batch", batch.path, "-o", folder});
            CHECK(outcome.exit_code == 2);
            CHECK(outcome.err.find("is a link") != std::string::npos);
            CHECK(contentOf(victim) == "kept");
            CHECK_FALSE(std::filesystem::exists(batch.folder / "nowhere"));
            CHECK(std::distance(std::filesystem::directory_iterator(folder), {}) == 1);
            std::filesystem::remove_all(folder);
        }
    // Of the results that it merges, too.
    const std::string folder = batch.folder / "linked", results = contentOf(batch.out() + "/results.csv");
    std::filesystem::create_directory(folder);
    std::filesystem::create_symlink(batch.out() + "/results.csv", folder + "/results.csv");
    CHECK(runTalus({"merge", batch.out(), "-o", folder}).exit_code == 2);
    CHECK(contentOf(batch.out() + "/results.csv") == results);
}

TEST_CASE("a batch whose folder is removed says so") {
    const BatchFolder batch(draws(100000));
    Program program(batch.command());
    REQUIRE(waitFor([&] { return std::filesystem::exists(batch.out() + "/results.csv"); }));
    // Moved away at one stroke: while entries are removed one by one, the batch may still add another.
    std::filesystem::rename(batch.out(), batch.folder / "removed");
    std::filesystem::remove_all(batch.folder / "removed");
    CHECK(program.outcome().exit_code == 4);
}

TEST_CASE("a batch whose results are truncated says so") {
    const BatchFolder batch(draws(100000));
    const std::string results = batch.out() + "/results.csv";
    Program program(batch.command());
    REQUIRE(waitFor([&] { return std::filesystem::exists(results) && linesOf(results).size() > 3; }));
    std::filesystem::resize_file(results, 0);
    CHECK(program.endsWithin(60));
    program.signal(SIGINT);
    const Outcome outcome = program.outcome();
    CHECK(outcome.exit_code == 4);
    CHECK(outcome.err.find("truncated while the batch went on") != std::string::npos);
}

}  // namespace talus::tools::testing
