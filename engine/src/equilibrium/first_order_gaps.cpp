#include "equilibrium/first_order_gaps.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "forces/contact_forces.h"
#include "state/block_motion.h"

namespace talus::equilibrium {
namespace {

// Pairs that have turned or slid by less count from the poses as built. A column that turns by the first
// value has long failed; after a slide by the second, a patch has been clipped again.
constexpr double kHardlyTurned = 1e-2;  // [rad]
constexpr double kHardlySlid = 1e-2;    // of the smaller block's size

}  // namespace

FirstOrderGaps::FirstOrderGaps(const State& state)
    : made_{state.blocks.position, state.blocks.orientation},
      built_{state.geometry->initial_position, state.geometry->initial_orientation} {
    const Interfaces& f = state.interfaces;
    std::vector<bool> turned;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        turned.push_back(rotationFrom(built_.orientation, made_.orientation, b) > kHardlyTurned);
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (f.kind[i] != InterfaceKind::faces) continue;
        const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
        const RelativePose now = relativePose(made_.position, made_.orientation, f, i),
                           built = relativePose(built_.position, built_.orientation, f, i);
        const double slid =
            std::hypot(now.slide_1.x() - built.slide_1.x(), now.slide_2.x() - built.slide_2.x());
        const double smaller = std::min(state.geometry->size[a], state.geometry->size[b]);
        pairs_.push_back(pairOf(state, i, !turned[a] && !turned[b] && slid < kHardlySlid * smaller));
    }
}

FirstOrderGaps::Pair FirstOrderGaps::pairOf(const State& state, std::size_t i, bool is_as_built) const {
    const Interfaces& f = state.interfaces;
    const Places& about = is_as_built ? built_ : made_;
    Pair pair{.interface = i,
              .block_a = static_cast<std::size_t>(f.block_a[i]),
              .block_b = static_cast<std::size_t>(f.block_b[i]),
              .is_as_built = is_as_built,
              .reference = {f.referenceGap(i, 0), f.referenceGap(i, 1), f.referenceGap(i, 2)}};
    const RelativePose at = relativePose(about.position, about.orientation, f, i);
    const Vec3 gap = at.gap + pair.reference;
    pair.gap = at.gap;
    pair.apart = at.slide_1.x() * at.e1 + at.slide_2.x() * at.e2 + gap.x() * at.e3;
    pair.along_1 = (1.0 + at.slide_1.y()) * at.e1 + at.slide_2.y() * at.e2 + gap.y() * at.e3;
    pair.along_2 = at.slide_1.z() * at.e1 + (1.0 + at.slide_2.z()) * at.e2 + gap.z() * at.e3;
    pair.arm_a = at.origin - about.position.get(pair.block_a);
    pair.arm_b = at.origin + pair.apart - about.position.get(pair.block_b);
    pair.normal = at.e3;
    return pair;
}

Vec3 FirstOrderGaps::secondOrder(const Pair& pair, const Vec3& exact, const Motion& a, const Motion& b) {
    const Vec3 tilts = a.turn.cross(pair.normal);
    const Vec3 moves_apart = b.shift - a.shift + b.turn.cross(pair.arm_b) - a.turn.cross(pair.arm_a);
    const Vec3 first_order(moves_apart.dot(pair.normal) + pair.apart.dot(tilts),
                           b.turn.cross(pair.along_1).dot(pair.normal) + pair.along_1.dot(tilts),
                           b.turn.cross(pair.along_2).dot(pair.normal) + pair.along_2.dot(tilts));
    return exact - first_order;
}

void FirstOrderGaps::set(State& state, const PositionArray& position, const QuaternionArray& orientation) {
    std::vector<char> turned(state.blocks.size(), 0);
    for (Places* places : {&made_, &built_}) {
        places->motion.resize(state.blocks.size());
        for (std::size_t b = 0; b < state.blocks.size(); ++b)
            places->motion[b] = {position.get(b) - places->position.get(b),
                                 rotationVector(places->orientation[b], orientation[b])};
    }
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        turned[b] = made_.motion[b].turn.norm() > kHardlyTurned;
    for (const Pair& pair : pairs_) {
        assert(pair.interface < state.interfaces.size());
        state.interfaces.setReferenceGap(pair.interface, pair.reference);
        if (turned[pair.block_a] || turned[pair.block_b]) continue;
        const Places& about = pair.is_as_built ? built_ : made_;
        const Vec3 exact =
            relativePose(position, orientation, state.interfaces, pair.interface).gap - pair.gap;
        const Vec3 second = secondOrder(pair, exact, about.motion[pair.block_a], about.motion[pair.block_b]);
        state.interfaces.setReferenceGap(pair.interface, pair.reference + second);
    }
}

void FirstOrderGaps::remove(State& state) const {
    for (const Pair& pair : pairs_) state.interfaces.setReferenceGap(pair.interface, pair.reference);
}

}  // namespace talus::equilibrium
