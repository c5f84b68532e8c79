#include "answers/search.h"

#include <limits>

#include "cli/scenario.h"

namespace talus::tools {

namespace {

/// Of what the answer is for.
Ceiling ceilingOf(const formats::Scenario& scenario, Varied load, const CeilingOptions& options,
                  const SearchResult& result, const Control& control) {
    const std::vector<std::string> others = leftOut(result);
    if (others.empty()) return findCeiling(scenario, load, options, result, control);
    formats::Scenario rest = scenario;
    rest.model = withoutBlocks(scenario.model, others);
    return findCeiling(rest, load, options, result, control);
}

std::size_t mostPointsOfRange(const RangeOptions& range) {
    if (range.never) return 0;
    return range.always ? std::numeric_limits<std::size_t>::max() : kMostPointsOfRange;
}

}  // namespace

SearchReport answer(const LoadSearch& search, const formats::Scenario& scenario, const SearchRequest& request,
                    const Common& common, Control control) {
    FailureKeeper keeper(request.keep, common, scenario);
    control.keep_failing_state = keeper.wanted();
    control.groups = request.groups;
    control.most_points_of_range = mostPointsOfRange(request.range);
    SearchResult result = valueOf(search.find(scenario.model, control, {}), scenario);
    const Ceiling ceiling = ceilingOf(scenario, search.load->varied, request.ceiling, result, control);
    holdUnder(ceiling, search.load->varied, result);
    const bool interrupted = result.status == SearchStatus::interrupted;
    auto theory = interrupted ? std::nullopt : search.theory(scenario.model, control.stop);
    SearchReport report{common, scenario, search, std::move(result), std::move(theory), ceiling};
    const auto stopped = [&] { return control.stop != nullptr && control.stop->load(); };
    report.cut_short = !interrupted && stopped();
    if (!keeper.wanted()) return report;
    report.kept = keeper.keep(report.result, search, control);
    // A file that cannot be written ends its run by the same flag.
    if (report.kept->exit_code != kFileRefused) report.cut_short = !interrupted && stopped();
    return report;
}

}  // namespace talus::tools
