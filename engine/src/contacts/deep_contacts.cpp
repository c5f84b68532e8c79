#include "contacts/deep_contacts.h"

#include <algorithm>
#include <cassert>
#include <tuple>

#include "state/incidence.h"
#include "state/placed_shape.h"

namespace talus {
namespace {

// Cosine of 120 degrees. Around the edge of a box axes turn by 90, which is no passage; through a plate by
// 180.
constexpr double kTurnedRound = -0.5;

bool isDeep(const State& state, std::size_t i, const RelativePose& pose) {
    const Interfaces& f = state.interfaces;
    const double size = std::min(state.geometry->size[static_cast<std::size_t>(f.block_a[i])],
                                 state.geometry->size[static_cast<std::size_t>(f.block_b[i])]);
    return depthOf(f, i, pose) > kDeep * size;
}

}  // namespace

double depthOf(const Interfaces& interfaces, std::size_t i, const RelativePose& pose) {
    return -(pose.gap.x() + interfaces.referenceGap(i, 0));
}

std::vector<DeepFaces> deepFaces(const State& state, const SearchRange& range) {
    const Interfaces& f = state.interfaces;
    std::vector<DeepFaces> deep;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isVertexEdge(f, i) ||
            !range.has(static_cast<std::size_t>(f.block_a[i]), static_cast<std::size_t>(f.block_b[i])))
            continue;
        if (isDeep(state, i, relativePose(state, i)))
            deep.push_back({partsOf(*state.geometry, f, i), f.block_a[i], f.face_a[i], f.face_b[i]});
    }
    std::sort(deep.begin(), deep.end(), [](const DeepFaces& a, const DeepFaces& b) {
        return std::tie(a.parts, a.face_a, a.face_b) < std::tie(b.parts, b.face_a, b.face_b);
    });
    return deep;
}

bool areHeldByFaces(const State& state, std::size_t begin) {
    const Interfaces& f = state.interfaces;
    const Incidence& incidence = state.incidence;
    const BoxPair parts = partsOf(*state.geometry, f, begin);
    const auto row = [&](std::int32_t block) {
        const auto b = static_cast<std::size_t>(block);
        return std::pair(incidence.interface_begin[b], incidence.interface_begin[b + 1]);
    };
    const auto [a_begin, a_end] = row(f.block_a[begin]);
    const auto [b_begin, b_end] = row(f.block_b[begin]);
    const bool a_has_fewer = a_end - a_begin <= b_end - b_begin;
    for (auto k = a_has_fewer ? a_begin : b_begin; k < (a_has_fewer ? a_end : b_end); ++k) {
        const auto i = static_cast<std::size_t>(incidence.interface[static_cast<std::size_t>(k)]);
        if (!isVertexEdge(f, i) && partsOf(*state.geometry, f, i) == parts &&
            isDeep(state, i, relativePose(state, i)))
            return true;
    }
    return false;
}

bool pushAgainst(const State& state, std::size_t begin, const Vec3& axis) {
    const Interfaces& f = state.interfaces;
    for (std::size_t i = begin; i < begin + kPlacesOfPair; ++i) {
        if (isIdle(f, i)) continue;
        const RelativePose pose = relativePose(state, i);
        if (pose.e3.dot(axis) < kTurnedRound && isDeep(state, i, pose)) return true;
    }
    return false;
}

}  // namespace talus
