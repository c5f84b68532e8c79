// Scenarios for Python: read from a file or from text, with places for messages.

#include <pybind11/stl.h>

#include <optional>

#include "cli/failures.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "python/computing.h"
#include "python/module.h"
#include "report/blocks_files.h"
#include "schemas/schemas.h"
#include "talus/simulation.h"

namespace talus::python {

namespace {

std::vector<std::string> blockNames(const formats::Scenario& scenario) {
    std::vector<std::string> names;
    for (const Block& block : scenario.model.blocks) names.push_back(block.name);
    return names;
}

/// Reading may take long, where rock is cut into many blocks.
template <class Read>
formats::Scenario interruptible(const Read& read) {
    std::optional<Result<formats::Scenario>> result;
    compute({}, [&](Computing& computing) { result.emplace(read(&computing.stop())); });
    return tools::valueOf(std::move(*result));
}

/// As `talus blocks` draws them.
std::string picture(const formats::Scenario& scenario, double azimuth_deg, double elevation_deg) {
    return tools::blocksSvg(scenario.model, {talus::radians(azimuth_deg), talus::radians(elevation_deg)},
                            scenario.path);
}

/// The checks of `talus validate` beyond reading: overlaps, water on no face, pairs that do not touch.
void check(const formats::Scenario& scenario, const py::object& threads) {
    compute({threadsOf(threads)}, [&](Computing& computing) {
        const std::vector<Error> errors =
            formats::placed(scenario, checkModel(scenario.model, computing.control()));
        if (!errors.empty()) throw tools::BadInput(errors);
    });
}

}  // namespace

void addScenarios(py::module_& module) {
    py::class_<formats::Scenario>(module, "Scenario")
        .def_readonly("path", &formats::Scenario::path)
        .def_readonly("text", &formats::Scenario::text)
        .def_readonly("warnings", &formats::Scenario::warnings)
        .def_property_readonly("blocks", blockNames)
        .def("picture", picture, py::arg("azimuth_deg"), py::arg("elevation_deg"))
        .def("check", check, py::arg("threads"));
    module.def("scenario_schema", [] { return tools::kScenarioSchema; });
    module.def(
        "read",
        [](const std::string& path) {
            return interruptible(
                [&](const std::atomic<bool>* stop) { return formats::readScenario(path, stop); });
        },
        py::arg("path"));
    module.def(
        "parse",
        [](const std::string& text, const std::string& path) {
            return interruptible([&](const std::atomic<bool>* stop) {
                return formats::parseScenario(text, path, formats::kMostBlocks, stop);
            });
        },
        py::arg("text"), py::arg("path"));
}

}  // namespace talus::python
