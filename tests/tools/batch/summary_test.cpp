// What rows say together, from rows made up for the purpose.

#include "batch/summary.h"

#include <doctest/doctest.h>

#include "batch/report.h"

namespace talus::tools::batch {

namespace {

using Role = Column::Role;

std::string lineOf(const Row& cells) {
    std::string line = csvLine(cells);
    line.pop_back();
    return line;
}

/// Two cases of ten samples: the answer is the friction angle less the case's depth.
StoredBatch madeUp() {
    StoredBatch batch;
    BatchInfo& info = batch.info;
    info.analysis = "critical-angle";
    info.runs = 20;
    info.cases = 2;
    info.samples = 10;
    info.thresholds = {14.5, 1, 40};
    for (const char* name : {"run", "case", "sample"})
        info.columns.push_back({name, "integer", "", "", Role::key});
    info.columns.push_back({"water[0].depth", "number", "m", "", Role::varied, "grid"});
    info.columns.push_back({"phi", "number", "deg", "", Role::varied, "random"});
    info.columns.push_back({"status", "string", "", ""});
    for (const char* name : {"critical_angle_deg", "bracket_low_deg", "bracket_high_deg"})
        info.columns.push_back({name, "number", "deg", ""});
    for (const char* name : {"failure_mode", "reason"}) info.columns.push_back({name, "string", "", ""});
    for (int run = 0; run < 20; ++run) {
        const int depth = run % 2, sample = run / 2, angle = 10 + sample - depth;
        batch.lines[static_cast<std::uint64_t>(run)] =
            lineOf({std::to_string(run), std::to_string(depth), std::to_string(sample), std::to_string(depth),
                    std::to_string(10 + sample), "found", std::to_string(angle), std::to_string(angle - 1),
                    std::to_string(angle + 1), sample < 3 ? "toppling" : "sliding", ""});
    }
    return batch;
}

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

TEST_CASE("the page has no outside resource and is escaped") {
    StoredBatch batch = madeUp();
    batch.info.sweep = "<b>&.toml";
    const std::string page = batchPage(summarise(batch), Json::object());
    CHECK(page.find("<b>&") == std::string::npos);
    CHECK(page.find("&lt;b&gt;&amp;.toml") != std::string::npos);
    for (const char* outside : {"src=", "href=\"http", "url(", "@import"})
        CHECK(page.find(outside) == std::string::npos);
    CHECK(toJson(summarise(batch))["all"]["failure"][0]["probability"] == doctest::Approx(0.55));
}

TEST_CASE("an empty batch has a page, too") {
    StoredBatch batch = madeUp();
    batch.lines.clear();
    CHECK(batchPage(summarise(batch), Json::object()).find("Not finished") != std::string::npos);
}

}  // namespace talus::tools::batch
