// The report about a slope: the page, the figures and the JSON of `talus report`, called from Python.

#include <pybind11/stl.h>

#include "cli/failures.h"
#include "cli/json.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "python/computing.h"
#include "python/module.h"
#include "slope_report/slope_report.h"

namespace talus::python {

namespace {

using namespace tools;

std::string reportOf(const formats::Scenario& scenario, const std::string& output, const std::string& figures,
                     const SlopeReportRequest& request, const Manner& manner) {
    if (request.sensitivity && !isSensitivity(*request.sensitivity)) {
        throw BadInput(Error{"sensitivity", "found " + text(100 * *request.sensitivity, 1) +
                                                ", allowed: more than 0 and at most 90 percent"});
    }
    requireFreeBlock(scenario);
    SlopeReportFiles files = slopeReportFiles(output, figures);
    refuseSlopeReportFiles(files);
    std::string json;
    compute(manner, [&](Computing& computing) {
        const Common common{.json = true, .quiet = true, .threads = manner.threads};
        const auto computed = computeSlopeReport(scenario, request, common, computing.control());
        if (!computed) return;  // stopped: compute() raises KeyboardInterrupt
        writeSlopeReport(*computed, files);
        json = jsonText(slopeReportJson(*computed, files));
    });
    return json;
}

}  // namespace

void addReport(py::module_& module) {
    module.def(
        "report",
        [](const formats::Scenario& scenario, const std::string& output, const std::string& figures,
           const std::string& analysis, const std::string& slope, int groups,
           std::optional<double> sensitivity, const py::object& threads, const py::object& progress) {
            SlopeReportRequest request{analysis, slope, groups, {}};
            if (sensitivity) request.sensitivity = *sensitivity / 100;
            return reportOf(scenario, output, figures, request, {threadsOf(threads), progress});
        },
        py::arg("scenario"), py::kw_only(), py::arg("output"), py::arg("figures"), py::arg("analysis"),
        py::arg("slope"), py::arg("groups"), py::arg("sensitivity"), py::arg("threads"), py::arg("progress"));
}

}  // namespace talus::python
