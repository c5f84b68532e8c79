#include "block_theory/cone.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "block_theory/tolerances.h"

namespace talus::keyblocks {
namespace {

/// Two planes nearer than this to parallel have no usable line of intersection. It is half the angle at which
/// a neighbour obstructs, so one of two such planes is enough.
constexpr double kNoLine = 0.5 * kInTheWay;

/// The least s.n over |s|, and its contact.
struct Worst {
    double clearance = kInfinity;
    int contact = -1;
};

Worst worstOf(const Vec3& s, std::span<const Contact> contacts) {
    Worst worst;
    for (std::size_t k = 0; k < contacts.size(); ++k) {
        const double clearance = s.dot(contacts[k].normal);
        if (clearance < worst.clearance) worst = {clearance, static_cast<int>(k)};
    }
    worst.clearance /= s.norm();
    return worst;
}

/// Projects onto the cone of up to three contacts: onto the plane, line or point that the result lies in.
class SmallCone {
 public:
    SmallCone(const Vec3& force, std::span<const Contact> contacts) : force_(force), contacts_(contacts) {}

    /// \param known  pressed so far  \param violated  by what these left
    Projection with(const std::array<int, 2>& known, int violated) {
        considered_ = {violated};
        for (const int contact : known)
            if (contact >= 0) considered_.push_back(contact);
        consider({violated, -1});
        for (std::size_t k = 1; k < considered_.size(); ++k) consider({violated, considered_[k]});
        // The corner of three planes, if no face and no edge is nearer.
        if (considered_.size() == 3 && least_violation_ > kInTheWay) return {};
        return best_;
    }

 private:
    const Vec3& normalOf(int contact) const { return contacts_[static_cast<std::size_t>(contact)].normal; }

    /// The part of the force in these planes, if it presses on them and leaves the other contacts open.
    void consider(const std::array<int, 2>& pressed) {
        Vec3 along;
        const Vec3& n = normalOf(pressed[0]);
        if (pressed[1] < 0) {
            if (force_.dot(n) > kNoForce * force_.norm()) return;  // N = -force.n
            along = force_ - force_.dot(n) * n;
        } else {
            const Vec3 line = n.cross(normalOf(pressed[1]));
            const double sine = line.norm();
            if (sine < kNoLine) return;
            along = force_.dot(line) / (sine * sine) * line;
            const double cosine = n.dot(normalOf(pressed[1]));
            const double f1 = force_.dot(n), f2 = force_.dot(normalOf(pressed[1]));
            // N1 n1 + N2 n2 = along - force
            const double n1 = (cosine * f2 - f1) / (sine * sine), n2 = (cosine * f1 - f2) / (sine * sine);
            if (std::min(n1, n2) < -kNoForce * force_.norm()) return;
        }
        const double length = along.norm();
        if (length <= kNoForce * force_.norm()) {
            keep(0, {Vec3::Zero(), pressed});
            return;
        }
        double violation = 0;
        for (const int contact : considered_)
            violation = std::max(violation, -along.dot(normalOf(contact)) / length);
        keep(violation, {along, pressed});
    }

    /// A face that leaves the others free goes before an edge.
    void keep(double violation, const Projection& found) {
        if (least_violation_ <= kInTheWay || violation >= least_violation_) return;
        least_violation_ = violation;
        best_ = found;
    }

    const Vec3& force_;
    std::span<const Contact> contacts_;
    std::vector<int> considered_{};
    double least_violation_ = kInfinity;
    Projection best_{};
};

}  // namespace

Projection project(const Vec3& force, std::span<const Contact> contacts) {
    // The most violated contact joins those that are pressed, until none is violated: a dual active-set
    // method (D. Goldfarb and A. Idnani, Math. Program. 27: 1-33, 1983) in three dimensions. `along` gets
    // shorter each time, so it ends; the bound on iterations covers planes that differ by rounding.
    constexpr int kMostTurns = 100;
    Projection found{force, {-1, -1}};
    for (int turn = 0; turn < kMostTurns && found.along.norm() > kNoForce * force.norm(); ++turn) {
        const Worst worst = worstOf(found.along, contacts);
        if (worst.clearance >= -kInTheWay) return found;
        found = SmallCone(force, contacts).with(found.pressed, worst.contact);
    }
    return {};
}

Vec3 freeDirection(std::span<const Contact> contacts) {
    if (contacts.empty()) return -Vec3::UnitZ();
    // The area vectors of a closed body sum to zero, so the mean of its contacts' inward normals points to
    // its free side.
    Vec3 outwards = Vec3::Zero();
    for (const Contact& contact : contacts) outwards += contact.area * contact.normal;
    std::vector<Vec3> tried{outwards};
    // If any s remains, one of these has a component along it, and so a projection that is not zero.
    for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())})
        for (const double sign : {1.0, -1.0}) tried.push_back(sign * axis);
    for (const Vec3& way : tried)
        if (const Vec3 along = project(way, contacts).along; along.norm() > 0) return along.normalized();
    return Vec3::Zero();
}

bool isRemovable(std::span<const Contact> contacts) { return freeDirection(contacts).norm() > 0; }

}  // namespace talus::keyblocks
