#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "checks/loose_blocks.h"
#include "checks/open_cohesion.h"
#include "contacts/limits.h"
#include "equilibrium/release.h"
#include "law/joint_laws.h"
#include "limit_analysis/ceiling.h"
#include "measure/natural_order.h"
#include "search/limit_load.h"
#include "search/search_run.h"
#include "state/block_motion.h"
#include "state/caller.h"

namespace talus::search {
namespace {

using checks::areTied, checks::freeMass, checks::massOf, checks::movingBlocks, checks::numbersOf;
using equilibrium::Released;

// Of the answer: a smaller effect of elastic joints is negligible.
constexpr double kElasticEffect = 0.01;
// Of the block size: blocks that move by less before they fail change lever arms by less than that share.
constexpr double kLeans = 1e-3;
// Factorisations that the answer for other joints may take beyond those of the answer: negligible time.
constexpr std::int64_t kLeastEffort = 2000;
constexpr double kStiffer = 10;  // usual variation of stiffness in sensitivity studies

}  // namespace

void Search::addGroups(Course& course) {
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
            // Blocks that are unstable without them fail with them.
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
            result_.warnings.push_back("the search for the next group to fail is undecided");
        if (next.result != PathResult::failed) return;
        const double factor = 0.5 * (next.bracket.stands + next.bracket.fails);
        going = movingBlocks(next.since.poses().position, next.since.poses().orientation, *next.failing);
        BlockGroup group = groupOf(going, factor);
        group.low = next.bracket.stands, group.high = next.bracket.fails;
        result_.groups.push_back(std::move(group));
        stood = std::move(next.stood);
    }
}

void Search::addUpperBound(const Course& course) {
    const bool wanted = control_.upper_bound != Beside::never;
    if (result_.status == SearchStatus::interrupted || !wanted) {
        result_.upper_bound.reason =
            wanted ? "the search was interrupted" : "not computed (--no-upper-bound)";
        return;
    }
    result_.upper_bound = boundOf(course);
    if (!isAbove(result_.low, result_.upper_bound, varied_)) return;
    result_.warnings.push_back("the answer exceeds the upper bound of limit analysis, " +
                               axis().say(*result_.upper_bound.value) +
                               ", which holds for the shape as built: blocks move before they fail");
}

Ceiling Search::boundOf(const Course& course) {
    report("upper bound", kPath, "limit analysis");
    const bool has_settled = settled_ && course.begun.parted > kClosedGap;
    State state = has_settled ? *settled_ : *built_;
    state.laws = jointLaws(rest_->joints, 1);
    if (course.followed.stood) state.coupled_pressure = course.followed.stood->state.coupled_pressure;
    LimitSettings settings;
    for (const BlockGroup& group : result_.removed_groups)
        settings.left_out.insert(settings.left_out.end(), group.blocks.begin(), group.blocks.end());
    return limit::ceilingOf(state, varied_, control_.upper_bound == Beside::always, control_, settings);
}

UnloadedJoints Search::unloadedAtFirst() {
    const Course elastic = beginAt(1 / rules_.weight_strength);
    if (elastic.begun.result != PathResult::reached) return {};
    return UnloadedJoints(elastic.path->state(), rules_.unloaded);
}

void Search::lowerInterval(double answer, const std::string& reason) {
    if (answer >= result_.answer_interval->first - axis().loading.cell) return;
    result_.answer_interval->first = answer;
    result_.answer_interval_reasons.first = reason;
}

void Search::addLimitEquilibrium() {
    const bool has_answer = result_.status == SearchStatus::found;
    if (!has_answer && result_.status != SearchStatus::stable_to_stop) return;
    if (control_.upper_bound == Beside::never || isStopped(control_)) return;
    // A factor takes one look at the groups, other loads several.
    if (has_answer && varied_ != Varied::factor && !control_.interval) return;
    // Block theory would compute the flow anew at each tilt, and in joints that have not opened.
    if (rest_->flow && (varied_ == Varied::tilt || rest_->flow->coupled)) return;
    report("limit equilibrium", kPath, "blocks that slide as one body");
    std::vector<std::string> gone;
    for (const BlockGroup& group : result_.removed_groups)
        gone.insert(gone.end(), group.blocks.begin(), group.blocks.end());
    const Model model = talus::withoutBlocks(*rest_, gone);
    const double least = rest_->analysis.least_mass_share * freeMass(*built_);
    const LimitQuestion question{model, varied_, least, control_};
    if (has_answer) {
        result_.limit_equilibrium = limitEquilibriumOf(question, axis(), result_.answer);
    } else if (auto why = nothingCanSlide(question, result_.low)) {
        result_.warnings.push_back(std::move(*why));
    }
}

void Search::addBounds() {
    auto& [low_reason, high_reason] = result_.answer_interval_reasons;
    low_reason = high_reason = "the path of the search";
    if (jammed_at_ > result_.answer) {
        result_.answer_interval->second = jammed_at_;
        high_reason = "the slope is stable there on a loading path from more strength";
    }
    if (result_.upper_bound.value && *result_.upper_bound.value > result_.answer_interval->second) {
        result_.answer_interval->second = *result_.upper_bound.value;
        high_reason = "upper bound of limit analysis";
    }
    if (isAbove(result_.low, result_.upper_bound, varied_)) {
        result_.answer_interval->first = *result_.upper_bound.value;
        low_reason = "upper bound of limit analysis for the shape as built, which deforms before it fails";
    }
}

void Search::addUnloadedJoints(const Course& course) {
    std::string& low_reason = result_.answer_interval_reasons.first;
    report("the interval", kPath, "joints unloaded at first");
    std::vector<BlockGroup> removed_groups = result_.removed_groups;
    unloaded_ = unloadedAtFirst();
    result_.removed_groups = removed_groups;
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
    result_.removed_groups = std::move(removed_groups);
    *strength_ = axis;
    *axis_ = own;
    without_friction_ = false;
    const std::string what =
        "no friction on the " + std::to_string(unloaded_.size()) + " joints unloaded at first";
    const bool has_begun = other.begun.result == PathResult::reached;
    if (has_begun && other.followed.result == PathResult::failed) {
        const double answer = 0.5 * (other.followed.bracket.stands + other.followed.bracket.fails);
        if (answer >= result_.answer_interval->first - axis_->loading.cell)
            low_reason += "; the same with " + what;
        lowerInterval(answer, what);
    } else if (!has_begun && other.begun.result == PathResult::failed) {
        result_.answer_interval->first =
            std::min(result_.answer_interval->first, varied_ == Varied::factor ? other.factor : axis_->start);
        low_reason = what + ": unstable at the start";
    } else if (other.followed.result == PathResult::lost || other.begun.result == PathResult::lost) {
        low_reason += "; with " + what + " undecided";
    }
}

Result<SearchResult> Search::answerOf(const Model& model) const {
    std::atomic<bool> enough = false;
    Control control = control_;
    control.progress = [&](const Progress&) {
        if (isStopped(control_)) enough = true;
    };
    control.stop = &enough;
    control.keep_failing_state = false;
    control.groups = 1;
    control.interval = false;
    control.upper_bound = Beside::never;
    Model on_this_mesh = model;
    if (on_this_mesh.flow) on_this_mesh.flow->refines = false;
    Search other(varied_, std::make_shared<const Model>(std::move(on_this_mesh)), control, rules_);
    other.most_factors_ = kLeastEffort + factors_of_answer_;
    other.enough_ = &enough;
    Result<SearchResult> result = other.run();
    if (result && result->factors > other.most_factors_) result->status = SearchStatus::interrupted;
    return result;
}

Search::OtherAnswer Search::addAnswerOf(const Model& model, const std::string& what) {
    report("the interval", kPath, what);
    const Result<SearchResult> other = answerOf(model);
    if (!other) return {};
    if (other->status == SearchStatus::interrupted)
        result_.answer_interval_reasons.first +=
            "; with " + what + " not completed, because it takes more work than the answer";
    result_.steps += other->steps;
    result_.factors += other->factors;
    auto& [low, high] = *result_.answer_interval;
    auto& [low_reason, high_reason] = result_.answer_interval_reasons;
    if (other->status == SearchStatus::unstable_at_start) {
        low = std::min(low, axis_->start);
        low_reason = what + ": unstable at the start";
    } else if (other->status == SearchStatus::undecided) {
        low_reason += "; with " + what + " undecided";
    }
    if (other->status != SearchStatus::found) return {};
    const double margin = kElasticEffect * std::abs(result_.answer);
    if (std::abs(other->answer - result_.answer) <= margin) return {true, false, other->answer};
    if (other->answer < low) low = other->answer, low_reason = what;
    if (other->answer > high) high = other->answer, high_reason = what;
    return {true, true, other->answer};
}

const State& Search::lastEquilibrium(const Course& course) const {
    return course.followed.stood ? course.followed.stood->state : course.path->state();
}

void Search::addClosedParts(const Course& course, bool turns) {
    const PointRule::Kind rule = model_.points.kind;
    if (rule == PointRule::Kind::distributed) return;
    const double open =
        checks::openCohesion(lastEquilibrium(course), numbersOf(*rest_, result_.moving_blocks));
    // Four points bear a load anywhere between them: none opens.
    const bool bears_anywhere = rule == PointRule::Kind::corner || rule == PointRule::Kind::quarter;
    const bool has_cohesion = std::any_of(rest_->joints.begin(), rest_->joints.end(),
                                          [](const Joint& joint) { return joint.cohesion > 0; });
    const bool coheres = open > checks::kLeastOpenCohesion || (bears_anywhere && has_cohesion);
    if (!coheres && !(turns && rule == PointRule::Kind::vertex)) return;
    Model distributed = model_;
    distributed.points.kind = PointRule::Kind::distributed;
    const std::string what = std::string("pressure ") + (coheres ? "and cohesion " : "") +
                             "over the closed part of elastic joints";
    const OtherAnswer other = addAnswerOf(distributed, what);
    closed_parts_known_ = other.is_found;
    if (other.differs && coheres)
        result_.warnings.push_back("joints with cohesion are open in part: with " + what + " the answer is " +
                                   axis().say(other.value));
}

void Search::warnOfOpenCohesion(const Course& course) {
    const bool dilates = std::any_of(rest_->joints.begin(), rest_->joints.end(),
                                     [](const Joint& joint) { return joint.dilation > 0; });
    if (result_.status == SearchStatus::interrupted || (closed_parts_known_ && !dilates)) return;
    auto warning = checks::ofOpenCohesion(lastEquilibrium(course), numbersOf(*rest_, result_.moving_blocks));
    if (warning) result_.warnings.push_back(std::move(*warning));
}

void Search::addElasticity(const Course& course) {
    const bool turns = result_.mode == FailureMode::toppling || result_.mode == FailureMode::mixed;
    if (isStopped(control_)) return;
    addClosedParts(course, turns);
    if (!turns || isStopped(control_) || !course.followed.stood) return;
    const State& stood = course.followed.stood->state;
    const double moved =
        largestMotion(stood, stood.geometry->initial_position, stood.geometry->initial_orientation);
    if (moved < kLeans * stood.geometry->length_scale) return;
    Model stiff = model_;
    for (Joint& joint : stiff.joints) {
        joint.normal_stiffness *= kStiffer;
        joint.shear_stiffness *= kStiffer;
    }
    const std::string what = "joints ten times as stiff";
    if (const OtherAnswer other = addAnswerOf(stiff, what); other.differs)
        result_.warnings.push_back("the answer depends on the stiffness of the joints: with " + what +
                                   " it is " + axis().say(other.value));
}

void Search::addInterval(const Course& course) {
    if (result_.status != SearchStatus::found) return;
    result_.answer_interval = std::pair(result_.answer, result_.answer);
    addBounds();
    if (const auto& limit = result_.limit_equilibrium)
        lowerInterval(limit->value,
                      "limit equilibrium, " + (limit->translation_only ? "translation only" : limit->kind));
    if (!control_.interval || isStopped(control_)) return;
    factors_of_answer_ = result_.factors;
    addUnloadedJoints(course);
    addElasticity(course);
}

}  // namespace talus::search
