// Interrupted searches and limit analyses: what they print, and their exit codes.

#include <doctest/doctest.h>

#include <atomic>
#include <vector>

#include "answers/search.h"
#include "support/wedged_columns.h"
#include "talus/formats/scenario.h"
#include "tools/program.h"

using namespace talus::tools;
using namespace talus::tools::testing;
using talus::test::kTriesFew;

TEST_CASE("an interrupted search says so once, with its results so far, and claims no answer") {
    const std::string slope = std::string(TALUS_SOURCE_DIR) + "/bench/verification/rock-slope-842.toml";
    const std::vector<double> times = kTriesFew ? std::vector{0.3} : std::vector{0.3, 1.0, 2.5};
    for (const double begun : times) {
        CAPTURE(begun);
        Program program({"safety-factor", slope, "--threads", "1", "--quiet"});
        REQUIRE(waitFor([&] { return program.hasBegun(kSlower * begun); }));
        program.signal(SIGINT);
        const Outcome outcome = program.outcome();
        CHECK(outcome.exit_code == 130);
        const std::string all = outcome.out + outcome.err;
        const std::size_t said = all.find("interrupted");
        REQUIRE(said != std::string::npos);
        CHECK(all.find("interrupted", said + 1) == std::string::npos);
        CHECK(outcome.out.find("failure mode") == std::string::npos);
        CHECK(outcome.out.find("theory") == std::string::npos);
        CHECK(outcome.out.find(", fails at") == std::string::npos);
    }
}

TEST_CASE("an interrupted limit analysis says so, with its bounds so far") {
    const std::string spur = std::string(TALUS_SOURCE_DIR) + "/bench/examples/spur.toml";
    Program program({"limit-analysis", spur, "--for", "factor", "--threads", "1", "--quiet"});
    REQUIRE(waitFor([&] { return program.hasBegun(kSlower * 1.0); }));
    program.signal(SIGINT);
    CHECK(program.endsWithin(kSlower * 0.5));
    const Outcome outcome = program.outcome();
    CHECK(outcome.exit_code == 130);
    CHECK(outcome.out.find("interrupted; so far: at least ") != std::string::npos);
    CHECK(outcome.out.find("undecided") == std::string::npos);
}

TEST_CASE("interrupted after the search, a command keeps its answer and ends with 130") {
    const TemporaryFolder folder;
    const auto scenario =
        talus::formats::readScenario(folder.write("columns.toml", talus::test::wedgedColumns(5)));
    REQUIRE(scenario.ok());
    for (const talus::LoadSearch& search : talus::loadSearches()) {
        for (const std::string stage : {"upper bound", "the interval"}) {
            CAPTURE(search.name);
            CAPTURE(stage);
            std::atomic<bool> stop = false;
            talus::Control control;
            control.stop = &stop;
            control.progress = [&](const talus::Progress& progress) {
                stop = stop || progress.stage == stage;
            };
            SearchRequest request;
            request.upper_bound = talus::Beside::always;
            const SearchReport report = answer(search, *scenario, request, {}, control);
            REQUIRE(stop);
            CHECK(exitCode(report) == 130);
            const Json json = searchJson(report);
            CHECK(json["status"] == "found");
            CHECK(json["interrupted"] == true);
            CHECK(json["answer_interval"].is_array());
            CHECK(json["ceiling"].is_null() == (stage == "upper bound"));
            if (stage == "upper bound")
                CHECK(searchText(report, false).find("limit analysis was interrupted") != std::string::npos);
        }
    }
}
