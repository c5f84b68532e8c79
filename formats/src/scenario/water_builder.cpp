#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "scenario/water.h"

namespace talus::formats::scenario {

namespace {

constexpr std::size_t kMaxWalls =
    4'000'000;  // of all waters together: keeps repeated entries from taking all memory

/// Faces of a stack's blocks in the joint behind `fissure` columns: the +x faces of the column in front of it
/// and the -x faces of the column behind it, as far as there are such columns.
std::vector<WetFace> stackJointWalls(const Stack& stack, int fissure, const Model& model) {
    std::vector<WetFace> walls;
    const auto addColumn = [&](int column, const Vec3& direction) {
        if (column < 0 || column >= stack.columns) return;
        const auto first = static_cast<std::size_t>(stack.blockIndex(column, 0, 0));
        const std::int32_t face =
            faceTowards(model.blocks[first].shape, direction);  // the same in all its boxes
        for (int row = 0; row < stack.heights[static_cast<std::size_t>(column)]; ++row)
            for (int slice = 0; slice < stack.slices; ++slice)
                walls.push_back({stack.blockIndex(column, row, slice), face});
    };
    addColumn(fissure - 1, Vec3::UnitX());
    addColumn(fissure, -Vec3::UnitX());
    return walls;
}

std::vector<WetFace> wallsOf(const WaterEntry& entry, const std::vector<Stack>& stacks, const Model& model) {
    switch (entry.where) {
        case WaterEntry::Where::stack_joint:
            return stackJointWalls(stacks[entry.stack], entry.fissure, model);
        case WaterEntry::Where::block_face: {
            const Polyhedron& shape = model.blocks[static_cast<std::size_t>(entry.block)].shape;
            return {{entry.block, faceTowards(shape, entry.direction)}};
        }
        default:
            return {};
    }
}

/// One entry's wet part of one wall normal to x, as an interval of z.
struct WetInterval {
    std::int32_t block = 0, face = 0;
    double bottom = 0, top = 0;  ///< [m]
    std::size_t entry = 0;
};

/// Highest z that water reaches on the plane at x, over time. On a plane normal to x the steepest line runs
/// along z at any tilt about y, so a depth is a difference of z; an elevation is x sin(tilt) + z cos(tilt)
/// there.
double waterTop(const Water& water, double base, double x, double tilt) {
    double highest = -kInfinity;
    for (const LevelPoint& point : water.level) {
        const bool is_elevation = water.kind == Water::Level::elevation;
        const double top =
            is_elevation ? (point.value - x * std::sin(tilt)) / std::cos(tilt) : base + point.value;
        highest = std::max(highest, top);
    }
    return highest;
}

void addIntervals(const Model& model, std::size_t entry, double tilt, std::vector<WetInterval>& intervals) {
    const Water& water = model.waters[entry];
    for (const WetFace& wall : water.walls) {
        const Polyhedron& shape = model.blocks[static_cast<std::size_t>(wall.block)].shape;
        const auto face = static_cast<std::size_t>(wall.face);
        if (std::abs(shape.faceNormal(face).x()) < 1 - 1e-12) continue;
        double low = kInfinity, high = -kInfinity;
        for (const std::int32_t vertex : shape.faces[face]) {
            low = std::min(low, shape.vertices[static_cast<std::size_t>(vertex)].z());
            high = std::max(high, shape.vertices[static_cast<std::size_t>(vertex)].z());
        }
        const double base = std::isfinite(water.base) ? water.base : low;
        const double x = shape.vertices[static_cast<std::size_t>(shape.faces[face][0])].x();
        const double bottom = std::max(base, low);
        const double top = std::min(high, waterTop(water, base, x, tilt));
        const double rounding = 1e-9 * (high - low);
        if (top - bottom > rounding)
            intervals.push_back({wall.block, wall.face, bottom, top - rounding, entry});
    }
}

}  // namespace

void appendWaters(Report& report, const std::vector<WaterEntry>& entries, const std::vector<Stack>& stacks,
                  const std::vector<std::vector<WetFace>>& rock_walls, Model& model) {
    std::size_t walls = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const WaterEntry& entry = entries[i];
        Water water = entry.water;
        water.walls =
            entry.where == WaterEntry::Where::rock_joint ? rock_walls[i] : wallsOf(entry, stacks, model);
        walls += water.walls.size();
        if (walls > kMaxWalls) {
            report.add(entry.place, water.field,
                       "found water on more than " + std::to_string(kMaxWalls) +
                           " faces in all, allowed: at most that many");
            return;
        }
        model.waters.push_back(std::move(water));
    }
}

void checkWaterOverlaps(Report& report, const std::vector<WaterEntry>& entries, const Model& model) {
    const double tilt = model.analysis.start.value_or(model.gravity.tilt);
    std::vector<WetInterval> intervals;
    for (std::size_t entry = 0; entry < model.waters.size(); ++entry)
        addIntervals(model, entry, tilt, intervals);
    std::sort(intervals.begin(), intervals.end(), [](const WetInterval& a, const WetInterval& b) {
        return std::tie(a.block, a.face, a.bottom, a.entry) < std::tie(b.block, b.face, b.bottom, b.entry);
    });
    std::set<std::pair<std::size_t, std::size_t>> reported;
    for (std::size_t i = 1; i < intervals.size(); ++i) {
        WetInterval& lower = intervals[i - 1];
        WetInterval& upper = intervals[i];
        if (lower.block != upper.block || lower.face != upper.face) continue;
        const auto pair = std::minmax(lower.entry, upper.entry);
        if (upper.bottom < lower.top && reported.insert(pair).second)
            report.add(entries[pair.second].place, entries[pair.second].water.field,
                       "found water on faces that " + entries[pair.first].water.field +
                           " wets already, allowed: wet parts that do not overlap");
        if (lower.top > upper.top) {  // the highest so far is what the next one may meet
            upper.top = lower.top;
            upper.entry = lower.entry;
        }
    }
}

}  // namespace talus::formats::scenario
