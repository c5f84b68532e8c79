#pragma once
// Models built by hand, so that the formulas are tested without the scenario reader.

#include <string>
#include <vector>

#include "talus/model.h"

namespace talus::theory::testing {

inline constexpr double kDegree = 0.017453292519943295;

inline Joint plainJoint(double friction_deg, double cohesion = 0) {
    Joint joint;
    joint.name = "default";
    joint.normal_stiffness = joint.shear_stiffness = 3.375e11;
    joint.friction = joint.residual_friction = friction_deg * kDegree;
    joint.cohesion = joint.residual_cohesion = cohesion;
    return joint;
}

inline Block boxBlock(const std::string& name, const Vec3& min, const Vec3& max, Motion motion,
                      double density = 2700) {
    Block block;
    block.name = name;
    block.shape = *makeBox(min, max);
    block.density = density;
    block.motion = motion;
    block.face_joint.assign(block.shape.faces.size(), 0);
    return block;
}

inline std::int32_t faceOf(const Block& block, const Vec3& direction) {
    std::int32_t best = 0;
    for (std::size_t face = 0; face < block.shape.faces.size(); ++face)
        if (block.shape.faceNormal(face).dot(direction) > block.shape.faceNormal(best).dot(direction))
            best = static_cast<std::int32_t>(face);
    return best;
}

/// The paper's kind of slope; joint 0 everywhere.
struct StackOptions {
    std::vector<int> heights = {5, 5, 5, 5, 5, 5, 5};
    int slices = 3;
    Vec3 block{0.2, 0.1, 0.1};
    double friction_deg = 19.5;
    double density = 2700;
};

inline Model stackModel(const StackOptions& options) {
    Model model;
    model.joints.push_back(plainJoint(options.friction_deg));
    StackShape shape;
    shape.columns = static_cast<int>(options.heights.size());
    shape.slices = options.slices;
    shape.block = options.block;
    shape.heights = options.heights;
    for (const int height : options.heights) shape.rows = std::max(shape.rows, height);
    const double length = shape.columns * shape.block.x(), width = shape.slices * shape.block.y();
    model.blocks.push_back(boxBlock("floor", {-0.1, 0, -0.1}, {length + 0.1, width, 0}, Motion::fixed));
    for (int column = 0; column < shape.columns; ++column)
        for (int row = 0; row < options.heights[column]; ++row)
            for (int slice = 0; slice < shape.slices; ++slice) {
                const Vec3 corner = Vec3(column, slice, row).cwiseProduct(shape.block);
                model.blocks.push_back(boxBlock("c" + std::to_string(column + 1) + "r" +
                                                    std::to_string(row + 1) + "s" + std::to_string(slice + 1),
                                                corner, corner + shape.block, Motion::free, options.density));
            }
    model.stack = shape;
    return model;
}

/// Water in a fissure, on every face that bounds it (0: the toe's free face).
inline void addFissureWater(Model& model, int fissure, double depth, double base = 0) {
    Water water;
    water.level = {{0, depth}};
    water.base = base;
    const double plane = fissure * model.stack->block.x();
    for (std::size_t block = 0; block < model.blocks.size(); ++block) {
        if (model.blocks[block].motion != Motion::free) continue;
        for (const double side : {1.0, -1.0}) {
            const std::int32_t face = faceOf(model.blocks[block], Vec3(side, 0, 0));
            if (std::abs(model.blocks[block].shape.faceCentroid(face).x() - plane) < 1e-9)
                water.walls.push_back({static_cast<std::int32_t>(block), face});
        }
    }
    model.waters.push_back(water);
}

/// One box of b x h, 0.5 m across, on a wide floor. Unit weight of rock over that of water: 26 / 9.81.
inline Model singleModel(double length, double height, double friction_deg, double cohesion = 0) {
    Model model;
    model.joints.push_back(plainJoint(friction_deg, cohesion));
    model.blocks.push_back(boxBlock("floor", {-3, -3, -1}, {3, 3, 0}, Motion::fixed));
    model.blocks.push_back(boxBlock("key", {0, 0, 0}, {length, 0.5, height}, Motion::free, 26000 / 9.81));
    return model;
}

inline void addFaceWater(Model& model, const Vec3& direction, double depth) {
    Water water;
    water.level = {{0, depth}};
    water.walls.push_back({1, faceOf(model.blocks[1], direction)});
    model.waters.push_back(water);
}

}  // namespace talus::theory::testing
