#include "talus/formats/fractures.h"

#include <algorithm>
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

/// Of an ellipse, in place of a size.
constexpr std::array kAxes{semi_major, semi_minor, rake};

bool hasAxes(const PlaneTable& rows) {
    return std::any_of(kAxes.begin(), kAxes.end(), [&](PlaneColumn axis) { return rows.has(axis); });
}

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
    rows.fault(own == nullptr
                   ? "found no size of the discs, allowed: radius_m, diameter_m or trace_m; of ellipses "
                     "semi_major_m, semi_minor_m and rake_deg"
                   : "found " + found + ", allowed: one of them");
    return nullptr;
}

/// Axes without the others, or beside a size, are a fault.
bool areAxesWhole(PlaneTable& rows) {
    for (const PlaneColumn axis : kAxes)
        if (!rows.has(axis)) {
            rows.fault(
                "found an ellipse without all its columns, allowed: semi_major_m, semi_minor_m and "
                "rake_deg together");
            return false;
        }
    for (const Size& size : kSizes)
        if (rows.has(size.column)) {
            rows.fault("found " + std::string(size.title) +
                       " beside semi_major_m, allowed: the size of a disc or the axes of an ellipse");
            return false;
        }
    return true;
}

/// The ellipse's axes go into a fracture with its centre and orientation.
bool readAxes(PlaneTable& rows, Fracture& ellipse) {
    const auto major = rows.number(semi_major), minor = rows.number(semi_minor), angle = rows.number(rake);
    if (!major || !minor || !angle) return false;
    if (*minor > *major) {
        rows.fault("found semi_minor_m " + numberText(*minor) + ", allowed: at most semi_major_m, " +
                       numberText(*major),
                   semi_minor);
        return false;
    }
    ellipse.radius = *major;
    ellipse.semi_minor = *minor;
    ellipse.rake = *angle * kDegree;
    return true;
}

bool readSize(PlaneTable& rows, const Size& size, Fracture& disc) {
    const auto length = rows.number(size.column);
    if (length) disc.radius = *length / size.radii;
    return length.has_value();
}

/// \param size  of discs; none: of ellipses
void readRow(PlaneTable& rows, const Size* size, std::vector<Fracture>& fractures) {
    const auto at_x = rows.number(x), at_y = rows.number(y), at_z = rows.number(z);
    const auto plane = rows.orientation();
    Fracture fracture;
    const bool has_size = size != nullptr ? readSize(rows, *size, fracture) : readAxes(rows, fracture);
    if (!at_x || !at_y || !at_z || !plane || !has_size) return;
    fracture.centre = {*at_x, *at_y, *at_z};
    fracture.dip = plane->dip;
    fracture.dip_direction = plane->dip_direction;
    fractures.push_back(fracture);
}

/// The columns of one size, as numbers.
std::vector<double> sizesOf(const Fracture& fracture, bool as_ellipse) {
    if (!as_ellipse) return {fracture.radius};
    return {fracture.radius, fracture.isEllipse() ? fracture.semi_minor : fracture.radius,
            fracture.rake / kDegree};
}

}  // namespace

std::string fracturesCsv(const std::vector<std::pair<std::string, Fracture>>& fractures) {
    const bool ellipses = std::any_of(fractures.begin(), fractures.end(),
                                      [](const auto& each) { return each.second.isEllipse(); });
    std::string text = std::string("x_m,y_m,z_m,dip_deg,dip_direction_deg,") +
                       (ellipses ? "semi_major_m,semi_minor_m,rake_deg" : "radius_m") + ",set\n";
    for (const auto& [set, f] : fractures) {
        for (const double value :
             {f.centre.x(), f.centre.y(), f.centre.z(), f.dip / kDegree, f.dip_direction / kDegree})
            text += numberText(value) + ",";
        for (const double value : sizesOf(f, ellipses)) text += numberText(value) + ",";
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
    PlaneTable rows(path, text, {x, y, z, radius, diameter, trace, semi_major, semi_minor, rake});
    std::vector<Fracture> fractures;
    if (!rows.readHeader({x, y, z})) return rows.faults();
    const bool ellipses = hasAxes(rows);
    const Size* size = ellipses ? nullptr : sizeOf(rows);
    const bool is_known = ellipses ? areAxesWhole(rows) : size != nullptr;
    while (is_known && rows.next()) readRow(rows, size, fractures);
    if (!rows.faults().empty()) return rows.faults();
    return fractures;
}

}  // namespace talus::formats
