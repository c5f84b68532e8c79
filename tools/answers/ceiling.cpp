#include "answers/ceiling.h"

#include <CLI/CLI.hpp>

#include "cli/scenario.h"
#include "cli/text.h"
#include "talus/searches.h"

namespace talus::tools {

std::string shortLoadText(double value, Varied load) {
    const VariedQuantity& quantity = quantityOf(load);
    const std::string figure = text(value / quantity.scale, quantity.decimals);
    return *quantity.unit != '\0' ? figure + " " + quantity.unit : quantity.name + (" " + figure);
}

void addCeiling(CLI::App& app, CeilingOptions& options) {
    CLI::Option* never = app.add_flag("--no-ceiling", options.never, "Leave limit analysis out");
    app.add_flag("--ceiling", options.always,
                 "Limit analysis beside the answer whatever the size (default: up to " +
                     std::to_string(kCeilingPointsInSection) + " contact points in a plane section, " +
                     std::to_string(kCeilingPoints) + " in space)")
        ->excludes(never);
}

Ceiling findCeiling(const formats::Scenario& scenario, Varied load, const CeilingOptions& options,
                    const SearchResult& result, const Control& control) {
    if (options.never) return {std::nullopt, "not wanted (--no-ceiling)"};
    if (result.status == SearchStatus::interrupted) return {std::nullopt, "the search was interrupted"};
    LimitSettings settings;
    settings.left_out = leftOut(result);  // the answer is for the others
    return valueOf(limitCeiling(scenario.model, load, options.always, control, settings), scenario);
}

void holdUnder(const Ceiling& ceiling, Varied load, SearchResult& result) {
    if (!isAbove(result.low, ceiling, load)) return;
    result.status = SearchStatus::undecided;
    result.warnings.push_back("the answer is wrong: the search has it stand at " +
                              shortLoadText(result.low, load) + ", above the ceiling of limit analysis, " +
                              shortLoadText(*ceiling.value, load));
}

}  // namespace talus::tools
