#include "analysis/load_search.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "analysis/bracket.h"
#include "analysis/evidence.h"
#include "analysis/failure_mode.h"
#include "analysis/load_pace.h"
#include "analysis/load_start.h"
#include "analysis/loose_blocks.h"
#include "analysis/probing.h"
#include "analysis/search_warnings.h"
#include "analysis/stopwatch.h"
#include "contacts/update.h"
#include "forces/sum.h"
#include "frame/frame.h"
#include "measure/measure.h"
#include "state/caller.h"
#include "state/incidence.h"

namespace talus::analysis {
namespace {

constexpr int kMostReopenings = 12;  // times a failing motion may come to rest before the search gives up

class Search {
 public:
    Search(const State& state, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
           bool parallel)
        : axis_(axis),
          control_(control),
          parallel_(parallel),
          bracket_(axis.stop),
          probing_(beginProbing(state, axis, control, settings, parallel)) {}

    SearchResult run() {
        for (bool goes_on = start(); goes_on; goes_on = letSmallGo()) {
            for (int k = 0; k <= kMostReopenings && searchUpwards(); ++k) {
            }
        }
        finish();
        return std::move(result_);
    }

    /// Gravity and water; what fails goes on until it is seen to. True when the assembly stands.
    bool start() {
        const Verdict verdict = loadGravityAndWater(probing_, [&] { return isSeenToFail(); });
        if (verdict == Verdict::stable) return true;
        if (verdict != Verdict::failing) return false;
        result_.status = SearchStatus::unstable_at_start;
        if (result_.confirmed || interrupted(probing_)) return false;
        continueToFailure(evidence());
        if (result_.confirmed || interrupted(probing_)) return false;
        if (!restsAfterAll(probing_)) {
            countElsewhere();
            restless_ = restlessSplinters(probing_.last_moving);
            return false;
        }
        result_.status = SearchStatus::undecided;
        probing_.has_stood = true;
        return true;
    }

    Effort effort() const {
        TimeSpent time = probing_.time;
        time += continuations_.time;
        return {probing_.steps + continuations_.steps, probing_.factors, time};
    }

    /// Blocks that were seen to fall in the continuation.
    const std::vector<std::size_t>& falling() const { return falling_; }
    const std::vector<std::size_t>& restless() const { return restless_; }

 private:
    /// What is known of the failing load stays until a lower one fails. \param cuts_back  what the implicit solve leaves open is left so:
    /// the next load step is shorter
    Verdict probeAt(std::int64_t cell, bool cuts_back = false) {
        const double from = axis_.load(bracket_.low()), to = axis_.load(cell);
        const auto ramp = [&](State& state, double share) { axis_.apply(state, from + share * (to - from)); };
        std::optional<SeenFailing> known;
        if (bracket_.high()) known = seenFailing(probing_);
        probing_.cuts_back = cuts_back;
        Verdict verdict = probe(probing_, "probe " + std::to_string(probing_.probes.size() + 1), to, ramp);
        probing_.cuts_back = false;
        if (verdict != Verdict::stable) {
            std::vector<std::size_t> leaving = smallLeaving(probing_);
            if (!leaving.empty()) verdict = Verdict::failing;
            if (verdict == Verdict::failing) leaving_ = std::move(leaving);
        }
        if (verdict == Verdict::stable && probing_.areMany() && probing_.implicit_first)
            pace_.learn(cell - bracket_.low(), probing_.work.leaving);
        if (verdict == Verdict::stable) bracket_.stands(cell);
        if (verdict == Verdict::failing) bracket_.fails(cell, probing_.probes.back().out_of_balance);
        if (verdict == Verdict::failing) failed_by_its_way_ = probing_.stands_elsewhere;
        if (verdict != Verdict::failing && known) seeAgain(probing_, std::move(*known));
        return verdict;
    }

    /// The implicit solve takes a load step as one: from far below it may come to rest beyond a failure.
    std::int64_t within(std::int64_t cell) const {
        if (!probing_.implicit_first || !axis_.farthest) return cell;
        return std::min(cell, bracket_.low() + pace_.next(axis_.farthest(bracket_.low()) - bracket_.low()));
    }

    /// Of many blocks explicit steps take three times as long as the implicit solve that knew nothing: a long load step is tried
    /// again half as long before they are asked.
    bool mayCutBack(std::int64_t cell) const {
        return probing_.areMany() && probing_.implicit_first && axis_.farthest &&
               !isShort(cell - bracket_.low());
    }

    /// One load step, or where that may be cut back and is left open none: the next one is half as long then. \return undecided:
    /// explicit steps did not know, either
    std::optional<Verdict> stepTo(std::int64_t cell) {
        if (!mayCutBack(cell)) return probeAt(cell);
        const Verdict verdict = probeAt(cell, true);
        if (verdict != Verdict::undecided) return verdict;
        pace_.cutBack(cell - bracket_.low());
        return {};
    }

    /// Finds a failing cell and lets it go on. True when the motion came to rest there: the assembly has moved to where
    /// it stands again (columns that lean on each other do), and the search is to go on from that state.
    bool searchUpwards() {
        probing_.lets_small_go = probing_.hasCrumbs() && probing_.least_mass > 0;
        for (;;) {
            result_.status = SearchStatus::undecided;
            findFailure();
            narrow();
            if (!mayLetLeavingGo()) break;
            probing_.lets_small_go = letLeavingGo();
        }
        probing_.lets_small_go = false;
        leaving_.clear();
        if (result_.status != SearchStatus::found || interrupted(probing_)) return false;
        if (hasFailed(axis_.load(*bracket_.high()))) return false;
        result_.confirmed = false;
        result_.status = SearchStatus::undecided;
        bracket_.reopen();
        return true;
    }

    /// A failure of less mass than counts is taken out where the assembly last stood, with all that does not stand there without
    /// it. True when the rest stands: the search is to go on from that. The answer is what has enough mass, all together, and
    /// what would leave less than that; where the rest is neither seen to stand nor to fail there is none.
    bool letSmallGo() {
        if (!claimsSmallFailure()) return false;
        const double load = axis_.load(bracket_.low());
        BlockGroup group = groupInBracket();
        std::vector<BlockMotion> gone;
        double mass = 0;
        bool stands = false, fails = true;
        while (!stands && fails) {
            State& stable = probing_.last_stable;
            const std::vector<std::size_t> going = numbersOf(stable.geometry->model, result_.moving_blocks);
            const double own = massOf(stable, going);
            mass += own;
            group.blocks.insert(group.blocks.end(), result_.moving_blocks.begin(),
                                result_.moving_blocks.end());
            std::sort(group.blocks.begin(), group.blocks.end());
            if (mass >= probing_.least_mass || freeMass(stable) - own < probing_.least_mass ||
                areTied(stable, going)) {
                if (!gone.empty()) joinTo(std::move(gone));
                result_.moving_blocks = std::move(group.blocks);
                return false;
            }
            for (const BlockMotion& motion : result_.motions)
                if (motion.moving) gone.push_back(motion);
            takeOut(stable, going, parallel_);
            probing_.no_near_rest = {};
            stands = standsWithout(load);
            if (interrupted(probing_)) return false;
            fails = hasFailedOrIsSmall();
        }
        result_.let_go.push_back(std::move(group));
        bracket_.goOn();
        if (!stands) {
            result_.status = SearchStatus::undecided;
            is_rest_unknown_ = true;
        }
        return stands;
    }

    /// Those of an answer that went before are gone from the state that was let go last: only how they moved is left of them.
    void joinTo(std::vector<BlockMotion> gone) {
        result_.failing = nullptr;
        for (BlockMotion& motion : gone) {
            if (motion.mode != result_.mode) result_.mode = FailureMode::mixed;
            result_.motions.push_back(std::move(motion));
        }
    }

    /// Where there are crumbs a failure of too little mass is not closed in on, nor waited for to be seen with inertia: what leaves its
    /// place, or does not come to rest, is taken out as soon as the load step is short, where the assembly last stood. Where the rest
    /// does not stand there, or that would be all that counts, nothing is taken out, and it is closed in on after all. \pre
    /// mayLetLeavingGo()
    bool letLeavingGo() {
        const double load = axis_.load(bracket_.low());
        const std::int64_t step = *bracket_.high() - bracket_.low();
        const State stood = probing_.last_stable, moving = probing_.last_moving;
        BlockGroup group = groupInBracket();
        double mass = 0;
        std::vector<std::size_t> leaving = std::exchange(leaving_, {});
        for (; !leaving.empty() && !interrupted(probing_); leaving = smallLeaving(probing_)) {
            mass += massOf(stood, leaving);
            if (mass >= probing_.least_mass) break;
            for (const std::size_t b : leaving) group.blocks.push_back(nameOf(b));
            takeOut(probing_.last_stable, leaving, parallel_);
            probing_.no_near_rest = {};
            if (probeAnew("without what leaves", load) == Verdict::stable) {
                std::sort(group.blocks.begin(), group.blocks.end());
                result_.let_go.push_back(std::move(group));
                bracket_.goOn(step);
                return true;
            }
        }
        probing_.last_stable = stood;
        probing_.last_moving = moving;
        probing_.leaving.clear();
        probing_.no_near_rest = {};
        return false;
    }

    /// Of blocks yet to be named.
    BlockGroup groupInBracket() const {
        const double low = axis_.load(bracket_.low()), high = axis_.load(*bracket_.high());
        return {.factor = 0.5 * (low + high), .low = low, .high = high};
    }

    /// Whether at the failing load small blocks leave, in a step as short as to take them out.
    bool mayLetLeavingGo() const {
        return bracket_.high() && !leaving_.empty() && isShort(*bracket_.high() - bracket_.low()) &&
               !interrupted(probing_);
    }

    /// A quarter of the farthest step of the implicit solve; where there is none, a cell.
    bool isShort(std::int64_t step) const {
        const std::int64_t farthest = axis_.farthest ? axis_.farthest(bracket_.low()) - bracket_.low() : 1;
        return step <= std::max<std::int64_t>(1, farthest / 4);
    }

    bool claimsSmallFailure() const {
        return probing_.least_mass > 0 && !result_.moving_blocks.empty() && hasFailedOrIsSmall() &&
               !interrupted(probing_);
    }

    /// Whether what moves has failed, or has so little mass that it need not be seen to: a splinter between others may leave its place
    /// in the implicit solve, and chatter where it is in time.
    bool hasFailedOrIsSmall() const {
        if (result_.status != SearchStatus::found) return false;
        const State& stood = probing_.last_stable;
        const std::vector<std::size_t> moving = numbersOf(stood.geometry->model, result_.moving_blocks);
        return result_.confirmed || (!moving.empty() && massOf(stood, moving) < probing_.least_mass);
    }

    /// At the load at which the assembly last stood.
    Verdict probeAnew(const char* stage, double load) {
        return probe(probing_, stage, load, [&](State& state, double) { axis_.apply(state, load); });
    }

    /// Whether the rest stands at the load at which all last stood; what fails there is let go likewise.
    bool standsWithout(double load) {
        result_.confirmed = false;
        const Verdict verdict = probeAnew("without what has failed", load);
        if (verdict == Verdict::stable) return true;
        if (verdict == Verdict::failing) return !hasFailed(load);
        result_.status = SearchStatus::undecided;
        return false;
    }

    const std::string& nameOf(std::size_t block) const {
        return probing_.last_stable.geometry->model.blocks[block].name;
    }

    /// Up from the start until a probe fails or the end is reached.
    void findFailure() {
        while (!bracket_.high() && !bracket_.stoodToTheEnd() && !interrupted(probing_)) {
            const std::int64_t cell = within(bracket_.up(axis_.next(bracket_.low())));
            if (stepTo(cell) == Verdict::undecided) return;
        }
        if (bracket_.stoodToTheEnd()) result_.status = SearchStatus::stable_to_stop;
    }

    /// An undecided probe is answered by one between it and the failing load; a second one ends the search.
    void narrow() {
        std::int64_t left_open = -1;
        while (bracket_.high() && !bracket_.closed() && !interrupted(probing_) && !mayLetLeavingGo()) {
            const std::int64_t cell = within(bracket_.next());
            if (cell == left_open) break;  // from the same state it would be again
            if (stepTo(cell) != Verdict::undecided) continue;
            left_open = cell;
            const std::int64_t higher = (cell + *bracket_.high() + 1) / 2;
            if (higher >= *bracket_.high() || probeAt(higher) == Verdict::undecided) break;
        }
        if (bracket_.closed()) result_.status = SearchStatus::found;
    }

    /// Whether the failing load is one, and not a load at which the assembly comes to stand again. Watched for longer, and
    /// let go, a slide is sharp; no other failure counts before the implicit solve has failed to find rest.
    bool hasFailed(double load) {
        probing_.stands_elsewhere = no_rest_ = false;
        bool is_in_doubt = false;
        const bool by_its_way = std::exchange(failed_by_its_way_, false);
        const bool asks_first = by_its_way || probing_.implicit_first;
        if (asks_first) {
            if (rests(load)) return false;
            if (by_its_way) probing_.last_moving = probing_.last_stable;
        } else {
            State moving = probing_.last_moving;
            const bool stands = continueToFailure(
                doubted(evidence(), [&] { return askForRest(load, kFactorsOfDoubt) == Verdict::stable; }));
            if (stands) return false;
            if (interrupted(probing_)) return true;
            std::swap(probing_.last_moving, moving);
            if (result_.confirmed && result_.mode == FailureMode::sliding) {
                if (settles(probing_, State(probing_.last_moving), load)) return false;
                std::swap(probing_.last_moving, moving);
                return true;
            }
            if (rests(load)) return false;
            is_in_doubt = result_.confirmed && isAlone();
            if (!is_in_doubt) {
                countElsewhere();
                if (result_.confirmed || !no_rest_) std::swap(probing_.last_moving, moving);
                if (result_.confirmed) return true;
            }
        }
        if (asks_first || no_rest_ || is_in_doubt) continueToFailure(evidence(isAlone()));
        countElsewhere();
        if (result_.confirmed || interrupted(probing_)) return true;
        State moved = probing_.last_moving;
        axis_.apply(moved, load);
        takeBack(moved, probing_.work);
        // The way it has gone beyond the failing load is none of a failure at it: rest that is too far off says nothing.
        return !settles(probing_, moved, load);
    }

    /// What stands again only where it is jammed has failed, whether or not the motion is seen to get there.
    void countElsewhere() {
        if (result_.confirmed || !probing_.stands_elsewhere || interrupted(probing_)) return;
        Failure way = describeWay(probing_.last_stable, probing_.elsewhere);
        result_.confirmed = true;
        result_.mode = way.mode;
        result_.moving_blocks = std::move(way.moving_blocks);
        result_.motions = std::move(way.motions);
    }

    /// Lets what moves at the start go, and takes it back where that shows no failure.
    bool isSeenToFail() {
        State moving = probing_.last_moving;
        continueToFailure(evidenceOfFall());
        if (!result_.confirmed) probing_.last_moving = std::move(moving);
        return result_.confirmed;
    }

    /// Whether there is rest at the failing load by the implicit solve, or where that knows nothing by watching for longer, or by the
    /// solve given more time: a failure that is watched while it might stand is to show more, and takes longer than that. Where it
    /// stands all the same, the solve is given twice as much from then on.
    bool rests(double load) {
        const Verdict found = askForRest(load, probing_.most_factors);
        if (found != Verdict::undecided) return found == Verdict::stable;
        const bool stands =
            settles(probing_, State(probing_.last_moving), load) ||
            askForRest(load, std::max(kPatientFactors, probing_.most_factors)) == Verdict::stable;
        if (stands) probing_.most_factors = std::min(2 * probing_.most_factors, kMostOfAllFactors);
        return stands;
    }

    Verdict askForRest(double load, std::int64_t most_factors) {
        const Verdict found = restAt(probing_, load, most_factors);
        no_rest_ = found == Verdict::failing && !probing_.stands_elsewhere;
        return found;
    }

    /// Whether the implicit solve has been asked and knows nothing.
    bool isAlone() const { return !no_rest_ && !probing_.stands_elsewhere; }

    Evidence evidence(bool alone = false) const {
        return evidenceOfFailure(probing_,
                                 {.at_start = !bracket_.high(), .no_rest = no_rest_, .alone = alone});
    }

    /// \return whether it was found to stand after all
    bool continueToFailure(const Evidence& wanted) {
        // A few cells beyond the failing load, because at it the motion would start as slowly as the bracket is fine.
        const double failing_load = bracket_.high() ? axis_.load(*bracket_.high()) : axis_.start;
        const double load = failing_load + axis_.overload * axis_.cell;
        State& moving = probing_.last_moving;
        axis_.apply(moving, load);
        report(probing_, "failure", failing_load, "let go");
        std::shared_ptr<FailingState> failing;
        if (control_.keep_failing_state)
            failing = std::make_shared<FailingState>(FailingState{fullFrameOf(moving), load});
        result_.supports = supportReports(moving);
        const double solved = probing_.time.solving;
        const Stopwatch watching;
        Failure failure = continueFailure(moving, wanted, control_, parallel_, probing_.leaving);
        const double asking = probing_.time.solving - solved;
        continuations_ += {.steps = failure.steps, .time = {.watching = watching.seconds() - asking}};
        if (failing) {
            failing->contact_damping = failure.contact_damping;
            failing->block_size = moving.geometry->length_scale;
        }
        result_.failing = failure.confirmed ? std::move(failing) : nullptr;
        if (failure.confirmed && failure.at_rest)
            moving.warnings.push_back("the failing motion came to rest after " +
                                      formatted("%.3g", failure.motion) +
                                      " m: the assembly moves at this load, but stands again");
        const bool stands = failure.stands;
        take(std::move(failure));
        return stands;
    }

    void take(Failure failure) {
        result_.mode = failure.mode;
        result_.moving_blocks = std::move(failure.moving_blocks);
        result_.motions = std::move(failure.motions);
        result_.continuation_seconds = failure.seconds;
        result_.time_step = failure.time_step;
        result_.confirmed = failure.confirmed;
        falling_ = std::move(failure.falling);
    }

    void finish() {
        const bool fell = result_.status == SearchStatus::unstable_at_start;
        if (interrupted(probing_))
            result_.status = isStopped(control_) ? SearchStatus::interrupted : SearchStatus::undecided;
        const bool fails =
            result_.status == SearchStatus::found || result_.status == SearchStatus::unstable_at_start;
        result_.low = probing_.has_stood ? axis_.load(bracket_.low()) : -kInfinity;
        result_.high = bracket_.high() ? axis_.load(*bracket_.high()) : fell ? axis_.start : kInfinity;
        if (result_.status == SearchStatus::found) result_.answer = 0.5 * (result_.low + result_.high);
        if (result_.status == SearchStatus::stable_to_stop)
            take({});  // what was let go on the way is no answer
        if (!fails) result_.failing = nullptr;
        if (!fails) result_.supports = supportReports(probing_.last_stable);
        setEffort(effort(), result_);
        describe(fails ? probing_.last_moving : probing_.last_stable, fails);
        result_.probes = std::move(probing_.probes);
    }

    void describe(const State& last, bool fails) {
        result_.state_hash = stateHash(last);
        result_.inertia_scaled = probing_.work.inertia_scaled;
        result_.damping_local = probing_.work.settings.local_damping;
        result_.blocks = last.blocks.size();
        const ContactCount contacts = countContacts(last.interfaces);
        result_.interfaces = contacts.interfaces;
        result_.contact_points = contacts.points;
        result_.warnings = searchWarnings(probing_, last, fails);
        if (is_rest_unknown_) {
            result_.warnings.push_back(
                "without the blocks let go last the rest is neither seen to stand nor to fail at that load");
        }
        if (fails) result_.lost_cohesion = lostCohesion(last);
    }

    const LoadAxis& axis_;
    const Control& control_;
    bool parallel_;
    Bracket bracket_;
    Probing probing_;
    SearchResult result_;
    std::vector<std::size_t> falling_{}, restless_{};
    std::vector<std::size_t> leaving_{};  ///< small blocks that leave at the failing load
    LoadPace pace_{};
    /// the failing load's probe came to rest, too far off: from a rest at a load far below it may have been
    bool failed_by_its_way_ = false;
    bool no_rest_ = false;          ///< at the failing load, nearby or elsewhere
    bool is_rest_unknown_ = false;  ///< whether what is left stands without what was let go last
    Effort continuations_{};
};

}  // namespace

Outcome searchLoad(const State& state, const LoadAxis& axis, const Control& control,
                   const QuasiStatic& settings, bool parallel) {
    Search search(state, axis, control, settings, parallel);
    SearchResult result = search.run();
    return {std::move(result), search.falling(), search.restless()};
}

Start loadStart(const State& state, const LoadAxis& axis, const Control& control, const QuasiStatic& settings,
                bool parallel) {
    Search search(state, axis, control, settings, parallel);
    search.start();
    return {search.falling(), search.effort()};
}

}  // namespace talus::analysis
