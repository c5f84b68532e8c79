#pragma once
// Boxes, faces and tables over time, as several sections say them.

#include <optional>
#include <string_view>
#include <vector>

#include "scenario/reading.h"
#include "talus/model.h"

namespace talus::formats::scenario {

struct Corners {
    Vec3 min, max;
};

/// `key = { min = [x, y, z], max = [x, y, z] }`; nothing when it is missing or wrong.
std::optional<Corners> readCorners(TableReader& table, std::string_view key);

/// "+x", "-x", ... as a unit vector.
std::optional<Vec3> readDirection(TableReader& table, std::string_view key);

/// `key = [[time s, value], ...]` with rising times. \param what  the value, for messages: "depth m"
std::vector<LevelPoint> readTable(Report& report, TableReader& table, std::string_view key,
                                  const Interval& values, std::string_view what);

}  // namespace talus::formats::scenario
