// One free box on one fixed block, as a section of one column: water on its upright faces, uplift from two
// heads.

#include <algorithm>
#include <cmath>

#include "model/plain_joint.h"
#include "theory/joints.h"
#include "theory/section.h"
#include "theory/wall_water.h"

namespace talus::theory {

namespace {

struct Box {
    Vec3 min = Vec3::Constant(kInfinity), max = Vec3::Constant(-kInfinity);
    Vec3 size() const { return max - min; }
};

/// The box a block is, if its faces look along the axes.
std::optional<Box> boxOf(const Polyhedron& shape) {
    if (shape.faces.size() != 6 || shape.vertices.size() != 8) return std::nullopt;
    for (std::size_t face = 0; face < 6; ++face)
        if (shape.faceNormal(face).cwiseAbs().maxCoeff() < 1 - 1e-12) return std::nullopt;
    Box box;
    for (const Vec3& vertex : shape.vertices) {
        box.min = box.min.cwiseMin(vertex);
        box.max = box.max.cwiseMax(vertex);
    }
    return box;
}

/// True when the whole base of the box lies on the face.
bool carries(const Polyhedron& shape, std::size_t face, const Box& box) {
    const double tolerance = 1e-4 * box.size().minCoeff();
    if (std::abs(shape.faceCentroid(face).z() - box.min.z()) > tolerance) return false;
    const auto& corners = shape.faces[face];
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3& from = shape.vertices[corners[i]];
        const Vec3 edge = shape.vertices[corners[(i + 1) % corners.size()]] - from;
        for (const double x : {box.min.x(), box.max.x()})
            for (const double y : {box.min.y(), box.max.y()})
                if (edge.x() * (y - from.y()) - edge.y() * (x - from.x()) < -tolerance * edge.norm())
                    return false;
    }
    return true;
}

/// Uplift under the base: heads at its +x and -x end, linear between, per cos(tilt).
bool addUplift(const Water& water, double gravity, const Box& box, Body& body) {
    const double length = box.size().x(), back = water.head[0], front = water.head[1];
    if (water.kind != Water::Level::head || back < 0 || front < 0) return false;
    const double unit_weight = water.density * gravity * box.size().y();
    body.uplift += unit_weight * length * 0.5 * (back + front);
    body.uplift_front += unit_weight * length * length * (front / 6 + back / 3);
    return true;
}

bool addWater(const Model& model, const Box& box, Body& body) {
    std::vector<Water> on_walls;
    for (const Water& water : model.waters) {
        if (!water.pair) {
            on_walls.push_back(water);
        } else if (!addUplift(water, model.gravity.magnitude, box, body)) {
            return false;
        }
    }
    const auto walls = wallWaters(model, on_walls);
    if (!walls || body.uplift >= body.weight) return false;
    for (const WallWater& wall : *walls) {
        (wall.on_back ? body.back_thrust : body.front_thrust) += wall.thrust();
        (wall.on_back ? body.back_moment : body.front_moment) += wall.momentAbout(box.min.z());
    }
    return true;
}

Body bodyOf(const Block& block, const Box& box, const Joint& joint, double gravity) {
    const Vec3 size = box.size();
    Body body;
    body.length = size.x();
    body.height = size.z();
    body.weight = block.density * size.prod() * gravity;
    body.weight_moment = 0.5 * body.weight * size.z();
    body.tan_friction = std::tan(joint.friction);
    body.cohesion_force = joint.cohesion * size.x() * size.y();
    return body;
}

}  // namespace

std::optional<Section> singleSection(const Model& model) {
    if (model.blocks.size() != 2) return std::nullopt;
    const std::int32_t free = model.blocks[0].motion == Motion::free ? 0 : 1, fixed = 1 - free;
    if (model.blocks[free].motion != Motion::free || model.blocks[fixed].motion != Motion::fixed)
        return std::nullopt;
    if (model.blocks[fixed].shape.partCount() > 1) return std::nullopt;
    const auto box = boxOf(model.blocks[free].shape);
    const auto base = faceTowards(model, free, -Vec3::UnitZ()),
               bed = faceTowards(model, fixed, Vec3::UnitZ());
    if (!box || !base || !bed || !carries(model.blocks[fixed].shape, bed->face, *box)) return std::nullopt;
    const Joint joint = strengthAt(jointBetween(model, JointChoice(model), *base, *bed), 0);
    if (!isPlainCoulomb(joint)) return std::nullopt;
    Body body = bodyOf(model.blocks[free], *box, joint, model.gravity.magnitude);
    body.blocks = {free};
    if (!addWater(model, *box, body)) return std::nullopt;
    return Section{{Bed{1, box->min.z(), {body}}}};
}

}  // namespace talus::theory
