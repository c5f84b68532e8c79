#include "answers/limit_report.h"

#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"

namespace talus::tools {

namespace {

Json mechanismJson(const LimitResult& result) {
    Json list = Json::array();
    for (const BlockVelocity& block : result.mechanism)
        list.push_back({{"block", block.block},
                        {"moving", block.moving},
                        {"velocity_m_s", vector(block.velocity)},
                        {"spin_rad_s", vector(block.spin)},
                        {"speed_m_s", number(block.speed)}});
    return list;
}

}  // namespace

Json limitJson(const VariedQuantity& load, const LimitResult& result, const Common& common,
               const formats::Scenario& scenario) {
    return {{"status", toString(result.status)},
            {"for", load.name},
            {"unit", *load.unit != '\0' ? Json(load.unit) : Json(nullptr)},
            {"lower", number(result.lower / load.scale)},
            {"upper", number(result.upper / load.scale)},
            {"moving_blocks", result.moving_blocks},
            {"mechanism", mechanismJson(result)},
            {"plane_section", result.plane_section},
            {"blocks", result.blocks},
            {"contact_points", result.contact_points},
            {"rows", result.rows},
            {"columns", result.columns},
            {"programmes", result.programmes},
            {"iterations", result.iterations},
            {"wall_seconds", number(result.wall_seconds)},
            {"interrupted", result.status == SearchStatus::interrupted},
            {"warnings", warningsJson(scenario, result.warnings)},
            {"provenance", provenance(common, scenario.path)}};
}

}  // namespace talus::tools
