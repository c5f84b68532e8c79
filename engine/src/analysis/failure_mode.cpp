#include "analysis/failure_mode.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/loose_blocks.h"
#include "contacts/update.h"
#include "forces/contact_forces.h"
#include "measure/measure.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "state/incidence.h"
#include "step/step.h"
#include "step/time_step.h"
#include "talus/motion_roles.h"

namespace talus::analysis {
namespace {

constexpr double kDashpot = 0.5;  // damping ratio of the fastest mode: takes out the rattle only
// Share of the force on a block that opposes its motion, where the continuation alone says that it fails: modes far slower than the
// fastest have no dashpots to speak of. What falls, falls with the rest.
constexpr double kLocalAlone = 0.3;
// Blocks with more than this times the median frequency are given inertia: one splinter of rock would set the time step of
// all. Where it is pushed along, its inertia is nothing; where it fails by itself, it goes as far in as many steps.
constexpr double kStiffest = 4.0;
// The motion is looked at when it has gone these many times the deflection at rest, doubling, until two looks agree:
// close to toppling, elastic rocking takes part in a slide at first and is left behind by it.
constexpr double kFirstTarget = 10.0, kLastTarget = 640.0;
// A clean slide is clear when it is looked at for the first time, if it was one at half of that way, too: all that moves slides, by so
// much of the farthest block's way or more, and nothing else has gone more than the deflection, so that no rocking hides in it.
constexpr double kTogether = 0.5;
constexpr double kLeastMotion = 5.0;  // of the deflection at rest, else it is no failure
constexpr double kFarEnough = 0.1;    // of a block's size: what is not clear by then stays mixed
constexpr double kFarthest = 0.2;     // likewise of a part, whose steps cost little
constexpr double kAgreement = 0.02;   // share of the moving mass that may change its role between two looks
constexpr double kGathers = 1.1;      // speed in the last third of the time over that in the third before
constexpr double kFallsAlong = 0.1;   // of the farthest block's way: what has gone less is only pushed
// Where it is known which blocks leave, they go on with what is so many contacts from them while all others are held, unless that is more
// than this share of what is free.
constexpr int kRings = 4;
constexpr double kMostOfPart = 0.25;
constexpr int kStepsPerLook = 20;
// Steps for which a pair of blocks may wait that alone wants its contact of faces made anew: of many that move some pair always
// does, and searched for at once that was six tenths of an analysis (579 blocks of random joints).
constexpr std::int64_t kPairWaits = 400;
constexpr std::int64_t kStepsPerRestCheck = 20'000;
constexpr double kAtRest = 1e-3;  // of the largest kinetic energy seen: the motion has come to rest

struct Poses {
    PositionArray position;
    QuaternionArray orientation;
};

BlockWay waySince(const State& state, const Poses& start, std::size_t b) {
    return {.free = state.blocks.motion[b] == Motion::free,
            .position = state.blocks.position.get(b),
            .radius = state.geometry->radius[b],
            .translation = (state.blocks.position.get(b) - start.position.get(b)).norm(),
            .rotation = rotationFrom(start.orientation, state.blocks.orientation, b),
            .mass = state.blocks.mass[b]};
}

/// The squared frequency up to which blocks keep their true inertia [1/s^2]: that of the stiffest, or a multiple of the median.
double frequencyCap(const std::vector<double>& bounds) {
    const double highest = *std::max_element(bounds.begin(), bounds.end());
    return highest > 0 ? std::min(highest, kStiffest * kStiffest * medianBound(bounds)) : 1.0;
}

/// Blocks stiffer than the cap get the inertia that takes them there. \return whether there are any
bool scaleStiffest(State& state, const std::vector<double>& bounds, double cap) {
    std::vector<double> scale;
    scale.reserve(bounds.size());
    for (const double bound : bounds) scale.push_back(std::max(1.0, bound / cap));
    setInertia(state, scale);
    return std::any_of(scale.begin(), scale.end(), [](double s) { return s > 1.0; });
}

double dashpots(double omega_squared) { return 2.0 * kDashpot / std::sqrt(omega_squared); }

/// Shares of open area and of mobilised friction over a block's contact points.
void addContactEvidence(const State& state, std::size_t block, BlockMotion& motion) {
    double area = 0, open_area = 0, shear = 0, strength = 0;
    for (auto k = state.incidence.interface_begin[block]; k < state.incidence.interface_begin[block + 1];
         ++k) {
        const auto i = static_cast<std::size_t>(state.incidence.interface[static_cast<std::size_t>(k)]);
        if (isIdle(state.interfaces, i)) continue;
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
        for (const ContactPoint& point : contactPoints(state, i)) {
            area += point.area;
            if (point.force.normal == 0.0) {
                open_area += point.area;
                continue;
            }
            shear += std::hypot(point.force.shear_1, point.force.shear_2);
            strength += contact::shearStrength(law, point.area, point.force.normal, point.memory.bond);
        }
    }
    motion.open_share = area > 0 ? open_area / area : 1.0;
    motion.mobilised_friction = strength > 0 ? std::min(1.0, shear / strength) : 0.0;
}

BlockMotion describeBlock(const State& state, const Poses& start, std::size_t b, const BlockWay& way,
                          FailureMode role) {
    BlockMotion motion;
    motion.block = state.geometry->model.blocks[b].name;
    motion.mode = role;
    motion.moving = role != FailureMode::none;
    motion.translation = state.blocks.position.get(b) - start.position.get(b);
    motion.rotation = way.rotation;
    motion.rotation_share = way.way() > 0 ? way.rotation * way.radius / way.way() : 0.0;
    addContactEvidence(state, b, motion);
    return motion;
}

/// \param roles  one per block
bool isCleanSlide(const std::vector<BlockWay>& ways, const std::vector<FailureMode>& roles,
                  double deflection) {
    double farthest = 0;
    for (const BlockWay& way : ways)
        if (way.free) farthest = std::max(farthest, way.way());
    for (std::size_t b = 0; b < ways.size(); ++b) {
        if (!ways[b].free) continue;
        const bool slides = roles[b] == FailureMode::sliding && ways[b].way() >= kTogether * farthest;
        const bool stands = roles[b] == FailureMode::none && ways[b].way() <= deflection;
        if (!slides && !stands) return false;
    }
    return true;
}

void describeFailure(const State& state, const Poses& start, double deflection, Failure& failure) {
    failure.motions.clear();
    failure.moving_blocks.clear();
    std::vector<BlockWay> ways;
    for (std::size_t b = 0; b < state.blocks.size(); ++b) ways.push_back(waySince(state, start, b));
    const std::vector<FailureMode> roles = motionRoles(ways, deflection);
    for (std::size_t b = 0; b < ways.size(); ++b) {
        if (!ways[b].free) continue;
        failure.motions.push_back(describeBlock(state, start, b, ways[b], roles[b]));
        if (failure.motions.back().moving) failure.moving_blocks.push_back(failure.motions.back().block);
    }
    std::sort(failure.moving_blocks.begin(), failure.moving_blocks.end());
    failure.mode = overallMode(ways, roles);
    failure.is_clean_slide = failure.mode == FailureMode::sliding && isCleanSlide(ways, roles, deflection);
}

/// Mass of the moving blocks, and of those whose role is another one than at the look before [kg].
struct Agreement {
    double moving = 0, changed = 0;

    Agreement(const State& state, const Failure& before, const Failure& now) {
        std::size_t k = 0;
        for (std::size_t b = 0; b < state.blocks.size(); ++b) {
            if (state.blocks.motion[b] != Motion::free) continue;
            const FailureMode was = k < before.motions.size() ? before.motions[k].mode : FailureMode::none;
            const FailureMode is = now.motions[k++].mode;
            if (is != FailureMode::none) moving += state.blocks.mass[b];
            if (is != was) changed += state.blocks.mass[b];
        }
    }
};

/// Two looks agree when they give the same mode to the whole and, but for a little mass, to each block.
bool agree(const State& state, const Failure& before, const Failure& now) {
    const Agreement roles(state, before, now);
    return now.mode == before.mode && now.mode != FailureMode::none &&
           roles.changed <= kAgreement * roles.moving;
}

/// Of the motion of a failing state that is let go.
struct Pace {
    double cap = 0;              ///< squared frequency that no block exceeds [1/s^2]
    bool is_scaled = false;      ///< some blocks have more than their true inertia
    double time_step = 0;        ///< [s]
    double contact_damping = 0;  ///< with every block's true inertia [s]
};

/// True inertia but for the stiffest blocks, at rest, with dashpots that only take out the rattle; more where it is the only witness.
Pace makeDynamic(State& state, bool is_alone, bool parallel) {
    setAtRest(state.blocks);
    const std::vector<double> bounds = frequencyBounds(state, parallel);
    Pace pace{.cap = frequencyCap(bounds)};
    pace.is_scaled = scaleStiffest(state, bounds, pace.cap);
    const double highest = *std::max_element(bounds.begin(), bounds.end());
    pace.contact_damping = dashpots(highest > 0 ? highest : pace.cap);
    state.damping = {.contact = dashpots(pace.cap), .local = is_alone ? kLocalAlone : 0.0};
    state.release = 1.0;
    updateForces(state, parallel);
    pace.time_step = kContinuationStepSafety * stableTimeStep(pace.cap, state.damping.contact);
    return pace;
}

/// A failing state that is let go, watched.
class Continuation {
 public:
    /// \param takes_time  goes on until it is both clear how it moves and far, not one of these, but no farther than kFarthest
    Continuation(State& state, const Pace& pace, const Evidence& wanted, const Control& control,
                 bool parallel, bool takes_time)
        : state_(state),
          pace_(pace),
          wanted_(wanted),
          control_(control),
          parallel_(parallel),
          takes_time_(takes_time) {
        start_ = {state.blocks.position, state.blocks.orientation};
        failure_.time_step = pace.time_step;
        failure_.contact_damping = pace.contact_damping;
    }

    Failure run() {
        double next_look = wanted_.deflection > 0 ? 0.5 : 1;
        bool clear = false;
        while (!failure_.at_rest && hasSteps() && !interrupted()) {
            goOn();
            if (isDoubted() && wanted_.rests()) {
                failure_.stands = true;
                break;
            }
            const double progress = progressOf();
            if (!clear && progress >= next_look) {
                const bool is_early = progress < 1;
                clear = look(is_early);
                next_look = is_early ? 1 : 2 * progress;
            }
            const bool last = progress >= kLastTarget / kFirstTarget, far = share_of_farthest_ >= kFarEnough;
            const bool is_read =
                takes_time_ ? (clear && far) || share_of_farthest_ >= kFarthest : clear || far;
            if ((is_read || last) && borneOut()) break;
        }
        failure_.confirmed = !failure_.stands && borneOut();
        failure_.seconds = static_cast<double>(failure_.steps) * failure_.time_step;
        describeFailure(state_, start_, wanted_.deflection, failure_);
        nameFalling();
        return std::move(failure_);
    }

 private:
    bool interrupted() const { return isStopped(control_); }

    void goOn() {
        advance(state_, {failure_.time_step, parallel_}, kStepsPerLook);
        failure_.steps += kStepsPerLook;
        const bool may_wait = failure_.steps - searched_at_ < kPairWaits;
        if (refreshInterfaces(state_, parallel_, kStepsPerLook * failure_.time_step, control_.stop, {},
                              may_wait)) {
            searched_at_ = failure_.steps;
            if (pace_.is_scaled) scaleStiffest(state_, frequencyBounds(state_, parallel_), pace_.cap);
        }
        measure();
        const double energy = kineticEnergy(state_);
        if (failure_.steps % kStepsPerRestCheck == 0) failure_.at_rest = energy < kAtRest * most_energy_;
        most_energy_ = std::max(most_energy_, energy);
    }

    void measure() {
        failure_.motion = share_ = share_of_farthest_ = 0;
        for (std::size_t b = 0; b < state_.blocks.size(); ++b) {
            if (state_.blocks.motion[b] != Motion::free) continue;
            const double way = waySince(state_, start_, b).way();
            const double share = way / state_.geometry->size[b];
            share_ = std::max(share_, share);
            if (way <= failure_.motion) continue;
            failure_.motion = way;
            share_of_farthest_ = share;
        }
        ways_.push_back(failure_.motion);
    }

    /// How far it has come of the way after which it is looked at for the first time.
    double progressOf() const {
        const double of_share = share_ / wanted_.share;
        if (!(wanted_.deflection > 0)) return of_share;
        return std::min(of_share, failure_.motion / (kFirstTarget * wanted_.deflection));
    }

    /// What gathers speed and has not gone far, or has gone far and neither does nor rests, is soon seen to be one or the other.
    bool isOnItsWay() const {
        const bool is_far = failure_.motion >= kLeastMotion * wanted_.deflection;
        return share_ >= wanted_.share && is_far != gathersSpeed();
    }

    bool hasSteps() const {
        return failure_.steps < wanted_.most_steps ||
               (failure_.steps < wanted_.most_steps_on_its_way && isOnItsWay());
    }

    /// Asked once.
    bool isDoubted() {
        if (!wanted_.rests || failure_.is_doubted || failure_.steps < wanted_.doubted_after || borneOut())
            return false;
        failure_.is_doubted = true;
        return true;
    }

    /// Reads the motion once more. \return whether it says the same as before; an early look counts for nothing but a clean slide
    bool look(bool is_early) {
        Failure now = failure_;
        describeFailure(state_, start_, wanted_.deflection, now);
        const bool counts =
            !std::exchange(was_early_, is_early) || (failure_.is_clean_slide && now.is_clean_slide);
        const bool same = counts && agree(state_, failure_, now);
        failure_ = std::move(now);
        return same;
    }

    /// A block that falls, slides or topples gathers speed; one that settles has gone through its greatest speed, and one that a
    /// jolt has moved goes no third of its way in the last third of the time.
    bool gathersSpeed() const {
        const std::size_t n = ways_.size();
        if (n < 3) return false;
        const double first = ways_[n / 3], second = ways_[2 * n / 3];
        const double last = ways_.back() - second;
        return last > kGathers * (second - first) && 3.0 * last >= ways_.back();
    }

    /// What goes on is a failure, and so is what has moved by far more than it gives at rest, though it stands again.
    bool borneOut() const {
        const bool stands_again = failure_.at_rest && wanted_.deflection > 0;
        return share_ >= wanted_.share && failure_.motion >= kLeastMotion * wanted_.deflection &&
               (gathersSpeed() || stands_again);
    }

    void nameFalling() {
        for (std::size_t b = 0; b < state_.blocks.size(); ++b) {
            if (state_.blocks.motion[b] != Motion::free) continue;
            const double way = waySince(state_, start_, b).way();
            if (failure_.confirmed && way >= kFallsAlong * failure_.motion) failure_.falling.push_back(b);
        }
    }

    State& state_;
    const Pace& pace_;
    const Evidence& wanted_;
    const Control& control_;
    bool parallel_, takes_time_;
    Poses start_{};
    Failure failure_{};
    std::vector<double> ways_{};    ///< of the farthest-moved block, at each look [m]
    std::int64_t searched_at_ = 0;  ///< the last search for contacts, in steps
    double share_ = 0;              ///< largest way of a block over its own size
    double share_of_farthest_ =
        0;  ///< of the block that has gone farthest: what a splinter has gone says nothing of the whole
    double most_energy_ = 0;
    bool was_early_ = false;  ///< the last look
};

/// Those that move, and what is kRings of contacts from them; empty: nobody says which, it is too large a part, or bolts reach beyond.
std::vector<char> partAround(const State& state, const std::vector<std::size_t>& moving) {
    if (!state.bolts.segments.empty()) return {};
    std::vector<char> part(state.blocks.size(), 0);
    for (const std::size_t b : moving) part[b] = 1;
    part = withNeighbours(state, std::move(part), kRings, Through::free_blocks);
    std::int64_t free = 0, in_part = 0;
    for (std::size_t b = 0; b < part.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        ++free;
        in_part += part[b];
    }
    if (moving.empty() || static_cast<double>(in_part) > kMostOfPart * static_cast<double>(free))
        part.clear();
    return part;
}

/// Whether blocks that move touch, by one of two sets of contacts, others that do not belong to the part: these might move as well.
bool moveBesideOthers(const State& all, const Interfaces& now, const std::vector<std::string>& moving,
                      const std::vector<char>& part) {
    const std::vector<char> moves = blocksNamed(all.geometry->model, moving);
    const auto is_held = [&](std::size_t b) { return !part[b] && all.blocks.motion[b] == Motion::free; };
    const auto touch = [&](const Interfaces& f) {
        for (std::size_t i = 0; i < f.size(); ++i) {
            const auto a = static_cast<std::size_t>(f.block_a[i]), b = static_cast<std::size_t>(f.block_b[i]);
            if (!isIdle(f, i) && ((moves[a] && is_held(b)) || (moves[b] && is_held(a)))) return true;
        }
        return false;
    };
    return touch(all.interfaces) || touch(now);
}

/// Brings all to where they have come with the others held, who have not moved.
void takeOver(const State& held, State& state, bool parallel) {
    state.blocks.position = held.blocks.position;
    state.blocks.orientation = held.blocks.orientation;
    for (auto vectors : {&Blocks::velocity, &Blocks::angular_momentum, &Blocks::angular_velocity})
        state.blocks.*vectors = held.blocks.*vectors;
    updateForces(state, parallel);
    refreshInterfaces(state, parallel, 0.0);
}

}  // namespace

Failure continueFailure(State& state, const Evidence& wanted, const Control& control, bool parallel,
                        const std::vector<std::size_t>& moving) {
    const Pace pace = makeDynamic(state, wanted.alone, parallel);
    const std::vector<char> part = partAround(state, moving);
    std::int64_t spent = 0;
    bool is_doubted = false;
    Evidence wanted_of_all = wanted;
    if (!part.empty()) {
        State held = state;
        holdOthers(held, part, parallel);
        Failure failure = Continuation(held, pace, wanted, control, parallel, true).run();
        if (failure.confirmed && !moveBesideOthers(state, held.interfaces, failure.moving_blocks, part)) {
            const Poses start{state.blocks.position, state.blocks.orientation};
            takeOver(held, state, parallel);
            describeFailure(state, start, wanted.deflection, failure);
            return failure;
        }
        if (failure.stands) return failure;
        is_doubted = failure.is_doubted;
        if (is_doubted) wanted_of_all.rests = nullptr;
        spent = failure.steps;
    }
    Failure failure = Continuation(state, pace, wanted_of_all, control, parallel, false).run();
    failure.steps += spent;
    failure.is_doubted = failure.is_doubted || is_doubted;
    return failure;
}

Failure describeWay(const State& from, const State& to) {
    Failure failure;
    describeFailure(to, {from.blocks.position, from.blocks.orientation}, 0.0, failure);
    return failure;
}

}  // namespace talus::analysis
