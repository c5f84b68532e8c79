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
constexpr double kSlideLimit =
    0.01;  // of the root of the patch area or the smaller block's size, the larger of the
           // two: then the patch is clipped again

double searchMargin(const State& state, double ahead) {
    double fastest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) fastest = std::max(fastest, speedBound(state, b));
    return std::max(kSearchMargin * state.geometry->length_scale, kFasterAhead * fastest * ahead);
}

/// Far enough that a contact could be missed, or that a patch has slid or turned too far over its partner.
bool movedTooFar(const State& state, double margin) {
    double farthest = 0, most_turned = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] == Motion::fixed) continue;
        const double shift = (state.blocks.position.get(b) - state.search_position.get(b)).norm();
        const double turn = rotationFrom(state.search_orientation, state.blocks.orientation, b);
        const double motion = shift + turn * state.geometry->radius[b];
        if (motion > kTravelLimit * state.geometry->size[b]) return true;
        farthest = std::max(farthest, motion);
        most_turned = std::max(most_turned, turn);
    }
    if (most_turned > kTurnLimit) return true;
    // Half the margin each, less what they may go before the next look.
    if (farthest > kShareOfMargin * state.search_margin || margin > 1.001 * state.search_margin) return true;
    const Interfaces& f = state.interfaces;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isVertexEdge(f, i)) continue;
        const double size = std::min(state.geometry->size[static_cast<std::size_t>(f.block_a[i])],
                                     state.geometry->size[static_cast<std::size_t>(f.block_b[i])]);
        const double limit = kSlideLimit * std::max(std::sqrt(f.area[i]), size);
        if (2.0 * farthest < limit) continue;
        const RelativePose pose = relativePose(state, i);
        if (std::hypot(pose.slide_1.x(), pose.slide_2.x()) > limit) return true;
    }
    return false;
}

/// Forces of the contacts as they are now, for the next half kick: of their springs. A contact point that has just been placed
/// has not slid yet, so it would stick, and its dashpot would be felt to stop the whole slide at once.
void updateSpringForces(State& state, bool parallel) {
    const double damping = std::exchange(state.damping.contact, 0.0);
    const bool restitution = std::exchange(state.damping.restitution, false);
    updateForces(state, parallel);
    state.damping.contact = damping;
    state.damping.restitution = restitution;
}

#ifndef NDEBUG
/// Whether there are none; else the first is named, which the assertion itself cannot.
bool areNone(const std::vector<std::string>& findings) {
    if (!findings.empty()) std::fprintf(stderr, "invalid state: %s\n", findings.front().c_str());
    return findings.empty();
}

/// A motion that has run off into infinity is for its run to report, not for an assertion.
bool isSound(const State& state) { return !isFinite(state) || areNone(validate(state)); }
bool haveSoundForces(const State& state) { return !isFinite(state) || areNone(validateForces(state)); }
#endif

}  // namespace

std::vector<Error> findInterfaces(State& state, bool initial, bool parallel, const Control& control) {
    std::vector<Error> errors =
        makeInterfaces(state, searchMargin(state, 0.0), 0.0, initial, parallel, control);
    assert(!errors.empty() || isSound(state));
    return errors;
}

bool refreshInterfaces(State& state, bool parallel, double ahead, const std::atomic<bool>* stop,
                       const std::vector<double>& gone, bool may_wait) {
    const double margin = searchMargin(state, ahead);
    const PlaceChanges changes = movedTooFar(state, margin)
                                     ? PlaceChanges{.places = false, .search = true}
                                     : updateVertexEdges(state, ahead, parallel, gone, may_wait);
    if (!changes.search) {
        const bool recovered = recoverGaps(state);
        // The next half kick is that of the springs as they are now; the old one would do work that none of them holds.
        if (state.springs == Springs::keep_energy && (changes.places || recovered))
            updateSpringForces(state, parallel);
        assert(isSound(state));
        return false;
    }
    Control control;
    control.stop = stop;
    if (!makeInterfaces(state, margin, ahead, false, parallel, control).empty()) return false;
    // Forces are there again before anything looks at them.
    if (state.springs == Springs::keep_energy) {
        updateSpringForces(state, parallel);
    } else {
        updateContacts(state, {0, state.interfaces.groups.size()});
        updateBlockForces(state);
    }
    assert(isSound(state) && haveSoundForces(state));
    return true;
}

}  // namespace talus
