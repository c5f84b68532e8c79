#include "search/search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "build/build.h"
#include "build/wet_joints.h"
#include "checks/loose_blocks.h"
#include "checks/plausible.h"
#include "checks/water_warnings.h"
#include "equilibrium/release.h"
#include "measure/stopwatch.h"
#include "search/search_run.h"
#include "search/wet_tilt_search.h"
#include "state/caller.h"
#include "state/threads.h"
#include "step/time_step.h"
#include "talus/held.h"

namespace talus::search {
namespace {

using checks::areTied, checks::freeMass, checks::kMostLoose, checks::looseShare, checks::massOf,
    checks::movingBlocks, checks::touchesSomething, checks::withoutBlocks;
using equilibrium::Released;

// Failure displacements for which every answer is reported.
constexpr std::array kDisplacements{1e-4, 3e-4, 1e-3, 3e-3, 1e-2};
constexpr double kStrongest = 0.1;  // of the factors tried

}  // namespace

void Search::tellDisplacements() {
    const double own = model_.analysis.failure_displacement;
    const auto is_own = [&](double d) { return std::abs(d - own) < 1e-12; };
    displacements_.assign(kDisplacements.begin(), kDisplacements.end());
    if (std::none_of(displacements_.begin(), displacements_.end(), is_own)) displacements_.push_back(own);
    std::sort(displacements_.begin(), displacements_.end());
    const auto place = std::find_if(displacements_.begin(), displacements_.end(), is_own);
    counts_ = static_cast<std::size_t>(place - displacements_.begin());
}

Result<SearchResult> Search::run() {
    for (;;) {
        if (auto errors = build(); !errors.empty()) return errors;
        if (isStopped(control_)) return interruptedBefore();
        const Stopwatch loading;
        Course course = begin();
        result_.time.loading += loading.seconds();
        if (removeFallen(course)) continue;
        const Stopwatch path;
        follow(course);
        result_.time.path += path.seconds();
        if (auto finer = onFinerMesh(course)) return std::move(*finer);
        finish(course);
        const Stopwatch beside;
        addUpperBound(course);
        addGroups(course);
        addLimitEquilibrium();
        addInterval(course);
        warnOfOpenCohesion(course);
        result_.time.beside += beside.seconds();
        return std::move(result_);
    }
}

LoadAxis Search::axisOf(const Model& model) const {
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

std::vector<Error> Search::build() {
    const bool all = std::find(gone_.begin(), gone_.end(), 1) == gone_.end();
    rest_ = all ? kept_ : std::make_shared<const Model>(withoutBlocks(model_, gone_));
    Result<State> built = buildWithWetJoints(rest_, control_.threads != 1, control_);
    axis_ = axisOf(*rest_);
    strength_ = strengthAxis(*rest_, rules_);
    if (isStopped(control_)) return {};
    if (!built) return built.errors();
    built_ = std::move(*built);
    coupled_.reset();
    if (rest_->flow && rest_->flow->coupled) {
        coupled_.emplace(*built_);
        if (varied_ == Varied::tilt) coupled_->followTilt(axis().start);
    }
    parallel_ = worthThreads(*built_, control_.threads);
    const std::vector<double> bounds = frequencyBounds(*built_, parallel_);
    const double imbalance = axis().loading.imbalance;
    const auto slivers = checks::splintersOfRounding(*built_, imbalance, bounds);
    if (takeOutOfModel(slivers, &slivers_)) return build();
    if (auto errors = checks::implausibleSearch(*built_, imbalance, bounds); !errors.empty()) return errors;
    for (std::string& doubt : checks::doubts(*built_)) built_->warnings.push_back(std::move(doubt));
    for (const Error& doubt : checks::wetStrengthOfDryJoints(*rest_))
        built_->warnings.push_back(doubt.field + ": " + doubt.message);
    if (varied_ == Varied::tilt)
        if (auto doubt = checks::flowOfOtherTilt(*rest_)) built_->warnings.push_back(std::move(*doubt));
    for (std::string& line : heldAtTimeZero(*rest_)) built_->warnings.push_back(std::move(line));
    warnOfLooseBlocks();
    stopDrivenBlocks();
    built_->searches_around = true;
    built_->load.gravity_share = built_->load.water_share = 0;
    built_->load.horizontal = 0;
    return {};
}

void Search::warnOfLooseBlocks() {
    for (std::size_t b = 0; b < built_->blocks.size(); ++b) {
        if (built_->blocks.motion[b] != Motion::free || touchesSomething(*built_, b)) continue;
        built_->warnings.push_back("block \"" + rest_->blocks[b].name +
                                   "\" touches no other block at the start");
        return;
    }
}

void Search::stopDrivenBlocks() {
    bool any = false;
    for (std::size_t b = 0; b < built_->blocks.size(); ++b) {
        if (built_->blocks.motion[b] != Motion::driven) continue;
        any = true;
        built_->blocks.velocity.set(b, Vec3::Zero());
    }
    if (any) built_->warnings.push_back("driven blocks do not move in this analysis");
}

void Search::report(const std::string& stage, double fraction, const std::string& detail) const {
    if (control_.progress) control_.progress({stage, fraction, detail});
}

Course Search::beginAt(double factor, bool weakens) {
    Course course{.path = std::make_unique<EquilibriumPath>(*built_, rules_, parallel_, control_.stop)};
    if (enough_ != nullptr) course.path->limitWork(most_factors_ - result_.factors);
    if (coupled_) course.path->couple(&*coupled_);
    counted_ = {};
    const auto weighted = [&](EquilibriumPath& path) {
        if (!without_friction_) settled_ = path.exactState();
        if (without_friction_) path.mark([&](State& state) { unloaded_.release(state); });
        return without_friction_;
    };
    Start start{.tilt = startTilt(),
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

Course Search::begin() {
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

bool Search::removeFallen(const Course& course) {
    if (course.begun.result != PathResult::failed || isStopped(control_)) return false;
    if (std::string(course.begun.stage) != "weight") return false;
    const State& state = course.path->state();
    return takeOutOfModel(movingBlocks(*built_, state), &fallen_);
}

bool Search::takeOutOfModel(const std::vector<std::size_t>& blocks, std::size_t* count) {
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

void Search::follow(Course& course) {
    if (course.begun.result != PathResult::reached) return;
    if (std::isfinite(begins_failing_)) {
        if (!raiseTo(course, begins_failing_)) return;
        if (result_.removed_groups.empty()) return narrowBeginnings(course);
        raiseTo(course, axis().stop);
        return;
    }
    if (course.factor != 1 && !raiseTo(course, 1)) return;
    raiseTo(course, axis().stop);
}

void Search::narrowBeginnings(Course& course) {
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

bool Search::raiseTo(Course& course, double target) {
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
    if (course.is_followed) {  // the path to the scenario's own strength comes before
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

double Search::progressOf(double load, double from, double target) {
    // Most searches end long before their target: the progress bar slows down and never stops.
    const double way = std::abs(load - from) / std::max(0.1 * std::abs(target - from), 0.2);
    return way / (1 + way);
}

bool Search::letSmallGo(EquilibriumPath& path, const Followed& found, bool is_answer) {
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
    result_.removed_groups.push_back(std::move(group));
    return true;
}
Result<SearchResult> searchFor(Varied varied, const Model& model, const Control& control,
                               const SearchRules& rules) {
    return inArena(control.threads, [&]() -> Result<SearchResult> {
        const Stopwatch all;
        const bool wets = varied == Varied::tilt && hasWetJoints(model);
        Result<SearchResult> result =
            wets ? findTiltOfWetJoints(model, control, rules) : Search(varied, model, control, rules).run();
        if (result) result->wall_seconds = all.seconds();
        return result;
    });
}

}  // namespace talus::search
