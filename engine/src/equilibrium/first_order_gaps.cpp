#include "equilibrium/first_order_gaps.h"

#include <algorithm>
#include <cmath>

#include "forces/contact_forces.h"
#include "state/block_motion.h"

namespace talus::equilibrium {
namespace {

constexpr double kHardlyTurned = 1e-2;  // [rad]
constexpr double kHardlySlid = 1e-2;    // of the smaller block's size

}  // namespace

FirstOrderGaps::FirstOrderGaps(const State& stood, const State& state)
    : stood_{stood.blocks.position, stood.blocks.orientation},
      built_{stood.geometry->initial_position, stood.geometry->initial_orientation} {
    std::vector<bool> turned_before;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        const auto turned = [&](const QuaternionArray& from, const QuaternionArray& to) {
            return rotationFrom(from, to, b) > kHardlyTurned;
        };
        turned_before.push_back(turned(built_.orientation, stood_.orientation));
        turned_since_.push_back(turned(stood_.orientation, state.blocks.orientation));
    }
    for (std::size_t i = 0; i < state.interfaces.size(); ++i) {
        const auto part = [&](std::size_t k) { return state.interfaces.referenceGap(i, k); };
        reference_.emplace_back(part(0), part(1), part(2));
        const auto a = static_cast<std::size_t>(state.interfaces.block_a[i]),
                   b = static_cast<std::size_t>(state.interfaces.block_b[i]);
        const RelativePose then = relativePose(stood_.position, stood_.orientation, state.interfaces, i),
                           built = relativePose(built_.position, built_.orientation, state.interfaces, i);
        const double slid =
            std::hypot(then.slide_1.x() - built.slide_1.x(), then.slide_2.x() - built.slide_2.x());
        is_as_built_.push_back(!turned_before[a] && !turned_before[b] &&
                               slid <
                                   kHardlySlid * std::min(state.geometry->size[a], state.geometry->size[b]));
    }
}

Vec3 FirstOrderGaps::secondOrder(const State& state, std::size_t i) const {
    const Interfaces& f = state.interfaces;
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    if (turned_since_[a] || turned_since_[b]) return Vec3::Zero();
    const Places& about = is_as_built_[i] ? built_ : stood_;
    const RelativePose at = relativePose(about.position, about.orientation, f, i);
    const Vec3 exact = relativePose(state, i).gap - at.gap;

    const Vec3 gap = at.gap + Vec3(f.referenceGap(i, 0), f.referenceGap(i, 1), f.referenceGap(i, 2));
    // b's material point over the origin, and its directions there that were e1 and e2.
    const Vec3 apart = at.slide_1.x() * at.e1 + at.slide_2.x() * at.e2 + gap.x() * at.e3;
    const Vec3 along_1 = (1.0 + at.slide_1.y()) * at.e1 + at.slide_2.y() * at.e2 + gap.y() * at.e3;
    const Vec3 along_2 = at.slide_1.z() * at.e1 + (1.0 + at.slide_2.z()) * at.e2 + gap.z() * at.e3;
    const auto way = [&](std::size_t block) {
        return Vec3(state.blocks.position.get(block) - about.position.get(block));
    };
    const auto turn = [&](std::size_t block) {
        return rotationVector(about.orientation[block], state.blocks.orientation[block]);
    };
    const Vec3 turn_a = turn(a), turn_b = turn(b);
    const Vec3 tilts = turn_a.cross(at.e3);
    const Vec3 moves_apart = way(b) - way(a) + turn_b.cross(at.origin + apart - about.position.get(b)) -
                             turn_a.cross(at.origin - about.position.get(a));
    const Vec3 first_order(moves_apart.dot(at.e3) + apart.dot(tilts),
                           turn_b.cross(along_1).dot(at.e3) + along_1.dot(tilts),
                           turn_b.cross(along_2).dot(at.e3) + along_2.dot(tilts));
    return exact - first_order;
}

void FirstOrderGaps::set(State& state) const {
    Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i)
        if (f.kind[i] == InterfaceKind::faces) f.setReferenceGap(i, reference_[i] + secondOrder(state, i));
}

double FirstOrderGaps::share(const State& state) const {
    const Interfaces& f = state.interfaces;
    const double g = state.geometry->model.gravity.magnitude;
    double most = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (f.kind[i] != InterfaceKind::faces) continue;
        double mass = kInfinity;
        for (const std::int32_t block : {f.block_a[i], f.block_b[i]}) {
            const auto b = static_cast<std::size_t>(block);
            if (state.blocks.motion[b] == Motion::free) mass = std::min(mass, state.blocks.mass[b]);
        }
        const Vec3 gap = secondOrder(state, i);
        double closed = 0;
        for (std::size_t k = 0; k < f.cornerCount(i); ++k) {
            const std::size_t slot = f.cornerSlot(i, k);
            closed = std::max(closed,
                              std::abs(gap.dot(Vec3(1.0, f.corners.get(slot, 0), f.corners.get(slot, 1)))));
        }
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(f.joint[i])];
        most = std::max(most, law.normal_stiffness * f.area[i] * closed / (mass * g));
    }
    return most;
}

}  // namespace talus::equilibrium
