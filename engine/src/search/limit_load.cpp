#include "search/limit_load.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "block_theory/column_row.h"
#include "build/build.h"
#include "measure/natural_order.h"
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

constexpr double kWeakestRow = 0.01;  // of safety: a row of columns with less is given no factor
constexpr int kStepsDown = 10;  // from an answer to the start, where a stable row of columns is looked for

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
    return {.value = value,
            .kind = wedge ? "sliding along two planes" : "sliding on one plane",
            .blocks = std::move(group.blocks)};
}

/// A load, and what is left there: above 0 while the slope is stable, below where it fails.
struct Trial {
    double load = 0, reserve = 1;
    std::optional<LimitEquilibrium> limit{};  ///< what fails or would fail; `value` is not set
};

/// Nothing where the model cannot be judged at this load.
using TryLoad = std::function<std::optional<Trial>(double load)>;

/// The reserve is 1 less driving over resisting force of the weakest group: 1 where none slides. It is
/// kLeastReserve at least.
std::optional<Trial> tryGroups(const Groups& groups, double load) {
    auto all = groups.at(load);
    if (!all) return std::nullopt;
    Trial trial{.load = load};
    auto group = groups.weakest(std::move(*all));
    if (!group) return trial;
    trial.reserve = std::max(kLeastReserve, 1 - 1 / group->sliding.factor);
    trial.limit = limitOf(0, *std::move(group));
    return trial;
}

/// The row of columns of a model at a load. Nothing where it is none.
std::optional<keyblocks::ColumnRow> rowAt(const LimitQuestion& question, double load) {
    Model model = question.model;
    putUnderLoad(model, question.varied, load);
    Control control = question.control;
    control.progress = {};
    auto state = buildState(keptByCaller(model), control.threads != 1, control);
    return state && !isStopped(control) ? keyblocks::columnRow(*state) : std::nullopt;
}

LimitEquilibrium limitOf(const Model& model, const keyblocks::ColumnRow& row,
                         const keyblocks::LeaningState& leaning) {
    LimitEquilibrium limit;
    limit.kind =
        leaning.topples ? "toppling of columns (Goodman and Bray)" : "sliding of columns (Goodman and Bray)";
    limit.translation_only = false;
    for (std::size_t k = 0; k < leaning.moving; ++k) limit.blocks.push_back(model.blocks[row.blocks[k]].name);
    sortNaturally(limit.blocks);
    return limit;
}

/// The reserve is that of the toe column.
std::optional<Trial> tryColumns(const Model& model, const std::optional<keyblocks::ColumnRow>& row,
                                double load, double factor) {
    const auto leaning = row ? keyblocks::leaningAt(row->columns, factor) : std::nullopt;
    if (!leaning) return std::nullopt;
    return Trial{load, -leaning->excess, limitOf(model, *row, *leaning)};
}

/// Narrows [stands, fails] by false position with halved ends (Illinois; Dowell and Jarratt 1971). Trials
/// keep half a tolerance off both ends: one close to an end says nothing about the other.
std::optional<LimitEquilibrium> narrowed(const TryLoad& tryLoad, Trial stands, Trial fails,
                                         double tolerance) {
    double of_stands = stands.reserve, of_fails = fails.reserve;
    while (fails.load - stands.load > tolerance) {
        const double share = of_stands / (of_stands - of_fails);
        auto trial = tryLoad(std::clamp(std::lerp(stands.load, fails.load, share),
                                        stands.load + 0.5 * tolerance, fails.load - 0.5 * tolerance));
        if (!trial) return std::nullopt;
        if (trial->reserve > 0) {
            of_fails *= 0.5;
            of_stands = trial->reserve;
            stands = std::move(*trial);
        } else {
            of_stands *= 0.5;
            of_fails = trial->reserve;
            fails = std::move(*trial);
        }
    }
    const double share = stands.reserve / (stands.reserve - fails.reserve);
    LimitEquilibrium limit = *std::move(fails.limit);
    limit.value = std::lerp(stands.load, fails.load, share);
    return limit;
}

/// From a load where the slope is stable up to one where it fails, and between them.
std::optional<LimitEquilibrium> limitAbove(const TryLoad& tryLoad, const LoadAxis& axis,
                                           std::optional<Trial> stands, double answer) {
    if (!stands || !(stands->reserve > 0)) return std::nullopt;
    const double first = stands->load;
    auto fails = tryLoad(answer);
    while (fails && fails->reserve > 0) {
        if (!(fails->load < axis.stop)) return std::nullopt;
        const double next = std::min(axis.stop, fails->load + (fails->load - first));
        stands = std::move(fails);
        fails = tryLoad(next);
    }
    if (!fails) return std::nullopt;
    return narrowed(tryLoad, std::move(*stands), std::move(*fails), kOfTolerance * axis.loading.cell);
}

/// The nearest load below the answer at which the slope is stable. Far below it a row of columns may lock, so
/// that it cannot be judged.
std::optional<Trial> stableBelow(const TryLoad& tryLoad, double first, double answer) {
    for (int k = kStepsDown - 1; k >= 0; --k) {
        auto trial = tryLoad(std::lerp(first, answer, static_cast<double>(k) / kStepsDown));
        if (!trial || trial->reserve > 0) return trial;
    }
    return std::nullopt;
}

std::optional<LimitEquilibrium> leastFactor(const Groups& groups) {
    auto all = groups.at(1);
    auto group = all ? groups.weakest(std::move(*all)) : std::nullopt;
    if (!group) return std::nullopt;
    const double factor = group->sliding.factor;
    return limitOf(factor, std::move(*group));
}

std::optional<LimitEquilibrium> limitOfGroups(const LimitQuestion& question, const LoadAxis& axis,
                                              double answer) {
    const Groups groups(question);
    if (question.varied == Varied::factor) return leastFactor(groups);
    const TryLoad tryLoad = [&](double load) { return tryGroups(groups, load); };
    return limitAbove(tryLoad, axis, tryLoad(axis.start), answer);
}

std::optional<LimitEquilibrium> limitOfColumns(const LimitQuestion& question, const LoadAxis& axis,
                                               double answer) {
    const Model& model = question.model;
    const bool is_factor = question.varied == Varied::factor;
    const auto built = is_factor ? rowAt(question, 1) : std::nullopt;
    const TryLoad tryLoad = [&](double load) {
        return is_factor ? tryColumns(model, built, load, load)
                         : tryColumns(model, rowAt(question, load), load, 1);
    };
    // On a level base no side is downhill.
    const double first = is_factor ? kWeakestRow : axis.start + axis.loading.cell;
    return limitAbove(tryLoad, axis, stableBelow(tryLoad, first, answer), answer);
}

}  // namespace

std::optional<LimitEquilibrium> limitEquilibriumOf(const LimitQuestion& question, const LoadAxis& axis,
                                                   double answer) {
    auto groups = limitOfGroups(question, axis, answer), columns = limitOfColumns(question, axis, answer);
    if (!groups || (columns && columns->value < groups->value)) return columns;
    return groups;
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
