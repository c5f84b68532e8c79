#include "talus/formats/fractures.h"

#include <numbers>

#include "mesh/plane_table.h"
#include "talus/formats/csv.h"
#include "toml/file_text.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using toml::numberText;
using enum PlaneColumn;

constexpr double kDeg = std::numbers::pi / 180;

/// One size of the disc: its radius, or its diameter.
bool hasOneSize(PlaneTable& rows) {
    if (rows.has(radius) != rows.has(diameter)) return true;
    rows.fault(rows.has(radius) ? "found radius_m and diameter_m, allowed: one of them"
                                : "found no size of the discs, allowed: radius_m or diameter_m");
    return false;
}

void readRow(PlaneTable& rows, std::vector<Fracture>& fractures) {
    const auto at_x = rows.number(x), at_y = rows.number(y), at_z = rows.number(z);
    const auto plane = rows.orientation();
    const auto size = rows.number(rows.has(radius) ? radius : diameter);
    if (at_x && at_y && at_z && plane && size) {
        fractures.push_back(
            {{*at_x, *at_y, *at_z}, plane->dip, plane->dip_direction, rows.has(radius) ? *size : *size / 2});
    }
}

}  // namespace

std::string fracturesCsv(const std::vector<std::pair<std::string, Fracture>>& fractures) {
    std::string text = "x_m,y_m,z_m,dip_deg,dip_direction_deg,radius_m,set\n";
    for (const auto& [set, f] : fractures) {
        for (const double value :
             {f.centre.x(), f.centre.y(), f.centre.z(), f.dip / kDeg, f.dip_direction / kDeg, f.radius})
            text += numberText(value) + ",";
        text += csvField(set) + "\n";
    }
    return text;
}

Result<std::vector<Fracture>> readFractures(const std::string& path) {
    const auto text = toml::readFileText(path);
    if (!text) return text.errors();
    return parseFractures(*text, path);
}

Result<std::vector<Fracture>> parseFractures(const std::string& text, const std::string& path) {
    PlaneTable rows(path, text, {x, y, z, radius, diameter});
    std::vector<Fracture> fractures;
    if (rows.readHeader({x, y, z}) && hasOneSize(rows))
        while (rows.next()) readRow(rows, fractures);
    if (!rows.faults().empty()) return rows.faults();
    return fractures;
}

}  // namespace talus::formats
