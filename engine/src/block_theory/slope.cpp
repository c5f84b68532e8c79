#include "block_theory/slope.h"

#include <algorithm>

#include "contacts/limits.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "state/incidence.h"
#include "state/point_layout.h"

namespace talus::keyblocks {
namespace {

/// Of the contact points that are closed at the start [m^2].
double closedArea(const State& state, std::size_t i, const RelativePose& pose) {
    const Interfaces& f = state.interfaces;
    const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
    const double closed = kClosedGap * std::min(state.geometry->size[a], state.geometry->size[b]);
    double area = 0;
    for (const contact::PatchPoint& point : interfacePoints(f, i, state.geometry->model.points)) {
        const double gap =
            pose.gap.x() + point.position.x() * pose.gap.y() + point.position.y() * pose.gap.z();
        if (gap <= closed) area += point.area;
    }
    return area;
}

struct Found {
    std::int32_t block;
    Contact contact;
};

/// Both views of each closed contact with a free block, in the order of the interfaces.
std::vector<Found> closedContacts(const State& state) {
    const Interfaces& f = state.interfaces;
    std::vector<Found> found;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const std::int32_t a = f.block_a[i], b = f.block_b[i];
        const bool any_free = state.blocks.free[static_cast<std::size_t>(a)] != 0 ||
                              state.blocks.free[static_cast<std::size_t>(b)] != 0;
        if (isIdle(f, i) || !any_free) continue;
        const RelativePose pose = relativePose(state, i);
        const double area = closedArea(state, i, pose);
        if (!(area > 0)) continue;
        const bool is_patch = !isVertexEdge(f, i);
        found.push_back({b, {a, f.joint[i], pose.e3, area, is_patch}});
        found.push_back({a, {b, f.joint[i], -pose.e3, area, is_patch}});
    }
    return found;
}

void addContacts(const State& state, Slope& slope) {
    const std::vector<Found> found = closedContacts(state);
    slope.begin.assign(slope.size() + 1, 0);
    for (const Found& each : found) ++slope.begin[static_cast<std::size_t>(each.block) + 1];
    for (std::size_t b = 0; b < slope.size(); ++b) slope.begin[b + 1] += slope.begin[b];
    slope.contacts.resize(found.size());
    std::vector<std::size_t> next(slope.begin.begin(), slope.begin.end() - 1);
    for (const Found& each : found)
        slope.contacts[next[static_cast<std::size_t>(each.block)]++] = each.contact;
}

}  // namespace

Slope slopeOf(State& state) {
    state.load.gravity_share = state.load.water_share = 1;
    updateBlockForces(state);
    Slope slope;
    slope.acceleration = bodyAcceleration(state);
    const std::size_t n = state.blocks.size();
    const Model& model = state.geometry->model;
    for (std::size_t b = 0; b < n; ++b) {
        slope.mass.push_back(state.blocks.mass[b]);
        const double density = model.blocks[b].density;
        slope.volume.push_back(density > 0 ? state.blocks.mass[b] / density : 0.0);
        slope.free.push_back(state.blocks.free[b] != 0 ? 1 : 0);
        slope.force.push_back(state.blocks.mass[b] * slope.acceleration + blockForcesOn(state, b).force);
    }
    addContacts(state, slope);
    return slope;
}

}  // namespace talus::keyblocks
