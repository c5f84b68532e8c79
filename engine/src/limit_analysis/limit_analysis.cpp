#include "talus/limit_analysis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "build/wet_joints.h"
#include "checks/plausible.h"
#include "checks/strength_held.h"
#include "checks/water_levels.h"
#include "checks/water_warnings.h"
#include "forces/sum.h"
#include "law/joint_laws.h"
#include "limit_analysis/assemble.h"
#include "limit_analysis/at_wet_tilt.h"
#include "limit_analysis/ceiling.h"
#include "limit_analysis/solver.h"
#include "measure/natural_order.h"
#include "model/gravity.h"
#include "state/caller.h"
#include "state/threads.h"
#include "talus/angles.h"
#include "talus/searches.h"

namespace talus {
namespace {

using namespace limit;

constexpr double kClose = 1e-5;      // of tilts [rad] and horizontal loads: a bracket that is good enough
constexpr double kTiltWidth = 1e-8;  // [rad]; the wrench of water depends on the tilt, so the limit is found
                                     // by iteration
constexpr int kMostTilts = 60;
constexpr double kLargestTurn = 1.5;   // farthest that gravity is turned in one programme [rad]
constexpr double kLeastFactor = 1e-4;  // of safety: a lower one counts as none
constexpr double kLargestFactor = 102.4;
constexpr double kMostHorizontal = 100;  // weights

/// a + factor b.
Loads sum(Loads a, const Loads& b, double factor = 1) {
    for (std::size_t k = 0; k < a.size(); ++k) {
        a[k].force += factor * b[k].force;
        a[k].torque += factor * b[k].torque;
    }
    return a;
}

std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// A limit from one side, or why there is none.
struct Limit {
    SearchStatus status = SearchStatus::undecided;
    double value = 0;
};

class LimitSearch {
 public:
    LimitSearch(State& state, const Assembly& assembly, const Control& control, const LimitSettings& settings)
        : state_(state),
          assembly_(assembly),
          model_(state.geometry->model),
          control_(control),
          settings_(settings),
          solver_(assembly, state.laws, control) {}

    LimitResult run(Varied load) {
        if (load == Varied::tilt) findTilt();
        if (load == Varied::factor) findFactor();
        if (load == Varied::horizontal) findHorizontal();
        if (isStopped(control_)) result_.status = SearchStatus::interrupted;
        if (result_.status == SearchStatus::found || result_.status == SearchStatus::unstable_at_start)
            describeMechanism();
        describeEffort();
        return std::move(result_);
    }

 private:
    void report(const std::string& detail) const {
        constexpr double kExpected = 12;  // programmes
        const double made = solver_.effort().programmes;
        if (control_.progress) control_.progress({"limit analysis", made / (made + kExpected), detail});
    }

    Loads byMass(const Vec3& acceleration) const { return weightLoads(state_, assembly_, acceleration); }
    Loads loadsAt(double tilt) {
        const Loads applied = appliedLoads(state_, assembly_, tilt);
        return sum(byMass(bodyAcceleration(state_)), applied);
    }

    /// Whether the assembly is stable at the initial load; sets the result if not.
    bool stands(const Loads& loads, double start) {
        const Balance inside = solver_.check(loads, Side::inside);
        if (inside.balanced) return true;
        if (inside.outcome != Outcome::optimal) return false;
        const bool falls = assembly_.plane_section || !solver_.check(loads, Side::outside).balanced;
        result_.status = falls ? SearchStatus::unstable_at_start : SearchStatus::undecided;
        if (falls) result_.upper = start;
        return false;
    }

    // --- tilt
    // -----------------------------------------------------------------------------------------------------

    void findTilt() {
        const double start = model_.analysis.start.value_or(model_.gravity.tilt);
        if (!stands(loadsAt(start), start)) return;
        const Limit inside = tiltFrom(start, Side::inside);
        result_.status = inside.status;
        if (inside.status == SearchStatus::undecided) return;
        result_.lower = inside.value;
        if (inside.status == SearchStatus::stable_to_stop) return;
        const Limit outside = assembly_.plane_section ? inside : tiltFrom(inside.value, Side::outside);
        if (outside.status == SearchStatus::found) result_.upper = std::max(outside.value, result_.lower);
        if (outside.status != SearchStatus::found) result_.status = SearchStatus::undecided;
    }

    /// How much farther gravity can turn, with the water of this tilt; nothing where the solver failed.
    std::optional<double> wayOn(double tilt, double least, double most, Side side) {
        report("tilt " + formatted("%.4f deg", degrees(tilt)));
        const Loads present = loadsAt(tilt);
        const Vec3 now = bodyAcceleration(state_),
                   turning(now.z(), 0, -now.x());  // its derivative by the tilt
        const Growth found =
            solver_.grow(present, byMass(turning), std::tan(least), std::tan(most), side, kClose);
        if (found.outcome == Outcome::infeasible) return least;
        if (found.outcome != Outcome::optimal) return std::nullopt;
        return std::atan(found.multiplier);
    }

    /// Where all loads turn with gravity and no joint has strength without normal force, only their direction
    /// matters, and the first programme finds the limit.
    bool onlyDirectionMatters() const {
        const bool bonds =
            std::any_of(assembly_.points.begin(), assembly_.points.end(), [&](const auto& point) {
                return contact::holdsUnloaded(state_.laws[static_cast<std::size_t>(point.joint)]);
            });
        return !bonds && !hasBlockForces(state_) && bodyAcceleration(state_).y() == 0;
    }

    Limit tiltFrom(double start, Side side) {
        const bool at_once = onlyDirectionMatters();
        const double stop = model_.analysis.stop;
        double stands = start, falls = kInfinity, tilt = start;
        std::optional<std::pair<double, double>> last{};  // the previous tilt and the remaining turn from
                                                          // there
        for (int k = 0; k < kMostTilts; ++k) {
            const double most = std::clamp(stop - tilt, 0.0, kLargestTurn);
            const std::optional<double> way = wayOn(tilt, k == 0 ? 0 : -kLargestTurn, most, side);
            if (!way) {
                if (isStopped(control_)) keepSoFar(side, stands, falls);
                return {};
            }
            const bool clipped = *way >= most * (1 - 1e-12);
            if (clipped && tilt + most >= stop * (1 - 1e-12) && (at_once || most < kTiltWidth))
                return {SearchStatus::stable_to_stop, stop};
            if (at_once && !clipped) return {SearchStatus::found, tilt + *way};
            (*way >= 0 ? stands : falls) = tilt;
            // From either side: a tilt just beyond the limit is as near to it as one just below.
            if (std::abs(*way) < kTiltWidth) return {SearchStatus::found, std::max(stands, tilt + *way)};
            if (falls - stands < kTiltWidth) return {SearchStatus::found, stands};
            const double next = nextTilt(tilt, *way, last);
            last = {tilt, *way};
            tilt =
                next > stands && next < falls ? std::min(next, stop) : 0.5 * (stands + std::min(falls, stop));
        }
        return {};
    }

    /// For an interrupted search: a load balanced by forces inside the cones is below the limit, and one that
    /// fails outside of them is above it. In a plane section both are the cone.
    void keepSoFar(Side side, double stands, double falls) {
        if (side == Side::inside) result_.lower = std::max(result_.lower, stands);
        if (side == Side::outside || assembly_.plane_section) result_.upper = std::min(result_.upper, falls);
    }

    /// The tilt at which the remaining turn vanishes, by the secant through two tilts.
    static double nextTilt(double tilt, double way, const std::optional<std::pair<double, double>>& last) {
        if (!last || last->second == way) return tilt + way;
        return tilt - way * (tilt - last->first) / (way - last->second);
    }

    // --- horizontal load
    // ------------------------------------------------------------------------------------------

    void findHorizontal() {
        const double tilt = model_.gravity.tilt;
        state_.load.horizontal = 0;
        const Loads fixed = loadsAt(tilt);
        const Loads growing = byMass(model_.gravity.magnitude * pushOf(model_.seismic, model_.gravity, tilt));
        if (!stands(fixed, 0)) return;
        report("horizontal load");
        const Growth inside = solver_.grow(fixed, growing, 0, kMostHorizontal, Side::inside);
        if (isStopped(control_)) result_.lower = 0;
        if (inside.outcome != Outcome::optimal) return;
        result_.lower = inside.multiplier;
        result_.status = SearchStatus::stable_to_stop;
        if (inside.multiplier >= kMostHorizontal) return;
        result_.status = SearchStatus::found;
        result_.upper = inside.multiplier;
        if (assembly_.plane_section) return;
        const Growth outside = solver_.grow(sum(fixed, growing, inside.multiplier), growing, 0,
                                            kMostHorizontal, Side::outside, kClose);
        if (outside.outcome == Outcome::optimal)
            result_.upper = inside.multiplier + std::max(outside.multiplier, 0.0);
        else
            result_.status = SearchStatus::undecided;
    }

    // --- factor of safety
    // -----------------------------------------------------------------------------------------

    Balance checkFactor(const Loads& loads, double factor, Side side) {
        report("factor " + formatted("%.5f", factor));
        solver_.setLaws(jointLaws(model_.joints, factor));
        return solver_.check(loads, side);
    }

    void findFactor() {
        const Loads loads = loadsAt(model_.gravity.tilt);
        FactorBracket bracket;
        double factor = 1;
        while (bracket.falls > bracket.stands * (1 + settings_.factor_width)) {
            const Balance found = checkFactor(loads, factor, Side::inside);
            if (found.outcome != Outcome::optimal) {
                const double stands = bracket.stands > 0 ? bracket.stands : -kInfinity;
                if (isStopped(control_)) keepSoFar(Side::inside, stands, bracket.falls);
                return;
            }
            bracket.take(factor, found.balanced);
            if (bracket.stands >= kLargestFactor || bracket.falls <= kLeastFactor) break;
            factor = nextFactor(found, factor, bracket);
        }
        concludeFactor(loads, bracket.stands, bracket.falls);
    }

    /// Largest stable and smallest failing factor so far.
    struct FactorBracket {
        double stands = 0, falls = kInfinity;
        int stood = 0;  ///< times in a row

        void take(double factor, bool balanced) {
            (balanced ? stands : falls) = factor;
            stood = balanced ? stood + 1 : 0;
        }
    };

    /// From a failing factor to one without imbalance, by Newton's method in the factor's logarithm, and
    /// slightly below; from there up by the bracket's width. Where that does not close it, by halves.
    double nextFactor(const Balance& found, double factor, const FactorBracket& bracket) const {
        const double width = settings_.factor_width;
        if (bracket.falls == kInfinity) return std::min(2 * factor, kLargestFactor);
        const double least = std::max(bracket.stands, kLeastFactor);
        const double half = std::sqrt(least * bracket.falls);
        if (found.balanced) return bracket.stood > 1 ? half : std::min(half, factor * (1 + 0.9 * width));
        const double newton =
            found.growth > 0 ? factor * std::exp(-found.imbalance / found.growth) * (1 - 0.4 * width) : 0;
        if (newton > bracket.stands) return std::max(newton, kLeastFactor);
        return bracket.stands > 0 ? half : kLeastFactor;
    }

    void concludeFactor(const Loads& loads, double stands, double falls) {
        result_.upper = falls;
        if (stands > 0) result_.lower = stands;
        result_.status = stands >= kLargestFactor ? SearchStatus::stable_to_stop
                         : stands > 0             ? SearchStatus::found
                                                  : SearchStatus::unstable_at_start;
        if (assembly_.plane_section || result_.status != SearchStatus::found) return;
        double step = settings_.factor_width;
        Balance outside = checkFactor(loads, falls, Side::outside);
        for (; outside.balanced && result_.upper < kLargestFactor; step *= 2) {
            result_.upper *= 1 + step;
            outside = checkFactor(loads, result_.upper, Side::outside);
        }
        if (outside.outcome == Outcome::optimal) return;
        result_.status = SearchStatus::undecided;
        if (isStopped(control_)) result_.upper = kInfinity;  // not yet shown to fail outside the cones
    }

    // --- the mechanism
    // --------------------------------------------------------------------------------------------

    BlockVelocity velocityOf(std::size_t b) const {
        const auto body = static_cast<std::size_t>(assembly_.body_of_block[b]);
        const BodyMotion& motion = solver_.mechanism()[body];
        const Vec3 arm = state_.blocks.position.get(b) - assembly_.bodies[body].centroid;
        BlockVelocity velocity{.block = model_.blocks[b].name,
                               .velocity = motion.velocity + motion.spin.cross(arm),
                               .spin = motion.spin};
        velocity.speed = velocity.velocity.norm() + velocity.spin.norm() * state_.geometry->radius[b];
        return velocity;
    }

    void describeMechanism() {
        if (solver_.mechanism().empty()) return;
        double fastest = 0;
        for (std::size_t b = 0; b < model_.blocks.size(); ++b) {
            if (assembly_.body_of_block[b] < 0) continue;
            result_.mechanism.push_back(velocityOf(b));
            fastest = std::max(fastest, result_.mechanism.back().speed);
        }
        for (BlockVelocity& velocity : result_.mechanism) {
            velocity.velocity /= fastest;
            velocity.spin /= fastest;
            velocity.speed /= fastest;
            velocity.moving = velocity.speed >= kMechanismShare;
            if (velocity.moving) result_.moving_blocks.push_back(velocity.block);
        }
        sortNaturally(result_.moving_blocks);
    }

    void describeEffort() {
        result_.plane_section = assembly_.plane_section;
        result_.blocks = static_cast<std::size_t>(std::count_if(assembly_.body_of_block.begin(),
                                                                assembly_.body_of_block.end(),
                                                                [](std::int32_t body) { return body >= 0; }));
        result_.contact_points = assembly_.points.size();
        result_.rows = solver_.effort().rows;
        result_.columns = solver_.effort().columns;
        result_.programmes = solver_.effort().programmes;
        result_.iterations = solver_.effort().iterations;
    }

    State& state_;
    const Assembly& assembly_;
    const Model& model_;
    const Control& control_;
    const LimitSettings& settings_;
    Solver solver_;
    LimitResult result_;
};

/// Limit analysis takes straight envelopes: the first joint between bodies whose strength is another law's.
const Joint* curvedJoint(const State& state, const Assembly& assembly) {
    for (const ContactPoint& point : assembly.points) {
        const auto joint = static_cast<std::size_t>(point.joint);
        if (state.laws[joint].curved) return &state.geometry->model.joints[joint];
    }
    return nullptr;
}

std::string curvedText(const Joint& joint) {
    return "joint \"" + joint.name + "\" has law \"" + std::string(toString(joint.law)) +
           "\"; limit analysis needs straight envelopes (\"coulomb\")";
}

/// Why limit analysis does not cover the model; "" where it does.
std::string whyNot(const State& state, const Assembly& assembly) {
    if (const Joint* curved = curvedJoint(state, assembly)) return curvedText(*curved);
    const auto limits = tieLimits(state);
    return limits.ok() ? "" : limits.errors().front().message;
}

Error tooLarge(std::size_t points, std::size_t most) {
    return {"", "limit analysis: the model has " + std::to_string(points) +
                    " contact points; allowed: at most " + std::to_string(most)};
}

LimitResult analyse(State& state, const Assembly& assembly, Varied load, const Control& control,
                    const LimitSettings& settings) {
    if (!assembly.bodies.empty()) return LimitSearch(state, assembly, control, settings).run(load);
    LimitResult nothing_moves;
    nothing_moves.status = SearchStatus::stable_to_stop;
    return nothing_moves;
}

/// Builds the model and calls with its state and assembly. \param interrupted  the result where that is
/// stopped
template <class T, class Body>
Result<T> withAssembly(const Model& model, const Control& control, const LimitSettings& settings,
                       const T& interrupted, const Body& body) {
    return inArena(control.threads, [&]() -> Result<T> {
        Result<State> built = buildWithWetJoints(model, control.threads != 1, control);
        if (isStopped(control)) return interrupted;
        if (!built) return built.errors();
        built->load.gravity_share = built->load.water_share = 1;
        return body(*built, assemble(*built, settings.left_out));
    });
}

std::string tooManyPoints(std::size_t points, std::size_t most, bool section) {
    return "the model has " + std::to_string(points) + " contact points" +
           (section ? " in its section" : "") + "; by default limit analysis is computed up to " +
           std::to_string(most);
}

bool wetsByTilt(const Model& model, Varied load) { return load == Varied::tilt && hasWetJoints(model); }

constexpr const char* kInterrupted = "limit analysis was interrupted";

Ceiling upperEnd(const LimitResult& result) {
    if (std::isfinite(result.upper)) return {result.upper, ""};
    if (result.status == SearchStatus::stable_to_stop)
        return {std::nullopt, "limit analysis finds the assembly stable up to the largest load tried"};
    return {std::nullopt,
            result.status == SearchStatus::interrupted ? kInterrupted : "limit analysis is undecided"};
}

Result<LimitResult> analyseModel(const Model& model, Varied load, const Control& control,
                                 const LimitSettings& settings) {
    LimitResult interrupted;
    interrupted.status = SearchStatus::interrupted;
    return withAssembly<LimitResult>(
        model, control, settings, interrupted,
        [&](State& state, const Assembly& assembly) -> Result<LimitResult> {
            std::vector<Error> errors = checks::implausible(state);
            for (Error& error : checks::strongLoads(state)) errors.push_back(std::move(error));
            if (auto falls = checks::nothingHolds(model)) errors.push_back(std::move(*falls));
            if (!errors.empty()) return errors;
            if (assembly.points.size() > settings.max_contact_points)
                return tooLarge(assembly.points.size(), settings.max_contact_points);
            if (const std::string why = whyNot(state, assembly); !why.empty()) return Error{"", why};
            LimitResult result = analyse(state, assembly, load, control, settings);
            result.warnings = checks::strengthsHeld(model);
            for (const Error& doubt : checks::levelsAboveJoints(state))
                result.warnings.push_back(doubt.field + ": " + doubt.message);
            if (auto stated = checks::flowAsStated(model, checks::kNothingOpens))
                result.warnings.push_back(std::move(*stated));
            return result;
        });
}

Result<LimitResult> overWetTilt(const Model& model, const Control& control, const LimitSettings& settings) {
    const auto analyse = [&](const Model& wet) { return analyseModel(wet, Varied::tilt, control, settings); };
    std::string doubt;
    Result<LimitResult> result = atWetTilt<LimitResult>(model, control, analyse, doubt);
    if (result && !doubt.empty()) result->warnings.push_back(std::move(doubt));
    return result;
}

}  // namespace

Result<LimitResult> limitAnalysis(const Model& model, Varied load, const Control& control,
                                  const LimitSettings& settings) {
    const auto begin = std::chrono::steady_clock::now();
    Result<LimitResult> result = wetsByTilt(model, load) ? overWetTilt(model, control, settings)
                                                         : analyseModel(model, load, control, settings);
    if (result)
        result->wall_seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

namespace limit {

Ceiling ceilingOf(State& state, Varied load, bool always, const Control& control,
                  const LimitSettings& settings) {
    // A search's state may lack them: it applies them step by step.
    state.load.gravity_share = state.load.water_share = 1;
    state.load.horizontal = state.geometry->model.seismic.horizontal;
    const Assembly assembly = assemble(state, settings.left_out);
    if (const std::string why = whyNot(state, assembly); !why.empty()) return {std::nullopt, why};
    const std::size_t most = assembly.plane_section ? kCeilingPointsInSection : kCeilingPoints;
    if (!always && assembly.points.size() > most)
        return {std::nullopt, tooManyPoints(assembly.points.size(), most, assembly.plane_section)};
    return upperEnd(analyse(state, assembly, load, control, settings));
}

}  // namespace limit

Result<Ceiling> limitCeiling(const Model& model, Varied load, bool always, const Control& control,
                             const LimitSettings& settings) {
    if (wetsByTilt(model, load)) {
        std::string doubt;
        const auto analyse = [&](const Model& wet) {
            return limitCeiling(wet, load, always, control, settings);
        };
        return limit::atWetTilt<Ceiling>(model, control, analyse, doubt);
    }
    return inArena(control.threads, [&]() -> Result<Ceiling> {
        Result<State> built = buildWithWetJoints(model, control.threads != 1, control);
        if (isStopped(control)) return Ceiling{std::nullopt, kInterrupted};
        if (!built) return built.errors();
        return limit::ceilingOf(*built, load, always, control, settings);
    });
}

bool isAbove(double stands, const Ceiling& ceiling, Varied load) {
    if (!ceiling.value) return false;
    const VariedQuantity& quantity = quantityOf(load);
    const double tolerance = quantity.give_is_share ? quantity.give * *ceiling.value : quantity.give;
    return stands > *ceiling.value + tolerance;
}

}  // namespace talus
