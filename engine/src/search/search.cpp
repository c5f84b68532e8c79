#include "search/search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "build/build.h"
#include "checks/loose_blocks.h"
#include "checks/plausible.h"
#include "checks/water_warnings.h"
#include "contacts/limits.h"
#include "equilibrium/release.h"
#include "failure/failure.h"
#include "forces/sum.h"
#include "frame/frame.h"
#include "law/joint_laws.h"
#include "limit_analysis/ceiling.h"
#include "measure/measure.h"
#include "measure/natural_order.h"
#include "measure/stopwatch.h"
#include "search/beginning.h"
#include "search/path_follower.h"
#include "search/search_warnings.h"
#include "search/unloaded_joints.h"
#include "state/block_motion.h"
#include "state/caller.h"
#include "state/incidence.h"
#include "state/threads.h"
#include "step/time_step.h"

namespace talus::search {
namespace {

using checks::areTied, checks::freeMass, checks::kMostLoose, checks::looseShare, checks::massOf,
    checks::movingBlocks, checks::numbersOf, checks::touchesSomething, checks::withoutBlocks;
using equilibrium::EquilibriumPath;
using equilibrium::Released;

// Failure displacements that every answer is told for.
constexpr std::array kDisplacements{1e-4, 3e-4, 1e-3, 3e-3, 1e-2};
constexpr double kStrongest = 0.1;  // of the factors tried
// Of the answer: answers nearer than that are the same.
constexpr double kSameAnswer = 1.0;  // cells
constexpr double kNoTilt = 1e-9;     // [rad]

std::vector<double> displacementsAround(double own) {
    std::vector<double> all(kDisplacements.begin(), kDisplacements.end());
    if (std::none_of(all.begin(), all.end(), [&](double d) { return std::abs(d - own) < 1e-12; }))
        all.push_back(own);
    std::sort(all.begin(), all.end());
    return all;
}

std::size_t indexOf(const std::vector<double>& all, double own) {
    std::size_t k = 0;
    while (all[k] < own - 1e-12) ++k;
    return k;
}

/// What a path has come to, wherever it ended.
struct Course {
    std::unique_ptr<EquilibriumPath> path{};
    Begun begun{};
    Followed followed{};
    double factor = 1;  ///< at which it began
    bool is_followed = false;
};

class Search {
 public:
    Search(Varied varied, const Model& model, const Control& control, const SearchRules& rules)
        : varied_(varied), model_(model), control_(control), rules_(rules), gone_(model.blocks.size(), 0) {
        displacements_ = displacementsAround(model.analysis.failure_displacement);
        counts_ = indexOf(displacements_, model.analysis.failure_displacement);
    }

    Result<SearchResult> run() {
        for (;;) {
            if (auto errors = build(); !errors.empty()) return errors;
            if (isStopped(control_)) return interruptedBefore();
            const Stopwatch loading;
            Course course = begin();
            result_.time.loading += loading.seconds();
            if (letFall(course)) continue;
            const Stopwatch path;
            follow(course);
            result_.time.path += path.seconds();
            finish(course);
            const Stopwatch beside;
            addUpperBound(course);
            addGroups(course);
            addInterval(course);
            result_.time.beside += beside.seconds();
            return std::move(result_);
        }
    }

 private:
    const LoadAxis& axis() const { return *axis_; }

    LoadAxis axisOf(const Model& model) const {
        switch (varied_) {
            case Varied::tilt:
                return tiltAxis(model, rules_);
            case Varied::factor:
                return strengthAxis(model, rules_);
            case Varied::horizontal:
                break;
        }
        return accelerationAxis(model, rules_);
    }

    /// The model without the blocks that are gone, its state and what is wrong with it.
    std::vector<Error> build() {
        const bool all = std::find(gone_.begin(), gone_.end(), 1) == gone_.end();
        rest_ = all ? keptByCaller(model_) : std::make_shared<const Model>(withoutBlocks(model_, gone_));
        axis_ = axisOf(*rest_);
        strength_ = strengthAxis(*rest_, rules_);
        Result<State> built = buildState(rest_, control_.threads != 1, control_);
        if (isStopped(control_)) return {};
        if (!built) return built.errors();
        built_ = std::move(*built);
        parallel_ = worthThreads(*built_, control_.threads);
        const std::vector<double> bounds = frequencyBounds(*built_, parallel_);
        const double imbalance = axis().loading.imbalance;
        const auto slivers = checks::splintersOfRounding(*built_, imbalance, bounds);
        if (takeOutOfModel(slivers, &slivers_)) return build();
        if (auto errors = checks::implausibleSearch(*built_, imbalance, bounds); !errors.empty())
            return errors;
        for (std::string& doubt : checks::doubts(*built_)) built_->warnings.push_back(std::move(doubt));
        warnOfLooseBlocks();
        stopDrivenBlocks();
        built_->searches_around = true;
        built_->load.gravity_share = built_->load.water_share = 0;
        built_->load.horizontal = 0;
        return {};
    }

    void warnOfLooseBlocks() {
        for (std::size_t b = 0; b < built_->blocks.size(); ++b) {
            if (built_->blocks.motion[b] != Motion::free || touchesSomething(*built_, b)) continue;
            built_->warnings.push_back("block \"" + rest_->blocks[b].name +
                                       "\" touches no other block at the start");
            return;
        }
    }

    void stopDrivenBlocks() {
        bool any = false;
        for (std::size_t b = 0; b < built_->blocks.size(); ++b) {
            if (built_->blocks.motion[b] != Motion::driven) continue;
            any = true;
            built_->blocks.velocity.set(b, Vec3::Zero());
        }
        if (any) built_->warnings.push_back("driven blocks stand still in this analysis");
    }

    void report(const std::string& stage, double fraction, const std::string& detail) const {
        if (control_.progress) control_.progress({stage, fraction, detail});
    }

    double startTilt() const { return varied_ == Varied::tilt ? axis().start : rest_->gravity.tilt; }
    double startHorizontal() const {
        return varied_ == Varied::horizontal ? axis().start : rest_->seismic.horizontal;
    }
    bool isLevel() const { return rest_->gravity.direction || std::abs(startTilt()) < kNoTilt; }

    /// A path that begins with strengths divided by a factor.
    /// \param weakens  to that after the weight has come on with more strength
    Course beginAt(double factor, bool weakens = true) {
        Course course{.path = std::make_unique<EquilibriumPath>(*built_, rules_, parallel_, control_.stop)};
        counted_ = {};
        const auto weighted = [&](EquilibriumPath& path) {
            if (!without_friction_) settled_ = path.exactState();
            if (without_friction_) path.mark([&](State& state) { unloaded_.release(state); });
            return without_friction_;
        };
        Start start{
            .tilt = startTilt(),
            .horizontal = startHorizontal(),
            .factor = factor,
            .weakens = weakens,
            .strength = *strength_,
            .imbalance = axis().loading.imbalance,
            .displacements = {displacements_[counts_]},
            .counts = 0,
            .rise = rules_.rise * (varied_ == Varied::factor ? rules_.driving : 1) * axis().loading.cell,
            .mends =
                [&](const Followed& found) {
                    return mends_on_the_way_ && letSmallGo(*course.path, found, false);
                },
            .report = [&](const std::string& what) { report("loading", kLoading, what); },
            .weighted = weighted};
        course.begun = bringToStart(*course.path, *rest_, start);
        course.factor = weakens ? factor : course.begun.factor;
        effort(*course.path);
        return course;
    }

    /// What fails on the way to its own tilt is tilted with more strength, no more than is needed.
    Course begin() {
        if (isLevel()) return beginAt(1, varied_ != Varied::factor);
        // The factor at which a small failure occurs is found on the way back from more strength.
        mends_on_the_way_ = varied_ != Varied::factor;
        Course course = beginAt(1);
        begins_failing_ = kInfinity;
        while (course.begun.result == PathResult::failed && varied_ == Varied::factor &&
               course.factor / rules_.more_strength > kStrongest && !isStopped(control_)) {
            begins_failing_ = course.factor;
            course = beginAt(course.factor / rules_.more_strength);
        }
        const bool fails = course.begun.result == PathResult::failed;
        if (!fails || mends_on_the_way_ || !(rest_->analysis.least_mass_share > 0)) return course;
        mends_on_the_way_ = true;
        begins_failing_ = kInfinity;
        return beginAt(1);
    }

    /// Blocks that fall as weight comes on, whatever the strength, are taken out if they are few.
    bool letFall(const Course& course) {
        if (course.begun.result != PathResult::failed || isStopped(control_)) return false;
        if (std::string(course.begun.stage) != "weight") return false;
        const State& state = course.path->state();
        return takeOutOfModel(movingBlocks(*built_, state), &fallen_);
    }

    /// \param blocks  of the model that is left \param count  of those taken out so
    bool takeOutOfModel(const std::vector<std::size_t>& blocks, std::size_t* count) {
        if (blocks.empty()) return false;
        std::vector<char> going = gone_;
        std::size_t left = 0;
        auto next = blocks.begin();
        for (std::size_t b = 0; b < gone_.size() && next != blocks.end(); ++b) {
            if (gone_[b] || left++ != *next) continue;
            going[b] = 1;
            ++next;
        }
        if (looseShare(model_, going) > kMostLoose) return false;
        gone_ = std::move(going);
        *count += blocks.size();
        return true;
    }

    /// Follows the load that is searched for from where the path began.
    void follow(Course& course) {
        if (course.begun.result != PathResult::reached) return;
        if (std::isfinite(begins_failing_)) {
            if (!raiseTo(course, begins_failing_)) return;
            if (result_.let_go.empty()) return narrowBeginnings(course);
            raiseTo(course, axis().stop);
            return;
        }
        if (course.factor != 1 && !raiseTo(course, 1)) return;
        raiseTo(course, axis().stop);
    }

    /// The slope fails as it is tilted with strengths divided by some factor, yet stands so when it comes there from
    /// more strength: the path decides. The answer is the factor from which on it fails on its way to the tilt.
    void narrowBeginnings(Course& course) {
        double stands = course.factor, fails = begins_failing_;
        jammed_at_ = begins_failing_;
        std::optional<Course> failed;
        while ((fails - stands > axis().loading.cell || !failed) && !isStopped(control_)) {
            Course next = beginAt(0.5 * (stands + fails));
            if (next.begun.result == PathResult::reached) {
                stands = next.factor;
                course.path = std::move(next.path);
                course.path->vary(axis().loading, stands);
                course.followed.stood = course.path->place();
            } else if (next.begun.result == PathResult::failed && next.begun.followed.failing) {
                fails = next.factor;
                failed.emplace(std::move(next));
            } else {
                course.followed.result = next.begun.result;
                return;
            }
        }
        if (!failed) return;
        const Followed& last = failed->begun.followed;
        course.followed.result = PathResult::failed;
        course.followed.bracket = {stands, fails};
        course.followed.failing = last.failing;
        course.followed.since = last.since;
        course.followed.by_displacement.clear();
    }

    /// \return whether it stands there
    bool raiseTo(Course& course, double target) {
        const double from = varied_ == Varied::factor ? course.factor : axis().start;
        EquilibriumPath& path = *course.path;
        path.vary(axis().loading, from);
        Follow follow{.target = target,
                      .displacements = displacements_,
                      .counts = counts_,
                      .mends = [&](const Followed& found) { return letSmallGo(path, found, true); },
                      .report =
                          [&](double load, const char* what) {
                              report("path", kLoading + (kPath - kLoading) * progressOf(load, from, target),
                                     axis().say(load) + ", " + what);
                          }};
        Followed followed = followPath(path, axis(), follow);
        effort(path);
        const bool stands = followed.result == PathResult::reached;
        if (course.is_followed) {  // the way to the scenario's own strength comes before
            const auto prepend = [](auto& before, auto& after) {
                before.insert(before.end(), after.begin(), after.end());
                after = std::move(before);
            };
            prepend(course.followed.points, followed.points);
            prepend(course.followed.probes, followed.probes);
        }
        course.followed = std::move(followed);
        course.is_followed = true;
        if (stands && varied_ == Varied::factor) course.factor = target;
        return stands;
    }

    static double progressOf(double load, double from, double target) {
        // Most searches end long before their target: the bar slows down and never stands.
        const double way = std::abs(load - from) / std::max(0.1 * std::abs(target - from), 0.2);
        return way / (1 + way);
    }

    /// What has failed and has less mass than an answer is taken out where the rest stood, and the path goes on.
    /// \param is_answer  of the load that is searched for
    bool letSmallGo(EquilibriumPath& path, const Followed& found, bool is_answer) {
        const double least = rest_->analysis.least_mass_share * freeMass(*built_);
        if (!(least > 0) || isStopped(control_)) return false;
        const auto failing = path.place();
        std::vector<std::size_t> going =
            movingBlocks(found.since.poses().position, found.since.poses().orientation, path.state());
        const double load = found.stood->load;
        path.goBack(*found.stood);
        std::vector<std::size_t> all;
        double mass = 0;
        const double free = freeMass(path.state());
        for (;;) {
            mass += massOf(path.state(), going);
            const bool is_small = mass < least && free - mass >= least;
            if (going.empty() || !is_small || areTied(path.state(), going)) {
                path.goBack(failing);
                return false;
            }
            all.insert(all.end(), going.begin(), going.end());
            path.takeOut(going);
            const auto before = path.place();
            const auto since = path.parting();
            const double most = displacements_[counts_] + rules_.jolt;
            if (equilibrium::release(path, load, since, most) == Released::rests) break;
            going = movingBlocks(before.state, path.state());
            if (is_answer)
                followers_ = Followers{going, path.state().blocks.position, path.state().blocks.orientation};
            path.goBack(before);
        }
        followers_.reset();
        const double at = is_answer ? load : axis().start;
        BlockGroup group = groupOf(all, at);
        if (is_answer) {
            group.low = found.bracket.stands, group.high = found.bracket.fails;
            group.factor = 0.5 * (group.low + group.high);
        }
        result_.let_go.push_back(std::move(group));
        return true;
    }

    BlockGroup groupOf(const std::vector<std::size_t>& blocks, double load) const {
        BlockGroup group{.factor = load, .low = load, .high = load};
        for (const std::size_t b : blocks) {
            group.blocks.push_back(rest_->blocks[b].name);
            group.mass += built_->blocks.mass[b];
            group.volume += built_->blocks.mass[b] / rest_->blocks[b].density;
        }
        sortNaturally(group.blocks);
        return group;
    }

    void effort(const EquilibriumPath& path) {
        result_.steps += path.work().steps - counted_.steps;
        result_.factors += path.work().factors - counted_.factors;
        counted_ = path.work();
    }

    Result<SearchResult> interruptedBefore() {
        result_.status = SearchStatus::interrupted;
        result_.low = -kInfinity;
        result_.high = kInfinity;
        result_.blocks = model_.blocks.size();
        return std::move(result_);
    }

    /// From what the paths have come to.
    void finish(Course& course) {
        result_.failure_displacement = displacements_[counts_];
        const bool has_begun = course.begun.result == PathResult::reached;
        const PathResult ended = has_begun ? course.followed.result : course.begun.result;
        result_.low = has_begun ? course.followed.bracket.stands : -kInfinity;
        result_.high = has_begun ? course.followed.bracket.fails : kInfinity;
        switch (ended) {
            case PathResult::reached:
                result_.status = SearchStatus::stable_to_stop;
                break;
            case PathResult::failed:
                result_.status = has_begun ? SearchStatus::found : SearchStatus::unstable_at_start;
                if (!has_begun) result_.high = axis().start;
                break;
            case PathResult::lost:
                result_.status = SearchStatus::undecided;
                break;
            case PathResult::interrupted:
                result_.status = SearchStatus::interrupted;
                break;
        }
        if (result_.status == SearchStatus::undecided) {
            result_.warnings.push_back(std::string("Newton's method finds no equilibrium ") +
                                       (has_begun ? "beyond " + axis().say(result_.low)
                                                  : "as " + std::string(course.begun.stage) + " comes on"));
        }
        if (result_.status == SearchStatus::found) result_.answer = 0.5 * (result_.low + result_.high);
        result_.path = std::move(course.followed.points);
        result_.probes = std::move(course.followed.probes);
        addDisplacements(course.followed);
        describe(course, has_begun);
    }

    void addDisplacements(const Followed& followed) {
        if (result_.status != SearchStatus::found) return;
        for (std::size_t k = 0; k < followed.by_displacement.size(); ++k) {
            const auto& bracket = followed.by_displacement[k];
            if (!bracket || k == counts_) continue;
            const double load = 0.5 * (bracket->stands + bracket->fails);
            if (std::abs(load - result_.answer) > kSameAnswer * axis().loading.cell)
                result_.answers_by_displacement.push_back({displacements_[k], load});
        }
    }

    /// How it fails, and the state the search ended in.
    void describe(Course& course, bool has_begun) {
        const bool fails =
            result_.status == SearchStatus::found || result_.status == SearchStatus::unstable_at_start;
        const Followed& followed = course.followed;
        State last = followed.failing              ? *followed.failing
                     : has_begun && followed.stood ? followed.stood->state
                                                   : course.path->state();
        if (followers_) followers_->put(last.blocks);
        if (fails) {
            const bool is_seen = followed.failing.has_value();
            const PositionArray& position =
                is_seen ? followed.since.poses().position : built_->blocks.position;
            const QuaternionArray& orientation =
                is_seen ? followed.since.poses().orientation : built_->blocks.orientation;
            // What blocks give elastically is no motion, as long as they go farther than that.
            const double gives = std::min(course.path->elasticDisplacement(),
                                          kLeastMotion * largestMotion(last, position, orientation));
            failure::Failure failure = failure::describeFailure(position, orientation, last, gives);
            result_.mode = failure.mode;
            result_.moving_blocks = std::move(failure.moving_blocks);
            result_.motions = std::move(failure.motions);
            for (std::size_t b = 0, k = 0; b < last.blocks.size(); ++b) {
                if (last.blocks.motion[b] != Motion::free) continue;
                if (!result_.motions[k++].moving) continue;
                result_.failing_mass += last.blocks.mass[b];
                result_.failing_volume += last.blocks.mass[b] / rest_->blocks[b].density;
            }
            result_.lost_cohesion = lostCohesion(last);
        }
        result_.supports = supportReports(last);
        result_.state_hash = stateHash(last);
        result_.blocks = last.blocks.size();
        const ContactCount contacts = countContacts(last.interfaces);
        result_.interfaces = contacts.interfaces;
        result_.contact_points = contacts.points;
        const bool alike = gone_ == std::vector<char>(gone_.size(), 0) && result_.let_go.empty();
        if (fails && control_.keep_failing_state && alike) keepFailing(course, last);
        for (std::string& warning : searchWarnings(*built_, last, fails, !has_begun))
            result_.warnings.push_back(std::move(warning));
        if (result_.status == SearchStatus::unstable_at_start)
            if (auto pushed = checks::pushedByWater(*built_, movingBlocks(*built_, last)))
                result_.warnings.push_back(std::move(*pushed));
        nameFallen();
    }

    /// From the last equilibrium, which the load that fails is put on.
    void keepFailing(Course& course, const State& last) {
        auto failing = std::make_shared<FailingState>();
        const bool has_begun = course.begun.result == PathResult::reached;
        const Followed& followed = has_begun ? course.followed : course.begun.followed;
        failing->load = result_.status == SearchStatus::found
                            ? result_.high + kPlayedBeyond * axis().loading.cell
                            : axis().start;
        if (followed.stood) {
            course.path->goBack(*followed.stood);
            course.path->putUnder(has_begun ? failing->load : 1.0);  // on the way there loads are shares
        }
        failing->state = fullFrameOf(followed.stood ? course.path->exactState() : last);
        std::vector<char> moving(last.blocks.size(), 0);
        for (std::size_t b = 0, k = 0; b < moving.size(); ++b)
            if (last.blocks.motion[b] == Motion::free) moving[b] = result_.motions[k++].moving;
        failing->frequency = failure::playedFrequency(last, moving, parallel_);
        failing->contact_damping = failure::rattleDamping(failing->frequency);
        failing->block_size = last.geometry->length_scale;
        result_.failing = std::move(failing);
    }

    void nameFallen() {
        for (std::size_t b = 0; b < gone_.size(); ++b)
            if (gone_[b]) result_.fallen_at_start.push_back(model_.blocks[b].name);
        if (result_.fallen_at_start.empty()) return;
        sortNaturally(result_.fallen_at_start);
        std::string what;
        if (fallen_ > 0)
            what = std::to_string(fallen_) + " of the blocks fall at the start whatever the strength";
        if (slivers_ > 0)
            what +=
                (what.empty() ? "" : ", and ") + std::to_string(slivers_) + " are ill-conditioned slivers";
        result_.warnings.push_back(what + " (" + result_.fallen_at_start.front() +
                                   " for one): the answer is for the others");
    }

    /// Who goes next, and at which factor: what has failed is taken out where the rest stood, and the path goes on.
    void addGroups(Course& course) {
        if (varied_ != Varied::factor || result_.status != SearchStatus::found) return;
        result_.groups.push_back({.factor = result_.answer,
                                  .blocks = result_.moving_blocks,
                                  .low = result_.low,
                                  .high = result_.high,
                                  .volume = result_.failing_volume,
                                  .mass = result_.failing_mass});
        EquilibriumPath& path = *course.path;
        auto stood = course.followed.stood;
        std::vector<std::size_t> going = numbersOf(*rest_, result_.moving_blocks);
        while (static_cast<int>(result_.groups.size()) < control_.groups && stood && !going.empty() &&
               !isStopped(control_)) {
            path.goBack(*stood);
            const double load = stood->load;
            if (areTied(path.state(), going) || massOf(path.state(), going) >= freeMass(path.state())) return;
            path.takeOut(going);
            auto before = path.place();
            if (equilibrium::release(path, load, path.parting(), displacements_[counts_] + rules_.jolt) !=
                Released::rests) {
                // What does not stand without them goes with them.
                going = movingBlocks(before.state, path.state());
                BlockGroup also = groupOf(going, load);
                BlockGroup& last = result_.groups.back();
                last.blocks.insert(last.blocks.end(), also.blocks.begin(), also.blocks.end());
                sortNaturally(last.blocks);
                last.volume += also.volume, last.mass += also.mass;
                stood = std::move(before);
                continue;
            }
            Follow follow{.target = axis().stop, .displacements = {displacements_[counts_]}};
            follow.report = [&](double at, const char* what) {
                report("the next group", kPath, axis().say(at) + ", " + what);
            };
            Followed next = followPath(path, axis(), follow);
            effort(path);
            result_.groups_undecided = next.result == PathResult::lost;
            if (result_.groups_undecided)
                result_.warnings.push_back("the search for the blocks that go next is undecided");
            if (next.result != PathResult::failed) return;
            const double factor = 0.5 * (next.bracket.stands + next.bracket.fails);
            going = movingBlocks(next.since.poses().position, next.since.poses().orientation, *next.failing);
            BlockGroup group = groupOf(going, factor);
            group.low = next.bracket.stands, group.high = next.bracket.fails;
            result_.groups.push_back(std::move(group));
            stood = std::move(next.stood);
        }
    }

    /// By limit analysis: of the assembly as built, or as it settled where joints had to close first.
    void addUpperBound(const Course& course) {
        const bool wanted = control_.upper_bound != Beside::never;
        if (result_.status == SearchStatus::interrupted || !wanted) {
            result_.upper_bound.reason =
                wanted ? "the search was interrupted" : "not wanted (--no-upper-bound)";
            return;
        }
        report("upper bound", kPath, "limit analysis");
        const bool has_settled = settled_ && course.begun.parted > kClosedGap;
        State state = has_settled ? *settled_ : *built_;
        state.laws = jointLaws(rest_->joints, 1);
        LimitSettings settings;
        for (const BlockGroup& group : result_.let_go)
            settings.left_out.insert(settings.left_out.end(), group.blocks.begin(), group.blocks.end());
        result_.upper_bound =
            limit::ceilingOf(state, varied_, control_.upper_bound == Beside::always, control_, settings);
        if (!isAbove(result_.low, result_.upper_bound, varied_)) return;
        result_.warnings.push_back("the answer is above the upper bound of limit analysis, " +
                                   axis().say(*result_.upper_bound.value) +
                                   ", which is for the shape as built: blocks move before they fail");
    }

    /// Joints that carry nothing where the search begins, with more strength than the assembly has: there nothing has
    /// slid that could press them.
    UnloadedJoints unloadedAtFirst() {
        const Course elastic = beginAt(1 / rules_.weight_strength);
        if (elastic.begun.result != PathResult::reached) return {};
        return UnloadedJoints(elastic.path->state(), rules_.unloaded);
    }

    /// The lowest answer that another loading path leaves open: joints that carry nothing when the assembly is first in
    /// equilibrium get no friction.
    void addInterval(const Course& course) {
        if (result_.status != SearchStatus::found) return;
        result_.answer_interval = std::pair(result_.answer, result_.answer);
        auto& [low_reason, high_reason] = result_.answer_interval_reasons;
        low_reason = high_reason = "the path of the search";
        if (jammed_at_ > result_.answer) {
            result_.answer_interval->second = jammed_at_;
            high_reason = "it stands there when it comes from more strength";
        }
        if (result_.upper_bound.value && *result_.upper_bound.value > result_.answer_interval->second) {
            result_.answer_interval->second = *result_.upper_bound.value;
            high_reason = "upper bound of limit analysis";
        }
        if (isAbove(result_.low, result_.upper_bound, varied_)) {
            result_.answer_interval->first = *result_.upper_bound.value;
            low_reason =
                "upper bound of limit analysis for the shape as built, which deforms before it fails";
        }
        if (!control_.interval || isStopped(control_)) return;
        report("the interval", kPath, "joints that carry nothing at first");
        std::vector<BlockGroup> let_go = result_.let_go;
        unloaded_ = unloadedAtFirst();
        result_.let_go = let_go;
        if (isStopped(control_)) return;
        if (unloaded_.empty() || !course.followed.stood ||
            unloaded_.shearCarried(course.followed.stood->state) < rules_.carries_shear) {
            low_reason += "; no joint that was unloaded at first carries shear at the answer";
            return;
        }
        report("the interval", kPath, std::to_string(unloaded_.size()) + " joints without friction");
        const LoadAxis weakened = unloaded_.with(*strength_);
        without_friction_ = true;
        const LoadAxis axis = std::exchange(*strength_, weakened);
        const LoadAxis own = *axis_;
        if (varied_ == Varied::factor) *axis_ = weakened;
        Course other = begin();
        follow(other);
        result_.let_go = std::move(let_go);
        *strength_ = axis;
        *axis_ = own;
        without_friction_ = false;
        const std::string what =
            "no friction on the " + std::to_string(unloaded_.size()) + " joints that carry nothing at first";
        const bool has_begun = other.begun.result == PathResult::reached;
        if (has_begun && other.followed.result == PathResult::failed) {
            const double answer = 0.5 * (other.followed.bracket.stands + other.followed.bracket.fails);
            if (answer < result_.answer_interval->first - axis_->loading.cell) {
                result_.answer_interval->first = answer;
                low_reason = what;
            } else {
                low_reason += "; the same with " + what;
            }
        } else if (!has_begun && other.begun.result == PathResult::failed) {
            result_.answer_interval->first = std::min(
                result_.answer_interval->first, varied_ == Varied::factor ? other.factor : axis_->start);
            low_reason = what + ": it does not stand at the start";
        } else if (other.followed.result == PathResult::lost || other.begun.result == PathResult::lost) {
            low_reason += "; with " + what + " undecided";
        }
    }

    static constexpr double kLoading = 0.2, kPath = 0.9;  // of the progress
    static constexpr double kLeastMotion = 0.05;          // of the farthest block's
    // Cells beyond the bracket at which a failure is played on: at the peak itself it would take minutes to begin.
    static constexpr double kPlayedBeyond = 8;

    /// Blocks that fall because those before them have left: where they were seen to go.
    struct Followers {
        std::vector<std::size_t> blocks;
        PositionArray position;
        QuaternionArray orientation;

        void put(Blocks& to) const {
            for (const std::size_t b : blocks) {
                to.position.set(b, position.get(b));
                to.orientation[b] = orientation[b];
            }
        }
    };

    const Varied varied_;
    const Model& model_;
    const Control& control_;
    const SearchRules& rules_;
    std::vector<double> displacements_{};
    std::size_t counts_ = 0;
    std::vector<char> gone_;  ///< per block of the model: taken out before the search
    std::size_t fallen_ = 0, slivers_ = 0;
    std::shared_ptr<const Model> rest_{};
    std::optional<LoadAxis> axis_{}, strength_{};
    std::optional<State> built_{};
    bool parallel_ = false;
    std::optional<State> settled_{};  ///< when the weight was first in equilibrium
    UnloadedJoints unloaded_{};       ///< where the search begins, with more strength
    bool without_friction_ = false;
    std::optional<Followers> followers_{};  ///< of what was too small to be the answer without them
    bool mends_on_the_way_ = true;          ///< to where the search begins: small failures are taken out
    double begins_failing_ = kInfinity;  ///< least factor with which the slope fails on its way to its tilt
    double jammed_at_ = -kInfinity;  ///< factor at which it stands though it fails on its way there with that
    equilibrium::PathWork counted_{};  ///< of the path that is followed
    SearchResult result_{};
};

}  // namespace

Result<SearchResult> searchFor(Varied varied, const Model& model, const Control& control,
                               const SearchRules& rules) {
    return inArena(control.threads, [&]() -> Result<SearchResult> {
        const Stopwatch all;
        Result<SearchResult> result = Search(varied, model, control, rules).run();
        if (result) result->wall_seconds = all.seconds();
        return result;
    });
}

}  // namespace talus::search
