#include "batch/map_on_slope.h"

#include <algorithm>

#include "batch/map_picture.h"
#include "batch/map_words.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "recording/start_frame.h"
#include "replay/page.h"

namespace talus::tools::batch {

namespace {

constexpr int kColours = 16;  // of the scale; the page goes straight from one to the next

void append(const Vec3& point, Json& list) {
    for (const double x : point) list.push_back(x);
}

Json scaleJson(const FailureMap& map, MapQuantity quantity) {
    return {{"title", scaleTitle(quantity)}, {"most", scaleEnd(map, quantity)}};
}

/// Values of each cell; centres and normals as x, y, z.
Json cellsJson(const FailureMap& map) {
    Json area = Json::array(), low = area, high = area, centre = area, normal = area;
    for (std::size_t c = 0; c < map.face.cells.size(); ++c) {
        const Interval interval = map.interval(c);
        area.push_back(map.face.cells[c].area);
        low.push_back(interval.low);
        high.push_back(interval.high);
        append(map.face.cells[c].centre, centre);
        append(map.face.cells[c].normal, normal);
    }
    return {
        {"area", area},     {"hits", map.hits}, {"low", low}, {"high", high}, {"volume", map.volume_per_area},
        {"centre", centre}, {"normal", normal}};
}

/// The convex pieces of the cells: where each begins in the list of corners, and its cell.
void addPieces(const FailureMap& map, Json& json) {
    Json corner = Json::array(), begin = Json::array({0}), cell = Json::array();
    for (std::size_t c = 0; c < map.face.cells.size(); ++c)
        for (const auto& piece : map.face.cells[c].pieces) {
            for (const Vec3& point : piece) append(point, corner);
            begin.push_back(corner.size() / 3);
            cell.push_back(c);
        }
    json["corner"] = std::move(corner);
    json["pieceBegin"] = std::move(begin);
    json["pieceCell"] = std::move(cell);
}

Json factsJson(const FailureMap& map, const BatchInfo& info, const Common& common) {
    Json facts = Json::array();
    for (const Facts& list : {mapFacts(map), mapProvenance(info, common)})
        for (const auto& [name, value] : list) facts.push_back(Json::array({name, value}));
    return facts;
}

Json mapJson(const FailureMap& map, const BatchInfo& info, const Common& common) {
    Json colours = Json::array();
    for (int k = 0; k < kColours; ++k)
        colours.push_back(hexColour(mapColour(std::max(1e-9, k / (kColours - 1.0)))));
    Json json{{"title", mapTitle(info)},
              {"lead", leadText(map, info)},
              {"warning", uncountedText(map, info)},
              {"reading", readingText(info)},
              {"facts", factsJson(map, info, common)},
              {"sweep", info.sweep_text},
              {"runs", map.runs},
              {"confidence", map.confidence},
              {"colours", colours},
              {"none", hexColour(mapColour(0))},
              {"scales",
               {{"probability", scaleJson(map, MapQuantity::probability)},
                {"volume", scaleJson(map, MapQuantity::volume_per_area)}}},
              {"outlook", nullptr},
              {"cells", cellsJson(map)}};
    if (map.face.outlook) json["outlook"] = {map.face.outlook->x(), map.face.outlook->y()};
    addPieces(map, json);
    return json;
}

}  // namespace

Slope slopeOf(const formats::Sweep& sweep) {
    formats::Scenario scenario = *sweep.base;
    scenario.model.flow.reset();  // it moves no block before the first frame
    StartFrame start = startFrame(scenario.model);
    return {formats::headerOf(scenario, std::move(start.geometry), commandLine(), 1), std::move(start.frame)};
}

std::string mapOnSlope(const FailureMap& map, const BatchInfo& info, const Slope& slope,
                       const Common& common) {
    const Json json = mapJson(map, info, common);
    return replayPage(snapshotBytes(slope.header, slope.frame), &json);
}

}  // namespace talus::tools::batch
