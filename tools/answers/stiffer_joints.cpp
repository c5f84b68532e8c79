#include "answers/stiffer_joints.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/text.h"

namespace talus::tools {

namespace {

// Ways to rest are in proportion to what joints give; with a thousandth of that blocks stay where they are.
constexpr double kStiffer[] = {1000, 100, 10};
constexpr double kBegins = 0.9;  // share of the progress: the first search takes as long, but is done

formats::Scenario withStiffness(const formats::Scenario& scenario, double factor) {
    formats::Scenario stiffer = scenario;
    for (Joint& joint : stiffer.model.joints) joint = stiffened(std::move(joint), factor);
    return stiffer;
}

bool isAllowed(const Model& model) {
    const Interval allowed = propertyOf(&Joint::normal_stiffness).allowed;
    return std::all_of(model.joints.begin(), model.joints.end(), [&](const Joint& joint) {
        return std::max(joint.normal_stiffness, joint.shear_stiffness) <= allowed.max;
    });
}

/// Of what the answer is for.
Ceiling ceilingOf(const formats::Scenario& scenario, Varied load, const CeilingOptions& options,
                  const SearchResult& result, const Control& control) {
    const std::vector<std::string> others = leftOut(result);
    if (others.empty()) return findCeiling(scenario, load, options, result, control);
    formats::Scenario rest = scenario;
    rest.model = withoutBlocks(scenario.model, others);
    return findCeiling(rest, load, options, result, control);
}

void addCost(const SearchResult& of, SearchResult& result) {
    result.steps += of.steps;
    result.factors += of.factors;
    result.time += of.time;
    result.wall_seconds += of.wall_seconds;
}

/// How far the blocks went from rest to rest [m].
double wayOf(const SearchResult& result) {
    double way = 0;
    for (const Probe& probe : result.probes)
        if (probe.verdict == Verdict::stable) way += probe.displacement;
    return way;
}

/// The joints as given may fail before, where weight is brought on at the load: the range begins there, too.
/// \return what that says to whoever counts on the answer
std::string takeLowerEnd(const SearchResult& given, Varied load, SearchResult& result) {
    constexpr double kWorthSaying = 0.01;  // of the answer
    const auto [low, high] = result.range.value_or(std::pair(result.answer, result.answer));
    if (!given.range || given.range->first >= low) return "";
    result.range = {given.range->first, high};
    result.range_reason =
        shortLoadText(given.range->first, load) + " with joints as soft as given: " + given.range_reason;
    const double below = result.answer - given.range->first;
    return below > kWorthSaying * std::abs(result.answer)
               ? "; count on the lower end of the range unless the load grows as the search has it"
               : "";
}

void explain(const SearchResult& given, Varied load, CeiledAnswer& answer) {
    answer.result.warnings.push_back(
        "the answer is for joints of " + text(answer.stiffness, 0) +
        " times the stiffness given, with which the blocks stay where they were built: with that given they "
        "move by " +
        text(wayOf(given), 2) + " m from rest to rest, to a slope of another shape that stands at " +
        shortLoadText(given.low, load) + ", above the ceiling" + takeLowerEnd(given, load, answer.result));
}

}  // namespace

CeiledAnswer heldUnderCeiling(const LoadSearch& search, const formats::Scenario& scenario,
                              SearchResult result, const CeilingOf& ceiling_of, const Control& control) {
    const Varied load = search.load->varied;
    Ceiling ceiling = ceiling_of(scenario, result);
    if (!isAbove(result.low, ceiling, load)) return {std::move(result), std::move(ceiling)};
    Control again = control;
    if (control.progress) {
        again.progress = [&](const Progress& progress) {
            control.progress(
                {"with stiffer joints", kBegins + (1 - kBegins) * progress.fraction, progress.detail});
        };
    }
    for (const double factor : kStiffer) {
        const formats::Scenario stiffer = withStiffness(scenario, factor);
        if (!isAllowed(stiffer.model)) continue;
        Result<SearchResult> found = search.find(stiffer.model, again, {});
        if (control.stop != nullptr && control.stop->load()) {
            result.status = SearchStatus::interrupted;
            return {std::move(result), {std::nullopt, "the search was interrupted"}};
        }
        if (!found) continue;  // so stiff that rounding would move blocks
        CeiledAnswer answer{std::move(*found), {}, factor};
        answer.ceiling = ceiling_of(stiffer, answer.result);
        const bool is_below = answer.result.status == SearchStatus::found && answer.ceiling.value &&
                              !isAbove(answer.result.low, answer.ceiling, load);
        addCost(is_below ? result : answer.result, is_below ? answer.result : result);
        if (!is_below) continue;
        explain(result, load, answer);
        return answer;
    }
    holdUnder(ceiling, load, result);
    return {std::move(result), std::move(ceiling)};
}

Result<CeiledAnswer> findUnderCeiling(const LoadSearch& search, const formats::Scenario& scenario,
                                      const CeilingOptions& options, const Control& control) {
    Result<SearchResult> found = search.find(scenario.model, control, {});
    if (!found) return found.errors();
    const auto ceiling_of = [&](const formats::Scenario& of, const SearchResult& result) {
        return ceilingOf(of, search.load->varied, options, result, control);
    };
    return heldUnderCeiling(search, scenario, std::move(*found), ceiling_of, control);
}

}  // namespace talus::tools
