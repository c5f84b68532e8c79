#include "answers/support_report.h"

#include <cmath>
#include <cstdio>

#include "cli/json.h"

namespace talus::tools {
namespace {

Json supportJson(const SupportReport& support) {
    Json json{{"name", support.name},
              {"force_n", number(support.force)},
              {"utilisation", number(support.utilisation)}};
    for (const SupportSign& sign : support.signs) json[sign.key] = sign.is;
    json["broken"] = support.broken;
    return json;
}

std::string lineOf(const SupportReport& support) {
    char text[96];
    std::snprintf(text, sizeof text, ": %.4g kN, %.0f %% of its capacity", support.force / 1000,
                  std::round(100 * support.utilisation));
    std::string line = support.name + text;
    for (const SupportSign& sign : support.signs)
        if (sign.is) line += ", " + sign.text;
    return line + (support.broken ? ", broken" : "");
}

}  // namespace

void addSupports(const std::vector<Supports>& supports, Json& json) {
    for (const Supports& kind : supports) {
        Json& list = json[kind.kind] = Json::array();
        for (const SupportReport& support : kind.reports) list.push_back(supportJson(support));
    }
}

std::vector<SupportTexts> supportTexts(const std::vector<Supports>& supports) {
    std::vector<SupportTexts> texts;
    for (const Supports& kind : supports) {
        texts.push_back({kind.kind, {}});
        for (const SupportReport& support : kind.reports) texts.back().lines.push_back(lineOf(support));
    }
    return texts;
}

}  // namespace talus::tools
