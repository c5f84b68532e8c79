#pragma once
// Fracture networks as CSV (a header, then one disc a row), and all joints of a scenario's rock mass.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "talus/formats/scenario.h"
#include "talus/fractures.h"
#include "talus/result.h"

namespace talus::formats {

/// Discs with the name of their set; columns x_m, y_m, z_m, dip_deg, dip_direction_deg, radius_m, set. Where
/// there are ellipses, semi_major_m, semi_minor_m and rake_deg in place of the radius.
std::string fracturesCsv(const std::vector<std::pair<std::string, Fracture>>& fractures);

/// Reads such a file. Columns may have any order, with or without units; others are ignored, and so are lines
/// that begin with #. Separators are commas, semicolons or tabs; decimal commas are allowed unless commas
/// separate the columns. The orientation may have any notation of readPoles (poles.h). `diameter_m`, or
/// `trace_m`, a trace's length taken as the diameter, may replace `radius_m`; so may an ellipse's
/// `semi_major_m`, `semi_minor_m` and `rake_deg`. Errors, up to 20 of them: the file cannot be read; a missing
/// or repeated column; a row of another length, or with a cell that is no number or out of range, with its
/// line.
Result<std::vector<Fracture>> readFractures(const std::string& path);
/// The same for text already in memory; `path` is used in messages.
Result<std::vector<Fracture>> parseFractures(const std::string& text, const std::string& path);

/// A plane that cuts the rock mass.
struct RockJoint {
    std::string set;                 ///< name, or else field, of its table
    Vec3 normal = Vec3::UnitZ();     ///< upwards
    std::optional<Fracture> disc{};  ///< of a fracture set
    double area_inside = 0;          ///< of a disc, in the region [m^2]
};

/// All planes that cut the rock mass of a scenario, in the order of cutting; none without a rock mass.
Result<std::vector<RockJoint>> rockJoints(const Scenario& scenario);

}  // namespace talus::formats
