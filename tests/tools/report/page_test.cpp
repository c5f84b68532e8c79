// The page of a report: what the program puts into it, and what a browser makes of it.

#include "report/page.h"

#include <doctest/doctest.h>

#include "batch/report.h"
#include "reproduction/page.h"
#include "support/browser.h"
#include "support/skip.h"
#include "tools/batch/samples.h"
#include "tools/reproduction/samples.h"
#include "verification/manual.h"

namespace talus::tools {

namespace {

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

/// The JSON inside a page.
Json dataOf(const std::string& page) {
    const std::string start = "<script id=\"report\" type=\"application/json\">";
    const auto begin = page.find(start) + start.size();
    return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// The rows of the manual that take the least time.
Json quickManual() {
    std::vector<VerificationRow> rows = verificationRows();
    std::erase_if(rows, [](const VerificationRow& row) { return row.seconds > 0.3; });
    const std::atomic<bool> stop = false;
    return manualReport({.rows = verify(rows, 2, stop, {}),
                         .quick = true,
                         .interrupted = false,
                         .wall_seconds = 0,
                         .provenance = Json::object()});
}

const char* const kHostile =
    "</script><script>window.ran = true</script><!-- \"quoted\" & 'single' \\ \u2028";

Json hostileReport() {
    Report report;
    report.title = report.heading = kHostile;
    report.opening = Json::array({paragraph(kHostile, "lead")});
    Drawing drawing{kHostile, kHostile, {{"stable", {{0, 0}, {1, 0}, {1, 1}}, kHostile}}};
    drawing.caption_title = drawing.caption = kHostile;
    drawing.links = {{"javascript:window.ran=true", kHostile}, {"https://example.org/", kHostile}};
    Plot plot{"hostile", kHostile, kHostile, PlotAxis{kHostile}, PlotAxis{kHostile}};
    plot.x.categories = {kHostile, "b"};
    plot.series = {{"points", "dem", kHostile, {{0, 1}, {1, 2}}, {kHostile, kHostile}}};
    report.sections = Json::array({section(
        "hostile-section", kHostile, "Names that would like to be markup",
        {facts({{kHostile, kHostile}}), file(kHostile, kHostile), drawings({drawing}, false), toJson(plot),
         table(kHostile, Json::array({textColumn(kHostile)}), Json::array({Json::array({kHostile})}))})});
    return toJson(report);
}

}  // namespace

TEST_CASE("nothing in a report ends its script element, and all of it comes back") {
    const std::string bare(kReportPage), page = reportPage(hostileReport());
    CHECK(count(page, "</script") == count(bare, "</script") + 1);
    CHECK(count(page, "<!--") + 1 == count(bare, "<!--"));  // the place is filled
    CHECK(dataOf(page) == hostileReport());
}

TEST_CASE("text that is not UTF-8 does not stop a page") {
    Report report;
    report.heading = "caf\xe9";
    CHECK(dataOf(reportPage(toJson(report)))["heading"] == "caf\ufffd");
}

TEST_CASE("the page lets no script run but its own, and loads nothing") {
    const std::string page(kReportPage);
    CHECK(count(page,
                "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
                "'sha256-") == 1);
    for (const char* outside : {"<link", "@import", "url(http", "src=\"http"})
        CHECK(count(page, outside) == 0);
    for (const char* package : {"@observablehq/plot 0", "d3-scale 4", "isoformat 0"})
        CHECK_MESSAGE(count(page, package) == 1, package);
}

TEST_CASE("values that are not there are null, not numbers that are none") {
    CHECK(maybe(std::nullopt).is_null());
    CHECK(maybe(kInfinity).is_null());
    CHECK(maybe(1.5) == 1.5);
}

TEST_SUITE("slow: report page") {
    TEST_CASE(
        "Chromium draws every plot, table and drawing of the reports, and nothing is wider than the screen") {
        const testing::TemporaryFolder folder;
        std::string pages;
        const auto add = [&](const std::string& name, const Json& report) {
            pages += " '" + folder.write(name + ".html", reportPage(report)) + "'";
        };
        add("hostile", hostileReport());
        add("paper", paperReport(samples::results()));
        const Json provenance{{"version", "1.2.3"}};
        batch::Summary summary = batch::summarise(batch::samples::madeUp());
        summary.info.sweep = "made-up.toml";
        add("batch", batch::batchReport(summary, provenance));
        add("verification", quickManual());
        const testing::ScriptOutcome seen =
            testing::runScript("tools/report/page.test.mjs", "\"$CHROMIUM\"" + pages);
        if (seen.is_skipped)
            return test::skip("node, npm, chromium or playwright-core are not to be had here");
        INFO(seen.said);
        CHECK(seen.status == 0);
        CHECK(seen.said.find("8 passed, 0 failed") != std::string::npos);
    }
}

}  // namespace talus::tools
