// The failing runs on the paper's page, on a slope small enough to be searched here.

#include <doctest/doctest.h>

#include <algorithm>

#include "cli/json.h"
#include "reproduction/kept.h"
#include "reproduction/slope.h"
#include "support/files.h"
#include "tools/reproduction/samples.h"

using namespace talus;
using namespace talus::tools;
using test::contentOf;
using test::TemporaryFolder;

namespace {

/// Two columns on a floor, the lower one pushed off by the water between them.
const char* const kSlope =
    "[analysis]\nstart_deg = 8.0\nstop_deg = 24.0\ntolerance_deg = 0.1\n[material.rock]\ndensity = 2700.0\n"
    "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 19.5\n"
    "[[stack]]\ncolumns = 2\nrows = 1\nslices = 1\nblock = [0.2, 0.1, 0.1]\n"
    "[[water]]\nfissure = 1\ndepth = 0.07\n";

std::size_t shapesOf(const Drawing& drawing, const std::string& role) {
    return static_cast<std::size_t>(std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                                                  [&](const Shape& shape) { return shape.role == role; }));
}

/// Made-up results, but for the slope with water in fissure 5, which is searched.
PaperResults resultsWithOneRun() {
    PaperResults results = samples::results();
    for (PaperRun& run : results.runs) {
        if (run.what.group != PaperGroup::table || run.what.fissures != std::vector{5} ||
            run.what.friction_deg != 19.5)
            continue;
        run.what.scenario = *formats::parseScenario(kSlope, "fissure-5.toml");
        run.what.fissures = {5};
        run.what.keep_failing = true;
        Control control;
        control.keep_failing_state = true;
        run.search = *criticalAngle(run.what.scenario.model, control);
    }
    return results;
}

}  // namespace

TEST_CASE("the dry slope and the one with fissure 5 at Table 2's friction angle are marked, no others") {
    const PaperResults results = samples::results();
    std::vector<PaperCase> cases;
    for (const PaperRun& run : results.runs) cases.push_back(run.what);
    markKept(cases);
    std::vector<std::vector<int>> marked;
    for (const PaperCase& what : cases)
        if (what.keep_failing) marked.push_back(what.fissures);
    CHECK(marked == std::vector<std::vector<int>>{{}, {5}});
}

TEST_CASE("the page links to the replay it was made with, shows where the run ends and says what is seen") {
    const TemporaryFolder folder;
    Common common;
    common.quiet = true;
    PaperResults results = resultsWithOneRun();
    keepFailures(results, folder / "out/failing", folder / "out", common);
    REQUIRE(results.kept.size() == 1);
    const PaperKept& kept = results.kept[0];
    CHECK(kept.figure == "Fig. 5");
    CHECK(kept.page == "failing/" + results.runs[kept.of].what.name + ".html");
    CHECK(contentOf(folder / ("out/" + kept.page)).find("<title>Talus replay</title>") != std::string::npos);
    auto reader = formats::SnapshotReader::open(folder / ("out/" + kept.file));
    REQUIRE(reader.ok());
    CHECK(reader->verify().empty());

    CHECK(kept.run.slides == std::vector<std::string>{"c1r1s1"});
    CHECK(kept.run.stays == std::vector<std::string>{"c2r1s1"});
    CHECK(seenText(kept.run) == "Column 1 (1 block) slid; column 2 (1 block) stayed.");
    const Drawing drawing = drawEnd(kept.run, {1}, "");
    CHECK(shapesOf(drawing, "sliding") == 1);
    CHECK(shapesOf(drawing, "stable") == 1);
    CHECK(shapesOf(drawing, "water") == 2);  // the water in the gap and the mark of its level

    const Json picture = keptSection(results)["blocks"][1]["items"][0];
    CHECK(picture["links"][0]["href"] == kept.page + "#colour=role");
    CHECK(picture["links"][1]["href"] == kept.file);
    CHECK(picture["caption"]["text"].get<std::string>().starts_with("Column 1 (1 block) slid"));
}

TEST_CASE("without kept runs the page says how to get them; a slope that stood is named") {
    const auto said = [](const PaperResults& results, std::size_t block) {
        return keptSection(results)["blocks"][block]["text"].get<std::string>();
    };
    CHECK(said(samples::results(), 0).find("talus paper --keep-run") != std::string::npos);
    PaperResults results = samples::results();
    results.kept.push_back({0, "Fig. 4", "failing/dry.mcap", "failing/dry.html", {}});
    results.kept[0].run.reason = "the slope is stable up to the largest load tried";
    CHECK(said(results, 1).ends_with("not kept, the slope is stable up to the largest load tried."));
    CHECK(keptSection(results)["blocks"].size() == 2);
}
