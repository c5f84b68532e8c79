// Statistics of made-up rows.

#include "batch/summary.h"

#include <doctest/doctest.h>

#include "batch/report.h"
#include "cli/json.h"
#include "tools/batch/samples.h"

namespace talus::tools::batch {

namespace {

using samples::lineOf;
using samples::madeUp;

void setStatus(StoredBatch& batch, std::uint64_t run, const std::string& status, const std::string& low,
               const std::string& high) {
    Row row = batch.row(run);
    row[5] = status;
    row[6] = "";
    row[7] = low;
    row[8] = high;
    batch.lines[run] = lineOf(row);
}

}  // namespace

TEST_CASE("distribution, probabilities, modes and sensitivity of all runs and of each case") {
    const Summary summary = summarise(madeUp());
    CHECK(summary.done == 20);
    CHECK(summary.all.moments.mean == doctest::Approx(14));
    REQUIRE(summary.cases.size() == 2);
    CHECK(summary.cases[1].label == "water[0].depth = 1");
    CHECK(summary.cases[1].moments.mean == doctest::Approx(13.5));
    CHECK(summary.all.failure[0].failed == 11);  // 10..14 and 9..14
    CHECK(summary.all.failure[0].count == 20);
    CHECK(summary.all.failure[1].failed == 0);
    CHECK(summary.all.failure[2].failed == 20);
    CHECK(summary.all.modes.at("toppling") == 6);
    REQUIRE(summary.sensitivities.size() == 2);
    CHECK(summary.sensitivities[0].column == "phi");
    CHECK(summary.sensitivities[0].correlation.rho > 0.9);
    CHECK(summary.sensitivities[1].correlation.rho < 0);
}

TEST_CASE("searches that did not reach a tilt are not counted there, and rank at the ends") {
    StoredBatch batch = madeUp();
    setStatus(batch, 0, "unstable_at_start", "", "5");  // fails below 5 deg
    setStatus(batch, 19, "stable_to_stop", "30", "");   // stands at 30 deg
    setStatus(batch, 18, "undecided", "", "");
    const Summary summary = summarise(batch);
    CHECK(summary.failed == 1);
    CHECK(summary.failures.front().first == 18);
    const auto& failure = summary.all.failure;
    CHECK(failure[0].count == 19);  // 14.5 deg: both can be told
    CHECK(failure[0].failed == 11);
    CHECK(failure[1].count == 18);  // 1 deg: whether run 0 stood there is not known
    CHECK(failure[2].count == 18);  // 40 deg: whether run 19 would is not known
    CHECK(summary.all.moments.count == 17);
    CHECK(summary.all.sorted.size() == 19);
}

namespace {

/// The same runs when other loading histories were tried: every run of the deeper case has a range down to
/// 9.2 degrees.
StoredBatch withRanges() {
    StoredBatch batch = madeUp();
    const StoredBatch without = batch;
    for (const char* name : {"range_low_deg", "range_high_deg"})
        batch.info.columns.push_back({name, "number", "deg", ""});
    for (auto& [run, line] : batch.lines) {
        Row row = without.row(run);
        row.insert(row.end(), 2, "");
        if (run % 2 == 1) row[row.size() - 2] = "9.2", row.back() = row[6];
        line = lineOf(row);
    }
    return batch;
}

}  // namespace

TEST_CASE("where other loading histories were tried, probabilities are those of both ends of the range") {
    const Summary summary = summarise(withRanges());
    CHECK(summary.all.ranges == 10);
    CHECK(summary.all.failure[0].failed == 11);  // below 14.5 degrees: 10..14 and 9..14
    REQUIRE(summary.all.failure_at_least.size() == 3);
    CHECK(summary.all.failure_at_least[0].failed == 15);  // 10..14, and all of the deeper case
    CHECK(summary.cases[0].ranges == 0);
    CHECK(summary.cases[0].failure_at_least[0].failed == summary.cases[0].failure[0].failed);
    const Json json = toJson(summary);
    CHECK(json["all"]["failure_at_range_low"][0]["failed"] == 15);
    CHECK(json["all"]["failure"][0]["failed"] == 11);
    CHECK(!toJson(summarise(madeUp()))["all"].contains("failure_at_range_low"));
    const Json report = batchReport(summary, Json::object());
    CHECK(report["opening"][1]["text"].get<std::string>().find("In 10 runs") == 0);
}

namespace {

/// The report's blocks of a section; null when it is not there.
Json blocksOf(const Json& report, const std::string& id) {
    for (const Json& section : report["sections"])
        if (section["id"] == id) return section["blocks"];
    return nullptr;
}

Json blockOf(const Json& report, const std::string& section, const std::string& id) {
    for (const Json& block : blocksOf(report, section))
        if (block.value("id", "") == id) return block;
    return nullptr;
}

}  // namespace

TEST_CASE("the report says how the runs are spread, with the probabilities and their intervals") {
    const Json report = batchReport(summarise(madeUp()), Json{{"version", "1.2.3"}});
    const Json distribution = blocksOf(report, "distribution");
    const Json& table = distribution[1];
    CHECK(table["columns"].back()["title"] == "critical angle below 40\u00b0");
    CHECK(table["rows"][0][0] == 20);
    CHECK(table["rows"][0][7]["share"] == doctest::Approx(0.55));
    CHECK(table["rows"][0][7]["low"].get<double>() < 0.55);
    double runs = 0;
    const Json histogram = blockOf(report, "distribution", "histogram");
    for (const Json& bar : histogram["series"][0]["rows"]) runs += bar[2].get<double>();
    CHECK(runs == 20);
    CHECK(histogram["references"].size() == 1);  // 14.5 deg; 1 and 40 lie beyond the answers
    CHECK(blockOf(report, "distribution", "share")["series"][1]["rows"].back() == Json::array({19, 1}));
}

TEST_CASE("the share of failed runs settles at what the table says, its interval closing in") {
    const Json report = batchReport(summarise(madeUp()), Json::object());
    const Json plot = blockOf(report, "convergence", "convergence-0");
    const Json& band = plot["series"][0]["rows"];
    const Json& share = plot["series"][1]["rows"];
    REQUIRE(share.size() == 20);
    CHECK(share[0] == Json::array({1, 1}));  // run 0 fails at 10 deg
    CHECK(share[19][1] == doctest::Approx(0.55));
    CHECK(band[19][2].get<double>() - band[19][1].get<double>() <
          band[3][2].get<double>() - band[3][1].get<double>());
}

TEST_CASE("the report shows what was drawn, and the grid as a grid") {
    const Json report = batchReport(summarise(madeUp()), Json::object());
    CHECK(blockOf(report, "inputs", "input-0").is_null());  // the depth is no draw
    double drawn = 0;
    const Json input = blockOf(report, "inputs", "input-1");
    for (const Json& bar : input["series"][0]["rows"]) drawn += bar[2].get<double>();
    CHECK(drawn == 20);
    CHECK(blocksOf(report, "maps").is_null());  // one grid makes no map
    CHECK(blockOf(report, "sensitivity", "correlations")["y"]["categories"] ==
          Json::array({"phi", "water[0].depth"}));
    const Json response = blockOf(report, "response", "response-0");
    CHECK(response["series"][1]["rows"] == Json::array({Json::array({0, 14.5}), Json::array({1, 13.5})}));
}

TEST_CASE("an empty batch has a report, too") {
    StoredBatch batch = madeUp();
    batch.lines.clear();
    const Json report = batchReport(summarise(batch), Json::object());
    CHECK(report["opening"][1]["text"] ==
          "Not finished: 20 runs are missing. Run the same command again to continue.");
    CHECK(blocksOf(report, "response").is_null());
    CHECK(!blocksOf(report, "origin").is_null());
}

}  // namespace talus::tools::batch
