// Kinematic analysis: the computation and the JSON of `talus kinematics`, called from Python.

#include <pybind11/stl.h>

#include "answers/kinematics.h"
#include "cli/failures.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/outputs.h"
#include "cli/text.h"
#include "python/computing.h"
#include "python/module.h"

namespace talus::python {

namespace {

using namespace tools;

using Pair = std::pair<double, double>;  ///< of angles [deg]

struct Wish {
    Pair slope;
    double friction, lateral;
    std::size_t sets;
    std::optional<Pair> scanline;
    std::optional<double> bias_limit;
    std::string stereonet;
    NetPicture picture;
};

KinematicsQuestion questionOf(const Wish& wish) {
    KinematicsQuestion question;
    question.face = {radians(wish.slope.first), radians(wish.slope.second)};
    question.limits = {radians(wish.friction), radians(wish.lateral)};
    question.find_sets = wish.sets;
    if (wish.scanline) question.scanline = scanlineOf(wish.scanline->first, wish.scanline->second);
    if (wish.bias_limit) {
        if (!(*wish.bias_limit >= 1 && *wish.bias_limit <= 90)) {
            throw BadInput(
                Error{"bias_limit", "found " + text(*wish.bias_limit, 2) + ", allowed: 1 to 90 degrees"});
        }
        question.bias_limit = radians(*wish.bias_limit);
    }
    return question;
}

/// \param scenario  none: a table, in the file
std::string kinematicsOf(const formats::Scenario* scenario, const std::string& file, const Wish& wish) {
    if (!wish.stereonet.empty()) requireEnding("stereonet", wish.stereonet, {".svg"});
    const KinematicsQuestion question = questionOf(wish);
    std::string json;
    compute({}, [&](Computing&) {
        PoleSource source = scenario != nullptr ? polesOf(*scenario, question)
                                                : polesOf(tools::valueOf(formats::readPoles(file)), question);
        const KinematicsAnswer answer = answerKinematics(std::move(source), question);
        const std::string& name = scenario != nullptr ? scenario->path : file;
        if (!wish.stereonet.empty()) {
            refuseInput("stereonet", wish.stereonet);
            writeFile(wish.stereonet, kinematicsSvg(answer, wish.picture, "Kinematics of " + name));
        }
        json = jsonText(kinematicsJson(answer, {.json = true, .quiet = true}, name));
    });
    return json;
}

}  // namespace

void addKinematics(py::module_& module) {
    module.def("is_pole_table", isPoleTable, py::arg("path"));
    module.def(
        "kinematics",
        [](const formats::Scenario* scenario, const std::string& file, const Pair& slope, double friction,
           double lateral, std::size_t sets, std::optional<Pair> scanline, std::optional<double> bias_limit,
           const std::string& stereonet, const std::string& view, const std::string& net,
           const std::string& contours, double counting_area) {
            return kinematicsOf(scenario, file,
                                {slope, friction, lateral, sets, scanline, bias_limit, stereonet,
                                 netPicture(view, net, contours, counting_area)});
        },
        py::arg("scenario"), py::arg("file"), py::kw_only(), py::arg("slope"), py::arg("friction"),
        py::arg("lateral"), py::arg("sets"), py::arg("scanline"), py::arg("bias_limit"), py::arg("stereonet"),
        py::arg("view"), py::arg("net"), py::arg("contours"), py::arg("counting_area"));
}

}  // namespace talus::python
