#include "analysis/probing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/loose_blocks.h"
#include "equilibrium/find_equilibrium.h"
#include "forces/contact_forces.h"
#include "forces/sum.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "state/incidence.h"

namespace talus::analysis {
namespace {

// Steps of a probe before the implicit solve is asked; most slides need 1,000 to 3,400. Of many free blocks more, so many for each:
// a mass of many is slower to come to rest (a slope of 1,406 that stands to 0.907 was called failing at 0.880 after 3,000).
constexpr std::int64_t kFirstSteps = 3'500;
constexpr double kFirstStepsPerBlock = 7.5;
// More free blocks than that begin with fewer explicit steps, at least so many, and so many factorisations from where these end.
constexpr std::int64_t kManyBlocks = 1'000, kStepsOfWeight = 3'000, kFactorsOfWeight = 4'000;
// Factorisations that one may take: about as long as the steps so far, at least a number that decides most.
constexpr std::int64_t kLeastFactors = 30, kStepsPerFactor = 2000;
// Rest is near when it is no farther than this times the way the assembly has come, from rest to rest (engine/README.md says
// what smaller and larger ones do).
constexpr double kNear = 1.5;
// ... but in a load step of few cells no more than so many times what the step is worth: what is elastic goes with the load. (A thousand:
// one arch, about to buckle on its joints, ends a cell earlier; 10,000: blocks are followed down a slide.)
constexpr double kShortStep = 4, kMostAmplified = 2'000;
// Nor may neighbours part in a load step by more, in block sizes, than so many times what the step is worth: what goes a hundredth of a
// block for each hundredth of its strength is failing, though it comes to rest after every step. (Of many blocks some crumb always moves on.)
constexpr double kMostYield = 1.0;
// ... of which what is too little to be seen is none. In steps as short as that they part from where it stood so many times that before.
constexpr double kYieldsFrom = 2.0;
// Rests in one short step after the other that go on and on are a slide, however little each goes: so many times what else is near in all.
constexpr double kMostCrept = 5;
constexpr double kSettlingDrag = 0.125;

std::int64_t freeBlocks(const State& state) {
    return std::count(state.blocks.motion.begin(), state.blocks.motion.end(), Motion::free);
}

/// Between which loads the answer lies by the probes so far: a later rest above a failure takes that failure back.
std::string bracketText(const Probing& p) {
    double stood = -std::numeric_limits<double>::infinity(), failed = std::numeric_limits<double>::infinity();
    for (const Probe& probe : p.probes) {
        if (probe.verdict == Verdict::stable) stood = std::max(stood, probe.load);
        if (probe.verdict == Verdict::failing) failed = std::min(failed, probe.load);
        if (failed <= stood) failed = std::numeric_limits<double>::infinity();
    }
    return (std::isfinite(stood) ? ", stood at " + p.axis.say(stood) : "") +
           (std::isfinite(failed) ? ", failed at " + p.axis.say(failed) : "");
}

/// Of the farthest-moved point of any block, since the assembly last stood: a probe may have had several parts [m].
double wayFromRest(const Probing& p, const State& state) {
    return largestMotion(state, p.last_stable.blocks.position, p.last_stable.blocks.orientation);
}

/// Whether a load step from where the assembly last stood is one of a few cells. Where not the load has changed but blocks were taken
/// out it is none; nor of many blocks, for some crumb of those always moves on.
bool isOfFewCells(const Probing& p, double load) {
    const double cells = std::abs(load - p.stable_load) / p.axis.cell;
    return !p.areMany() && cells > 0 && cells < kShortStep;
}

/// What a load step is worth of the weight: tilts and accelerations are shares of it, strength resists at most as much.
double worthOfStep(const Probing& p, double from, double load) {
    const double step = std::abs(load - from);
    return p.axis.strongest_at_start ? step / load : step;
}

/// At rest at a load: where the next steps' parting counts from. Where the load stays, weight came on or blocks went.
void countPartingFrom(Probing& p, double load, const Blocks& blocks) {
    const bool is_far = !p.stood_before || load == p.stable_load ||
                        kMostYield * worthOfStep(p, p.stood_before->load, load) >= kYieldsFrom * kSeenShare;
    if (is_far) p.stood_before = {load, blocks};
}

Verdict keep(Probing& p, const std::string& stage, double load, Probe probe, State& state) {
    probe.load = load;
    p.steps += probe.steps;
    p.factors += probe.factors;
    p.time += probe.time;
    p.probes.push_back(probe);
    report(p, stage, load, toString(probe.verdict));
    if (probe.verdict == Verdict::stable) {
        ++p.states_at_rest;
        const double way = wayFromRest(p, state);
        const double taken_up = std::max(0.0, tieReach(p.last_stable) - tieReach(state));  // by bolts
        p.deflection += way;
        p.crept = p.has_stood && isOfFewCells(p, load) ? p.crept + std::max(0.0, way - taken_up) : 0;
        countPartingFrom(p, load, state.blocks);
        p.stable_load = load;
    }
    p.leaving.clear();
    if (probe.verdict == Verdict::failing && p.has_stood) p.leaving = movingBlocks(p.last_stable, state);
    (probe.verdict == Verdict::stable ? p.last_stable : p.last_moving) = std::move(state);
    return probe.verdict;
}

/// How far a rest may be from where the assembly last stood [m]. Bolts hold only as far as blocks have moved, so that way is none of
/// a failure.
double nearLimit(const Probing& p, double load) {
    const double seen = kSeenShare * p.last_stable.geometry->length_scale, reach = tieReach(p.last_stable);
    if (!isOfFewCells(p, load)) return std::max(seen, kNear * ownDeflection(p)) + reach;
    const double own = std::min(ownDeflection(p), std::max(0.0, p.deflection - p.crept));
    const double share = std::min(1.0, kMostAmplified * worthOfStep(p, p.stable_load, load));
    const double left = std::max(0.0, kMostCrept * std::max(seen, own) - p.crept);
    return std::min(left, std::max(seen, kNear * share * own)) + reach;
}

/// How far neighbours have parted since the assembly stood, most of any [m].
double partedFrom(const Blocks& stood, const State& state) {
    const Interfaces& f = state.interfaces;
    double most = 0;
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (isIdle(f, i)) continue;
        const RelativePose before = relativePose(stood, f, i), now = relativePose(state, i);
        most = std::max(most, std::hypot(now.slide_1.x() - before.slide_1.x(),
                                         now.slide_2.x() - before.slide_2.x(), now.gap.x() - before.gap.x()));
    }
    return most;
}

/// Whether blocks have gone so far to a rest that they yield to the load steps.
bool yields(const Probing& p, double load, const State& state) {
    if (!p.has_stood || p.areMany() || load == p.stable_load) return false;
    const double worth = worthOfStep(p, p.stood_before->load, load);
    const double most = std::max(kSeenShare, kMostYield * worth) * state.geometry->length_scale;
    return partedFrom(p.stood_before->blocks, state) > most + tieReach(p.last_stable);
}

/// Whether the implicit solve leaves a few blocks behind in its steps: that changes what slides on the way, and of fewer blocks that
/// have slid the answer.
bool leavesFew(const Probing& p) { return p.areMany() || !p.has_stood; }

/// Whether a rest is where the assembly stands, but for what it gives; else it is a failure. Blocks that lean on each other have
/// others, farther off, in which they are jammed: to get there is to fail first.
bool standsThere(Probing& p, double load, const State& state, Probe& rest) {
    const double way = wayFromRest(p, state);
    State moved = state;
    const bool is_near = !p.has_stood || (way <= nearLimit(p, load) && !yields(p, load, state));
    if (is_near) {
        p.work.leaves_few = leavesFew(p);
        const Probe found =
            findRestOfFirstOrder(p.last_stable, moved, p.work, p.has_stood ? kMostFactors : kPatientFactors);
        rest.factors += found.factors;
        rest.time += found.time;
        if (isStopped(p.control)) {
            rest.verdict = Verdict::undecided;
            rest.reason = "interrupted";
            return false;
        }
        const bool has_left =
            p.has_stood && (wayFromRest(p, moved) > nearLimit(p, load) || yields(p, load, moved));
        if (found.verdict == Verdict::stable || (found.verdict == Verdict::undecided && !has_left))
            return true;
    }
    rest.verdict = Verdict::failing;
    rest.reason =
        "moves " + formatted("%.2g", way) + " m to where it stands " + (is_near ? "jammed" : "again");
    p.stands_elsewhere = true;
    p.elsewhere = std::move(moved);
    return false;
}

/// Where the assembly last stood, with a probe's load brought on.
State loadedAnew(const Probing& p, const Ramp& load) {
    State state = p.last_stable;
    load(state, 1.0);
    return state;
}

/// \param watched  of the motion: empty, it begins from the last stable state; else it goes on from the last moving one with what was left open
/// \param most_steps  of those that a probe may have
Verdict probeExplicitly(Probing& p, const std::string& stage, double load, const Ramp& ramp,
                        std::optional<Watched>& watched, std::int64_t most_steps) {
    report(p, stage, load, "moving");
    State state = watched ? p.last_moving : p.last_stable;
    const std::int64_t all_steps = p.work.settings.max_steps_per_probe;
    p.work.settings.max_steps_per_probe = std::min(most_steps, all_steps);
    Probe probe = watched ? goOn(state, p.work, *watched) : bringOn(state, p.work, ramp, &watched);
    p.work.settings.max_steps_per_probe = all_steps;
    if (probe.verdict == Verdict::stable && !standsThere(p, load, state, probe)) state = loadedAnew(p, ramp);
    return keep(p, stage, load, probe, state);
}

std::int64_t firstSteps(const State& state) {
    const double of_many = kFirstStepsPerBlock * static_cast<double>(freeBlocks(state));
    return std::max(kFirstSteps, static_cast<std::int64_t>(of_many));
}

/// The whole change of load at once, from the last stable state or another. \param asked_factors  most factorisations; 0: what is due
Verdict probeImplicitly(Probing& p, const std::string& stage, double load, const Ramp& ramp,
                        std::int64_t asked_factors = 0, const State* from = nullptr) {
    const bool doubtful = p.implicit_first || !p.has_stood;
    const std::int64_t own_factors =
        doubtful ? p.most_factors : std::clamp(p.steps / kStepsPerFactor, kLeastFactors, kMostFactors);
    const std::int64_t most_factors = asked_factors > 0 ? asked_factors : own_factors;
    State state = from != nullptr ? *from : p.last_stable;
    if (from != nullptr) takeBack(state, p.work);
    ramp(state, 1.0);
    report(p, stage, load, "solving");
    p.work.leaves_few = leavesFew(p);
    Probe found = findRest(state, p.work, most_factors);
    const bool is_elsewhere = found.verdict == Verdict::stable && !standsThere(p, load, state, found) &&
                              found.verdict == Verdict::failing;
    std::vector<std::size_t> leaving;  // of explicit steps that did not see it
    if (from != nullptr && found.verdict == Verdict::failing) leaving = movingBlocks(*from, state);
    if (is_elsewhere) state = loadedAnew(p, ramp);
    if (found.verdict != Verdict::stable)
        p.no_near_rest = {load, most_factors, p.states_at_rest, found.verdict, is_elsewhere};
    const Verdict verdict = keep(p, stage, load, found, state);
    if (!leaving.empty()) p.leaving = std::move(leaving);
    return verdict;
}

}  // namespace

void report(const Probing& p, const std::string& stage, double load, const std::string& what) {
    if (!p.control.progress) return;
    // Longer than most, and never down to nothing: what comes after the last probe takes as long as some of them.
    constexpr double kAfterwards = 4.0;
    const double probes = static_cast<double>(p.probes.size());
    const double expected = std::max(6.0 + std::log2(static_cast<double>(p.axis.stop)) / 2, probes + 1);
    p.control.progress(
        {stage, probes / (expected + kAfterwards), p.axis.say(load) + ", " + what + bracketText(p)});
}

Probing beginProbing(const State& state, const LoadAxis& axis, const Control& control,
                     const QuasiStatic& settings, bool parallel) {
    Probing p{.axis = axis, .control = control, .last_stable = state, .last_moving = {}, .work = {}};
    p.stable_load = axis.start;
    p.last_stable.searches_around = freeBlocks(state) > kManyBlocks;
    p.least_mass = state.geometry->model.analysis.least_mass_share * freeMass(state);
    p.work = prepare(p.last_stable, settings, control, axis.imbalance_tolerance, parallel);
    p.reach = tieReach(state);
    p.implicit_first = p.reach > 0;
    return p;
}

bool Probing::hasCrumbs() const {
    return freeBlocks(last_stable) >= static_cast<std::int64_t>(equilibrium::kBlocksWithCrumbs);
}

bool interrupted(const Probing& p) {
    return isStopped(p.control) ||
           (p.control.most_work > 0 && workOf(p.steps, p.factors) > p.control.most_work);
}

Verdict probe(Probing& p, const std::string& stage, double load, const Ramp& ramp) {
    p.stands_elsewhere = false;
    if (p.implicit_first) {
        const Verdict found = probeImplicitly(p, stage, load, ramp);
        if (found != Verdict::undecided || p.cuts_back || !smallLeaving(p).empty()) return found;
    }
    // Of many blocks some are loose: explicit steps see them fall. Else they bring the weight to where the solve is quick.
    const bool begins = !p.has_stood && freeBlocks(p.last_stable) > kManyBlocks;
    const std::int64_t first_steps = firstSteps(p.last_stable);
    std::optional<Watched> watched;
    const Verdict verdict = probeExplicitly(p, stage, load, ramp, watched,
                                            begins ? std::max(kStepsOfWeight, first_steps / 4) : first_steps);
    const bool doubtful = verdict == Verdict::failing && !p.has_stood;
    if (verdict == Verdict::stable || (verdict == Verdict::failing && (!doubtful || begins)) ||
        interrupted(p))
        return verdict;
    if (!p.implicit_first) {
        const State moving = p.last_moving;
        const Verdict found =
            probeImplicitly(p, stage, load, ramp, begins ? kFactorsOfWeight : 0, begins ? &moving : nullptr);
        if (found != Verdict::undecided) p.implicit_first = true;
        if (found != Verdict::stable) p.last_moving = moving;  // nearer to rest, where a failure is let go
        if (found != Verdict::undecided) return found;
    }
    if (verdict == Verdict::failing || !smallLeaving(p).empty()) return verdict;
    return probeExplicitly(p, stage, load, ramp, watched, p.work.settings.max_steps_per_probe);
}

Verdict restAt(Probing& p, double load, std::int64_t most_factors) {
    const Probing::NoNearRest& known = p.no_near_rest;
    const std::int64_t asked = known.verdict == Verdict::failing ? kMostFactors : most_factors;
    if (known.load == load && known.most_factors >= asked && known.states_at_rest == p.states_at_rest) {
        p.stands_elsewhere = known.is_elsewhere;
        return known.verdict;
    }
    State moving = p.last_moving;
    const Verdict found = probeImplicitly(
        p, "equilibrium", load, [&](State& state, double) { p.axis.apply(state, load); }, most_factors);
    if (found == Verdict::stable)
        p.implicit_first = true;
    else
        p.last_moving = std::move(moving);  // nearer to rest, where a failure is let go
    return found;
}

bool settles(Probing& p, const State& moving, double load, double watch_periods) {
    QuasiStaticWork work = patient(p.work, kSettlingDrag, watch_periods);
    State state = moving;
    report(p, "settling", load, "moving");
    Probe probe = bringOn(state, work, [](State&, double) {});
    if (probe.verdict == Verdict::stable && !standsThere(p, load, state, probe)) state = moving;
    return keep(p, "settling", load, probe, state) == Verdict::stable;
}

SeenFailing seenFailing(const Probing& p) { return {p.last_moving, p.leaving}; }

void seeAgain(Probing& p, SeenFailing seen) {
    p.last_moving = std::move(seen.moving);
    p.leaving = std::move(seen.leaving);
    p.stands_elsewhere = false;
}

std::vector<std::size_t> smallLeaving(const Probing& p) {
    if (!p.lets_small_go) return {};
    const State& stood = p.last_stable;
    const State& state = p.stands_elsewhere ? p.elsewhere : p.last_moving;
    // A solve ends as soon as something is seen to leave: of what is not at rest then the most would come to rest.
    std::vector<std::size_t> leaving = p.probes.back().verdict == Verdict::failing
                                           ? leavingBlocks(stood, state, p.least_mass)
                                           : restlessBlocks(state);
    const double mass = massOf(stood, leaving);
    const bool are_small = mass < p.least_mass && freeMass(stood) - mass >= p.least_mass;
    if (!are_small || areTied(stood, leaving)) leaving.clear();
    return leaving;
}

double ownDeflection(const Probing& p) {
    return p.reach > 0 ? std::min(p.settlement, p.deflection) : p.deflection;
}

}  // namespace talus::analysis
