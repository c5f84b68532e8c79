// The curve of factor and volume: JSON, CSV, plot and the rows of a table.

#include "answers/factor_volume.h"

#include <doctest/doctest.h>

#include <cmath>

#include "cli/json.h"
#include "report/csv.h"
#include "report/svg.h"

using namespace talus;
using namespace talus::tools;

namespace {

/// Points of these volumes [m3] and factors.
KeyBlockResult curveOf(const std::vector<std::pair<double, double>>& points) {
    KeyBlockResult result;
    for (const auto& [volume, factor] : points) {
        MovingGroup group;
        group.blocks = {"a,b", "c" + std::to_string(result.factor_volume.size())};
        group.sliding.mode = SlidingMode::slides;
        group.sliding.factor = factor;
        group.sliding.direction = -Vec3::UnitX();
        group.sliding.joints = {"bedding"};
        group.volume = volume;
        group.mass = 2600 * volume;
        result.factor_volume.push_back(group);
    }
    return result;
}

}  // namespace

TEST_CASE("factor-volume: JSON and CSV have all points") {
    const KeyBlockResult result = curveOf({{0.5, 0}, {12.25, 1.25}, {300, 1.5}});
    const Json json = factorVolumeJson(result);
    REQUIRE(json.size() == 3);
    CHECK(json[1].at("volume_m3") == 12.25);
    CHECK(json[1].at("mass_kg") == 2600 * 12.25);
    CHECK(json[1].at("safety_factor") == 1.25);
    CHECK(json[1].at("mode") == "slides");
    CHECK(json[1].at("blocks") == Json::array({"a,b", "c1"}));
    const std::string csv = factorVolumeCsv(result, "# made by\n");
    CHECK(csv ==
          "# made by\nvolume_m3,mass_kg,safety_factor,mode,joints,blocks\n"
          "0.5,1300,0,slides,bedding,\"a,b c0\"\n12.25,31850,1.25,slides,bedding,\"a,b c1\"\n"
          "300,780000,1.5,slides,bedding,\"a,b c2\"\n");
}

TEST_CASE("factor-volume: the stairs rise where a larger failure takes more") {
    const Plot plot = factorVolumePlot(curveOf({{1, 0.9}, {10, 1.2}, {100, 50}}), "folder/slope.toml");
    REQUIRE(plot.series.size() == 2);
    const auto& rows = plot.series[0].rows;
    // From the left edge to the first point; up and on to the second; up to the edge of what is drawn.
    REQUIRE(rows.size() == 5);
    CHECK(rows[0][1] == 0.9);
    CHECK(rows[1] == std::vector<double>{1, 0.9});
    CHECK(rows[2] == std::vector<double>{1, 1.2});
    CHECK(rows[3] == std::vector<double>{10, 1.2});
    CHECK(rows[4] == std::vector<double>{10, 5});
    CHECK(plot.series[1].rows.size() == 2);
    CHECK(plot.y.domain.at(1) >= 5);
    CHECK(plot.title.starts_with("slope.toml: "));
}

TEST_CASE("factor-volume: its axis is logarithmic") {
    Plot plot = factorVolumePlot(curveOf({{1, 0.9}, {100, 1.2}}), "slope.toml");
    plot.x.domain = {1, 100};
    const std::string svg = svgFile(plot, true);
    // Ten is in the middle between one and a hundred: 64 and 704 px.
    CHECK(svg.find("<text x=\"384.0\" y=\"418.0\" text-anchor=\"middle\" class=\"text\">10</text>") !=
          std::string::npos);
    for (const char* tick : {">1<", ">2<", ">5<", ">20<", ">50<", ">100<"})
        CHECK(svg.find(tick) != std::string::npos);
}

TEST_CASE("factor-volume: a table shows all of a short curve, and a long one by steps of its volume") {
    std::vector<std::pair<double, double>> points;
    for (int k = 0; k < 12; ++k) points.emplace_back(1 + 0.01 * k, 1 + 0.01 * k);
    CHECK(shownPoints(curveOf(points)).size() == 12);
    for (int k = 12; k < 900; ++k) points.emplace_back(1 + 0.1 * k, 1 + 0.01 * k);
    const KeyBlockResult curve = curveOf(points);
    const auto shown = shownPoints(curve);
    CHECK(shown.size() > 5);
    CHECK(shown.size() < 10);
    CHECK(shown.front()->volume == points.front().first);
    CHECK(shown.back()->volume == points.back().first);
    for (std::size_t k = 1; k < shown.size(); ++k) CHECK(shown[k - 1]->volume < shown[k]->volume);
}
