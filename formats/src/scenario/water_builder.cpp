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
            std::vector<WetFace> walls;
            for (const std::int32_t face : sideTowards(shape, entry.direction))
                walls.push_back({entry.block, face});
            return walls;
        }
        default:
            return {};
    }
}

}  // namespace

void appendWaters(Report& report, const std::vector<WaterEntry>& entries, const std::vector<Stack>& stacks,
                  const std::vector<RockWalls>& rock_walls, Model& model) {
    std::size_t walls = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const WaterEntry& entry = entries[i];
        if (entry.where == WaterEntry::Where::below_surface) {
            if (model.phreatic)
                report.add(entry.place, entry.surface.field,
                           "found a second surface, allowed: one, since it wets every joint");
            model.phreatic = entry.surface;
            continue;
        }
        Water water = entry.water;
        if (entry.where == WaterEntry::Where::rock_joint) {
            water.walls = rock_walls[i].faces;
            water.outline = rock_walls[i].outline;
        } else {
            water.walls = wallsOf(entry, stacks, model);
        }
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

}  // namespace talus::formats::scenario
