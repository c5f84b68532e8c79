#include "report/figures.h"

#include "cli/json.h"

namespace talus::tools {
namespace {

Json toJson(const PlotAxis& axis) {
    Json json{{"title", axis.title}};
    if (!axis.domain.empty()) json["domain"] = axis.domain;
    if (axis.step > 0) json["step"] = axis.step;
    if (axis.decimals >= 0) json["decimals"] = axis.decimals;
    if (!axis.categories.empty()) json["categories"] = axis.categories;
    if (axis.first_on_top) json["first_on_top"] = true;
    return json;
}

Json toJson(const Series& series) {
    Json json{{"type", series.type}, {"role", series.role}};
    if (!series.name.empty()) json["name"] = series.name;
    if (series.type == "points") {
        json["symbol"] = series.symbol;
        json["size"] = series.size;
    }
    if (series.shift != 0) json["shift"] = series.shift;
    json["rows"] = series.rows;
    if (!series.tips.empty()) json["tips"] = series.tips;
    return json;
}

Json toJson(const Reference& reference) {
    Json json{{"axis", std::string(1, reference.axis)}, {"at", reference.at}, {"role", reference.role}};
    if (reference.to) json["to"] = *reference.to;
    if (!reference.name.empty()) json["name"] = reference.name;
    if (!reference.text.empty()) json["text"] = reference.text;
    if (reference.below) json["below"] = true;
    return json;
}

Json spotJson(Spot spot) { return Json::array({spot.x, spot.y}); }

Json toJson(const Shape& shape) {
    Json json{{"role", shape.role}, {"points", Json::array()}};
    for (const Spot& spot : shape.spots) json["points"].push_back(spotJson(spot));
    if (!shape.tip.empty()) json["tip"] = shape.tip;
    if (shape.open) json["open"] = true;
    return json;
}

Json toJson(const Link& link) { return {{"href", link.href}, {"text", link.text}}; }

template <class T>
Json listOf(const std::vector<T>& items) {
    Json list = Json::array();
    for (const T& item : items) list.push_back(toJson(item));
    return list;
}

}  // namespace

Json toJson(const Plot& plot) {
    Json json{{"type", "plot"},
              {"id", plot.id},
              {"title", plot.title},
              {"description", plot.description},
              {"x", toJson(plot.x)},
              {"y", toJson(plot.y)},
              {"series", listOf(plot.series)},
              {"references", listOf(plot.references)}};
    if (!plot.key.empty()) json["key"] = listOf(plot.key);
    return json;
}

Json toJson(const Drawing& drawing) {
    Json json{{"title", drawing.title},
              {"description", drawing.description},
              {"shapes", listOf(drawing.shapes)},
              {"caption", {{"title", drawing.caption_title}, {"text", drawing.caption}}}};
    if (drawing.label)
        json["label"] = {{"at", spotJson(drawing.label->first)}, {"text", drawing.label->second}};
    if (!drawing.links.empty()) json["links"] = listOf(drawing.links);
    return json;
}

}  // namespace talus::tools
