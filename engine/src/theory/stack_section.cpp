// A regular stack as a section: blocks by their positions, each bed's joint and each wall's water per slice.
// All slices must be alike, or the section would not represent the model.

#include <algorithm>
#include <cmath>

#include "model/plain_joint.h"
#include "theory/joints.h"
#include "theory/section.h"
#include "theory/wall_water.h"

namespace talus::theory {

namespace {

/// Block index per column, row and slice (0-based); -1 above a column's top.
class Grid {
 public:
    explicit Grid(const StackShape& shape)
        : shape_(shape), blocks_(static_cast<std::size_t>(shape.columns) * shape.rows * shape.slices, -1) {}

    std::int32_t at(int column, int row, int slice) const {
        const bool inside = column >= 0 && column < shape_.columns && row >= 0 && row < shape_.rows &&
                            slice >= 0 && slice < shape_.slices;
        return inside ? blocks_[index(column, row, slice)] : -1;
    }

    /// False when the block is not in a cell, or the cell is taken.
    bool put(std::int32_t block, const Vec3& centre) {
        const Vec3 cell = (centre - shape_.origin).cwiseQuotient(shape_.block);
        const int column = static_cast<int>(std::floor(cell.x())),
                  row = static_cast<int>(std::floor(cell.z()));
        const int slice = static_cast<int>(std::floor(cell.y()));
        const bool inside = column >= 0 && column < shape_.columns && row >= 0 && row < shape_.rows &&
                            slice >= 0 && slice < shape_.slices;
        if (!inside || blocks_[index(column, row, slice)] >= 0) return false;
        blocks_[index(column, row, slice)] = block;
        return true;
    }

 private:
    std::size_t index(int column, int row, int slice) const {
        return (static_cast<std::size_t>(column) * shape_.rows + row) * shape_.slices + slice;
    }

    const StackShape& shape_;
    std::vector<std::int32_t> blocks_;
};

struct Stack {
    const Model& model;
    const StackShape& shape;
    Grid grid;
    std::int32_t floor = -1;
    JointChoice joints;
    std::vector<std::vector<WallWater>> water;  ///< per block

    explicit Stack(const Model& m)
        : model(m), shape(*m.stack), grid(shape), joints(m), water(m.blocks.size()) {}

    /// The joint under a block, or beside it.
    const Joint* jointTowards(std::int32_t block, std::int32_t other, const Vec3& direction) const {
        const auto face = faceTowards(model, block, direction),
                   opposite = faceTowards(model, other, -direction);
        return face && opposite ? &jointBetween(model, joints, *face, *opposite) : nullptr;
    }
    std::int32_t below(int column, int row, int slice) const {
        return row == 0 ? floor : grid.at(column, row - 1, slice);
    }
};

Vec3 centreOf(const Polyhedron& shape) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& vertex : shape.vertices) sum += vertex;
    return sum / static_cast<double>(shape.vertices.size());
}

bool placeBlocks(Stack& stack) {
    for (std::size_t block = 0; block < stack.model.blocks.size(); ++block) {
        const Block& data = stack.model.blocks[block];
        const auto id = static_cast<std::int32_t>(block);
        if (data.motion == Motion::driven) return false;
        if (data.motion == Motion::free && !stack.grid.put(id, centreOf(data.shape))) return false;
        if (data.motion == Motion::fixed && std::exchange(stack.floor, id) != -1) return false;
    }
    return stack.floor != -1;
}

/// Every cell up to a column's height holds a block, none above it does (it would rest on nothing).
bool columnsAreWhole(const Stack& stack) {
    for (int column = 0; column < stack.shape.columns; ++column)
        for (int row = 1; row < stack.shape.rows; ++row)
            for (int slice = 0; slice < stack.shape.slices; ++slice)
                if (stack.grid.at(column, row, slice) >= 0 && stack.grid.at(column, row - 1, slice) < 0)
                    return false;
    return true;
}

/// Upright joints across x must open without resistance.
bool fissuresPartFreely(const Stack& stack) {
    for (int column = 0; column + 1 < stack.shape.columns; ++column)
        for (int row = 0; row < stack.shape.rows; ++row)
            for (int slice = 0; slice < stack.shape.slices; ++slice) {
                const auto front = stack.grid.at(column, row, slice),
                           back = stack.grid.at(column + 1, row, slice);
                if (front < 0 || back < 0) continue;
                const Joint* joint = stack.jointTowards(front, back, Vec3::UnitX());
                if (!joint || !partsFreely(*joint)) return false;
            }
    return true;
}

/// Loads of one slice of a column above a bed (row 0: the floor); empty above the column's top.
std::optional<Body> sliceBody(const Stack& stack, int column, int first_row, int slice) {
    const Vec3& size = stack.shape.block;
    const double bed_z = stack.shape.origin.z() + first_row * size.z();
    if (stack.grid.at(column, first_row, slice) < 0) return std::nullopt;
    Body body;
    body.length = size.x();
    for (int row = first_row; stack.grid.at(column, row, slice) >= 0; ++row) {
        const std::int32_t block = stack.grid.at(column, row, slice);
        const double weight = stack.model.blocks[block].density * size.prod() * stack.model.gravity.magnitude;
        body.weight += weight;
        body.weight_moment += weight * (row - first_row + 0.5) * size.z();
        body.height += size.z();
        body.blocks.push_back(block);
        for (const WallWater& wall : stack.water[block]) {
            (wall.on_back ? body.back_thrust : body.front_thrust) += wall.thrust();
            (wall.on_back ? body.back_moment : body.front_moment) += wall.momentAbout(bed_z);
        }
    }
    return body;
}

bool setBedJoint(const Stack& stack, int column, int row, int slice, Body& body) {
    const std::int32_t block = stack.grid.at(column, row, slice);
    const Joint* joint = stack.jointTowards(block, stack.below(column, row, slice), -Vec3::UnitZ());
    if (!joint || !isPlainCoulomb(*joint)) return false;
    const Joint now = strengthAt(*joint, 0);
    body.tan_friction = std::tan(now.friction);
    body.cohesion_force = now.cohesion * stack.shape.block.x() * stack.shape.block.y();
    return true;
}

bool alike(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

bool alike(const Body& a, const Body& b) {
    return alike(a.height, b.height) && alike(a.weight, b.weight) &&
           alike(a.weight_moment, b.weight_moment) && alike(a.tan_friction, b.tan_friction) &&
           alike(a.cohesion_force, b.cohesion_force) && alike(a.back_thrust, b.back_thrust) &&
           alike(a.back_moment, b.back_moment) && alike(a.front_thrust, b.front_thrust) &&
           alike(a.front_moment, b.front_moment);
}

/// All slices of a column as one body.
void scale(Body& body, double slices) {
    for (double* force : {&body.weight, &body.weight_moment, &body.cohesion_force, &body.back_thrust,
                          &body.back_moment, &body.front_thrust, &body.front_moment})
        *force *= slices;
}

/// False when the slices differ or a joint is beyond the formulas; an empty body above the column's top.
bool columnBody(const Stack& stack, int column, int row, std::optional<Body>& result) {
    for (int slice = 0; slice < stack.shape.slices; ++slice) {
        auto body = sliceBody(stack, column, row, slice);
        if (body && !setBedJoint(stack, column, row, slice, *body)) return false;
        if (slice == 0) {
            result = body;
        } else if (body.has_value() != result.has_value() || (body && !alike(*body, *result))) {
            return false;
        } else if (body) {
            result->blocks.insert(result->blocks.end(), body->blocks.begin(), body->blocks.end());
        }
    }
    if (result) scale(*result, stack.shape.slices);
    return true;
}

/// Limit equilibrium does not determine how the columns of a group share their load, so their bed must have
/// one strength.
bool hasOneStrength(const Bed& bed) {
    const Body* first = nullptr;
    for (const auto& body : bed.columns) {
        if (!body) continue;
        if (first && !(alike(body->tan_friction, first->tan_friction) &&
                       alike(body->cohesion_force, first->cohesion_force)))
            return false;
        first = &*body;
    }
    return true;
}

}  // namespace

std::optional<Section> stackSection(const Model& model) {
    if (!model.stack || model.stack->running) return std::nullopt;
    Stack stack(model);
    const auto walls = wallWaters(model, model.waters);
    if (!walls || !placeBlocks(stack) || !columnsAreWhole(stack) || !fissuresPartFreely(stack))
        return std::nullopt;
    for (const WallWater& wall : *walls) stack.water[wall.block].push_back(wall);

    Section section;
    for (int row = 0; row < stack.shape.rows; ++row) {
        Bed bed{row + 1, stack.shape.origin.z() + row * stack.shape.block.z(), {}};
        for (int column = 0; column < stack.shape.columns; ++column)
            if (!columnBody(stack, column, row, bed.columns.emplace_back())) return std::nullopt;
        if (!hasOneStrength(bed)) return std::nullopt;
        section.beds.push_back(bed);
    }
    return section;
}

}  // namespace talus::theory
