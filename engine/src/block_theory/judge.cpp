#include "block_theory/judge.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "block_theory/cone.h"
#include "block_theory/tolerances.h"

namespace talus::keyblocks {
namespace {

/// The contacts of one orientation that a body slides along.
struct Plane {
    double angle =
        0;  ///< about the direction of sliding, of its normal from where the planes are pressed [rad]
    double area = 0;          ///< [m^2]
    double friction = 0;      ///< mean of its contacts' tan(phi) by area: friction per normal force
    double normal_force = 0;  ///< [N]
    std::vector<const Contact*> contacts{};
};

/// For choosing among distributions: of a curved law the secant at 100 kPa.
double tanFriction(const Joint& joint) { return std::tan(frictionAngle(joint)); }

/// What a contact holds in shear under a normal force [N].
double resistanceOf(const Contact& contact, const Joint& joint, double normal_force) {
    if (!contact.is_patch) return normal_force * tanFriction(joint);
    return contact.area * shearStrength(joint, normal_force / contact.area);
}

/// Axes across the direction of sliding: `down` from which angles are counted, and the one beside it.
struct Across {
    Vec3 up, beside;
    double pressing = 0;  ///< normal load along `up` [N]
};

/// \param carried normal load on the planes: sum of N n
Across acrossOf(const Vec3& direction, const Vec3& carried) {
    Across across;
    across.pressing = carried.norm();
    Vec3 up = carried;
    if (!(across.pressing > 0)) up = direction.unitOrthogonal();
    across.up = (up - up.dot(direction) * direction).normalized();
    across.beside = direction.cross(across.up);
    return across;
}

/// Contacts that the direction lies in, by orientation.
std::vector<Plane> planesAlong(const Vec3& direction, const Across& across, const Body& body,
                               const std::vector<Joint>& joints) {
    std::vector<std::pair<double, const Contact*>> along;
    for (const Contact& contact : body.contacts)
        if (std::abs(contact.normal.dot(direction)) <= kInTheWay)
            along.emplace_back(std::atan2(contact.normal.dot(across.beside), contact.normal.dot(across.up)),
                               &contact);
    std::stable_sort(along.begin(), along.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Plane> planes;
    for (const auto& [angle, contact] : along) {
        if (planes.empty() || angle - planes.back().angle > kInTheWay) planes.push_back({.angle = angle});
        Plane& plane = planes.back();
        plane.area += contact->area;
        plane.friction += contact->area * tanFriction(joints[static_cast<std::size_t>(contact->joint)]);
        plane.contacts.push_back(contact);
    }
    for (Plane& plane : planes) plane.friction /= plane.area;
    return planes;
}

/// Two planes, or one twice, that carry the normal load, and the friction of that distribution.
struct Carrying {
    Plane *left = nullptr, *right = nullptr;
    double left_force = 0, right_force = 0, friction = kInfinity;
};

/// N1 n1 + N2 n2 = pressing * up, by the sine rule.
Carrying carriedBy(Plane& left, Plane& right, double pressing) {
    const double opening = std::sin(left.angle - right.angle);
    Carrying carrying{&left, &right, pressing * std::sin(-right.angle) / opening,
                      pressing * std::sin(left.angle) / opening};
    carrying.friction = carrying.left_force * left.friction + carrying.right_force * right.friction;
    return carrying;
}

/// The distribution with the least friction.
void press(std::vector<Plane>& planes, double pressing) {
    Carrying best;
    const auto look = [&](const Carrying& found) {
        // Among equals the first: those that differ by rounding must not depend on the order of contacts.
        if (found.friction < best.friction * (1 - 1e-12)) best = found;
    };
    for (Plane& plane : planes)
        if (std::abs(plane.angle) <= kInTheWay)
            look({&plane, &plane, pressing, 0, pressing * plane.friction});
    for (Plane& left : planes)
        for (Plane& right : planes)
            if (left.angle > kInTheWay && right.angle < -kInTheWay &&
                left.angle - right.angle < M_PI - kInTheWay)
                look(carriedBy(left, right, pressing));
    if (best.left == nullptr) return;
    best.left->normal_force += best.left_force;
    best.right->normal_force += best.right_force;
}

/// Strength of a plane; with `told` its joints are appended.
double resistanceOf(const Plane& plane, const std::vector<Joint>& joints, std::vector<SlidingPlane>* told) {
    double sum = 0;
    std::map<std::string, SlidingPlane> by_joint;
    for (const Contact* contact : plane.contacts) {
        const Joint& joint = joints[static_cast<std::size_t>(contact->joint)];
        const double normal_force = plane.normal_force * (contact->area / plane.area);
        const double resistance = resistanceOf(*contact, joint, normal_force);
        sum += resistance;
        if (told == nullptr || !(plane.normal_force > 0)) continue;
        SlidingPlane& entry =
            by_joint.try_emplace(joint.name, SlidingPlane{.joint = joint.name}).first->second;
        entry.normal = contact->normal;
        entry.area += contact->area;
        entry.normal_force += normal_force;
        entry.resistance += resistance;
    }
    for (auto& [name, entry] : by_joint) told->push_back(std::move(entry));
    return sum;
}

SlidingMode modeOf(const std::vector<Plane>& planes) {
    const auto pressed = std::count_if(planes.begin(), planes.end(),
                                       [](const Plane& plane) { return plane.normal_force > 0; });
    if (pressed == 0) return SlidingMode::falls;
    return pressed == 1 ? SlidingMode::slides : SlidingMode::wedge;
}

void nameJoints(Sliding& sliding) {
    std::stable_sort(sliding.planes.begin(), sliding.planes.end(),
                     [](const auto& a, const auto& b) { return a.normal_force > b.normal_force; });
    std::set<std::string> names;
    for (const SlidingPlane& plane : sliding.planes) names.insert(plane.joint);
    sliding.joints.assign(names.begin(), names.end());
}

Sliding judged(const Body& body, const std::vector<Joint>& joints, bool in_detail) {
    Sliding sliding;
    const Projection found = project(body.force, body.contacts);
    sliding.driving = found.along.norm();
    if (!(sliding.driving > 0)) return sliding;
    sliding.direction = found.along / sliding.driving;
    const bool pressed = found.pressed[0] >= 0;
    const Across across =
        acrossOf(sliding.direction, pressed ? Vec3(found.along - body.force) : Vec3(Vec3::Zero()));
    std::vector<Plane> planes = planesAlong(sliding.direction, across, body, joints);
    if (across.pressing > kNoForce * body.force.norm()) press(planes, across.pressing);
    sliding.mode = modeOf(planes);
    for (const Plane& plane : planes)
        sliding.resisting += resistanceOf(plane, joints, in_detail ? &sliding.planes : nullptr);
    sliding.factor = sliding.resisting / sliding.driving;
    if (in_detail) nameJoints(sliding);
    return sliding;
}

}  // namespace

Sliding judge(const Body& body, const std::vector<Joint>& joints) { return judged(body, joints, true); }
Sliding judgeBriefly(const Body& body, const std::vector<Joint>& joints) {
    return judged(body, joints, false);
}

}  // namespace talus::keyblocks
