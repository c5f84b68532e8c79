#include "analysis/failure_mode.h"

#include <algorithm>
#include <cmath>

#include "stages/contacts.h"
#include "stages/measure.h"
#include "stages/patches.h"
#include "stages/sharp_contacts.h"
#include "stages/step.h"
#include "stages/time_step.h"
#include "state/build.h"

namespace talus::analysis {
namespace {

constexpr double kDashpot = 0.5;  // damping ratio of the fastest mode: takes out the rattle only
// The motion is looked at when it has gone these many times the deflection at rest, doubling, until two looks agree:
// close to toppling, elastic rocking takes part in a slide at first and is left behind by it.
constexpr double kFirstTarget = 10.0, kLastTarget = 640.0;
constexpr double kLeastMotion = 5.0;  // of the deflection at rest, else it is no failure
constexpr double kFarEnough = 0.1;    // of a block's size: what is not clear by then stays mixed
constexpr double kAgreement = 0.02;   // share of the moving mass that may change its role between two looks
constexpr double kGathers = 1.1;      // speed in the last third of the time over that in the third before
constexpr double kFallsAlong = 0.1;   // of the farthest block's way: what has gone less is only pushed
constexpr int kStepsPerLook = 20;
constexpr std::int64_t kStepsPerRestCheck = 20'000;
constexpr double kAtRest = 1e-3;  // of the largest kinetic energy seen: the motion has come to rest
// A block moves when it goes this many times the deflection at rest, and this share of the farthest one's way. (A larger
// share would leave out columns that slide behind others which rocking has given a start.)
constexpr double kMovingDeflections = 2.0, kMovingShare = 0.02;
constexpr double kTopplingShare = 0.25;  // rotation times the moving group's extent, over the motion
constexpr double kPureShare = 0.9;       // share of the moving mass that gives the whole its mode

struct Poses {
    PositionArray position;
    QuaternionArray orientation;
};

double motionSince(const State& state, const Poses& start, std::size_t b) {
    return (state.blocks.position.get(b) - start.position.get(b)).norm() +
           stages::rotationFrom(start.orientation, state.blocks.orientation, b) * state.geometry->radius[b];
}

double largestMotion(const State& state, const Poses& start) {
    double largest = 0;
    for (std::size_t b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.motion[b] == Motion::free) largest = std::max(largest, motionSince(state, start, b));
    return largest;
}

/// True inertia, at rest, with dashpots that only take out the rattle. Returns the time step [s].
double makeDynamic(State& state, bool parallel) {
    setInertia(state, std::vector<double>(state.blocks.size(), 1.0));
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        state.blocks.velocity.set(b, Vec3::Zero());
        state.blocks.angular_momentum.set(b, Vec3::Zero());
    }
    const std::vector<double> bounds = stages::frequencyBounds(state, parallel);
    const double bound = *std::max_element(bounds.begin(), bounds.end());
    const double omega_squared = bound > 0 ? bound : 1.0;
    state.damping = {.contact = 2.0 * kDashpot / std::sqrt(omega_squared)};
    state.release = 1.0;
    stages::updateForces(state, parallel);
    return kContinuationStepSafety * stages::stableTimeStep(omega_squared, state.damping.contact);
}

/// Shares of open area and of mobilised friction over a block's Lps.
void addContactEvidence(const State& state, std::size_t block, BlockMotion& motion) {
    double area = 0, open_area = 0, shear = 0, strength = 0;
    for (auto k = state.incidence.interface_begin[block]; k < state.incidence.interface_begin[block + 1];
         ++k) {
        const auto i = static_cast<std::size_t>(state.incidence.interface[static_cast<std::size_t>(k)]);
        if (stages::isIdle(state.interfaces, i)) continue;
        const contact::JointLaw& law = state.laws[static_cast<std::size_t>(state.interfaces.joint[i])];
        for (const stages::PointState& point : stages::pointStates(state, i)) {
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

/// Diagonal of the box around the moving blocks: the length that makes a rotation comparable with a translation. A
/// block that turns about a pivot within reach of the moving group topples; one whose pivot is far away slides.
double movingExtent(const State& state, const std::vector<char>& moving) {
    Vec3 low = Vec3::Constant(kInfinity), high = Vec3::Constant(-kInfinity);
    for (std::size_t b = 0; b < moving.size(); ++b) {
        if (!moving[b]) continue;
        const Vec3 reach = Vec3::Constant(state.geometry->radius[b]);
        low = low.cwiseMin(state.blocks.position.get(b) - reach);
        high = high.cwiseMax(state.blocks.position.get(b) + reach);
    }
    return (high - low).norm();
}

BlockMotion describeBlock(const State& state, const Poses& start, std::size_t b, double extent, bool moving) {
    BlockMotion motion;
    motion.block = state.geometry->model.blocks[b].name;
    motion.translation = state.blocks.position.get(b) - start.position.get(b);
    motion.rotation = stages::rotationFrom(start.orientation, state.blocks.orientation, b);
    const double turned = motion.rotation * state.geometry->radius[b];
    const double whole = turned + motion.translation.norm();
    motion.rotation_share = whole > 0 ? turned / whole : 0.0;
    motion.moving = moving;
    addContactEvidence(state, b, motion);
    if (!moving) return motion;
    const bool topples = motion.rotation * extent > kTopplingShare * whole;
    motion.mode = topples ? FailureMode::toppling : FailureMode::sliding;
    return motion;
}

FailureMode overallMode(const State& state, const std::vector<BlockMotion>& motions,
                        const std::vector<std::size_t>& blocks) {
    double sliding = 0, toppling = 0;
    for (std::size_t k = 0; k < motions.size(); ++k) {
        const double mass = state.blocks.mass[blocks[k]];
        if (motions[k].mode == FailureMode::sliding) sliding += mass;
        if (motions[k].mode == FailureMode::toppling) toppling += mass;
    }
    const double all = sliding + toppling;
    if (all == 0) return FailureMode::none;
    if (sliding >= kPureShare * all) return FailureMode::sliding;
    return toppling >= kPureShare * all ? FailureMode::toppling : FailureMode::mixed;
}

void describeFailure(const State& state, const Poses& start, double deflection, Failure& failure) {
    failure.motions.clear();
    failure.moving_blocks.clear();
    const double least =
        std::max(kMovingDeflections * deflection, kMovingShare * largestMotion(state, start));
    std::vector<char> moving(state.blocks.size(), 0);
    for (std::size_t b = 0; b < moving.size(); ++b)
        moving[b] = state.blocks.motion[b] == Motion::free && motionSince(state, start, b) > least;
    const double extent = movingExtent(state, moving);
    std::vector<std::size_t> blocks;
    for (std::size_t b = 0; b < moving.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        failure.motions.push_back(describeBlock(state, start, b, extent, moving[b] != 0));
        blocks.push_back(b);
        if (moving[b]) failure.moving_blocks.push_back(failure.motions.back().block);
    }
    std::sort(failure.moving_blocks.begin(), failure.moving_blocks.end());
    failure.mode = overallMode(state, failure.motions, blocks);
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

/// A failing state that is let go, watched.
class Continuation {
 public:
    Continuation(State& state, const Evidence& wanted, const Control& control, bool parallel)
        : state_(state), wanted_(wanted), control_(control), parallel_(parallel) {
        failure_.time_step = makeDynamic(state, parallel);
        start_ = {state.blocks.position, state.blocks.orientation};
    }

    Failure run() {
        double next_look = 1;
        bool clear = false;
        while (!failure_.at_rest && failure_.steps < wanted_.most_steps && !interrupted()) {
            goOn();
            const double progress = progressOf();
            if (!clear && progress >= next_look) {
                clear = look();
                next_look = 2 * progress;
            }
            const bool far = progress >= kLastTarget / kFirstTarget || share_ >= kFarEnough;
            if ((clear || far) && borneOut()) break;
        }
        failure_.confirmed = borneOut();
        failure_.seconds = static_cast<double>(failure_.steps) * failure_.time_step;
        describeFailure(state_, start_, wanted_.deflection, failure_);
        nameFalling();
        return std::move(failure_);
    }

 private:
    bool interrupted() const {
        return control_.stop != nullptr && control_.stop->load(std::memory_order_relaxed);
    }

    void goOn() {
        stages::advance(state_, {failure_.time_step, parallel_}, kStepsPerLook);
        failure_.steps += kStepsPerLook;
        stages::refreshInterfaces(state_, parallel_, kStepsPerLook * failure_.time_step);
        measure();
        const double energy = stages::kineticEnergy(state_);
        if (failure_.steps % kStepsPerRestCheck == 0) failure_.at_rest = energy < kAtRest * most_energy_;
        most_energy_ = std::max(most_energy_, energy);
    }

    void measure() {
        failure_.motion = share_ = 0;
        for (std::size_t b = 0; b < state_.blocks.size(); ++b) {
            if (state_.blocks.motion[b] != Motion::free) continue;
            const double way = motionSince(state_, start_, b);
            failure_.motion = std::max(failure_.motion, way);
            share_ = std::max(share_, way / state_.geometry->size[b]);
        }
        ways_.push_back(failure_.motion);
    }

    /// How far it has come of the way after which it is looked at for the first time.
    double progressOf() const {
        const double of_share = share_ / wanted_.share;
        if (!(wanted_.deflection > 0)) return of_share;
        return std::min(of_share, failure_.motion / (kFirstTarget * wanted_.deflection));
    }

    /// Reads the motion once more. \return whether it says the same as before
    bool look() {
        Failure now = failure_;
        describeFailure(state_, start_, wanted_.deflection, now);
        const bool same = agree(state_, failure_, now);
        failure_ = std::move(now);
        return same;
    }

    /// A block that falls, slides or topples gathers speed; one that settles has gone through its greatest speed.
    bool gathersSpeed() const {
        const std::size_t n = ways_.size();
        if (n < 3) return false;
        const double first = ways_[n / 3], second = ways_[2 * n / 3];
        return ways_.back() - second > kGathers * (second - first);
    }

    bool borneOut() const {
        return share_ >= wanted_.share && failure_.motion >= kLeastMotion * wanted_.deflection &&
               gathersSpeed();
    }

    void nameFalling() {
        for (std::size_t b = 0; b < state_.blocks.size(); ++b) {
            if (state_.blocks.motion[b] != Motion::free) continue;
            const double way = motionSince(state_, start_, b);
            if (failure_.confirmed && way >= kFallsAlong * failure_.motion) failure_.falling.push_back(b);
        }
    }

    State& state_;
    const Evidence& wanted_;
    const Control& control_;
    bool parallel_;
    Poses start_{};
    Failure failure_{};
    std::vector<double> ways_{};  ///< of the farthest-moved block, at each look [m]
    double share_ = 0;            ///< largest way of a block over its own size
    double most_energy_ = 0;
};

}  // namespace

Failure continueFailure(State& state, const Evidence& wanted, const Control& control, bool parallel) {
    return Continuation(state, wanted, control, parallel).run();
}

}  // namespace talus::analysis
