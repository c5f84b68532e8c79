#pragma once
// [[stack]]: a regular block stack on a fixed floor of its own.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenario/properties.h"
#include "scenario/reading.h"
#include "talus/model.h"

namespace talus::formats::scenario {

/// What a [[stack]] table says. Columns, rows and slices are 1-based in names and 0-based in code.
struct Stack {
    std::string name;   ///< prefix of its blocks' names
    std::string field;  ///< "stack[0]"
    Place place;
    Place name_place;            ///< of the name, else of the table
    Vec3 origin = Vec3::Zero();  ///< [m]
    Vec3 block = Vec3::Ones();   ///< [m]
    int columns = 1, rows = 1, slices = 1;
    bool running = false;
    std::vector<int> heights;             ///< rows per column
    std::vector<std::int32_t> materials;  ///< per row
    std::int32_t joint = 0, bed_joint = 0, side_joint = 0;
    std::vector<std::vector<double>> bed_friction_deg;  ///< empty, or per level one value or one per column
    bool name_known = false;
    bool shape_known = false;  ///< name, counts and heights could be read, so its blocks' names are known

    std::int32_t first_block = 0;            ///< index of its floor in the model
    std::vector<std::int64_t> column_start;  ///< blocks in front of each column; one more for the total

    std::int64_t blockCount() const { return 1 + column_start.back(); }  ///< with the floor

    // Indices into the model's blocks: the floor first, then column by column, row by row, slice by slice.
    std::int32_t floorIndex() const { return first_block; }
    std::int32_t blockIndex(int column, int row, int slice) const {
        return static_cast<std::int32_t>(first_block + 1 + column_start[static_cast<std::size_t>(column)] +
                                         std::int64_t{row} * slices + slice);
    }
    bool hasBlock(int column, int row, int slice) const {
        return column >= 0 && column < columns && row >= 0 &&
               row < heights[static_cast<std::size_t>(column)] && slice >= 0 && slice < slices;
    }
    std::string blockName(int column, int row, int slice) const;
    std::string floorName() const { return name + "floor"; }

    /// x of a plane between blocks, counted in half blocks from the toe. One formula for both neighbours, so
    /// that faces that touch have the same coordinate to the last bit.
    double planeX(int half_blocks) const { return origin.x() + 0.5 * half_blocks * block.x(); }
    double planeY(int blocks) const { return origin.y() + blocks * block.y(); }
    double planeZ(int blocks) const { return origin.z() + blocks * block.z(); }
};

Stack readStack(Report& report, const FieldNode& entry, const Materials& materials, const Joints& joints,
                std::int64_t most_blocks);

/// Appends the stack's blocks and the joints of pairs that faces alone cannot tell. \pre the stack has no
/// errors
void appendStack(Report& report, const Stack& stack, const Materials& materials, Joints& joints,
                 Model& model);

/// The face of a shape whose outward normal is nearest to `direction`.
std::int32_t faceTowards(const Polyhedron& shape, const Vec3& direction);

}  // namespace talus::formats::scenario
