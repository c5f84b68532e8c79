// Time history of a model.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

#include "build/wet_joints.h"
#include "checks/closed_volumes.h"
#include "checks/loose_blocks.h"
#include "checks/open_cohesion.h"
#include "checks/passing.h"
#include "checks/plausible.h"
#include "checks/water_warnings.h"
#include "contacts/update.h"
#include "failure/failure.h"
#include "forces/closed_water.h"
#include "forces/sum.h"
#include "frame/frame.h"
#include "history/given_step.h"
#include "history/history_record.h"
#include "history/initial_state.h"
#include "law/joint_laws.h"
#include "measure/measure.h"
#include "measure/words.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "state/incidence.h"
#include "state/threads.h"
#include "step/energy_keeper.h"
#include "step/step.h"
#include "step/time_step.h"
#include "talus/simulation.h"

namespace talus {
namespace {

// Share of the stability bound. A spring that closes or opens in the middle of a step loses or adds up to
// (omega dt)^2 / 4 of the energy of the impact. Models in which blocks fly or move from the start get a step
// that keeps this below 0.1 %.
constexpr double kStepSafety = 0.4;
// For a continued failure: dashpots damp what a long step excites.
constexpr double kFailingStepSafety = 0.85;
constexpr double kImpactStepSafety = 0.03;
constexpr int kStepsPerLook = 10;  // neighbours, patches, draining, interruption
constexpr int kStepsPerReport = 2000;
static_assert(kStepsPerReport % kStepsPerLook == 0);

bool expectsImpacts(const State& state) {
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] == Motion::free &&
            (!checks::touchesSomething(state, b) || speedBound(state, b) > 0))
            return true;
        if (state.blocks.motion[b] == Motion::driven) return true;
    }
    return false;
}

class TimeHistory {
 public:
    /// \param given  the model without the joints of wet interfaces
    TimeHistory(State state, const Model& given, const Control& control, const RunOutput& output,
                bool parallel)
        : state_(std::move(state)),
          control_(control),
          output_(output),
          parallel_(parallel),
          settings_(state_.geometry->model.run),
          watched_(history::watchedBlocks(state_.geometry->model)),
          changes_strength_(std::any_of(state_.geometry->model.joints.begin(),
                                        state_.geometry->model.joints.end(), changesStrength)) {
        if (output_.begin) geometry_ = geometryOf(state_, given.joints.size());
    }

    /// False when stopped: then there is no state to start from. Errors: as of history::bringToStart.
    Result<bool> start() {
        progress_.step_safety = expectsImpacts(state_) ? kImpactStepSafety : kStepSafety;
        if (control_.progress) control_.progress({"start", 0.0, "weight and water are applied"});
        const Result<InitialState> begun = history::bringToStart(state_, control_, parallel_);
        if (isStopped(control_)) return false;
        if (!begun) return begun.errors();
        start_ = *begun;
        state_.springs = Springs::keep_energy;
        shake();
        chooseTimeStep();
        beginFrames();
        return true;
    }

    /// Continues from a frame taken after a whole step: nothing is recomputed.
    std::vector<Error> resume(const FullFrame& frame) {
        sayBegun();
        progress_ = frame.progress;
        if (!std::isfinite(progress_.next_frame) || !(progress_.time_step > 0) ||
            !(progress_.step_safety > 0) || !(progress_.time_step < kInfinity) || progress_.frames < 1)
            return {{"full.progress", "holds no valid time step or next frame: the frame is damaged"}};
        last_light_ = last_full_ = frame.step;
        // A continued failure keeps the settings of its search (startFailing).
        if (!isPlayedOn()) {
            state_.springs = Springs::keep_energy;
            shake();
        }
        return restoreFrame(frame, state_);
    }

    /// With zero velocity from a state of a search, which may have had its own inertia and damping.
    std::vector<Error> startFailing(const FailingState& failing, double far_enough) {
        if (std::vector<Error> errors = restoreFrame(failing.state, state_); !errors.empty()) return errors;
        const Model& model = state_.geometry->model;
        state_.time = state_.load.time = 0;
        state_.step = 0;
        state_.load.tilt = model.gravity.tilt;
        state_.damping = model.damping;
        state_.release = 1.0;
        for (std::size_t b = 0; b < state_.blocks.size(); ++b) {
            if (state_.blocks.motion[b] != Motion::free) continue;
            state_.blocks.velocity.set(b, Vec3::Zero());
            state_.blocks.angular_momentum.set(b, Vec3::Zero());
        }
        progress_.step_safety = kFailingStepSafety;
        progress_.stability_bound = stableTimeStep(failing.frequency, state_.damping.contact);
        chooseTimeStep();
        beginFrames();
        released_at_ = state_.blocks.position;
        far_enough_ = far_enough;
        return {};
    }

    Result<RunResult> run() {
        while (state_.time < settings_.duration - 0.5 * progress_.time_step && !interrupted() && !fault_ &&
               !went_far_)
            goOn(stepsAhead(settings_.duration));
        if (auto fault = faultNow()) return *fault;
        handOut(true);
        return result();
    }

    /// So many more steps, also past the duration: in whole looks the same as run().
    std::vector<Error> step(std::int64_t count) {
        open_ended_ = true;
        interrupted_ = false;
        const std::int64_t last = state_.step + count;
        while (state_.step < last && !interrupted() && !fault_)
            goOn(static_cast<int>(std::min<std::int64_t>(stepsAhead(kInfinity), last - state_.step)));
        if (auto fault = faultNow()) return {*fault};
        return {};
    }

    const State& state() const { return state_; }
    double timeStep() const { return progress_.time_step; }
    InitialState startedFrom() const { return start_; }
    HistoryRecord record() const { return history::recordOf(state_, watched_); }

 private:
    std::optional<Error> faultNow() const {
        if (fault_ || isFinite(state_)) return fault_;
        return becameInfinite();
    }

    Error becameInfinite() const {
        char text[60];
        std::snprintf(text, sizeof text, "the motion became infinite before t = %g s", state_.time);
        return history::stepTooLong(text, progress_.time_step, progress_.stability_bound);
    }

    void shake() { state_.load.shaken = !state_.geometry->model.ground_motion.empty(); }

    /// Called only once a state exists, so that an interruption before leaves no empty file.
    void sayBegun() {
        if (output_.begin && geometry_) output_.begin(*std::exchange(geometry_, std::nullopt));
    }

    void beginFrames() {
        sayBegun();
        beginClosedWater(state_);
        updateForces(state_, parallel_);
        progress_.next_frame = settings_.frame_interval;
        progress_.frames = 1;
        handOut(true);
    }

    bool wentFar() const {
        if (!(far_enough_ < kInfinity)) return false;
        for (std::size_t b = 0; b < state_.blocks.size(); ++b)
            if (state_.blocks.motion[b] == Motion::free &&
                (state_.blocks.position.get(b) - released_at_.get(b)).norm() >= far_enough_)
                return true;
        return false;
    }

    bool interrupted() {
        if (state_.step % kStepsPerLook == 0 && isStopped(control_)) interrupted_ = true;
        return interrupted_;
    }

    void frameIsDue() {
        while (progress_.next_frame <= state_.time + 0.5 * progress_.time_step)
            progress_.next_frame += settings_.frame_interval;
        const bool full = progress_.frames % std::max(1, output_.frames_per_full) == 0;
        ++progress_.frames;
        went_far_ = wentFar();
        handOut(full || went_far_);
    }

    /// No frame is returned twice. The last frame of an interrupted run is beside the regular ones and does
    /// not count. So the resumed run has its frames at the regular times.
    void handOut(bool full) {
        if (std::exchange(last_light_, state_.step) != state_.step) {
            if (output_.record) output_.record(history::recordOf(state_, watched_));
            if (output_.light) {
                LightFrame frame = lightFrameOf(state_);
                frame.time_step = progress_.time_step;
                output_.light(std::move(frame));
            }
        }
        if (!full || !output_.full || std::exchange(last_full_, state_.step) == state_.step) return;
        FullFrame frame = fullFrameOf(state_);
        frame.progress = progress_;
        output_.full(std::move(frame));
    }

    bool isPlayedOn() const { return progress_.step_safety == kFailingStepSafety; }

    /// \return whether any block has a frequency
    bool findBound() {
        if (isPlayedOn()) {
            const double frequency = frequencyOfStep(progress_.stability_bound, state_.damping.contact);
            failure::slowDownTo(state_, frequency, parallel_);
            return frequency > 0;
        }
        const double highest = highestFrequency(state_, parallel_);
        progress_.stability_bound =
            highest > 0 ? stableTimeStep(highest, state_.damping.contact) : settings_.duration / 1000;
        return highest > 0;
    }

    void chooseTimeStep() {
        const bool is_bounded = findBound();
        const double bound = progress_.stability_bound;
        if (settings_.time_step) {
            progress_.time_step = *settings_.time_step;
            if (is_bounded && isAboveBound()) judgeGivenStep();
            return;
        }
        // A whole number of steps ends exactly at the duration.
        const double left = settings_.duration - state_.time;
        if (left > 0.5 * progress_.time_step)
            progress_.time_step = left / std::max(1.0, std::ceil(left / (progress_.step_safety * bound)));
        else if (open_ended_)
            progress_.time_step = progress_.step_safety * bound;
    }

    bool isAboveBound() const { return progress_.time_step > progress_.stability_bound; }

    void judgeGivenStep() {
        fault_ = given_step_.begin(state_, progress_.time_step, progress_.stability_bound, parallel_);
        if (std::exchange(progress_.warned_of_step, true)) return;
        state_.warnings.push_back("run.time_step_s is above the stability bound of " +
                                  std::to_string(progress_.stability_bound * 1e6) + " us");
    }

    /// Up to the next look, frame or `end` [s], whichever comes first; at least one.
    int stepsAhead(double end) const {
        const double dt = progress_.time_step;
        const double until = std::min(progress_.next_frame, end) - 0.5 * dt;
        double time = state_.time + dt;
        int steps = 1;
        while (time < until && (state_.step + steps) % kStepsPerLook != 0) {
            time += dt;
            ++steps;
        }
        return steps;
    }

    /// Where blocks collide and nothing external works on them, energy added by the steps is removed.
    bool keepsEnergy() const { return progress_.step_safety == kImpactStepSafety && isLeftAlone(state_); }

    void goOn(int steps) {
        computeSteps(steps);
        if (!fault_ && state_.time >= progress_.next_frame - 0.5 * progress_.time_step) frameIsDue();
    }

    /// For the steps up to the next look the strength at the middle of them. It changes before the forces of
    /// the first of them, so that each frame's forces are of its laws.
    void followStrengthsForALook() {
        const double middle = state_.time + 0.5 * (kStepsPerLook - 1) * progress_.time_step;
        followStrengths(state_.geometry->model.joints, middle, state_.laws);
    }

    void computeSteps(int steps) {
        const double dt = progress_.time_step;
        const bool kept = keepsEnergy();
        const double energy = kept ? totalEnergy(state_, parallel_) : 0.0;
        advance(state_, {dt, parallel_}, steps, [&](int) {
            state_.time += dt;
            state_.load.time = state_.time;
            if (changes_strength_ && state_.step % kStepsPerLook == 0) followStrengthsForALook();
        });
        if (kept) takeBack(state_, totalEnergy(state_, parallel_) - energy, steps * dt, parallel_);
        if (state_.step % kStepsPerLook == 0) {
            if (!isFinite(state_)) {
                fault_ = becameInfinite();
                return;
            }
            if (isAboveBound())
                fault_ = given_step_.look(state_, progress_.time_step, progress_.stability_bound, parallel_);
            if (fault_) return;
            lookAtBlockForces(state_);
            checks::warnOfPassing(state_, kStepsPerLook * dt);
            if (refreshInterfaces(state_, parallel_, kStepsPerLook * progress_.time_step)) chooseTimeStep();
        }
        if (state_.step % kStepsPerReport == 0 && control_.progress)
            control_.progress(
                {"run", state_.time / settings_.duration, "t = " + std::to_string(state_.time) + " s"});
    }

    RunResult result() {
        RunResult result;
        result.start = start_;
        result.steps = state_.step;
        result.simulated_seconds = state_.time;
        result.time_step = progress_.time_step;
        result.blocks = state_.blocks.size();
        const ContactCount count = countContacts(state_.interfaces);
        result.interfaces = count.interfaces;
        result.contact_points = count.points;
        result.kinetic_energy = kineticEnergy(state_);
        result.state_hash = stateHash(state_);
        for (std::size_t b : watched_) result.watch.push_back(history::reportOn(state_, b));
        result.supports = supportReports(state_);
        result.waters = closedWaterReports(state_);
        for (std::size_t b = 0; b < state_.blocks.size(); ++b)
            result.displacements.push_back(history::reportOn(state_, b).displacement);
        result.interrupted = interrupted_;
        result.warnings = state_.warnings;
        if (auto pushed = checks::pushedAway(state_)) result.warnings.push_back(std::move(*pushed));
        if (state_.shear_lost > 0) result.warnings.push_back(ofLostShear());
        if (auto open = checks::ofOpenCohesion(state_, {})) result.warnings.push_back(std::move(*open));
        return result;
    }

    std::string ofLostShear() const {
        const double weight = checks::freeMass(state_) * state_.geometry->model.gravity.magnitude;
        const std::string share =
            weight > 0 ? formatted(", %.3g times the weight of all free blocks", state_.shear_lost / weight)
                       : "";
        return "joints opened while they still carried shear: " + formatted("%.3g", state_.shear_lost) +
               " N, summed over the whole run" + share +
               ". This is correct where blocks fall or bounce. Where they should stand or slide, chatter has "
               "taken friction away: run again with damping.contact (for example 1e-5 s) and compare";
    }

    State state_;
    const Control& control_;
    const RunOutput& output_;
    bool parallel_;
    const RunSettings& settings_;
    std::vector<std::size_t> watched_;
    bool changes_strength_;                  // of some joint
    std::optional<RunGeometry> geometry_{};  // until it is handed out
    RunProgress progress_;
    InitialState start_ = InitialState::unstressed;
    std::int64_t last_light_ = -1, last_full_ = -1;  // steps at which they were handed out
    PositionArray released_at_;                      // positions at the start of a failure
    double far_enough_ = kInfinity;
    bool went_far_ = false;
    bool interrupted_ = false;
    std::optional<Error> fault_{};
    history::GivenStep given_step_{};
    bool open_ended_ = false;  // steps are asked for, whatever the duration
};

/// Faults of the model; its doubts go among the state's warnings.
std::vector<Error> look(State& built, bool parallel) {
    std::vector<Error> errors = checks::implausible(built);
    if (!errors.empty()) return errors;
    for (std::string& doubt : checks::doubtsOfHistory(built, parallel))
        built.warnings.push_back(std::move(doubt));
    for (const Error& doubt : checks::undampedVolumes(built.geometry->model))
        built.warnings.push_back(doubt.field + ": " + doubt.message);
    return {};
}

/// For a run that did not reach its start or its frame to resume from.
RunResult notBegun(const Model& model, const FullFrame* resume) {
    RunResult result;
    if (resume != nullptr) {
        result.steps = resume->step;
        result.simulated_seconds = resume->time;
        result.state_hash = resume->state_hash;
    }
    result.blocks = model.blocks.size();
    result.displacements.assign(model.blocks.size(), Vec3::Zero());
    result.interrupted = true;
    result.began = false;
    return result;
}

/// Builds the model, calls `begin` to put the history at its start, and runs it. `begin` returns errors and
/// interruptions.
template <class Begin>
Result<RunResult> playHistory(const Model& model, const Control& control, const RunOutput& output,
                              const Begin& begin, const FullFrame* resume = nullptr) {
    return inArena(control.threads, [&]() -> Result<RunResult> {
        const auto started = std::chrono::steady_clock::now();
        Result<RunResult> result = [&]() -> Result<RunResult> {
            Result<State> built = buildWithWetJoints(model, control.threads != 1, control);
            if (isStopped(control)) return notBegun(model, resume);
            if (!built) return built.errors();
            const bool parallel = worthThreads(*built, control.threads);
            if (std::vector<Error> errors = look(*built, parallel); !errors.empty()) return errors;
            if (isStopped(control)) return notBegun(model, resume);
            TimeHistory history(std::move(*built), model, control, output, parallel);
            const auto [errors, stopped] = begin(history);
            if (!errors.empty()) return errors;
            return stopped ? notBegun(model, resume) : history.run();
        }();
        if (result)
            result->wall_seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
        return result;
    });
}

}  // namespace

Result<RunResult> run(const Model& model, const Control& control, const RunOutput& output,
                      const FullFrame* resume) {
    return playHistory(
        model, control, output,
        [&](TimeHistory& history) {
            if (resume != nullptr) return std::pair(history.resume(*resume), false);
            const Result<bool> begun = history.start();
            return std::pair(begun.errors(), begun && !*begun);
        },
        resume);
}

Result<RunResult> runFailing(const Model& model, const Control& control, const RunOutput& output,
                             const FailingState& failing, double far_enough) {
    return playHistory(model, control, output, [&](TimeHistory& history) {
        return std::pair(history.startFailing(failing, far_enough), false);
    });
}

struct Simulation::History {
    History(std::shared_ptr<const Model> of, const Control& lent) : model(std::move(of)), control(lent) {}

    std::shared_ptr<const Model> model;
    Control control;  // of the call that is computing
    RunOutput output{};
    std::optional<TimeHistory> taken{};
};

Simulation::Simulation(std::unique_ptr<History> history) : history_(std::move(history)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

Result<Simulation> Simulation::begin(std::shared_ptr<const Model> model, const Control& control) {
    auto history = std::make_unique<History>(std::move(model), control);
    const std::vector<Error> errors = inArena(control.threads, [&]() -> std::vector<Error> {
        Result<State> built = buildWithWetJoints(*history->model, control.threads != 1, control);
        if (!built) return built.errors();
        const bool parallel = worthThreads(*built, control.threads);
        if (std::vector<Error> errors = look(*built, parallel); !errors.empty()) return errors;
        history->taken.emplace(std::move(*built), *history->model, history->control, history->output,
                               parallel);
        const Result<bool> begun = history->taken->start();
        if (begun && !*begun) return {{"", "interrupted before the history began"}};
        return begun.errors();
    });
    if (!errors.empty()) return errors;
    history->control = {};
    return Simulation(std::move(history));
}

std::vector<Error> Simulation::step(std::int64_t count, const Control& control) {
    history_->control = control;
    std::vector<Error> errors = inArena(control.threads, [&] { return history_->taken->step(count); });
    history_->control = {};
    return errors;
}

BlockView Simulation::blocks() const {
    const State& state = history_->taken->state();
    const Blocks& b = state.blocks;
    return {.size = b.size(),
            .origin = state.geometry->origin,
            .position = numbers(b.position),
            .quaternion = numbers(b.orientation),
            .velocity = {b.velocity.x.data(), b.velocity.y.data(), b.velocity.z.data()}};
}

const Model& Simulation::model() const { return *history_->model; }
double Simulation::time() const { return history_->taken->state().time; }
std::int64_t Simulation::steps() const { return history_->taken->state().step; }
double Simulation::timeStep() const { return history_->taken->timeStep(); }
InitialState Simulation::startedFrom() const { return history_->taken->startedFrom(); }
HistoryRecord Simulation::record() const { return history_->taken->record(); }
std::uint64_t Simulation::stateHash() const { return talus::stateHash(history_->taken->state()); }
FullFrame Simulation::frame() const { return fullFrameOf(history_->taken->state()); }

}  // namespace talus
