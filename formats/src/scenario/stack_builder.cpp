#include <algorithm>
#include <array>

#include "scenario/stack.h"

namespace talus::formats::scenario {

namespace {

/// The sides of a box, in the order of `kSideDirections`.
enum Side : std::size_t { kMinX, kMaxX, kMinY, kMaxY, kMinZ, kMaxZ, kSides };
const std::array<Vec3, kSides> kSideDirections = {-Vec3::UnitX(), Vec3::UnitX(),  -Vec3::UnitY(),
                                                  Vec3::UnitY(),  -Vec3::UnitZ(), Vec3::UnitZ()};
using SideJoints = std::array<std::int32_t, kSides>;

/// Joint of each bed level and column. Level 0 is the floor's and level k lies on row k; the top of the last
/// row has the plain bed joint.
class BedJoints {
 public:
    BedJoints(const Stack& stack, Joints& joints) : plain_(stack.bed_joint) {
        for (const std::vector<double>& level : stack.bed_friction_deg) {
            levels_.emplace_back();
            for (const double friction_deg : level)
                levels_.back().push_back(joints.withFriction(stack.bed_joint, friction_deg));
        }
    }

    std::int32_t at(int level, int column) const {
        if (static_cast<std::size_t>(level) >= levels_.size()) return plain_;
        const auto& joints = levels_[static_cast<std::size_t>(level)];
        return joints.size() == 1 ? joints[0] : joints[static_cast<std::size_t>(column)];
    }

 private:
    std::int32_t plain_;
    std::vector<std::vector<std::int32_t>> levels_;
};

class StackBuilder {
 public:
    StackBuilder(Report& report, const Stack& stack, const Materials& materials, Joints& joints, Model& model)
        : report_(report), stack_(stack), materials_(materials), beds_(stack, joints), model_(model) {}

    void build() {
        if (!appendFloor()) return;
        for (int column = 0; column < stack_.columns; ++column)
            for (int row = 0; row < stack_.heights[static_cast<std::size_t>(column)]; ++row)
                for (int slice = 0; slice < stack_.slices; ++slice)
                    if (!appendBlock(column, row, slice)) return;
        appendPairJoints();
    }

 private:
    bool isShifted(int row) const { return stack_.running && row % 2 == 1; }

    bool appendFloor() {
        const int length = 2 * stack_.columns + (stack_.running && stack_.rows > 1 ? 1 : 0);
        const Vec3 min(stack_.planeX(-length), stack_.planeY(-1), stack_.planeZ(-1));
        const Vec3 max(stack_.planeX(2 * length), stack_.planeY(stack_.slices + 1), stack_.planeZ(0));
        SideJoints joints;
        joints.fill(stack_.bed_joint);
        joints[kMaxZ] = beds_.at(0, 0);
        return append(stack_.floorName(), min, max, stack_.materials[0], Motion::fixed, joints);
    }

    bool appendBlock(int column, int row, int slice) {
        const int left = 2 * column + isShifted(row);
        const Vec3 min(stack_.planeX(left), stack_.planeY(slice), stack_.planeZ(row));
        const Vec3 max(stack_.planeX(left + 2), stack_.planeY(slice + 1), stack_.planeZ(row + 1));
        const SideJoints joints = {stack_.joint,      stack_.joint,          stack_.side_joint,
                                   stack_.side_joint, beds_.at(row, column), beds_.at(row + 1, column)};
        return append(stack_.blockName(column, row, slice), min, max,
                      stack_.materials[static_cast<std::size_t>(row)], Motion::free, joints);
    }

    bool append(std::string name, const Vec3& min, const Vec3& max, std::int32_t material, Motion motion,
                const SideJoints& joints) {
        auto shape = makeBox(min, max);
        if (!shape) {
            report_.add(stack_.place, stack_.field,
                        "block " + name + " cannot be represented at coordinates this large: " +
                            shape.errors().front().message);
            return false;
        }
        Block block;
        block.name = std::move(name);
        block.shape = std::move(*shape);
        block.material = material;
        block.density = materials_.densities[static_cast<std::size_t>(material)];
        block.motion = motion;
        block.face_joint = faceJoints(block.shape, joints);
        block.field = stack_.field;
        model_.blocks.push_back(std::move(block));
        return true;
    }

    /// All boxes list their faces in the same order, so their sides are looked up once.
    std::vector<std::int32_t> faceJoints(const Polyhedron& shape, const SideJoints& joints) {
        if (side_of_face_.empty()) {
            side_of_face_.resize(shape.faces.size());
            for (std::size_t side = 0; side < kSides; ++side)
                side_of_face_[static_cast<std::size_t>(faceTowards(shape, kSideDirections[side]))] = side;
        }
        std::vector<std::int32_t> face_joints;
        face_joints.reserve(side_of_face_.size());
        for (const std::size_t side : side_of_face_) face_joints.push_back(joints[side]);
        return face_joints;
    }

    /// Two blocks on one face (the floor's top, a bed in running bond) may have two joints. The upper block's
    /// column decides, not the lesser friction.
    void appendPairJoints() {
        for (int column = 0; column < stack_.columns; ++column)
            for (int row = 0; row < stack_.heights[static_cast<std::size_t>(column)]; ++row) {
                if (row == 0 && beds_.at(0, column) != beds_.at(0, 0)) appendFloorPairs(column);
                if (row > 0 && stack_.running) appendBondPairs(column, row);
            }
    }

    void appendFloorPairs(int column) {
        for (int slice = 0; slice < stack_.slices; ++slice)
            appendPair(stack_.floorIndex(), stack_.blockIndex(column, 0, slice), beds_.at(0, column));
    }

    /// A block of a shifted row also lies on the next column, one of an unshifted row on the column before.
    void appendBondPairs(int column, int row) {
        const int other = isShifted(row) ? column + 1 : column - 1;
        const std::int32_t joint = beds_.at(row, column);
        if (!stack_.hasBlock(other, row - 1, 0) || beds_.at(row, other) == joint) return;
        for (int slice = 0; slice < stack_.slices; ++slice)
            appendPair(stack_.blockIndex(other, row - 1, slice), stack_.blockIndex(column, row, slice),
                       joint);
    }

    void appendPair(std::int32_t lower, std::int32_t upper, std::int32_t joint) {
        model_.pair_joints.push_back({lower, upper, joint, false, stack_.field + ".bed_friction_deg"});
    }

    Report& report_;
    const Stack& stack_;
    const Materials& materials_;
    BedJoints beds_;
    Model& model_;
    std::vector<std::size_t> side_of_face_;
};

}  // namespace

std::int32_t faceTowards(const Polyhedron& shape, const Vec3& direction) {
    std::size_t best = 0;
    double most = -kInfinity;
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
        const double along = shape.faceNormal(face).dot(direction);
        if (along <= most) continue;
        most = along;
        best = face;
    }
    return static_cast<std::int32_t>(best);
}

std::string Stack::blockName(int column, int row, int slice) const {
    return name + "c" + std::to_string(column + 1) + "r" + std::to_string(row + 1) + "s" +
           std::to_string(slice + 1);
}

void appendStack(Report& report, const Stack& stack, const Materials& materials, Joints& joints,
                 Model& model) {
    StackBuilder(report, stack, materials, joints, model).build();
}

}  // namespace talus::formats::scenario
