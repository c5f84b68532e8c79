#include "equilibrium/equilibrium_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "contacts/update.h"
#include "equilibrium/path_newton.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/incidence.h"
#include "step/step.h"

namespace talus::equilibrium {
namespace {

// Vertices and edges are checked after a quarter of the motion between two checks of a time history. So
// contacts are found before blocks reach the failure displacement.
constexpr double kFiner = 4.0;
constexpr int kShorterStarts = 2;
constexpr double kFirstSlide = 1e-3;  // of rules.step_displacement: where a release begins
constexpr double kAsLong = 0.99;      // but for rounding
constexpr int kShorterSlides = 8;
constexpr double kLeastProgress = 1.02;  // of a release: it makes no progress
constexpr double kLessGrowth = 0.3;      // of the excess over 1, after a failure
constexpr double kAlmost = 0.8;          // of the farthest that blocks may move in a step in pseudo-time
// Over the joints' stiffness. Blocks hardly move against it, and against more a step converges no better.
constexpr double kMostDrag = 1e3;
constexpr double kRecovers = 0.5;  // of the drag of a slowed block, from step to step

// Unbreakable joints: cohesion and tensile strength over the stress under the weights at first; their
// reduction in each solve; and the value below which they are none.
constexpr double kHeldStress = 1e3, kFewerHeld = 0.1, kFewestHeld = 0.9, kHardlyHeld = 1e-7;

void hold(contact::JointLaw& law, double strength) {
    law.cohesion += strength;
    law.residual_cohesion += strength;
    law.tensile_strength += strength;
    if (!law.curved) return;
    law.setCurve(nullptr);
    law.tan_friction = law.residual_tan_friction = 1;
}

PathStep scaled(PathStep step, double by) {
    for (Vec6& x : step.x) x *= by;
    return step;
}

}  // namespace

EquilibriumPath::EquilibriumPath(State state, const SearchRules& rules, bool parallel,
                                 const std::atomic<bool>* stop)
    : state_(std::move(state)),
      rules_(rules),
      parallel_(parallel),
      gaps_(state_),
      equations_(state_, gaps_, rules_, stop, work_),
      motion_(state_.blocks.size(), 0.0) {
    state_.release = rules_.bond_release;
}

void EquilibriumPath::vary(const Loading& loading, double load) {
    equations_.setLoading(loading, load);
    passes_ = 0;
    last_ = {};
    takeContacts();
}

void EquilibriumPath::putUnder(double load) {
    equations_.recover(0);
    if (load != this->load()) passes_ = 0;
    equations_.setLoad(load);
    updateBlockForces(state_);
    last_ = {};
    takeContacts();
}

void EquilibriumPath::mark(std::function<void(State&)> marked) {
    mark_ = std::move(marked);
    if (mark_) mark_(state_);
}

void EquilibriumPath::takeAsStated() {
    if (coupled_ != nullptr) coupled_->takeAsStated(state_);
}

bool EquilibriumPath::renewPressure() {
    if (coupled_ == nullptr) return false;
    const bool renewed = coupled_->renew(state_, passes_);
    passes_ = renewed ? passes_ + 1 : 0;
    if (!renewed) return false;
    last_ = {};
    takeContacts();
    return true;
}

void EquilibriumPath::setGaps() { gaps_.set(state_, state_.blocks.position, state_.blocks.orientation); }

void EquilibriumPath::takeContacts() { equations_.take(); }

PathStep EquilibriumPath::along(const Arc& arc) {
    PathStep step = tryAlong(arc);
    // A shorter step from the same place, extended again: its slipping contact points are known, and lie away
    // from the corner of the law.
    Arc shorter = arc;
    for (int k = 0; k < kShorterStarts && !step && !stopped(); ++k) {
        shorter.displacement *= rules_.shorter_start;
        shorter.load *= rules_.shorter_start;
        step = tryAlong(shorter);
    }
    if (!step || shorter.displacement == arc.displacement) return step;
    step = solveLonger(shorter, std::move(step), arc.displacement);
    step.iterations = static_cast<int>(rules_.newton_iterations);
    return step;
}

PathStep EquilibriumPath::tryAlong(const Arc& arc) {
    const auto merit = [&](const PathStep& step) {
        Vec6s force;
        equations_.residual(arc, step, equations_.moved(step.x), false, force);
        return equations_.merit(force);
    };
    PathStep guess = secantStep(equations_, arc, last_);
    const double of_secant = guess.x.empty() ? kInfinity : merit(guess);
    if (of_secant > rules_.near_secant) {  // the tangent costs a factorisation
        PathStep tangent = tangentStep(equations_, arc, last_);
        if (!tangent.x.empty() && !(of_secant < merit(tangent))) guess = std::move(tangent);
    }
    return guess.x.empty() ? guess : solveStep(equations_, arc, std::move(guess));
}

PathStep EquilibriumPath::solveLonger(const Arc& arc, PathStep step, double longest) {
    Arc next = arc;
    while (next.displacement < kAsLong * longest && step.value > 0 && !stopped()) {
        const double longer_by = std::min(rules_.longer_again, longest / next.displacement);
        next.displacement *= longer_by;
        next.load *= longer_by;
        PathStep guess = scaled(step, longer_by);
        guess.value *= longer_by;
        PathStep longer = solveStep(equations_, next, std::move(guess));
        if (!longer) break;
        step = std::move(longer);
    }
    return step;
}

PathStep EquilibriumPath::toRest() {
    const Arc arc{.unknown = Unknown::none, .displacement = kInfinity};
    return solveStep(equations_, arc, {.x = Vec6s(equations_.balance().block.size(), Vec6::Zero())});
}

PathStep EquilibriumPath::fromHeldJoints() {
    const std::vector<contact::JointLaw> own = state_.laws;
    const Arc arc{.unknown = Unknown::none, .displacement = kInfinity};
    double stress = 0;  // of the weights on the blocks' faces [Pa]
    for (std::size_t r = 0; r < equations_.balance().block.size(); ++r)
        stress = std::max(stress, equations_.balance().weight[r] /
                                      state_.geometry->face_area[equations_.balance().block[r]]);
    PathStep held{.x = Vec6s(equations_.balance().block.size(), Vec6::Zero())};
    double share = kHeldStress, fewer = kFewerHeld;
    while (!stopped()) {
        state_.laws = own;
        const bool is_last = share < kHardlyHeld;
        if (!is_last)
            for (contact::JointLaw& law : state_.laws) hold(law, share * stress);
        PathStep step = solveStep(equations_, arc, held);
        if (step && is_last) return step;
        if (step) {
            held = std::move(step);
            share *= fewer;
            continue;
        }
        if (share == kHeldStress || fewer > kFewestHeld) break;
        share /= fewer;
        fewer = std::sqrt(fewer);
        share *= fewer;
    }
    state_.laws = own;
    return {};
}

PathStep EquilibriumPath::against(double most, std::int64_t most_factors) {
    const std::int64_t last = work_.factors + most_factors;
    Arc arc{.unknown = Unknown::drag};
    PathStep best, before;
    double before_displacement = 0;
    if (last_.unknown == Unknown::drag && last_.x.size() == equations_.balance().block.size()) {
        arc.displacement = equations_.norm(last_.x);
        best = solveStep(equations_, arc, last_);
        best.converged = best.converged && best.value > 0;  // otherwise equilibrium is nearer than that
    }
    if (!best) arc.displacement = kFirstSlide * rules_.step_displacement;
    for (int k = 0; k < kShorterSlides && !best && !stopped(); ++k) {
        PathStep guess = tangentStep(equations_, arc, last_);
        if (guess.x.empty()) return {};
        best = solveStep(equations_, arc, std::move(guess));
        best.converged = best.converged && best.value > 0;
        if (!best) arc.displacement *= rules_.shorter_start;
    }
    double growth = rules_.release_growth;
    const Parting here = parting();
    while (best && growth > kLeastProgress && partedAfter(here, best) < most && work_.factors < last &&
           !stopped()) {
        Arc next = arc;
        next.displacement *= growth;
        PathStep guess = scaled(best, growth);
        guess.value = best.value / growth;
        // along the line of the last two: the elastic part is complete, the slide continues
        if (before) {
            const double on =
                (next.displacement - arc.displacement) / (arc.displacement - before_displacement);
            guess = best;
            for (std::size_t r = 0; r < guess.x.size(); ++r) guess.x[r] += on * (best.x[r] - before.x[r]);
            const double inverse = 1 / best.value + on * (1 / best.value - 1 / before.value);
            guess.value = inverse > 0 ? 1 / inverse : best.value / growth;
        }
        PathStep longer = solveStep(equations_, next, std::move(guess));
        if (!longer || longer.value <= 0) {
            growth = 1 + kLessGrowth * (growth - 1);
            continue;
        }
        const bool easy = longer.iterations <= static_cast<int>(rules_.wanted_iterations) / 2;
        if (easy) growth = std::min(rules_.release_growth, 1 + 2 * (growth - 1));
        before = std::exchange(best, std::move(longer));
        before_displacement = std::exchange(arc.displacement, next.displacement);
    }
    return best;
}

PathStep EquilibriumPath::relax(double most, double& drag) {
    while (!stopped() && drag < kMostDrag) {
        const Arc arc{.unknown = Unknown::none, .displacement = most, .drag = drag};
        PathStep step =
            solveStep(equations_, arc, {.x = Vec6s(equations_.balance().block.size(), Vec6::Zero())});
        if (!step) {  // which costs more than several steps that converge
            drag *= rules_.release_growth * rules_.release_growth;
            continue;
        }
        // Where blocks move freely, they move in proportion to the time.
        const double too_long = partedBy(step) / most, as_long = drag * too_long / kAlmost;
        if (too_long > 1) {
            drag = as_long;
            continue;
        }
        equations_.recover(kRecovers);
        const double falls =
            std::clamp(step.iterations / rules_.newton_iterations, 1 / rules_.release_growth, 1.0);
        drag = std::max({falls * drag, as_long, equations_.leastDrag(most)});
        return step;
    }
    return {};
}

void EquilibriumPath::commit(PathStep step) {
    assert(step.converged);
    ++work_.steps;
    const Balance& balance = equations_.balance();
    const double least = rules_.least_block_size * state_.geometry->length_scale;
    double motion = 0;
    for (std::size_t r = 0; r < step.x.size(); ++r) {
        const double moved = step.x[r].head<3>().norm() + step.x[r].tail<3>().norm();
        motion_[balance.block[r]] += kFiner * moved;
        motion = std::max(motion, moved / std::max(balance.size[r], least));
    }
    Poses poses = equations_.moved(step.x);
    setPoses(poses, state_);
    setGaps();
    if (step.unknown == Unknown::load) passes_ = 0;
    equations_.setLoad(step.unknown == Unknown::load ? load() + step.value : load());
    updateForces(state_, parallel_);
    motion_since_search_ += motion;
    last_ = std::move(step);
    if (motion_since_search_ > rules_.search_motion)
        searchContacts();
    else
        equations_.takePoses(std::move(poses));
}

void EquilibriumPath::searchContacts() {
    motion_since_search_ = 0;
    gaps_.remove(state_);
    refreshInterfaces(state_, parallel_, 0.0, nullptr, motion_);
    motion_.assign(motion_.size(), 0.0);
    gaps_ = FirstOrderGaps(state_);
    setGaps();
    if (mark_) mark_(state_);
    takeContacts();
}

bool EquilibriumPath::bondsGive() const {
    if (!state_.points.remembers()) return false;
    for (const ActiveInterface& i : equations_.balance().interfaces) {
        const auto joint = static_cast<std::size_t>(state_.interfaces.joint[i.interface]);
        if (contact::softens(state_.laws[joint])) continue;  // weakened by its own slide and opening
        for (std::size_t k = 0; k < state_.interfaces.pointCount(i.interface); ++k) {
            const double bond = state_.points.memoryAt(state_.interfaces.pointSlot(i.interface, k)).bond;
            if (bond > 0 && bond < 1) return true;
        }
    }
    return false;
}

double EquilibriumPath::outOfBalance() const { return outOfBalanceRatio(state_); }

bool EquilibriumPath::isBalanced() const {
    const Balance& balance = equations_.balance();
    const Vec3 acceleration = bodyAcceleration(state_);
    for (std::size_t r = 0; r < balance.block.size(); ++r)
        if (outOfBalanceRatio(state_, balance.block[r], acceleration) >= equations_.limitOf(r)) return false;
    return true;
}

double EquilibriumPath::elasticDisplacement() const {
    double most = 0;
    for (const ActiveInterface& i : equations_.balance().interfaces) {
        const auto joint = static_cast<std::size_t>(state_.interfaces.joint[i.interface]);
        const contact::JointLaw& law = state_.laws[joint];
        for (const ContactPoint& point : contactPoints(state_, i.interface)) {
            const double shear = std::hypot(point.force.shear_1, point.force.shear_2);
            most = std::max(most,
                            std::max(point.force.normal / law.normal_stiffness, shear / law.shear_stiffness) /
                                point.area);
        }
    }
    return most;
}

double EquilibriumPath::partedSince(const Parting& since) const {
    return since.now(poses()) / state_.geometry->length_scale;
}

double EquilibriumPath::slidSince(const Parting& since) const {
    return since.slidNow(poses()) / state_.geometry->length_scale;
}

double EquilibriumPath::partedAfter(const Parting& since, const PathStep& step) const {
    return since.now(equations_.moved(step.x)) / state_.geometry->length_scale;
}

void EquilibriumPath::takeOut(const std::vector<std::size_t>& blocks) {
    gaps_.remove(state_);
    talus::takeOut(state_, blocks, parallel_);
    gaps_ = FirstOrderGaps(state_);
    setGaps();
    if (mark_) mark_(state_);
    passes_ = 0;
    last_ = {};
    takeContacts();
}

EquilibriumPath::Place EquilibriumPath::place() const {
    return {state_, gaps_, equations_.loading(), load(), last_, motion_, motion_since_search_};
}

void EquilibriumPath::goBack(const Place& place) {
    state_ = place.state;
    gaps_ = place.gaps;
    last_ = place.last;
    motion_ = place.motion;
    motion_since_search_ = place.motion_since_search;
    equations_.setLoading(place.loading, place.load);
    passes_ = 0;
    takeContacts();
}

State EquilibriumPath::exactState() const {
    State state = state_;
    gaps_.remove(state);
    return state;
}

}  // namespace talus::equilibrium
