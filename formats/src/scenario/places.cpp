#include "scenario/places.h"

#include <array>
#include <string>

namespace talus::formats::scenario {

namespace {

const std::array<Vec3, 6> kFaceDirections = {Vec3::UnitX(),  -Vec3::UnitX(), Vec3::UnitY(),
                                             -Vec3::UnitY(), Vec3::UnitZ(),  -Vec3::UnitZ()};
const std::vector<std::string> kFaceNames = {"+x", "-x", "+y", "-y", "+z", "-z"};

/// False if a key is reported.
bool checkOrder(TableReader& box, const Vec3& min, const Vec3& max) {
    constexpr const char* kAxes = "xyz";
    bool in_order = true;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        if (min[axis] < max[axis]) continue;
        in_order = false;
        box.error("max", "found " + numberText(max[axis]) + " along " + kAxes[axis] +
                             ", allowed: greater than min, " + numberText(min[axis]));
    }
    return in_order;
}

}  // namespace

std::optional<Corners> readCorners(TableReader& table, std::string_view key) {
    auto box = table.table(key, {"min", "max"});
    if (!box) return std::nullopt;
    box->require({"min", "max"});
    const auto min = box->vector("min", kCoordinate);
    const auto max = box->vector("max", kCoordinate);
    if (!min || !max || !checkOrder(*box, *min, *max)) return std::nullopt;
    return Corners{*min, *max};
}

std::optional<Vec3> readDirection(TableReader& table, std::string_view key) {
    const auto face = table.choice(key, kFaceNames);
    return face ? std::optional(kFaceDirections[*face]) : std::nullopt;
}

std::vector<LevelPoint> readTable(Report& report, TableReader& table, std::string_view key,
                                  const Interval& values, std::string_view what) {
    std::vector<LevelPoint> points;
    const auto array = table.array(key);
    if (!array) return points;
    const std::string field = table.fieldOf(key);
    if (array->size() == 0)
        table.error(key, "found an empty array, allowed: [[time s, " + std::string(what) + "], ...]");
    for (std::size_t i = 0; i < array->size(); ++i) {
        const std::string element = elementField(field, i);
        const Node node = array->at(i);
        const auto pair = readNumbers(report, node, element, kAnyNumber, 2);
        if (!pair || !readNumber(report, node.at(0), elementField(element, 0), kNotNegative) ||
            !readNumber(report, node.at(1), elementField(element, 1), values))
            continue;
        if (!points.empty() && (*pair)[0] <= points.back().time)
            report.add(node.place(), element,
                       "found the time " + numberText((*pair)[0]) +
                           ", allowed: greater than the one before, " + numberText(points.back().time));
        points.push_back({(*pair)[0], (*pair)[1]});
    }
    return points;
}

}  // namespace talus::formats::scenario
