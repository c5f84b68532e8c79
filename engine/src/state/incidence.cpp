#include "state/incidence.h"

#include <algorithm>
#include <cassert>

namespace talus {
namespace {

#ifndef NDEBUG
bool isBlockOf(const Incidence& incidence, std::int32_t block) {
    return block >= 0 && static_cast<std::size_t>(block) + 1 < incidence.interface_begin.size();
}
#endif

}  // namespace

bool isVertexEdge(const Interfaces& f, std::size_t i) {
    assert(i < f.size());
    return f.kind[i] == InterfaceKind::vertex_edge;
}

bool isIdle(const Interfaces& f, std::size_t i) { return f.idle[i] != 0; }

void markIdle(Interfaces& f, std::size_t g) {
    InterfaceGroup& group = f.groups[g];
    const auto begin = static_cast<std::size_t>(group.begin),
               end = begin + static_cast<std::size_t>(group.size);
    const bool was_idle = group.is_idle;
    group.is_idle = true;
    for (std::size_t i = begin; i < end; ++i) group.is_idle = group.is_idle && isIdle(f, i);
    if (!group.is_idle || was_idle) return;
    for (std::size_t i = begin; i < end; ++i) f.setWrench(i, {});
}

ContactCount countContacts(const Interfaces& f) {
    ContactCount count;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isIdle(f, i)) continue;
        ++count.interfaces;
        count.points += f.pointCount(i);
    }
    return count;
}

void buildIncidence(State& state) {
    Incidence& incidence = state.incidence;
    const Interfaces& f = state.interfaces;
    const std::size_t n = state.blocks.size();
    assert(f.block_b.size() == f.size() && f.slot.size() == f.size());
    incidence.interface_begin.assign(n + 1, 0);
    for (std::size_t i = 0; i < f.size(); ++i) {
        ++incidence.interface_begin[static_cast<std::size_t>(f.block_a[i]) + 1];
        ++incidence.interface_begin[static_cast<std::size_t>(f.block_b[i]) + 1];
    }
    for (std::size_t b = 0; b < n; ++b) incidence.interface_begin[b + 1] += incidence.interface_begin[b];
    incidence.interface.resize(2 * f.size());
    incidence.wrench.resize(2 * f.size());
    std::vector<std::int64_t> next(incidence.interface_begin.begin(), incidence.interface_begin.end() - 1);
    for (std::size_t i = 0; i < f.size(); ++i)
        for (const std::int32_t side : {0, 1}) {
            const auto block = static_cast<std::size_t>(side == 0 ? f.block_a[i] : f.block_b[i]);
            const auto slot = static_cast<std::size_t>(next[block]++);
            incidence.interface[slot] = static_cast<std::int32_t>(i);
            incidence.wrench[slot] = 2 * f.slot[i] + side;
        }
    if (incidence.wet_begin.size() != n + 1) incidence.wet_begin.assign(n + 1, 0);
}

std::int32_t largestInterface(const State& state, std::int32_t block_1, std::int32_t block_2) {
    const Incidence& incidence = state.incidence;
    assert(isBlockOf(incidence, block_1) && isBlockOf(incidence, block_2));
    // The block with fewer interfaces knows them all: a floor may have thousands.
    const auto count = [&](std::int32_t b) {
        return incidence.interface_begin[static_cast<std::size_t>(b) + 1] -
               incidence.interface_begin[static_cast<std::size_t>(b)];
    };
    const std::int32_t block = count(block_1) <= count(block_2) ? block_1 : block_2;
    std::int32_t best = -1;
    for (auto k = incidence.interface_begin[static_cast<std::size_t>(block)];
         k < incidence.interface_begin[static_cast<std::size_t>(block) + 1]; ++k) {
        const std::int32_t i = incidence.interface[static_cast<std::size_t>(k)];
        const auto index = static_cast<std::size_t>(i);
        if (isVertexEdge(state.interfaces, index)) continue;
        if (std::minmax(state.interfaces.block_a[index], state.interfaces.block_b[index]) !=
            std::minmax(block_1, block_2))
            continue;
        if (best < 0 || state.interfaces.area[index] > state.interfaces.area[static_cast<std::size_t>(best)])
            best = i;
    }
    return best;
}

std::int32_t interfaceOfFaces(const State& state, std::int32_t block_1, std::int32_t face_1,
                              std::int32_t block_2, std::int32_t face_2) {
    const Incidence& incidence = state.incidence;
    const Interfaces& f = state.interfaces;
    assert(isBlockOf(incidence, block_1) && isBlockOf(incidence, block_2));
    const auto rowBegin = [&](std::int32_t b) {
        return incidence.interface_begin[static_cast<std::size_t>(b)];
    };
    const auto count = [&](std::int32_t b) { return rowBegin(b + 1) - rowBegin(b); };
    const std::int32_t block = count(block_1) <= count(block_2) ? block_1 : block_2;
    for (auto k = rowBegin(block); k < rowBegin(block + 1); ++k) {
        const std::int32_t index = incidence.interface[static_cast<std::size_t>(k)];
        const auto i = static_cast<std::size_t>(index);
        if (isVertexEdge(f, i)) continue;
        if (f.block_a[i] == block_1 && f.block_b[i] == block_2 && f.face_a[i] == face_1 &&
            f.face_b[i] == face_2)
            return index;
        if (f.block_a[i] == block_2 && f.block_b[i] == block_1 && f.face_a[i] == face_2 &&
            f.face_b[i] == face_1)
            return index;
    }
    return -1;
}

double coordinateReach(const State& state, const PositionArray& position, std::size_t block) {
    const Incidence& incidence = state.incidence;
    const Vec3 own = position.get(block);
    const double radius = state.geometry->radius[block];
    double reach = own.cwiseAbs().maxCoeff() + radius;
    for (auto k = incidence.interface_begin[block]; k < incidence.interface_begin[block + 1]; ++k) {
        const auto i = static_cast<std::size_t>(incidence.interface[static_cast<std::size_t>(k)]);
        const auto a = static_cast<std::size_t>(state.interfaces.block_a[i]);
        const auto other = a == block ? static_cast<std::size_t>(state.interfaces.block_b[i]) : a;
        const Vec3 there = position.get(other);
        const double arm = std::min((there - own).norm() + radius, state.geometry->radius[other]);
        reach = std::max(reach, there.cwiseAbs().maxCoeff() + arm);
    }
    return reach;
}

}  // namespace talus
