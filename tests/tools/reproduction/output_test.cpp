#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "cli/json.h"
#include "report/svg.h"
#include "report/svg_writer.h"
#include "reproduction/data.h"
#include "reproduction/page.h"
#include "reproduction/plots.h"
#include "reproduction/slope.h"
#include "reproduction/table.h"
#include "tools/reproduction/samples.h"

using namespace talus;
using namespace talus::tools;

namespace {

/// Fields of a CSV line without quoted fields.
std::vector<std::string> fieldsOf(const std::string& line) {
    std::vector<std::string> fields(1);
    for (const char letter : line) {
        if (letter == ',')
            fields.emplace_back();
        else
            fields.back() += letter;
    }
    return fields;
}

std::vector<std::string> dataLines(const std::string& csv) {
    std::istringstream stream(csv);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) {
        if (!line.starts_with('#')) lines.push_back(line);
    }
    return lines;
}

/// Results in which every kind of missing answer occurs.
PaperResults gapped() {
    PaperResults results = samples::results();
    results.interrupted = true;
    results.runs[0].begun = false;
    results.runs[1].search.status = SearchStatus::interrupted;
    results.runs[2].errors.push_back({"water[0]", "found <nothing> & more"});
    for (std::size_t i = 3; i < 6; ++i) results.runs[i].search.status = SearchStatus::undecided;
    results.runs[21].search.status = SearchStatus::unstable_at_start;
    results.runs[21].search.low = -kInfinity;
    results.runs[7].what.theory.reset();
    return results;
}

std::vector<std::string> markup(const PaperResults& results) {
    return {svgFile(plotFig6(results)), svgFile(plotDifference(results)), svgFile(plotPoints(results)),
            svgFile(drawSlope(results.runs.front())), svgFile(drawSlope(results.runs[22]))};
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

}  // namespace

TEST_CASE("JSON has the promised keys, nulls where there is nothing, and the order of the runs") {
    const PaperResults results = gapped();
    const Json json = paperJson(results);
    REQUIRE(json["cases"].size() == results.runs.size());
    CHECK(json["wall_seconds"] == 12.5);
    CHECK(json["interrupted"] == true);
    for (std::size_t i = 0; i < results.runs.size(); ++i) {
        const Json& one = json["cases"][i];
        CHECK(one["name"] == results.runs[i].what.name);
        for (const char* key : {"fissure", "water_depth_m", "points", "friction_deg", "critical_angle_deg",
                                "theory_deg", "paper_deg", "failure_mode", "status"}) {
            CHECK_MESSAGE(one.contains(key), key);
        }
    }
    CHECK(json["cases"][0]["fissure"].is_null());
    CHECK(json["cases"][0]["critical_angle_deg"].is_null());
    CHECK(json["cases"][0]["status"] == "not_run");
    CHECK(json["cases"][0]["bracket_deg"].is_null());
    CHECK(json["cases"][2]["errors"][0]["field"] == "water[0]");
    CHECK(json["cases"][6]["fissure"] == 2);
    CHECK(json["cases"][6]["critical_angle_deg"].get<double>() == doctest::Approx(11.8));
    CHECK(json["cases"][6]["paper_deg"] == 13.3);
    CHECK(json["cases"][6]["state_hash"] == "0123456789abcdef");
    CHECK(json["cases"][7]["theory_deg"].is_null());
    CHECK(json["cases"][21]["bracket_deg"][0].is_null());
    CHECK(json["cases"][22]["fissure"] == Json::array({7, 8, 9, 10}));
    CHECK(json["cases"][23]["paper_deg"].is_null());
}

TEST_CASE("CSV has one line per run and as many fields in each as in its head") {
    const PaperResults results = gapped();
    const auto lines = dataLines(paperCsv(results));
    REQUIRE(lines.size() == results.runs.size() + 1);
    for (const std::string& line : lines) CHECK(fieldsOf(line).size() == fieldsOf(lines.front()).size());
    CHECK(paperCsv(results).starts_with("# version: 1.2.3\n"));
    const auto head = fieldsOf(lines.front());
    const auto column =
        static_cast<std::size_t>(std::find(head.begin(), head.end(), "critical_angle_deg") - head.begin());
    CHECK(fieldsOf(lines[1])[column].empty());
    CHECK(fieldsOf(lines[7])[column] == "11.8000");
}

TEST_CASE("the laboratory's CSV keeps the dry line's empty first field") {
    const auto lines = dataLines(laboratoryCsv(samples::results()));
    REQUIRE(lines.size() == 8);
    CHECK(lines[1] == ",0.00,18.9,18.3,18.1,18.4");
    CHECK(lines[2] == "1,0.35,4.5,4.6,4.3,4.5");
}

TEST_CASE("plots and drawings are well-formed, with and without answers") {
    for (const std::string& svg : markup(samples::results())) CHECK(samples::markupFault(svg, {}) == "");
    for (const std::string& svg : markup(gapped())) CHECK(samples::markupFault(svg, {}) == "");
    for (const std::string& svg : markup(samples::results())) {
        CHECK(svg.find("nan") == std::string::npos);
        CHECK(svg.find("inf") == std::string::npos);
    }
}

TEST_CASE("the markup check finds what is wrong") {
    CHECK(samples::markupFault("<a><b/></a>", {}) == "");
    CHECK(samples::markupFault("<a><b></a>", {}) != "");
    CHECK(samples::markupFault("<a>", {}) != "");
    CHECK(samples::markupFault("<a> & </a>", {}) != "");
    CHECK(samples::markupFault("<a> > </a>", {}) != "");
    CHECK(samples::markupFault("<a x=\"<\"></a>", {}) != "");
}

TEST_CASE("Fig. 6 shows each answer once, at its L/H") {
    const auto demOf = [](const PaperResults& results) {
        const Plot plot = plotFig6(results);
        return *std::find_if(plot.series.begin(), plot.series.end(),
                             [](const Series& s) { return s.role == "dem"; });
    };
    const Series whole = demOf(samples::results());
    REQUIRE(whole.rows.size() == 6);
    CHECK(whole.rows[2][0] == doctest::Approx(0.6 / 0.35));
    CHECK(whole.rows[2][1] == doctest::Approx(15.4));
    CHECK(whole.tips[2] == "fissure 3 phi 19.5: 15.40");
    CHECK(demOf(gapped()).rows.size() == 5);
}

TEST_CASE("the file of a plot holds each of its symbols, and a legend") {
    const std::string svg = svgFile(plotFig6(samples::results()));
    CHECK(count(svg, "class=\"dem\"") == 6 + 1);
    CHECK(count(svg, "class=\"laboratory\"") == 6 + 1);
    CHECK(count(svg, "class=\"repeat\"") == 18 + 1);
    CHECK(count(svg, "fissure 3 phi 19.5: 15.40") == 1);
    CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("a slope shows every block of a slice, moving ones by their role, and its water") {
    const PaperRun run = samples::foundRun(samples::paperCase(PaperGroup::table, "", {3}, 19.5), 15);
    const Drawing drawing = drawSlope(run);
    const auto shapes = [&](const std::string& role) {
        return std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                             [&](const Shape& s) { return s.role == role; });
    };
    CHECK(shapes("sliding") == 15);
    CHECK(shapes("stable") == 20);
    CHECK(shapes("fixed") == 1);
    CHECK(shapes("water") == 2);  // the water and the mark of its level
    CHECK(drawing.label->second == "15.00\u00b0");
}

TEST_CASE("the report has every table, plot and drawing, and says when it was interrupted") {
    for (const PaperResults& results : {samples::results(), gapped()}) {
        const Json report = paperReport(results);
        std::map<std::string, int> blocks;
        std::vector<std::string> ids;
        for (const Json& section : report["sections"]) {
            ids.push_back(section["id"]);
            for (const Json& block : section["blocks"]) ++blocks[block["type"]];
        }
        CHECK(ids == std::vector<std::string>{"slopes", "replays", "bag", "table", "fig6", "section5",
                                              "points", "differences", "errata", "parameters", "time",
                                              "scenarios"});
        CHECK(blocks["table"] == 5);
        CHECK(blocks["plot"] == 3);
        CHECK(report["sections"][0]["blocks"][1]["items"].size() == 7 + 2);
        CHECK(report.dump().find("talus paper <x>") != std::string::npos);
    }
    CHECK(paperReport(gapped())["opening"][1]["style"] == "alert");
    CHECK(paperReport(samples::results())["opening"].size() == 2);
}

TEST_CASE("rows of Table 1 have a value for each column; what is not known is null") {
    for (const PaperResults& results : {samples::results(), gapped()}) {
        const Json table = table1(results);
        REQUIRE(table["rows"].size() == 7);
        for (const Json& row : table["rows"]) CHECK(row.size() == table["columns"].size());
    }
    const Json whole = table1(samples::results())["rows"][3], gaps = table1(gapped())["rows"][0];
    CHECK(whole[0] == "fissure 3");
    CHECK(whole[5] == doctest::Approx(15.4));
    CHECK(whole.back() == "sliding");
    CHECK(gaps[4].is_null());
    CHECK(gaps.back() == "interrupted");
}

TEST_CASE("the terminal table aligns numbers right and words left") {
    CHECK(alignedTable({{"case", "deg"}, {"dry", "19.50"}, {"fissure 1", "-"}}, " ") ==
          " case         deg\n"
          " dry        19.50\n"
          " fissure 1      -\n");
}

TEST_CASE("the terminal table holds the answers, and the cases without one") {
    const std::string whole = terminalTable(samples::results());
    CHECK(whole.find("fissure 4") != std::string::npos);
    CHECK(whole.find("Without an answer") == std::string::npos);
    CHECK(whole.find("12.5 s on 2 threads") != std::string::npos);
    const std::string parts = terminalTable(gapped());
    CHECK(parts.starts_with("Interrupted"));
    CHECK(parts.find("case-0, phi 18.0: not_run") != std::string::npos);
    CHECK(parts.find("failed") != std::string::npos);
}

TEST_CASE("steps between ticks are round, and SVG files are safe XML") {
    CHECK(niceStep(22, 11) == doctest::Approx(2));
    CHECK(niceStep(0.04, 6) == doctest::Approx(0.005));
    SvgWriter svg;
    svg.label({}, "<a href=\"x\">&'");
    CHECK(svg.file(1, 1, "", "", "").find(">&lt;a href=&quot;x&quot;&gt;&amp;&#39;</text>") !=
          std::string::npos);
}

TEST_CASE("what XML cannot hold is replaced in SVG files: bytes that are not UTF-8, control characters") {
    SvgWriter svg;
    svg.label({}, "caf\xe9 \x01 \uffff\ufffd caf\u00e9\t");
    CHECK(svg.file(1, 1, "", "", "").find(">caf\ufffd \ufffd \ufffd\ufffd caf\u00e9\t</text>") !=
          std::string::npos);
}
