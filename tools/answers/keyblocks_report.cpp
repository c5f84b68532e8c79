#include "answers/keyblocks_report.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "answers/factor_volume.h"
#include "cli/block_names.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/scenario.h"
#include "cli/text.h"

namespace talus::tools {

namespace {

/// Clockwise from +y, and below the horizontal [deg].
struct Line {
    double trend, plunge;
};

Line lineOf(const Vec3& direction) {
    const double level = std::hypot(direction.x(), direction.y());
    constexpr double kVertical = 1e-9;  // its trend would be that of rounding
    double trend = level > kVertical ? degrees(std::atan2(direction.x(), direction.y())) : 0.0;
    if (trend < 0) trend += 360;
    return {trend, degrees(std::atan2(-direction.z(), level))};
}

Json directionJson(const Vec3& direction) { return direction.norm() > 0 ? vector(direction) : Json(nullptr); }

Json planeJson(const SlidingPlane& plane) {
    // The dip of a plane is that of its upward normal.
    const Line pole = lineOf(plane.normal.z() > 0 ? plane.normal : Vec3(-plane.normal));
    return {{"joint", plane.joint},
            {"dip_deg", number(90 + pole.plunge)},
            {"dip_direction_deg", number(pole.trend)},
            {"area_m2", number(plane.area)},
            {"normal_force_n", number(plane.normal_force)},
            {"resistance_n", number(plane.resistance)}};
}

/// Common part of a single block and a group.
void addSliding(const Sliding& sliding, double volume, double mass, Json& json) {
    const bool moves = sliding.mode != SlidingMode::none;
    const Line line = lineOf(sliding.direction);
    json["mode"] = toString(sliding.mode);
    json["joints"] = sliding.joints;
    json["direction"] = directionJson(sliding.direction);
    json["trend_deg"] = moves ? number(line.trend) : Json(nullptr);
    json["plunge_deg"] = moves ? number(line.plunge) : Json(nullptr);
    json["safety_factor"] = number(sliding.factor);
    json["driving_n"] = number(sliding.driving);
    json["resisting_n"] = number(sliding.resisting);
    json["planes"] = Json::array();
    for (const SlidingPlane& plane : sliding.planes) json["planes"].push_back(planeJson(plane));
    json["volume_m3"] = number(volume);
    json["mass_kg"] = number(mass);
}

Json blockJson(const KeyBlock& block) {
    Json json{{"name", block.name},
              {"removable", block.removable},
              {"removal_direction", directionJson(block.free_direction)}};
    addSliding(block.sliding, block.volume, block.mass, json);
    return json;
}

Json groupJson(const MovingGroup& group) {
    Json json{{"blocks", group.blocks}, {"carries", group.carries}};
    addSliding(group.sliding, group.volume, group.mass, json);
    return json;
}

std::string row(std::string label, const std::string& content) {
    label.resize(std::max<std::size_t>(label.size() + 1, 18), ' ');
    return label + content + "\n";
}

std::string padded(const std::string& cell, std::size_t width, bool left) {
    const std::string pad(width - std::min(width, cell.size()), ' ');
    return left ? cell + pad : pad + cell;
}

/// Aligned columns; the first line is the header.
template <std::size_t N>
std::string aligned(const std::vector<std::array<std::string, N>>& lines, const std::array<bool, N>& left) {
    std::array<std::size_t, N> width{};
    for (const auto& cells : lines)
        for (std::size_t c = 0; c < N; ++c) width[c] = std::max(width[c], cells[c].size());
    std::string out;
    for (const auto& cells : lines) {
        std::string line;
        for (std::size_t c = 0; c < N; ++c) line += (c > 0 ? "  " : "") + padded(cells[c], width[c], left[c]);
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    return out;
}

constexpr std::size_t kNames = 4;  // of a group's blocks, before "and N more"

std::string groupTable(const KeyBlockResult& result, std::size_t rows) {
    std::vector<std::array<std::string, 6>> lines{{"factor", "mode", "trend/plunge", "m3", "t", "blocks"}};
    for (std::size_t k = 0; k < std::min(rows, result.groups.size()); ++k) {
        const MovingGroup& group = result.groups[k];
        lines.push_back({text(group.sliding.factor, 4), modeText(group.sliding),
                         trendPlungeText(group.sliding.direction), text(group.volume, 3),
                         text(group.mass / 1000, 2),
                         (group.carries.empty() ? "" : "* ") + compactNames(group.blocks, kNames)});
    }
    return aligned<6>(lines, {false, true, false, false, false, true});
}

std::string curveTable(const KeyBlockResult& result) {
    std::vector<std::array<std::string, 5>> lines{{"m3 or more", "t", "factor", "mode", "blocks"}};
    for (const MovingGroup* group : shownPoints(result)) {
        lines.push_back({text(group->volume, 3), text(group->mass / 1000, 2), text(group->sliding.factor, 4),
                         modeText(group->sliding), compactNames(group->blocks, kNames)});
    }
    return aligned<5>(lines, {false, false, false, true, true});
}

}  // namespace

std::string trendPlungeText(const Vec3& direction) {
    const Line line = lineOf(direction);
    constexpr double kShown = 0.05;  // of a plunge: less is level, with no sign
    return text(line.trend, 1) + "/" + text(std::abs(line.plunge) < kShown ? 0.0 : line.plunge, 1);
}

Json keyBlocksJson(const KeyBlockResult& result, const Common& common, const formats::Scenario& scenario) {
    Json blocks = Json::array(), groups = Json::array();
    for (const KeyBlock& block : result.blocks) blocks.push_back(blockJson(block));
    for (const MovingGroup& group : result.groups) groups.push_back(groupJson(group));
    return {{"blocks", std::move(blocks)},
            {"moving_groups", std::move(groups)},
            {"factor_volume", factorVolumeJson(result)},
            {"directions", result.directions},
            {"groups_judged", result.groups_judged},
            {"wall_seconds", number(result.wall_seconds)},
            {"interrupted", result.interrupted},
            {"warnings", warningsJson(scenario, result.warnings)},
            {"provenance", provenance(common, scenario.path)}};
}

std::string keyBlocksText(const KeyBlockResult& result, const std::string& scenario, std::size_t rows) {
    const auto count = [&](const auto& is) {
        return std::to_string(std::count_if(result.blocks.begin(), result.blocks.end(), is));
    };
    const auto unstable = [](const KeyBlock& block) { return block.sliding.factor < 1; };
    const auto moves = [](const KeyBlock& block) { return block.sliding.mode != SlidingMode::none; };
    std::string out =
        row("scenario", scenario) +
        row("blocks", std::to_string(result.blocks.size()) + " free; each alone: " +
                          count([](const KeyBlock& block) { return block.removable; }) + " removable, " +
                          count(moves) + " loaded in a free direction, " + count(unstable) +
                          " with a factor below 1") +
        row("groups", std::to_string(result.groups_judged) + " tested along " +
                          std::to_string(result.directions) + " directions" +
                          (result.interrupted ? ", interrupted" : "") + "; the lowest factors of safety:");
    out += result.groups.empty() ? row("", "none can move") : "\n" + groupTable(result, rows) + "\n";
    if (!result.factor_volume.empty()) {
        out += row("factor, volume", "the least factor of a failure of at least so much:") + "\n" +
               curveTable(result) + "\n";
    }
    const bool any_carries = std::any_of(result.groups.begin(), result.groups.end(),
                                         [](const MovingGroup& group) { return !group.carries.empty(); });
    if (any_carries)
        out += row("*", "blocks that cannot move with this group rest on it; their load is not counted");
    return out + row("covers", "limit equilibrium, translation only: toppling is not covered") +
           row("cost", text(result.wall_seconds, 2) + " s");
}

}  // namespace talus::tools
