#include "reproduction/page_parameters.h"

#include <algorithm>
#include <cstdio>

#include "report/html.h"

namespace talus::tools {
namespace {

using namespace html;

/// "3.375e11"
std::string scientific(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.4g", value);
    std::string number = buffer;
    if (const auto exponent = number.find("e+"); exponent != std::string::npos) number.erase(exponent + 1, 1);
    return number;
}

std::string stackText(const StackShape& stack) {
    return std::to_string(stack.columns) + " columns, " + std::to_string(stack.rows) + " rows, " +
           std::to_string(stack.slices) + " slices of blocks " + text(stack.block.x(), 1) + " m \u00d7 " +
           text(stack.block.y(), 1) + " m \u00d7 " + text(stack.block.z(), 1) +
           " m on a fixed floor; twelve columns in section 5, one slice in the study of contact points";
}

std::string jointText(const Joint& joint) {
    return "normal stiffness " + scientific(joint.normal_stiffness) + " Pa/m, shear stiffness " +
           scientific(joint.shear_stiffness) + " Pa/m, cohesion " + text(joint.cohesion, 0) +
           " Pa, friction angle as stated";
}

std::string slopeList(const Model& model) {
    std::string list;
    if (model.stack) list += definition("Slope", stackText(*model.stack));
    if (!model.blocks.empty()) {
        list += definition("Density", text(model.blocks.back().density, 0) + " kg/m\u00b3");
    }
    if (!model.joints.empty()) list += definition("Joints", jointText(model.joints.front()));
    return list + definition("Gravity", text(model.gravity.magnitude, 2) + " m/s\u00b2");
}

std::string waterList(const PaperResults& results) {
    for (const PaperRun& run : results.runs) {
        if (run.what.fissures.empty() || run.what.scenario.model.waters.empty()) continue;
        return definition("Water",
                          text(run.what.water_depth, 2) + " m up along the joint, " +
                              text(run.what.scenario.model.waters.front().density, 0) +
                              " kg/m\u00b3, level surface; pushes on both walls, also when the joint "
                              "opens");
    }
    return "";
}

/// "0.80", or "0.10 to 0.80" when the cases differ.
std::string dampingText(const std::vector<const PaperRun*>& begun) {
    const auto less = [](const PaperRun* a, const PaperRun* b) {
        return a->search.damping_local < b->search.damping_local;
    };
    const auto [least, most] = std::minmax_element(begun.begin(), begun.end(), less);
    const std::string from = text((*least)->search.damping_local, 2),
                      to = text((*most)->search.damping_local, 2);
    return from == to ? from : from + " to " + to;
}

std::string methodList(const PaperResults& results) {
    std::vector<const PaperRun*> begun;
    for (const PaperRun& run : results.runs) {
        if (run.begun && run.errors.empty()) begun.push_back(&run);
    }
    if (begun.empty()) return "";
    const bool scaled = begun.front()->search.inertia_scaled;
    return definition("Damping",
                      "local, " + dampingText(begun) +
                          ", while searching; the failure mode comes from a continuation without it") +
           definition("Inertia",
                      scaled ? "scaled while searching (equilibrium does not depend on it), true in the "
                               "continuation"
                             : "true");
}

}  // namespace

std::string htmlParameters(const PaperResults& results) {
    if (results.runs.empty()) return "";
    const Model& model = results.runs.front().what.scenario.model;
    const std::string search = "tilted slowly from the last tilt that held until the slope fails; bracket " +
                               text(degrees(model.analysis.tolerance), 3) + "\u00b0";
    return heading("parameters", "What was computed") +
           tagged("dl", slopeList(model) + waterList(results) +
                            definition("Contact points", results.table_points + " (Table 1 and section 5)") +
                            definition("Search", search) + methodList(results)) +
           paragraph(
               "A case fails when its out-of-balance force stays up and its slip grows, and stands when "
               "the force decays and no slip is left over one slowest period; neither is read from a "
               "fixed time.");
}

}  // namespace talus::tools
