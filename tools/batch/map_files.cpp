#include "batch/map_files.h"

#include <algorithm>

#include "batch/map_picture.h"
#include "batch/map_words.h"
#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/text.h"
#include "report/csv.h"
#include "report/html.h"
#include "talus/formats/export.h"

namespace talus::tools::batch {

namespace {

/// Probabilities whose area the page lists.
constexpr double kLevels[] = {0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};

formats::PolygonMap polygonsOf(const FailureMap& map) {
    formats::PolygonMap out;
    for (const char* name :
         {"cell", "cell_area", "probability", "probability_low", "probability_high", "volume_per_area"})
        out.values.push_back({name, {}});
    const double end = scaleEnd(map, MapQuantity::probability);
    for (std::size_t c = 0; c < map.face.cells.size(); ++c) {
        const Interval interval = map.interval(c);
        for (const auto& piece : map.face.cells[c].pieces) {
            out.polygons.push_back({});
            for (const Vec3& point : piece) {
                out.polygons.back().push_back(static_cast<std::int32_t>(out.vertices.size()));
                out.vertices.push_back(point);
            }
            const double values[] = {static_cast<double>(c), map.face.cells[c].area, map.probability(c),
                                     interval.low,           interval.high,          map.volume_per_area[c]};
            for (std::size_t v = 0; v < out.values.size(); ++v) out.values[v].second.push_back(values[v]);
            out.colours.push_back(mapColour(map.probability(c) / end));
        }
    }
    return out;
}

std::vector<std::vector<std::string>> levelRows(const FailureMap& map) {
    std::vector<std::vector<std::string>> rows;
    const auto area_of = [&](auto counts) {
        double area = 0;
        for (std::size_t c = 0; c < map.face.cells.size(); ++c)
            if (counts(map.probability(c))) area += map.face.cells[c].area;
        return area;
    };
    const auto add = [&](const std::string& words, double area) {
        rows.push_back({words, text(area, 1), percent(map.face.area > 0 ? area / map.face.area : 0)});
    };
    for (const double level : kLevels)
        if (level <= map.largestProbability() && level * static_cast<double>(map.runs) >= 1)
            add(csvNumber(level) + " or more",
                area_of([level](double probability) { return probability >= level; }));
    add("more than 0", area_of([](double probability) { return probability > 0; }));
    add("the face", map.face.area);
    return rows;
}

std::string mapPage(const FailureMap& map, const BatchInfo& info, const Common& common) {
    HtmlPage page;
    page.paragraph(leadText(map, info), "lead");
    if (const std::string warning = uncountedText(map, info); !warning.empty())
        page.paragraph(warning, "alert");
    page.facts(mapFacts(map));
    page.section("probability", "Probability");
    page.figure("map-probability", mapSvg(map, MapQuantity::probability),
                "Share of the samples in which a cell lies on a block that fails. " + viewText(map));
    page.table("Area by probability", {{"probability", true}, {"area, m\u00b2"}, {"of the face"}},
               levelRows(map));
    page.section("volume", "Volume");
    page.figure("map-volume", mapSvg(map, MapQuantity::volume_per_area),
                "Failing volume per m\u00b2 of the face, mean of all samples. Its integral over the face is "
                "the expected failing volume. " +
                    viewText(map));
    page.section("reading", "How to read it");
    page.paragraph(readingText(info));
    page.section("provenance", "Provenance");
    page.facts(mapProvenance(info, common));
    page.textFile("Sweep " + info.sweep, info.sweep_text);
    page.textFile("Scenario " + info.scenario, info.scenario_text);
    return page.html(mapTitle(info));
}

void refuseManyCells(const char* option, const std::string& remedy, const Face& face) {
    if (face.cells.size() > kMostDrawnCells)
        throw BadInput(Error{option, "found a face of " + std::to_string(face.cells.size()) +
                                         " cells, allowed in a page: at most " +
                                         std::to_string(kMostDrawnCells) + "; choose a larger --map-cell" +
                                         remedy});
}

}  // namespace

void refuseMapFile(const std::string& path, const Face& face) {
    requireEnding("--map", path, {".html", ".vtp", ".ply"});
    refuseInput("--map", path);
    refuseUnwritable(path);
    if (path.ends_with(".html")) refuseManyCells("--map", ", or a file that ends in .vtp or .ply", face);
}

void refuseSlopePage(const std::string& path, const Face& face) {
    requireEnding("--map-3d", path, {".html"});
    refuseInput("--map-3d", path);
    refuseUnwritable(path);
    refuseManyCells("--map-3d", "", face);
}

std::string mapFile(const std::string& path, const FailureMap& map, const BatchInfo& info,
                    const Common& common) {
    if (path.ends_with(".vtp")) return formats::vtpMap(polygonsOf(map));
    if (path.ends_with(".ply")) return formats::plyMap(polygonsOf(map));
    return mapPage(map, info, common);
}

Json toJson(const FailureMap& map, const std::vector<std::string>& files) {
    const Interval interval = shareInterval(map.failed, map.runs, map.confidence);
    return {{"files", files},
            {"threshold", map.threshold},
            {"runs", map.runs},
            {"failed", map.failed},
            {"interval", {number(interval.low), number(interval.high)}},
            {"confidence", map.confidence},
            {"cells", map.face.cells.size()},
            {"cell_size_m", number(map.face.cell_size)},
            {"face_area_m2", number(map.face.area)},
            {"largest_probability", number(map.largestProbability())},
            {"expected_failing_volume_m3", number(map.volume)},
            {"volume_without_face_m3", number(map.hidden_volume)}};
}

}  // namespace talus::tools::batch
