#include <algorithm>
#include <cmath>
#include <utility>

#include "checks/loose_blocks.h"
#include "checks/water_warnings.h"
#include "failure/failure.h"
#include "frame/frame.h"
#include "measure/measure.h"
#include "measure/natural_order.h"
#include "search/search_run.h"
#include "search/search_warnings.h"
#include "state/block_motion.h"
#include "state/incidence.h"

namespace talus::search {
namespace {

using checks::movingBlocks;

// Of the answer: nearer answers count as equal.
constexpr double kSameAnswer = 1.0;  // cells

}  // namespace

BlockGroup Search::groupOf(const std::vector<std::size_t>& blocks, double load) const {
    BlockGroup group{.factor = load, .low = load, .high = load};
    for (const std::size_t b : blocks) {
        group.blocks.push_back(rest_->blocks[b].name);
        group.mass += built_->blocks.mass[b];
        group.volume += built_->blocks.mass[b] / rest_->blocks[b].density;
    }
    sortNaturally(group.blocks);
    return group;
}

void Search::effort(const EquilibriumPath& path) {
    result_.steps += path.work().steps - counted_.steps;
    result_.factors += path.work().factors - counted_.factors;
    counted_ = path.work();
    if (enough_ != nullptr && result_.factors > most_factors_) enough_->store(true);
}

Result<SearchResult> Search::interruptedBefore() {
    result_.status = SearchStatus::interrupted;
    result_.low = -kInfinity;
    result_.high = kInfinity;
    result_.blocks = model_.blocks.size();
    return std::move(result_);
}

void Search::finish(Course& course) {
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
                                   (has_begun
                                        ? "beyond " + axis().say(result_.low)
                                        : "while the " + std::string(course.begun.stage) + " is applied"));
    }
    if (result_.status == SearchStatus::found) result_.answer = 0.5 * (result_.low + result_.high);
    result_.path = std::move(course.followed.points);
    result_.probes = std::move(course.followed.probes);
    addDisplacements(course.followed);
    addCoupling(course);
    describe(course, has_begun);
}

void Search::addCoupling(const Course& course) {
    if (!coupled_) return;
    const Followed& followed = course.followed;
    const State& last = followed.stood ? followed.stood->state : course.path->state();
    result_.flow_coupling = coupled_->coupling(last);
    for (std::string& warning : checks::ofCoupling(*coupled_, last))
        result_.warnings.push_back(std::move(warning));
}

void Search::addDisplacements(const Followed& followed) {
    if (result_.status != SearchStatus::found) return;
    for (std::size_t k = 0; k < followed.by_displacement.size(); ++k) {
        const auto& bracket = followed.by_displacement[k];
        if (!bracket || k == counts_) continue;
        const double load = 0.5 * (bracket->stands + bracket->fails);
        if (std::abs(load - result_.answer) > kSameAnswer * axis().loading.cell)
            result_.answers_by_displacement.push_back({displacements_[k], load});
    }
}

void Search::describe(Course& course, bool has_begun) {
    const bool fails =
        result_.status == SearchStatus::found || result_.status == SearchStatus::unstable_at_start;
    const Followed& followed = course.followed;
    State last = followed.failing              ? *followed.failing
                 : has_begun && followed.stood ? followed.stood->state
                                               : course.path->state();
    if (followers_) followers_->put(last.blocks);
    if (fails) {
        const bool is_seen = followed.failing.has_value();
        const PositionArray& position = is_seen ? followed.since.poses().position : built_->blocks.position;
        const QuaternionArray& orientation =
            is_seen ? followed.since.poses().orientation : built_->blocks.orientation;
        // Elastic displacement is not counted as motion, as long as blocks move farther than that.
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
        result_.lost_strength = lostStrength(last);
    }
    result_.supports = supportReports(last);
    result_.state_hash = stateHash(last);
    result_.blocks = last.blocks.size();
    const ContactCount contacts = countContacts(last.interfaces);
    result_.interfaces = contacts.interfaces;
    result_.contact_points = contacts.points;
    const bool alike = gone_ == std::vector<char>(gone_.size(), 0) && result_.removed_groups.empty();
    if (fails && control_.keep_failing_state && alike) keepFailing(course, last);
    for (std::string& warning : searchWarnings(*built_, last, fails, !has_begun))
        result_.warnings.push_back(std::move(warning));
    if (result_.status == SearchStatus::unstable_at_start)
        if (auto pushed = checks::pushedByWater(*built_, movingBlocks(*built_, last)))
            result_.warnings.push_back(std::move(*pushed));
    nameFallen();
}

void Search::keepFailing(Course& course, const State& last) {
    auto failing = std::make_shared<FailingState>();
    const bool has_begun = course.begun.result == PathResult::reached;
    const Followed& followed = has_begun ? course.followed : course.begun.followed;
    failing->load = result_.status == SearchStatus::found ? result_.high + kPlayedBeyond * axis().loading.cell
                                                          : axis().start;
    if (followed.stood) {
        course.path->goBack(*followed.stood);
        course.path->putUnder(has_begun ? failing->load : 1.0);  // before the search begins loads are shares
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

void Search::nameFallen() {
    for (std::size_t b = 0; b < gone_.size(); ++b)
        if (gone_[b]) result_.fallen_at_start.push_back(model_.blocks[b].name);
    if (result_.fallen_at_start.empty()) return;
    sortNaturally(result_.fallen_at_start);
    const auto counted = [](std::size_t n, const char* one, const char* more) {
        return std::to_string(n) + (n == 1 ? one : more);
    };
    std::string what;
    if (fallen_ > 0)
        what = counted(fallen_, " block falls", " blocks fall") + " at the start whatever the strength";
    if (slivers_ > 0)
        what += (what.empty() ? "" : ", and ") + counted(slivers_, " block is an ill-conditioned sliver",
                                                         " blocks are ill-conditioned slivers");
    result_.warnings.push_back(what + " (for example " + result_.fallen_at_start.front() +
                               "): the answer does not include them");
}

}  // namespace talus::search
