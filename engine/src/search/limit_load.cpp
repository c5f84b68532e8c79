#include "search/limit_load.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "state/caller.h"
#include "talus/block_theory.h"
#include "talus/searches.h"

namespace talus::search {
namespace {

// Of the search's tolerance. A closed formula shall show how far the answer is from it.
constexpr double kOfTolerance = 0.01;

// A factor of safety of 0.5. Near a tilt of 90 degrees the true reserve falls without bound. False position
// would then halve it dozens of times before that end moves.
constexpr double kLeastReserve = -1;

/// The model under loads, each judged by block theory.
class Groups {
 public:
    explicit Groups(const LimitQuestion& question) : question_(question) {}

    /// Nothing where the model cannot be judged at this load.
    std::optional<KeyBlockResult> at(double load) const {
        Model model = question_.model;
        putUnderLoad(model, question_.varied, load);
        Control control = question_.control;
        control.progress = {};
        auto found = keyBlocks(model, control, {.factor_volume = false});
        if (!found || found->interrupted) return std::nullopt;
        return std::move(*found);
    }

    /// The group with the least factor of those that have enough mass.
    std::optional<MovingGroup> weakest(KeyBlockResult all) const {
        const auto group = std::find_if(all.groups.begin(), all.groups.end(), [&](const MovingGroup& one) {
            const double factor = one.sliding.factor;
            return factor > 0 && std::isfinite(factor) && one.mass >= question_.least_mass;
        });
        if (group == all.groups.end()) return std::nullopt;
        return std::move(*group);
    }

 private:
    const LimitQuestion& question_;
};

LimitEquilibrium limitOf(double value, MovingGroup group) {
    const bool wedge = group.sliding.mode == SlidingMode::wedge;
    return {value, wedge ? "sliding along two planes" : "sliding on one plane", std::move(group.blocks)};
}

/// A load, and 1 less driving over resisting force of the weakest group there: 1 where none slides. It is
/// kLeastReserve at least.
struct Trial {
    double load = 0, reserve = 1;
    std::optional<MovingGroup> group{};
};

std::optional<Trial> tryLoad(const Groups& groups, double load) {
    auto all = groups.at(load);
    if (!all) return std::nullopt;
    Trial trial{load, 1.0, groups.weakest(std::move(*all))};
    if (trial.group) trial.reserve = std::max(kLeastReserve, 1 - 1 / trial.group->sliding.factor);
    return trial;
}

/// Narrows [stands, slides] by false position with halved ends (Illinois; Dowell and Jarratt 1971). Trials
/// keep half a tolerance off both ends: one close to an end says nothing about the other.
std::optional<LimitEquilibrium> narrowed(const Groups& groups, Trial stands, Trial slides, double tolerance) {
    double of_stands = stands.reserve, of_slides = slides.reserve;
    while (slides.load - stands.load > tolerance) {
        const double share = of_stands / (of_stands - of_slides);
        auto trial =
            tryLoad(groups, std::clamp(std::lerp(stands.load, slides.load, share),
                                       stands.load + 0.5 * tolerance, slides.load - 0.5 * tolerance));
        if (!trial) return std::nullopt;
        if (trial->reserve > 0) {
            of_slides *= 0.5;
            of_stands = trial->reserve;
            stands = std::move(*trial);
        } else {
            of_stands *= 0.5;
            of_slides = trial->reserve;
            slides = std::move(*trial);
        }
    }
    const double share = stands.reserve / (stands.reserve - slides.reserve);
    return limitOf(std::lerp(stands.load, slides.load, share), *std::move(slides.group));
}

std::optional<LimitEquilibrium> leastFactor(const Groups& groups) {
    auto all = groups.at(1);
    auto group = all ? groups.weakest(std::move(*all)) : std::nullopt;
    if (!group) return std::nullopt;
    const double factor = group->sliding.factor;
    return limitOf(factor, std::move(*group));
}

}  // namespace

std::optional<LimitEquilibrium> limitEquilibriumOf(const LimitQuestion& question, const LoadAxis& axis,
                                                   double answer) {
    const Groups groups(question);
    if (question.varied == Varied::factor) return leastFactor(groups);
    auto stands = tryLoad(groups, axis.start);
    if (!stands || !(stands->reserve > 0)) return std::nullopt;
    auto slides = tryLoad(groups, answer);
    while (slides && slides->reserve > 0) {
        if (!(slides->load < axis.stop)) return std::nullopt;
        const double next = std::min(axis.stop, slides->load + (slides->load - axis.start));
        stands = std::move(slides);
        slides = tryLoad(groups, next);
    }
    if (!slides) return std::nullopt;
    return narrowed(groups, std::move(*stands), std::move(*slides), kOfTolerance * axis.loading.cell);
}

std::optional<std::string> nothingCanSlide(const LimitQuestion& question, double load) {
    const auto all = Groups(question).at(load);
    if (!all) return std::nullopt;
    const auto moves = [](const auto& body) { return body.sliding.mode != SlidingMode::none; };
    if (std::any_of(all->blocks.begin(), all->blocks.end(), moves) ||
        std::any_of(all->groups.begin(), all->groups.end(), moves))
        return std::nullopt;
    const bool removable = std::any_of(all->blocks.begin(), all->blocks.end(),
                                       [](const KeyBlock& block) { return block.removable; });
    return std::string(removable ? "no block can slide or fall, alone or with others"
                                 : "no block can leave: neighbours hold each of them in") +
           " (block theory, translation only): less strength would not change that";
}

}  // namespace talus::search
