#include "answers/search.h"

#include "cli/scenario.h"

namespace talus::tools {

SearchReport answer(const LoadSearch& search, const formats::Scenario& scenario, const SearchRequest& request,
                    const Common& common, Control control) {
    requireFreeBlock(scenario);
    refuseSearchFiles(request.files);
    FailureKeeper keeper(request.keep, common, scenario);
    control.keep_failing_state = keeper.wanted();
    control.groups = request.groups;
    control.interval = request.interval;
    control.upper_bound = request.upper_bound;
    SearchResult found = valueOf(search.find(scenario.model, control, {}), scenario);
    const bool interrupted = found.status == SearchStatus::interrupted;
    auto theory = interrupted ? std::nullopt : search.theory(scenario.model, control.stop);
    SearchReport report{common, scenario, search, std::move(found), std::move(theory)};
    const auto stopped = [&] { return control.stop != nullptr && control.stop->load(); };
    report.cut_short = !interrupted && stopped();
    report.drawn = drawSearchFiles(request.files, search, report.result, scenario);
    for (const DrawnFile& drawn : report.drawn)
        if (drawn.exit_code != kDone) note(common, "error: " + drawn.reason);
    if (!keeper.wanted()) return report;
    report.kept = keeper.keep(report.result, search, control);
    // A file that cannot be written ends its run by the same flag.
    if (report.kept->exit_code != kFileRefused) report.cut_short = !interrupted && stopped();
    return report;
}

}  // namespace talus::tools
