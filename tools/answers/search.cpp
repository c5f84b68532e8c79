#include "answers/search.h"

#include <limits>

#include "answers/stiffer_joints.h"
#include "cli/scenario.h"

namespace talus::tools {

namespace {

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
    CeiledAnswer found = valueOf(findUnderCeiling(search, scenario, request.ceiling, control), scenario);
    const bool interrupted = found.result.status == SearchStatus::interrupted;
    auto theory = interrupted ? std::nullopt : search.theory(scenario.model, control.stop);
    SearchReport report{common,        scenario,       search, std::move(found.result), std::move(theory),
                        found.ceiling, found.stiffness};
    const auto stopped = [&] { return control.stop != nullptr && control.stop->load(); };
    report.cut_short = !interrupted && stopped();
    if (!keeper.wanted()) return report;
    report.kept = keeper.keep(report.result, search, report.stiffness, control);
    // A file that cannot be written ends its run by the same flag.
    if (report.kept->exit_code != kFileRefused) report.cut_short = !interrupted && stopped();
    return report;
}

}  // namespace talus::tools
