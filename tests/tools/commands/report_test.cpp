// talus report: its page, its figures, what both say of volumes, and its faults.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "report/csv.h"
#include "support/slower.h"
#include "tools/program.h"

using namespace talus::tools;
using namespace talus::tools::testing;
using talus::test::kTriesFew;

namespace {

const std::string kSlope = kTriesFew ? TALUS_SOURCE_DIR "/bench/verification/rock-slope-148.toml"
                                     : TALUS_SOURCE_DIR "/bench/examples/rock-slope.toml";
const std::string kWedge = TALUS_SOURCE_DIR "/bench/verification/wedge-phi-35.toml";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Rows of a CSV without its comments, the header first.
std::vector<std::vector<std::string>> rowsOf(const std::string& path) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream stream(contentOf(path));
    for (std::string line; std::getline(stream, line);)
        if (!line.starts_with('#')) rows.push_back(csvFields(line));
    return rows;
}

/// Sum of a column of slope.csv over the blocks of a fate.
double sumOf(const std::vector<std::vector<std::string>>& rows, const std::string& fate, std::size_t column) {
    double sum = 0;
    for (const auto& row : rows)
        if (row.at(2) == fate) sum += *numberIn(row.at(column));
    return sum;
}

/// Start tags less end tags of an element.
std::ptrdiff_t openOf(const std::string& html, const std::string& name) {
    const auto count = [&](const std::string& pattern) {
        const std::regex tag(pattern);
        return std::distance(std::sregex_iterator(html.begin(), html.end(), tag), {});
    };
    return count("<" + name + "[ >]") - count("</" + name + ">");
}

}  // namespace

TEST_CASE("report: a page with every section, which needs nothing else") {
    const TemporaryFolder folder;
    const Outcome outcome = runTalus({"report", kSlope, "-o", folder / "slope.html", "--quiet"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const std::string html = contentOf(folder / "slope.html");
    for (const char* section : {"question", "slope", "answer", "groups", "beside", "key-blocks", "kinematics",
                                "water-and-bolts", "warnings", "provenance"})
        CHECK(has(html, "<h2 id=\"" + std::string(section) + "\">"));
    CHECK(!has(html, "<h2 id=\"sensitivity\">"));
    for (const char* figure :
         {"slope", "load-displacement", "factor-volume", "stereonet-poles", "stereonet-intersections"}) {
        CHECK(has(html, "<svg id=\"figure-" + std::string(figure) + "\""));
        for (const char* ending : {".svg", ".csv"})
            CHECK(std::filesystem::file_size(folder / "slope_figures/" + figure + ending) > 100);
    }
    for (const char* element : {"div", "dl", "table", "tr", "td", "svg", "g", "figure", "style", "details"})
        CHECK(openOf(html, element) == 0);
    CHECK(!has(html, "<script"));
    CHECK(!has(html, "src="));
    CHECK(!has(html, "href="));
    CHECK(!has(html, "@import"));
    std::string without_names =
        std::regex_replace(html, std::regex("xmlns=\"http://www.w3.org/2000/svg\""), "");
    CHECK(!has(without_names, "http:"));
    CHECK(!has(without_names, "https:"));
    CHECK(has(html, "65.0/270.0 (dip/dip direction)"));
    CHECK(has(html, "32.0\u00b0: the least of the joints that have friction, that of bedding"));

    // Another time, on another number of threads: the same bytes but for the command.
    const Outcome again =
        runTalus({"report", kSlope, "-o", folder / "again.html", "--quiet", "--threads", "1"});
    REQUIRE(again.exit_code == 0);
    const auto without_command = [](const std::string& text) {
        return std::regex_replace(text, std::regex("<dt>command line</dt><dd>[^<]*</dd>"), "");
    };
    CHECK(without_command(contentOf(folder / "again.html")) == without_command(html));
}

TEST_CASE("report: volumes and masses are those of the model's blocks") {
    const TemporaryFolder folder;
    const Outcome outcome = runTalus({"report", kSlope, "-o", folder / "slope.html", "--figures",
                                      folder / "figures", "--json", "--quiet"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto json = outcome.json();
    CHECK(json.at("page") == folder / "slope.html");
    CHECK(json.at("analysis") == "safety-factor");
    CHECK(json.at("figures").size() == 10);
    const auto& search = json.at("search");
    const auto rows = rowsOf(folder / "figures/slope.csv");
    CHECK(rows.at(0).at(3) == "volume_m3");
    CHECK(sumOf(rows, "fails", 3) == doctest::Approx(search.at("failing_volume_m3").get<double>()));
    CHECK(sumOf(rows, "fails", 4) == doctest::Approx(search.at("failing_mass_kg").get<double>()));
    CHECK(search.at("failing_mass_kg").get<double>() ==
          doctest::Approx(2600 * search.at("failing_volume_m3").get<double>()));
    const auto points = rowsOf(folder / "figures/factor-volume.csv");
    CHECK(points.size() == json.at("key_blocks").at("factor_volume").size() + 1);
    // Each point's blocks have its volume.
    std::map<std::string, double> volumes;
    for (const auto& row : rows) volumes[row[0]] = numberIn(row[3]).value_or(0);
    for (const auto& point : json.at("key_blocks").at("factor_volume")) {
        double sum = 0;
        for (const auto& name : point.at("blocks")) sum += volumes.at(name.get<std::string>());
        CHECK(sum == doctest::Approx(point.at("volume_m3").get<double>()));
    }
    // The least factor of the list is the curve's first.
    for (const auto& group : json.at("key_blocks").at("moving_groups")) {
        if (!group.at("carries").empty()) continue;
        CHECK(json.at("key_blocks").at("factor_volume")[0].at("safety_factor").get<double>() ==
              doctest::Approx(group.at("safety_factor").get<double>()));
        break;
    }
}

TEST_CASE("report: sensitivity on request") {
    const TemporaryFolder folder;
    const Outcome outcome =
        runTalus({"report", kWedge, "-o", folder / "wedge.html", "--sensitivity", "10", "--json", "--quiet"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    const auto json = outcome.json();
    const double factor = json.at("search").at("safety_factor").get<double>();
    const auto& friction = json.at("sensitivity")[0];
    CHECK(friction.at("quantity") == "friction");
    CHECK(friction.at("less").at("safety_factor").get<double>() ==
          doctest::Approx(0.9 * factor).epsilon(2e-3));
    CHECK(friction.at("more").at("safety_factor").get<double>() ==
          doctest::Approx(1.1 * factor).epsilon(2e-3));
    const std::string html = contentOf(folder / "wedge.html");
    CHECK(has(html, "<svg id=\"figure-sensitivity\""));
    CHECK(rowsOf(folder / "wedge_figures/sensitivity.csv").size() == 7);
}

TEST_CASE("report: each of the three searches, and faults") {
    const TemporaryFolder folder;
    for (const char* search : {"critical-angle", "critical-acceleration"}) {
        const Outcome outcome = runTalus(
            {"report", kWedge, "-o", folder / "wedge.html", "--analysis", search, "--json", "--quiet"});
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        CHECK(outcome.json().at("analysis") == search);
        CHECK(has(contentOf(folder / "wedge.html"), "<svg id=\"figure-load-displacement\""));
    }
    const std::string block = folder.write("block.toml", blockScenario(20, 40));
    const Outcome tilted = runTalus({"report", block, "-o", folder / "block.html", "--json", "--quiet"});
    REQUIRE(tilted.exit_code == 0);
    CHECK(tilted.json().at("analysis") == "critical-angle");
    CHECK(tilted.json().at("search").at("critical_angle_deg").get<double>() ==
          doctest::Approx(40).epsilon(1e-3));
    CHECK(has(contentOf(folder / "block.html"), "The scenario has no joint sets"));
    CHECK(runTalus({"report", kWedge}).exit_code == 2);
    CHECK(runTalus({"report", kWedge, "-o", folder / "wedge.pdf"}).exit_code == 2);
    CHECK(runTalus({"report", kWedge, "-o", folder / "w.html", "--analysis", "run"}).exit_code == 2);
    CHECK(runTalus({"report", kWedge, "-o", folder / "w.html", "--slope", "65"}).exit_code == 2);
    CHECK(runTalus({"report", kWedge, "-o", folder / "w.html", "--sensitivity", "95"}).exit_code == 2);
    CHECK(runTalus({"report", folder / "none.toml", "-o", folder / "w.html"}).exit_code == 2);
    CHECK(runTalus({"report", kWedge, "-o", folder / "no/such/w.html"}).exit_code == 4);
    CHECK(!std::filesystem::exists(folder / "w.html"));
    const Outcome refused = runTalus({"report", folder / "none.toml", "-o", folder / "w.html", "--json"});
    CHECK(refused.json().at("ok") == false);
}
