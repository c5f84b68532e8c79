#include "scenario/water.h"

#include <algorithm>
#include <cmath>

namespace talus::formats::scenario {

namespace {

constexpr std::size_t kMaxWalls =
    4'000'000;  // of all waters together: keeps repeated entries from taking all memory

/// Faces of a stack's blocks in the joint behind `fissure` columns: the +x faces of the column in front of it
/// and the -x faces of the column behind it, where these columns exist.
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

/// Upwards, as the scenario lies.
Vec3 upOf(const Gravity& gravity) {
    const Vec3 down = gravity.direction.value_or(-Vec3::UnitZ()).normalized();
    const double s = std::sin(gravity.tilt), c = std::cos(gravity.tilt);
    return -Vec3(c * down.x() + s * down.z(), down.y(), c * down.z() - s * down.x());
}

/// Heights between which blocks that are not fixed bound joints [m].
struct Heights {
    double low = kInfinity, high = -kInfinity;

    void add(const Model& model, const Vec3& up, const JointWalls& walls) {
        Heights of_joint, of_outline;
        for (const WetFace& wall : walls.faces) {
            const Block& block = model.blocks[static_cast<std::size_t>(wall.block)];
            if (block.motion == Motion::fixed) continue;
            for (const std::int32_t v : block.shape.faces[static_cast<std::size_t>(wall.face)])
                of_joint.take(up.dot(block.shape.vertices[static_cast<std::size_t>(v)]));
        }
        for (const Vec3& corner : walls.outline) of_outline.take(up.dot(corner));
        if (!walls.outline.empty()) {
            of_joint.low = std::max(of_joint.low, of_outline.low);
            of_joint.high = std::min(of_joint.high, of_outline.high);
        }
        if (of_joint.low > of_joint.high) return;
        take(of_joint.low);
        take(of_joint.high);
    }

 private:
    void take(double height) {
        low = std::min(low, height);
        high = std::max(high, height);
    }
};

/// The level that `filled` means, and the water of the crack, which stands as high.
void fill(Report& report, const WaterEntry& entry, const RockWalls& walls, Model& model, Water& water) {
    const Vec3 up = upOf(model.gravity);
    Heights heights;
    if (!entry.fills_crack_alone) heights.add(model, up, walls.joint);
    if (entry.crack) heights.add(model, up, walls.crack);
    if (heights.low > heights.high) {
        const JointWalls& filled = entry.fills_crack_alone ? walls.crack : walls.joint;
        const char* why =
            filled.faces.empty() ? ", which cuts no block" : ", whose walls are all on fixed blocks";
        report.add(
            entry.place, water.field + ".percent_filled",
            "found the joint " + quoted(filled.name) + why + "; allowed: a joint that bounds a free block");
        return;
    }
    water.is_share = true;
    water.kind = Water::Level::elevation;
    water.level = {{0, heights.low + *entry.filled * (heights.high - heights.low)}};
    // As an elevation, rounding would decide whether it wets the lowest points.
    if (*entry.filled == 0) water.kind = Water::Level::depth, water.level = {{0, 0.0}};
    if (!entry.crack) return;
    Water crack = water;
    crack.daylight = Water::Daylight::closed;
    crack.walls = walls.crack.faces;
    crack.outline = walls.crack.outline;
    model.waters.push_back(std::move(crack));
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
                           "found a second surface, allowed: one, because it wets every joint");
            model.phreatic = entry.surface;
            continue;
        }
        Water water = entry.water;
        if (entry.where == WaterEntry::Where::rock_joint) {
            water.walls = rock_walls[i].joint.faces;
            water.outline = rock_walls[i].joint.outline;
            water.ends_at_free_blocks = true;
            if (entry.filled) fill(report, entry, rock_walls[i], model, water);
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
