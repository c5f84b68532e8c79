#pragma once
// Tables of measured planes from scanlines and face mapping.

#include <optional>
#include <string>
#include <vector>

#include "talus/polyhedron.h"
#include "talus/result.h"

namespace talus::formats {

/// A measured plane.
struct MeasuredPole {
    Vec3 normal = Vec3::UnitZ();     ///< upwards
    std::string set{};               ///< "" where the table names none
    double weight = 1;               ///< of the column `weight`
    double spacing = 0;              ///< of the column `spacing_m`, along the normal [m]
    std::optional<Vec3> scanline{};  ///< unit vector along the line that met it
};

struct PoleTable {
    std::vector<MeasuredPole> poles;  ///< a row of quantity n is n of them
    std::string notation;             ///< the columns it was read by: "dip_deg, dip_direction_deg"
    bool has_sets = false, has_weight = false, has_spacing = false, has_scanline = false;
    std::vector<std::string> passed_over;  ///< titles of columns that were not read
};

/// Reads a table of planes: a header, then one plane per row. Separators are commas, semicolons or tabs;
/// decimal commas are allowed unless commas separate the columns; lines that begin with # are ignored.
/// Columns in any order, by their usual names with or without a unit:
///   dip_deg, dip_direction_deg; or strike_deg, dip_deg (right-hand rule, or quadrants: N45E, 60SE); or
///   trend_deg, plunge_deg of the pole; or nx, ny, nz. Where a table has several of these, all must give the
///   same plane within 2 degrees. set; weight, spacing_m, or scanline_trend_deg and scanline_plunge_deg;
///   quantity.
/// Errors, up to 20 of them: the file cannot be read; missing or repeated columns; a row of another length,
/// or with a cell that is no number or out of range; two kinds of weight; no rows.
Result<PoleTable> readPoles(const std::string& path);
/// The same for text already in memory; `path` is used in messages.
Result<PoleTable> parsePoles(const std::string& text, const std::string& path);

}  // namespace talus::formats
