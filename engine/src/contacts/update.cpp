#include "contacts/update.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <utility>

#include "contacts/gap_recovery.h"
#include "contacts/interfaces.h"
#include "contacts/limits.h"
#include "contacts/vertex_edge.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "step/step.h"
#include "validate/validate.h"

namespace talus {
namespace {

constexpr double kSearchMargin = 0.05;  // of the median block size: pairs nearer than this are interfaces
constexpr double kClearly = 0.99;       // of it: less, and rounding does not matter
constexpr double kSlideLimit =
    0.01;  // of the root of the patch area or the smaller block's size, the larger of the
           // two: then the patch is clipped again

constexpr double kWider = 1.001;      // than the last margin: then that is too narrow
constexpr double kFartherThan = 1.5;  // necessary: falling blocks soon get faster
constexpr double kFewBlocks = 0.2;    // of all blocks: around more, a search costs as much as one around all

/// No speedBound of a block is more, but for rounding: as if it turned about its longest axis [m/s].
double roughSpeedBound(const State& state, std::size_t b) {
    const Blocks& blocks = state.blocks;
    return blocks.velocity.get(b).norm() + blocks.inverse_inertia.get(b).maxCoeff() *
                                               blocks.angular_momentum.get(b).norm() *
                                               state.geometry->radius[b];
}

double searchMargin(const State& state, double ahead) {
    const double least = kSearchMargin * state.geometry->length_scale;
    const auto fastest = [&](auto bound) {
        double most = 0;
        for (std::size_t b = 0; b < state.blocks.size(); ++b) most = std::max(most, bound(state, b));
        return most;
    };
    // Quasi-static work is slow: rotation of single blocks need not be checked.
    const bool is_slow = kFasterAhead * fastest(roughSpeedBound) * ahead < kClearly * least;
    return is_slow ? least : std::max(least, kFasterAhead * fastest(speedBound) * ahead);
}

double slideLimit(const State& state, std::size_t i) {
    const Interfaces& f = state.interfaces;
    const double size = std::min(state.geometry->size[static_cast<std::size_t>(f.block_a[i])],
                                 state.geometry->size[static_cast<std::size_t>(f.block_b[i])]);
    return kSlideLimit * std::max(std::sqrt(f.area[i]), size);
}

/// Whether a patch has slid too far over its partner, if blocks may have moved by `motion` [m] since it was
/// clipped.
bool hasSlid(const State& state, std::size_t i, double motion) {
    const double limit = slideLimit(state, i);
    if (2.0 * motion < limit) return false;
    const RelativePose pose = relativePose(state, i);
    return std::hypot(pose.slide_1.x(), pose.slide_2.x()) > limit;
}

/// Since the last search.
struct Way {
    double motion = 0;  ///< of the block point that has moved farthest [m]
    double turn = 0;    ///< [rad]
};
Way wayOf(const State& state, std::size_t b) {
    if (state.blocks.motion[b] == Motion::fixed) return {};
    const double shift = (state.blocks.position.get(b) - state.search_position.get(b)).norm();
    const double turn = rotationFrom(state.search_orientation, state.blocks.orientation, b);
    return {shift + turn * state.geometry->radius[b], turn};
}

/// Far enough that a contact could be missed, or that a patch has slid or turned too far over its partner.
bool movedTooFar(const State& state, double margin) {
    double farthest = 0, most_turned = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        const Way way = wayOf(state, b);
        if (way.motion > kTravelLimit * state.geometry->size[b]) return true;
        farthest = std::max(farthest, way.motion);
        most_turned = std::max(most_turned, way.turn);
    }
    if (most_turned > kTurnLimit) return true;
    // Half the margin each, less what they may move before the next look.
    if (farthest > kShareOfMargin * state.search_margin || margin > kWider * state.search_margin) return true;
    const Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (!isVertexEdge(f, i) && hasSlid(state, i, farthest)) return true;
    }
    return false;
}

/// Blocks that have moved too far (movedTooFar), and those of patches that have slid too far.
std::vector<char> farMovers(const State& state) {
    std::vector<char> marked(state.blocks.size(), 0);
    double farthest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        const Way way = wayOf(state, b);
        marked[b] = way.motion > kTravelLimit * state.geometry->size[b] || way.turn > kTurnLimit ||
                    way.motion > kShareOfMargin * state.search_margin;
        farthest = std::max(farthest, way.motion);
    }
    // A patch dates from the later search around one of its blocks: the other may have moved back and forth
    // since its own.
    constexpr double kToAndFro = 2.0;
    const Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
        if (isVertexEdge(f, i) || marked[a] || marked[b]) continue;
        if (!hasSlid(state, i, kToAndFro * farthest)) continue;
        for (const std::size_t block : {a, b}) marked[block] = state.blocks.motion[block] != Motion::fixed;
    }
    return marked;
}

/// Forces of the contacts as they are now, for the next half kick: of their springs. A new contact point has
/// not slid yet, so it would stick, and its dashpot would stop the whole slide at once.
void updateSpringForces(State& state, bool parallel) {
    const double damping = std::exchange(state.damping.contact, 0.0);
    const bool restitution = std::exchange(state.damping.restitution, false);
    updateForces(state, parallel);
    state.damping.contact = damping;
    state.damping.restitution = restitution;
}

#ifndef NDEBUG
/// Whether there are none; else the first is printed, which the assertion cannot do.
bool areNone(const std::vector<std::string>& findings) {
    if (!findings.empty()) std::fprintf(stderr, "invalid state: %s\n", findings.front().c_str());
    return findings.empty();
}

/// The run reports a motion that became infinite; an assertion must not.
bool isSound(const State& state) { return !isFinite(state) || areNone(validate(state)); }
bool haveSoundForces(const State& state) { return !isFinite(state) || areNone(validateForces(state)); }
#endif

}  // namespace

std::vector<Error> findInterfaces(State& state, bool initial, bool parallel, const Control& control) {
    std::vector<Error> errors =
        makeInterfaces(state, {.margin = searchMargin(state, 0.0)}, initial, parallel, control);
    assert(!errors.empty() || isSound(state));
    return errors;
}

bool refreshInterfaces(State& state, bool parallel, double ahead, const std::atomic<bool>* stop,
                       const std::vector<double>& moved, bool may_wait) {
    double margin = searchMargin(state, ahead);
    std::vector<char> around;
    PlaceChanges changes;
    if (state.searches_around && searchedAgain(state) && margin <= kWider * state.search_margin) {
        margin = state.search_margin;
        around = farMovers(state);
        changes = updateVertexEdges(state, ahead, parallel, moved, may_wait, &around);
        const auto count = std::count(around.begin(), around.end(), 1);
        changes.search = count > 0;
        if (static_cast<double>(count) > kFewBlocks * static_cast<double>(around.size())) around.clear();
    } else if (movedTooFar(state, margin)) {
        if (state.searches_around) margin *= kFartherThan;
        changes.search = true;
    } else {
        changes = updateVertexEdges(state, ahead, parallel, moved, may_wait);
    }
    if (!changes.search) {
        const bool recovered = recoverGaps(state);
        // The next half kick uses the springs as they are now; the old forces would do work that no spring
        // holds.
        if (state.springs == Springs::keep_energy && (changes.places || recovered))
            updateSpringForces(state, parallel);
        assert(isSound(state));
        return false;
    }
    Control control;
    control.stop = stop;
    SearchRange range{.margin = margin, .ahead = ahead};
    if (!around.empty()) range.near = blocksNear(state, around, margin);
    range.around = std::move(around);
    if (!makeInterfaces(state, range, false, parallel, control).empty()) return false;
    // Forces are computed again before anything reads them.
    if (state.springs == Springs::keep_energy) {
        updateSpringForces(state, parallel);
    } else {
        updateContacts(state, {0, state.interfaces.groups.size()});
        updateBlockForces(state);
    }
    assert(isSound(state) && haveSoundForces(state));
    return true;
}

namespace {

void fix(Blocks& blocks, std::size_t b) {
    assert(blocks.motion[b] == Motion::free);
    blocks.motion[b] = Motion::fixed;
    blocks.free[b] = 0;
    blocks.inverse_mass[b] = 0;
    for (auto vectors :
         {&Blocks::inverse_inertia, &Blocks::velocity, &Blocks::angular_momentum, &Blocks::angular_velocity})
        (blocks.*vectors).set(b, Vec3::Zero());
}

/// Finds the contacts around some blocks again, and the forces of all.
void searchAround(State& state, std::vector<char> around, bool parallel) {
    SearchRange range{.margin = state.search_margin, .near = blocksNear(state, around, state.search_margin)};
    range.around = std::move(around);
    makeInterfaces(state, range, false, parallel);
    updateContacts(state, {0, state.interfaces.groups.size()});
    updateBlockForces(state);
    assert(isSound(state) && haveSoundForces(state));
}

}  // namespace

void takeOut(State& state, const std::vector<std::size_t>& blocks, bool parallel) {
    Blocks& all = state.blocks;
    all.removed.resize(all.size(), 0);
    std::vector<char> around(all.size(), 0);
    for (const std::size_t b : blocks) {
        fix(all, b);
        all.removed[b] = 1;
        around[b] = 1;
    }
    searchAround(state, std::move(around), parallel);
}

}  // namespace talus
