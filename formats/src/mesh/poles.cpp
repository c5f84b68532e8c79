#include "talus/formats/poles.h"

#include <cmath>

#include "mesh/plane_table.h"
#include "talus/angles.h"
#include "talus/formats/csv.h"
#include "talus/rock_mass.h"
#include "toml/file_text.h"

namespace talus::formats {

namespace {

using enum PlaneColumn;

/// Rows and their quantities together; far more than can be tested in pairs.
constexpr std::size_t kMostMeasured = 1'000'000;

Vec3 lineTowards(double trend_deg, double plunge_deg) {
    const double trend_rad = trend_deg * kDegree, plunge_rad = plunge_deg * kDegree;
    return {std::cos(plunge_rad) * std::sin(trend_rad), std::cos(plunge_rad) * std::cos(trend_rad),
            -std::sin(plunge_rad)};
}

/// What the table has besides orientations; false where it has two kinds of weight.
bool readKinds(PlaneTable& rows, PoleTable& table) {
    table.has_sets = rows.has(set);
    table.has_weight = rows.has(weight);
    table.has_spacing = rows.has(spacing);
    table.has_scanline = rows.has(scanline_trend) && rows.has(scanline_plunge);
    if (rows.has(scanline_trend) != rows.has(scanline_plunge)) {
        rows.fault("found one of scanline_trend_deg and scanline_plunge_deg, allowed: both or none");
        return false;
    }
    if (table.has_weight + table.has_spacing + table.has_scanline <= 1) return true;
    rows.fault(
        "found more than one of weight, spacing_m and scanline_trend_deg, allowed: one, because each gives "
        "the weights of the poles");
    return false;
}

void readRow(PlaneTable& rows, PoleTable& table) {
    MeasuredPole pole;
    const auto plane = rows.orientation();
    if (!plane) return;
    pole.normal = upwardNormal(plane->dip, plane->dip_direction);
    if (table.has_sets) pole.set = csvText(rows.text(set));
    if (table.has_weight) pole.weight = rows.number(weight).value_or(1);
    if (table.has_spacing) pole.spacing = rows.number(spacing).value_or(1);
    if (table.has_scanline) {
        const auto towards = rows.number(scanline_trend), down = rows.number(scanline_plunge);
        if (towards && down) pole.scanline = lineTowards(*towards, *down);
    }
    double times = 1;
    if (rows.has(quantity)) times = rows.number(quantity).value_or(1);
    if (times != std::floor(times))
        rows.fault("found a broken number of planes, allowed: a whole one", quantity);
    if (static_cast<double>(table.poles.size()) + times > static_cast<double>(kMostMeasured)) {
        rows.fault("found more planes, allowed: " + std::to_string(kMostMeasured));
        return;
    }
    table.poles.insert(table.poles.end(), static_cast<std::size_t>(times), pole);
}

}  // namespace

Result<PoleTable> readPoles(const std::string& path) {
    const auto text = toml::readFileText(path);
    if (!text) return text.errors();
    return parsePoles(*text, path);
}

Result<PoleTable> parsePoles(const std::string& text, const std::string& path) {
    PlaneTable rows(path, text, {set, weight, spacing, scanline_trend, scanline_plunge, quantity});
    PoleTable table;
    if (rows.readHeader({}) && readKinds(rows, table)) {
        while (rows.next()) readRow(rows, table);
        if (table.poles.empty() && rows.faults().empty())
            rows.fault("found no rows, allowed: at least one plane");
    }
    if (!rows.faults().empty()) return rows.faults();
    table.notation = rows.notation();
    table.passed_over = rows.passedOver();
    return table;
}

}  // namespace talus::formats
