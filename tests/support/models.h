#pragma once
// Small models for tests, built without a scenario file.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "talus/angles.h"
#include "talus/model.h"

namespace talus::test {

using talus::degrees;
using talus::radians;

inline Joint joint(double friction_deg, double stiffness = 1e10) {
    Joint j;
    j.name = "default";
    j.normal_stiffness = j.shear_stiffness = stiffness;
    j.friction = j.residual_friction = radians(friction_deg);
    return j;
}

inline Block box(const std::string& name, const Vec3& min, const Vec3& max, double density = 2700,
                 Motion motion = Motion::free) {
    Block block;
    block.name = name;
    block.shape = *makeBox(min, max);
    block.density = density;
    block.motion = motion;
    block.face_joint.assign(block.shape.faces.size(), 0);
    block.field = "block[0]";
    return block;
}

/// One joint and a fixed floor with its top at z = 0.
inline Model floorModel(double friction_deg, double stiffness = 1e10) {
    Model model;
    model.joints = {joint(friction_deg, stiffness)};
    model.blocks = {box("floor", {-5, -5, -1}, {20, 5, 0}, 2700, Motion::fixed)};
    return model;
}

/// A box of width x (along x), depth y and height z whose lower corner is at `corner`.
inline void addBox(Model& model, const std::string& name, const Vec3& corner, const Vec3& size,
                   double density = 2700) {
    model.blocks.push_back(box(name, corner, corner + size, density));
}

inline Eigen::Quaterniond turnAbout(const Vec3& axis, double angle_deg) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(radians(angle_deg), axis.normalized()));
}

/// A cube turned about its centre, its lowest point `height` above z = 0 and its centre at (x, y).
inline void addTurnedCube(Model& model, const std::string& name, const Eigen::Quaterniond& turn, double x,
                          double y, double height, double side = 0.2) {
    addBox(model, name, Vec3::Constant(-side / 2), Vec3::Constant(side));
    double lowest = kInfinity;
    for (Vec3& v : model.blocks.back().shape.vertices) {
        v = turn * v;
        lowest = std::min(lowest, v.z());
    }
    for (Vec3& v : model.blocks.back().shape.vertices) v += Vec3(x, y, height - lowest);
}

/// A regular stack on the floor, blocks of `size`, toe at the origin.
inline Model stackModel(int columns, int rows, int slices, double friction_deg,
                        const Vec3& size = {0.2, 0.1, 0.1}, double stiffness = 3.375e11) {
    Model model = floorModel(friction_deg, stiffness);
    for (int c = 0; c < columns; ++c)
        for (int r = 0; r < rows; ++r)
            for (int s = 0; s < slices; ++s)
                addBox(
                    model,
                    "c" + std::to_string(c + 1) + "r" + std::to_string(r + 1) + "s" + std::to_string(s + 1),
                    {c * size.x(), s * size.y(), r * size.z()}, size);
    return model;
}

/// Index of a block's face whose normal is nearest to a direction.
inline std::int32_t faceTowards(const Model& model, std::size_t block, const Vec3& direction) {
    const Polyhedron& shape = model.blocks[block].shape;
    std::size_t best = 0;
    for (std::size_t f = 1; f < shape.faces.size(); ++f)
        if (shape.faceNormal(f).dot(direction) > shape.faceNormal(best).dot(direction)) best = f;
    return static_cast<std::int32_t>(best);
}

/// Water of constant depth on one face of a block.
inline Water waterOn(const Model& model, std::size_t block, const Vec3& direction, double depth,
                     double density = 1000) {
    Water water;
    water.level = {{0.0, depth}};
    water.density = density;
    water.walls = {{static_cast<std::int32_t>(block), faceTowards(model, block, direction)}};
    water.field = "water[0]";
    return water;
}

/// Water in the joint plane x = `x` of a model, on every face that lies in it.
inline Water fissureAt(const Model& model, double x, double depth) {
    Water water;
    water.level = {{0.0, depth}};
    water.base = 0.0;
    water.field = "water[0]";
    for (std::size_t b = 1; b < model.blocks.size(); ++b)
        for (std::size_t f = 0; f < model.blocks[b].shape.faces.size(); ++f) {
            const Polyhedron& shape = model.blocks[b].shape;
            if (std::abs(shape.faceNormal(f).x()) > 0.999 && std::abs(shape.faceCentroid(f).x() - x) < 1e-9)
                water.walls.push_back({static_cast<std::int32_t>(b), static_cast<std::int32_t>(f)});
        }
    return water;
}

}  // namespace talus::test
