#include "limit_analysis/programme.h"

#include <algorithm>
#include <cmath>

#include "talus/model.h"

namespace talus::limit {
namespace {

constexpr double kLightest = 1e-3;   // of the mean weight: what a lighter body's equations are divided by
constexpr double kViolation = 1e-7;  // of a reduced cost: an edge that is worth adding
constexpr double kBeyond = 1e-6;     // of a shear strength: a force outside the cone

Vec3 along(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

double meanWeight(const Assembly& assembly) {
    double sum = 0;
    for (const Body& body : assembly.bodies) sum += body.weight;
    return sum / static_cast<double>(assembly.bodies.size());
}

}  // namespace

Programme::Programme(const Assembly& assembly, const std::vector<contact::JointLaw>& laws,
                     const Pyramids& pyramids, Side side, const Loads& fixed, const Loads& growing,
                     const std::atomic<bool>* stop)
    : assembly_(assembly), laws_(laws), mean_weight_(meanWeight(assembly)), program_(makeRows(fixed, stop)) {
    Columns columns;
    addImbalance(columns);
    addMultiplier(columns, growing);
    for (const Tendon& tendon : assembly.tendons) addTendon(columns, tendon);
    for (std::size_t p = 0; p < assembly.points.size(); ++p) addPoint(columns, p, pyramids.corners(p, side));
    program_.append(columns);
    columns_ = columns.size();
}

double Programme::scaleOf(std::int32_t body) const {
    return std::max(assembly_.bodies[static_cast<std::size_t>(body)].weight, kLightest * mean_weight_);
}

double Programme::scaleOf(std::int32_t body_a, std::int32_t body_b) const {
    if (body_a == kFixed) return scaleOf(body_b);
    if (body_b == kFixed) return scaleOf(body_a);
    return std::min(scaleOf(body_a), scaleOf(body_b));
}

/// Tension bears shear only as the envelope says; where the tensile strength is beyond the envelope's apex,
/// the convex hull of both counts.
Programme::Strength Programme::strengthOf(const ContactPoint& point) const {
    const contact::StrengthLine line = contact::strengthLine(laws_[static_cast<std::size_t>(point.joint)]);
    const double cohesion = std::max(line.cohesion - line.tan_friction * line.tensile_strength, 0.0);
    return {line.tan_friction, cohesion * point.area, line.tensile_strength * point.area};
}

LinearProgram Programme::makeRows(const Loads& fixed, const std::atomic<bool>* stop) {
    Columns loads;
    for (std::size_t b = 0; b < fixed.size(); ++b) writeLoad(loads, b, fixed[b]);
    rows_ = assembly_.bodies.size() * static_cast<std::size_t>(assembly_.rowsPerBody());
    std::vector<double> lower(rows_, 0.0);
    for (std::size_t k = 0; k < loads.row.size(); ++k)
        lower[static_cast<std::size_t>(loads.row[k])] -= loads.value[k];
    std::vector<double> upper = lower;
    for (const ContactPoint& point : assembly_.points) {
        const Strength strength = strengthOf(point);
        limit_row_.push_back(strength.shear > 0 ? static_cast<int>(lower.size()) : -1);
        if (strength.shear == 0) continue;
        lower.push_back(-kInfinity);
        upper.push_back(std::max(strength.shear, strength.tension) / scaleOf(point));
    }
    return LinearProgram(lower, upper, stop);
}

/// Force [N] and torque about its centroid [N m] in the equations of a body.
void Programme::writeLoad(Columns& columns, std::size_t body, const Wrench& load) const {
    const int first = static_cast<int>(body) * assembly_.rowsPerBody();
    const double scale = scaleOf(static_cast<std::int32_t>(body));
    const Vec3 force = load.force / scale;
    const Vec3 torque = load.torque / (scale * assembly_.bodies[body].radius);
    if (assembly_.plane_section) {
        columns.entry(first, force.x());
        columns.entry(first + 1, force.z());
        columns.entry(first + 2, torque.y());
        return;
    }
    for (int k = 0; k < 3; ++k) columns.entry(first + k, force[k]);
    for (int k = 0; k < 3; ++k) columns.entry(first + 3 + k, torque[k]);
}

/// The same of a force at a place; nothing for fixed bodies.
void Programme::writeForce(Columns& columns, std::int32_t body, const Vec3& place, const Vec3& force) const {
    if (body == kFixed) return;
    const auto b = static_cast<std::size_t>(body);
    writeLoad(columns, b, {force, (place - assembly_.bodies[b].centroid).cross(force)});
}

void Programme::addImbalance(Columns& columns) const {
    const int per_body = assembly_.rowsPerBody();
    for (int row = 0; row < static_cast<int>(rows_); ++row)
        for (const double sign : {1.0, -1.0}) {
            columns.entry(row, sign);
            columns.close(0, kInfinity, scaleOf(row / per_body) / mean_weight_);
        }
}

void Programme::addMultiplier(Columns& columns, const Loads& growing) const {
    for (std::size_t b = 0; b < growing.size(); ++b) writeLoad(columns, b, growing[b]);
    columns.close(0, 0);
}

void Programme::addTendon(Columns& columns, const Tendon& tendon) const {
    const double scale = scaleOf(tendon.body_a, tendon.body_b);
    writeForce(columns, tendon.body_a, tendon.place, scale * tendon.along);
    writeForce(columns, tendon.body_b, tendon.place, -scale * tendon.along);
    columns.close(0, tendon.strength / scale);
}

/// A column of one force, as strong as the lighter of the two bodies is heavy.
void Programme::addForce(Columns& columns, std::size_t p, const Vec3& force, double most, int limit_row,
                         double share) {
    const ContactPoint& point = assembly_.points[p];
    const double scale = scaleOf(point);
    const Vec3 on_b = scale * (point.axes * force);
    const auto column = static_cast<int>(columns_ + columns.size());
    writeForce(columns, point.body_a, point.place, -on_b);
    writeForce(columns, point.body_b, point.place, on_b);
    if (limit_row >= 0) columns.entry(limit_row, share);
    columns.close(0, most);
    point_columns_.push_back({static_cast<std::int32_t>(p), scale * force, column});
}

void Programme::addCorner(Columns& columns, std::size_t p, const Corner& corner) {
    const Strength strength = strengthOf(assembly_.points[p]);
    const Vec3 shear = corner.reach * along(corner.angle);
    if (strength.tan_friction > 0)
        addForce(columns, p, Vec3::UnitZ() + strength.tan_friction * shear, kInfinity, -1, 0);
    if (strength.shear == 0) return;
    const double greatest = std::max(strength.shear, strength.tension);
    addForce(columns, p, (strength.shear * shear - strength.tension * Vec3::UnitZ()) / greatest, kInfinity,
             limit_row_[p], 1.0);
}

void Programme::addPoint(Columns& columns, std::size_t p, const std::vector<Corner>& corners) {
    const Strength strength = strengthOf(assembly_.points[p]);
    if (strength.tan_friction == 0) addForce(columns, p, Vec3::UnitZ(), kInfinity, -1, 0);
    if (strength.shear == 0 && strength.tension > 0)
        addForce(columns, p, -Vec3::UnitZ(), strength.tension / scaleOf(assembly_.points[p]), -1, 0);
    for (const Corner& corner : corners) addCorner(columns, p, corner);
}

Outcome Programme::balance() { return program_.solveDual(); }

Outcome Programme::solveAgain() { return program_.solvePrimal(); }

Outcome Programme::growMost(double least, double most) {
    const auto slacks = static_cast<int>(2 * rows_);
    for (int column = 0; column < slacks; ++column) program_.setColumn(column, 0, 0, 0);
    program_.setColumn(slacks, least, most, -1);
    return program_.solvePrimal();
}

double Programme::multiplier() const { return program_.value(static_cast<int>(2 * rows_)); }

std::vector<BodyMotion> Programme::mechanism() const {
    std::vector<BodyMotion> motion(assembly_.bodies.size());
    int row = 0;
    const auto next = [&] { return -program_.price(row++); };
    for (std::size_t b = 0; b < motion.size(); ++b) {
        BodyMotion& of = motion[b];
        if (assembly_.plane_section) {
            of.velocity.x() = next();
            of.velocity.z() = next();
            of.spin.y() = next();
        } else {
            for (double& v : of.velocity) v = next();
            for (double& v : of.spin) v = next();
        }
        of.velocity /= scaleOf(static_cast<std::int32_t>(b));
        of.spin /= scaleOf(static_cast<std::int32_t>(b)) * assembly_.bodies[b].radius;
    }
    return motion;
}

/// Of body b over body a at a point, along its axes.
Vec3 Programme::slip(std::size_t p, const std::vector<BodyMotion>& motion) const {
    const ContactPoint& point = assembly_.points[p];
    const auto velocity = [&](std::int32_t body) -> Vec3 {
        if (body == kFixed) return Vec3::Zero();
        const auto b = static_cast<std::size_t>(body);
        return motion[b].velocity + motion[b].spin.cross(point.place - assembly_.bodies[b].centroid);
    };
    return point.axes.transpose() * (velocity(point.body_b) - velocity(point.body_a));
}

double Programme::imbalanceGrowth() const {
    const std::vector<BodyMotion> motion = mechanism();
    double power = 0;
    for (const PointColumn& column : point_columns_) {
        const double force = program_.value(column.column);
        if (force == 0) continue;
        const Vec3 slip = this->slip(static_cast<std::size_t>(column.point), motion);
        power += force * (column.force.x() * slip.x() + column.force.y() * slip.y());
    }
    return -power;
}

/// Whether a unit of force along a new edge would pay: its reduced cost.
bool Programme::worthAdding(std::size_t p, const Vec3& slip, double angle) const {
    const ContactPoint& point = assembly_.points[p];
    const Strength strength = strengthOf(point);
    const Vec3 shear = along(angle);
    const double scale = scaleOf(point);
    const double cone = scale * slip.dot(Vec3::UnitZ() + strength.tan_friction * shear);
    if (cone < -kViolation) return true;
    if (strength.shear == 0) return false;
    const double greatest = std::max(strength.shear, strength.tension);
    const double end = scale / greatest * slip.dot(strength.shear * shear - strength.tension * Vec3::UnitZ());
    return end - program_.price(limit_row_[p]) < -kViolation;
}

bool Programme::refineInside(Pyramids& pyramids) {
    const std::vector<BodyMotion> motion = mechanism();
    Columns columns;
    for (std::size_t p = 0; p < assembly_.points.size(); ++p) {
        const Vec3 slip = this->slip(p, motion);
        const double angle = std::atan2(-slip.y(), -slip.x());
        if (worthAdding(p, slip, angle) && pyramids.add(p, angle)) addCorner(columns, p, {angle, 1.0});
    }
    program_.append(columns);
    columns_ += columns.size();
    return columns.size() > 0;
}

bool Programme::refineOutside(Pyramids& pyramids) const {
    std::vector<Vec3> force(assembly_.points.size(), Vec3::Zero());
    for (const PointColumn& column : point_columns_)
        force[static_cast<std::size_t>(column.point)] += program_.value(column.column) * column.force;
    bool added = false;
    for (std::size_t p = 0; p < force.size(); ++p) {
        const Strength strength = strengthOf(assembly_.points[p]);
        const double limit = strength.shear + strength.tan_friction * (force[p].z() + strength.tension);
        if (std::hypot(force[p].x(), force[p].y()) > (1 + kBeyond) * limit)
            added |= pyramids.add(p, std::atan2(force[p].y(), force[p].x()));
    }
    return added;
}

}  // namespace talus::limit
