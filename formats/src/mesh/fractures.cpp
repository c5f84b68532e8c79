#include "talus/formats/fractures.h"

#include <array>

#include "mesh/plane_table.h"
#include "talus/angles.h"
#include "talus/formats/csv.h"
#include "toml/file_text.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using toml::numberText;
using enum PlaneColumn;

/// How a table may state the size of a disc. A trace is taken as a chord through the centre: the smallest
/// disc that has it.
struct Size {
    PlaneColumn column;
    std::string_view title;
    double radii;  ///< how many radii it is long
};
constexpr std::array kSizes{Size{radius, "radius_m", 1}, Size{diameter, "diameter_m", 2},
                            Size{trace, "trace_m", 2}};

/// The one size that the table has; none, or several, are a fault.
const Size* sizeOf(PlaneTable& rows) {
    const Size* own = nullptr;
    std::string found;
    for (const Size& size : kSizes) {
        if (!rows.has(size.column)) continue;
        found += (found.empty() ? "" : " and ") + std::string(size.title);
        own = own == nullptr ? &size : own;
    }
    if (own != nullptr && found == own->title) return own;
    rows.fault(own == nullptr ? "found no size of the discs, allowed: radius_m, diameter_m or trace_m"
                              : "found " + found + ", allowed: one of them");
    return nullptr;
}

void readRow(PlaneTable& rows, const Size& size, std::vector<Fracture>& fractures) {
    const auto at_x = rows.number(x), at_y = rows.number(y), at_z = rows.number(z);
    const auto plane = rows.orientation();
    const auto length = rows.number(size.column);
    if (at_x && at_y && at_z && plane && length)
        fractures.push_back({{*at_x, *at_y, *at_z}, plane->dip, plane->dip_direction, *length / size.radii});
}

}  // namespace

std::string fracturesCsv(const std::vector<std::pair<std::string, Fracture>>& fractures) {
    std::string text = "x_m,y_m,z_m,dip_deg,dip_direction_deg,radius_m,set\n";
    for (const auto& [set, f] : fractures) {
        for (const double value :
             {f.centre.x(), f.centre.y(), f.centre.z(), f.dip / kDegree, f.dip_direction / kDegree, f.radius})
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
    PlaneTable rows(path, text, {x, y, z, radius, diameter, trace});
    std::vector<Fracture> fractures;
    const Size* size = rows.readHeader({x, y, z}) ? sizeOf(rows) : nullptr;
    while (size != nullptr && rows.next()) readRow(rows, *size, fractures);
    if (!rows.faults().empty()) return rows.faults();
    return fractures;
}

}  // namespace talus::formats
