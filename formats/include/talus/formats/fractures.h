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

/// Reads such a file: columns in any order, with or without their unit, others passed over, commas,
/// semicolons or tabs between them, decimal commas unless commas part the columns; lines that begin with #
/// too. The orientation in any notation of readPoles (poles.h). In place of `radius_m` may stand
/// `diameter_m`, or `trace_m`, a trace's length, which is taken as the diameter; or an ellipse's
/// `semi_major_m`, `semi_minor_m` and `rake_deg`. Errors, up to 20 of them:
/// the file cannot be read; a column that is missing or twice there; a row of another length, or with
/// something that is no number or out of range, with its line.
Result<std::vector<Fracture>> readFractures(const std::string& path);
/// The same for text already in memory; `path` is used in messages.
Result<std::vector<Fracture>> parseFractures(const std::string& text, const std::string& path);

/// A plane that cuts the rock mass.
struct RockJoint {
    std::string set;                 ///< what it is one of: the name, or else the field, of its table
    Vec3 normal = Vec3::UnitZ();     ///< upwards
    std::optional<Fracture> disc{};  ///< of a fracture set
    double area_inside = 0;          ///< of a disc, in the region [m^2]
};

/// All planes that cut the rock mass of a scenario, in the order of cutting; none without a rock mass.
Result<std::vector<RockJoint>> rockJoints(const Scenario& scenario);

}  // namespace talus::formats
