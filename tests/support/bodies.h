#pragma once
// Bodies of several convex parts, for tests.

#include <string>
#include <utility>
#include <vector>

#include "support/models.h"

namespace talus::test {

using Corners = std::pair<Vec3, Vec3>;  ///< of a box [m]

inline Polyhedron bodyOf(const std::vector<Corners>& boxes) {
    std::vector<Polyhedron> parts;
    for (const auto& [min, max] : boxes) parts.push_back(*makeBox(min, max));
    return *joinParts(parts);
}

/// An L: a foot along x, and an upright on its end at x = 0.
inline std::vector<Corners> angle() { return {{{0, 0, 0}, {1, 0.4, 0.2}}, {{0, 0, 0.2}, {0.2, 0.4, 0.8}}}; }

/// A U turned over: two legs, and a beam on them.
inline std::vector<Corners> channel() {
    return {{{0, 0, 0}, {0.2, 0.3, 0.4}}, {{0.8, 0, 0}, {1, 0.3, 0.4}}, {{0, 0, 0.4}, {1, 0.3, 0.6}}};
}

/// A plus in the plane of x and z, of five cubes.
inline std::vector<Corners> cross() {
    const auto cube = [](double x, double z) { return Corners{Vec3(x, 0, z), Vec3(x + 0.2, 0.2, z + 0.2)}; };
    return {cube(0, 0), cube(0.2, 0), cube(-0.2, 0), cube(0, 0.2), cube(0, -0.2)};
}

/// A box in eight parts, cut through at 0.45 of its sides.
inline Polyhedron inEight(const Vec3& min, const Vec3& max) {
    std::vector<Corners> boxes;
    const Vec3 middle = min + 0.45 * (max - min);
    for (int k = 0; k < 8; ++k) {
        Vec3 low, high;
        for (int axis = 0; axis < 3; ++axis) {
            const bool upper = (k >> axis) % 2 != 0;
            low[axis] = upper ? middle[axis] : min[axis];
            high[axis] = upper ? max[axis] : middle[axis];
        }
        boxes.emplace_back(low, high);
    }
    return bodyOf(boxes);
}

inline void addBody(Model& model, const std::string& name, Polyhedron shape, Motion motion = Motion::free) {
    Block block = box(name, Vec3::Zero(), Vec3::Ones(), 2700, motion);
    block.shape = std::move(shape);
    block.face_joint.assign(block.shape.faces.size(), 0);
    model.blocks.push_back(block);
}

inline Polyhedron moved(Polyhedron shape, const Eigen::Quaterniond& turn, const Vec3& by) {
    for (Vec3& v : shape.vertices) v = turn * v + by;
    return shape;
}

inline Polyhedron moved(Polyhedron shape, const Vec3& by) {
    return moved(std::move(shape), Eigen::Quaterniond::Identity(), by);
}

}  // namespace talus::test
