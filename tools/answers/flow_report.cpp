#include "answers/flow_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "cli/block_names.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"
#include "report/csv.h"

namespace talus::tools {

namespace {

std::string row(std::string label, const std::string& content) {
    label.resize(std::max<std::size_t>(label.size() + 1, 18), ' ');
    return label + content + "\n";
}

std::string figure(const char* format, double value) {
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), format, value);
    return buffer.data();
}

std::string discharge(double value) { return figure("%.4g", value) + " m3/s"; }

std::size_t highestPressure(const SteadyFlow& flow) {
    const auto most = std::max_element(flow.pressure.begin(), flow.pressure.end());
    return static_cast<std::size_t>(most - flow.pressure.begin());
}

std::string place(const Vec3& x) {
    return "x = " + figure("%.3f", x.x()) + ", y = " + figure("%.3f", x.y()) +
           ", z = " + figure("%.3f", x.z()) + " m";
}

std::string boundaryText(const BoundaryFlow& boundary) {
    std::string text = "in " + discharge(boundary.inflow) + ", out " + discharge(boundary.outflow);
    if (std::isfinite(boundary.highest_outflow))
        text += ", up to " + figure("%.3f", boundary.highest_outflow) + " m";
    return text;
}

std::string surfaceText(const SteadyFlow& flow) {
    if (flow.free_surface.empty()) return "none: every joint is full";
    return "from " + figure("%.3f", flow.lowest_surface) + " to " + figure("%.3f", flow.highest_surface) +
           " m";
}

double meanAt(const std::vector<double>& values, const std::array<std::int32_t, 3>& corners) {
    double sum = 0;
    for (const std::int32_t n : corners) sum += values[static_cast<std::size_t>(n)];
    return sum / 3;
}

Vec3 middleOf(const SteadyFlow& flow, std::size_t triangle) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t n : flow.triangles[triangle]) sum += flow.nodes[static_cast<std::size_t>(n)];
    return sum / 3;
}

Json boundariesJson(const SteadyFlow& flow, const std::optional<MeshChange>& change) {
    Json list = Json::array();
    for (std::size_t k = 0; k < flow.boundaries.size(); ++k) {
        const BoundaryFlow& boundary = flow.boundaries[k];
        list.push_back({{"name", boundary.name},
                        {"nodes", boundary.nodes},
                        {"inflow_m3_s", number(boundary.inflow)},
                        {"outflow_m3_s", number(boundary.outflow)},
                        {"mesh_change", change ? number(change->boundaries[k]) : Json(nullptr)},
                        {"highest_outflow_m", number(boundary.highest_outflow)}});
    }
    return list;
}

Json meshJson(const std::optional<MeshChange>& change) {
    if (!change) return nullptr;
    return {{"refinements", change->refinements},
            {"triangles", change->triangles},
            {"inflow_change", number(change->total)}};
}

std::string meshText(const SteadyFlow& flow, const MeshChange& change) {
    const auto percent = [](double share) { return figure("%+.2g", 100 * share) + " %"; };
    std::string text = "with refinements = " + std::to_string(change.refinements) + " (" +
                       std::to_string(change.triangles) + " triangles) ";
    if (std::isnan(change.total)) return text + "nothing flows to compare";
    text += "the inflow changes by " + percent(change.total);
    for (std::size_t k = 0; k < flow.boundaries.size(); ++k)
        if (!std::isnan(change.boundaries[k]))
            text += ", " + flow.boundaries[k].name + " by " + percent(change.boundaries[k]);
    return text;
}

Json surfaceJson(const SteadyFlow& flow) {
    if (flow.free_surface.empty()) return nullptr;
    Json points = Json::array();
    for (const Vec3& x : flow.free_surface) points.push_back(vector(x));
    return {{"lowest_m", number(flow.lowest_surface)},
            {"highest_m", number(flow.highest_surface)},
            {"points_m", std::move(points)}};
}

std::string aperturesText(const std::vector<double>& apertures) {
    if (apertures.empty()) return "none";
    const auto [least, most] = std::minmax_element(apertures.begin(), apertures.end());
    return figure("%.3g", *least) + " to " + figure("%.3g", *most) + " m";
}

std::string namedText(const std::vector<std::string>& blocks) {
    return std::to_string(blocks.size()) + ": " + compactNames(blocks);
}

}  // namespace

Json couplingJson(const std::optional<FlowCoupling>& coupling) {
    if (!coupling) return nullptr;
    return {{"refinements", coupling->refinements},
            {"passes", coupling->passes},
            {"flows", coupling->flows},
            {"last_change", number(coupling->last_change)},
            {"largest_change", number(coupling->largest_change)},
            {"converged", coupling->converged}};
}

std::string couplingText(const FlowCoupling& coupling) {
    return std::to_string(coupling.flows) +
           " flows computed, refinements = " + std::to_string(coupling.refinements) + "; at most " +
           std::to_string(coupling.passes) +
           " passes at one equilibrium; the last one changed the pressure by " +
           figure("%.1g", coupling.last_change) + " of its largest value" +
           (coupling.converged ? "" : "; not converged");
}

std::string flowText(const SteadyFlow& flow, const std::optional<MeshChange>& change,
                     const std::string& scenario) {
    std::string text =
        row("scenario", scenario) + row("network", std::to_string(flow.patches) + " polygons of joints, " +
                                                       std::to_string(flow.nodes.size()) + " nodes, " +
                                                       std::to_string(flow.triangles.size()) + " triangles");
    for (const BoundaryFlow& boundary : flow.boundaries) text += row(boundary.name, boundaryText(boundary));
    text += row("inflow", discharge(flow.inflow_sum)) + row("outflow", discharge(flow.outflow_sum));
    if (change) text += row("mesh", meshText(flow, *change));
    text += row("imbalance", figure("%.1g", flow.imbalance) + " m3/s at a node, at most");
    if (!flow.nodes.empty()) {
        const std::size_t most = highestPressure(flow);
        text += row("largest pressure",
                    figure("%.4g", flow.pressure[most]) + " Pa at " + place(flow.nodes[most]));
    }
    if (flow.coupling)
        text +=
            row("apertures", aperturesText(flow.aperture)) + row("coupling", couplingText(*flow.coupling));
    if (!flow.fallen_at_start.empty()) text += row("fallen at start", namedText(flow.fallen_at_start));
    return text + row("free surface", surfaceText(flow)) +
           row("iterations", std::to_string(flow.iterations) + ", joints conduct a half at " +
                                 figure("%.2g", flow.ramp) + " m of suction");
}

Json flowJson(const SteadyFlow& flow, const std::optional<MeshChange>& change, const Common& common,
              const formats::Scenario& scenario) {
    const bool any = !flow.nodes.empty();
    const std::size_t most = any ? highestPressure(flow) : 0;
    return {{"patches", flow.patches},
            {"unreached_patches", flow.unreached_patches},
            {"nodes", flow.nodes.size()},
            {"triangles", flow.triangles.size()},
            {"boundaries", boundariesJson(flow, change)},
            {"inflow_m3_s", number(flow.inflow_sum)},
            {"outflow_m3_s", number(flow.outflow_sum)},
            {"mesh", meshJson(change)},
            {"imbalance_m3_s", number(flow.imbalance)},
            {"largest_pressure_pa", any ? number(flow.pressure[most]) : Json(nullptr)},
            {"largest_pressure_at_m", any ? vector(flow.nodes[most]) : Json(nullptr)},
            {"free_surface", surfaceJson(flow)},
            {"iterations", flow.iterations},
            {"residual", number(flow.residual)},
            {"ramp_m", number(flow.ramp)},
            {"coupling", couplingJson(flow.coupling)},
            {"fallen_at_start", flow.fallen_at_start},
            {"warnings", warningsJson(scenario, flow.warnings)},
            {"provenance", provenance(common, scenario.path)}};
}

std::string flowCsv(const SteadyFlow& flow, const Model& model, const std::string& comments) {
    std::string out = comments +
                      "x_m,y_m,z_m,block_a,block_b,joint,head_m,pressure_pa,wet_share,discharge_x_m2_s,"
                      "discharge_y_m2_s,discharge_z_m2_s,aperture_m\n";
    const auto block = [&](std::int32_t b) -> const std::string& {
        return model.blocks[static_cast<std::size_t>(b)].name;
    };
    for (std::size_t t = 0; t < flow.triangles.size(); ++t) {
        const Vec3 x = middleOf(flow, t), &q = flow.discharge[t];
        out += csvLine({csvNumber(x.x()), csvNumber(x.y()), csvNumber(x.z()), block(flow.block_a[t]),
                        block(flow.block_b[t]), model.joints[static_cast<std::size_t>(flow.joint[t])].name,
                        csvNumber(meanAt(flow.head, flow.triangles[t])),
                        csvNumber(meanAt(flow.pressure, flow.triangles[t])), csvNumber(flow.wet_share[t]),
                        csvNumber(q.x()), csvNumber(q.y()), csvNumber(q.z()), csvNumber(flow.aperture[t])});
    }
    return out;
}

}  // namespace talus::tools
