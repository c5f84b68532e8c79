// What DXF files consist of: group codes, entities that are not faces, units.

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "files/csv_line.h"
#include "mesh/dxf.h"

namespace talus::formats::mesh {

std::string_view DxfPairs::nextLine() {
    const auto end = std::min(rest_.find('\n'), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return withoutBlanks(line);
}

bool DxfPairs::next() {
    if (faulty_ || withoutBlanks(rest_).empty()) return false;
    const std::string_view code = nextLine();
    const auto read = std::from_chars(code.data(), code.data() + code.size(), code_);
    if (read.ec != std::errc() || read.ptr != code.data() + code.size()) {
        faulty_ = true;
        value_ = code;
        return false;
    }
    value_ = nextLine();
    return true;
}

std::string countedText(const std::map<std::string, std::size_t>& counts) {
    std::string text;
    for (const auto& [type, count] : counts)
        text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + type;
    return text;
}

std::string_view dxfRemedy(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kRemedies{
        {{"INSERT", "explode inserted blocks"},
         {"MESH", "turn MESH into faces (EXPLODE)"},
         {"3DSOLID", "export solids as faces or as STL"},
         {"BODY", "export solids as faces or as STL"},
         {"REGION", "export solids as faces or as STL"},
         {"SURFACE", "export surfaces as faces or as STL"},
         {"POLYLINE", "triangulate contour lines"},
         {"LWPOLYLINE", "triangulate contour lines"},
         {"LINE", "triangulate contour lines"},
         {"SPLINE", "triangulate contour lines"},
         {"POINT", "triangulate points, or write them as .xyz"},
         {"ACAD_PROXY_ENTITY", "explode objects of other programs"}}};
    const auto found = std::find_if(kRemedies.begin(), kRemedies.end(),
                                    [&](const auto& remedy) { return remedy.first == type; });
    return found == kRemedies.end() ? std::string_view() : found->second;
}

std::optional<double> dxfUnit(std::string_view insunits) {
    constexpr std::array<std::pair<std::string_view, double>, 9> kUnits{{{"1", 0.0254},
                                                                         {"2", 0.3048},
                                                                         {"3", 1609.344},
                                                                         {"4", 1e-3},
                                                                         {"5", 1e-2},
                                                                         {"6", 1},
                                                                         {"7", 1e3},
                                                                         {"14", 0.1},
                                                                         {"21", 1200.0 / 3937}}};
    const auto found =
        std::find_if(kUnits.begin(), kUnits.end(), [&](const auto& unit) { return unit.first == insunits; });
    return found == kUnits.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace talus::formats::mesh
