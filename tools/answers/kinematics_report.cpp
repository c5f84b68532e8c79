// The answer of a kinematic analysis as JSON and as text.

#include <cmath>

#include "answers/kinematics.h"
#include "cli/json.h"
#include "cli/provenance.h"
#include "cli/text.h"
#include "report/table.h"
#include "talus/fractures.h"

namespace talus::tools {

namespace {

using kinematics::FisherStatistics;
using kinematics::LineShares;
using kinematics::PlaneShares;
using kinematics::Share;

/// An angle as given: degrees, without the rounding of the conversion to radians and back.
Json given(double angle) { return number(std::round(degrees(angle) * 1e9) / 1e9); }

/// critical, total, percent; by weight, too, where planes have weights.
Json shareJson(const Share& share, bool is_weighted) {
    Json json{{"critical", share.critical}, {"total", share.total}, {"percent", number(share.percent())}};
    if (is_weighted) json["weighted_percent"] = number(share.weightedPercent());
    return json;
}

Json optional(std::optional<double> value) { return value ? number(*value) : Json(nullptr); }

Json baseJson(const PlaneShares& planes, bool is_weighted) {
    Json json = shareJson(planes.base, is_weighted);
    json["steeper_than_friction"] = planes.sliding_base;
    return json;
}

Json planarJson(const PlaneShares& planes, bool is_weighted) {
    Json json = shareJson(planes.planar, is_weighted);
    json["without_lateral_limits"] = shareJson(planes.planar_without_limits, is_weighted);
    return json;
}

Json wedgeJson(const LineShares& lines, bool is_weighted) {
    Json json = shareJson(lines.wedge, is_weighted);
    json["primary"] = lines.primary;
    json["secondary"] = lines.secondary;
    json["on_both_planes"] = lines.wedge.critical - lines.on_one_plane;
    json["on_one_plane"] = lines.on_one_plane;
    json["held_by_friction"] = lines.held_by_friction;
    json["can_slide"] = lines.wedge.critical - lines.held_by_friction;
    return json;
}

Json directJson(const LineShares& lines, bool is_weighted) {
    Json json = shareJson(lines.direct, is_weighted);
    json["oblique"] = shareJson(lines.oblique, is_weighted);
    return json;
}

void addMean(const FisherStatistics& statistics, Json& json) {
    const auto [dip, direction] = dipOf(statistics.mean);
    json["dip_deg"] = number(degrees(dip));
    json["dip_direction_deg"] = number(degrees(direction));
    json["fisher_k"] = optional(statistics.k);
}

Json setJson(const KinematicsAnswer& answer, std::size_t set) {
    const FisherStatistics& statistics = answer.sets[set];
    const PlaneShares& planes = answer.analysis.sets[set];
    const bool is_weighted = !answer.weighted.empty();
    Json json{{"name", answer.source.sets[set]}};
    addMean(statistics, json);
    json["fisher_k_95"] = statistics.k_low
                              ? Json::array({number(*statistics.k_low), number(*statistics.k_high)})
                              : Json(nullptr);
    json["cone_95_deg"] = statistics.cone_95 ? number(degrees(*statistics.cone_95)) : Json(nullptr);
    json["poles"] = statistics.count;
    json["planar"] = planarJson(planes, is_weighted);
    json["flexural_toppling"] = shareJson(planes.flexural, is_weighted);
    json["base_planes"] = baseJson(planes, is_weighted);
    json["mean_plane"] = {
        {"planar", planarSliding(statistics.mean, answer.question.face, answer.question.limits)},
        {"flexural_toppling",
         flexuralToppling(statistics.mean, answer.question.face, answer.question.limits)}};
    if (!is_weighted) return json;
    addMean(answer.weighted[set], json["weighted"]);
    json["weighted"]["poles"] = number(planes.planar.total_weight);
    return json;
}

const char* nameOf(kinematics::WedgeZone zone) {
    if (zone == kinematics::WedgeZone::none) return "none";
    return zone == kinematics::WedgeZone::primary ? "primary" : "secondary";
}

const char* nameOf(kinematics::TopplingZone zone) {
    if (zone == kinematics::TopplingZone::none) return "none";
    return zone == kinematics::TopplingZone::direct ? "direct" : "oblique";
}

/// The line in which the mean planes of two sets meet.
Json meanLineJson(const KinematicsAnswer& answer, const kinematics::SetPair& pair) {
    if (pair.a == pair.b) return nullptr;
    const auto line = kinematics::intersection(answer.sets[pair.a].mean, answer.sets[pair.b].mean);
    if (!line) return nullptr;
    const kinematics::Face& face = answer.question.face;
    const kinematics::Limits& limits = answer.question.limits;
    return {{"trend_deg", number(degrees(kinematics::trendOf(*line)))},
            {"plunge_deg", number(degrees(kinematics::plungeOf(*line)))},
            {"wedge", nameOf(wedgeZone(*line, face, limits.friction))},
            {"toppling", nameOf(topplingZone(*line, face, limits))}};
}

Json pairJson(const KinematicsAnswer& answer, const kinematics::SetPair& pair) {
    const bool is_weighted = !answer.weighted.empty();
    return {{"sets", {answer.source.sets[pair.a], answer.source.sets[pair.b]}},
            {"wedge", wedgeJson(pair.lines, is_weighted)},
            {"direct_toppling", directJson(pair.lines, is_weighted)},
            {"mean_intersection", meanLineJson(answer, pair)}};
}

Json weightsJson(const KinematicsAnswer& answer) {
    if (answer.source.weighted_by.empty()) return nullptr;
    Json json{{"by", answer.source.weighted_by}};
    if (answer.source.weighted_by == "terzaghi")
        json["bias_limit_deg"] = given(answer.question.bias_limit.value_or(radians(kBiasLimitDeg)));
    if (answer.question.scanline) {
        json["scanline"] = {{"trend_deg", given(kinematics::trendOf(*answer.question.scanline))},
                            {"plunge_deg", given(kinematics::plungeOf(*answer.question.scanline))}};
    }
    return json;
}

std::string padded(const std::string& word, std::size_t width, bool right = false) {
    const std::string blanks(word.size() < width ? width - word.size() : 0, ' ');
    return right ? blanks + word : word + blanks;
}

std::string line(const std::string& name, const std::string& value) {
    return padded(name, 18) + value + "\n";
}

std::string shareLine(const std::string& name, const Share& share, const std::string& of) {
    return padded(name, 28) + padded(std::to_string(share.critical), 9, true) + " of " +
           padded(std::to_string(share.total), 9) + padded(text(share.percent(), 2), 7, true) + " %  " + of +
           "\n";
}

std::string countLine(const std::string& name, std::size_t count) {
    return padded("  " + name, 28) + padded(std::to_string(count), 9, true) + "\n";
}

std::string planeText(const Vec3& normal) {
    const auto [dip, direction] = dipOf(normal);
    return text(degrees(dip), 1) + "/" + text(degrees(direction), 1);
}

std::string testsText(const KinematicsAnswer& answer) {
    const PlaneShares& planes = answer.analysis.planes;
    const LineShares& lines = answer.analysis.lines;
    return shareLine("planar sliding", planes.planar, "poles") +
           shareLine("  without lateral limits", planes.planar_without_limits, "poles") +
           shareLine("wedge sliding", lines.wedge, "lines of intersection") +
           countLine("primary zone", lines.primary) + countLine("secondary zone", lines.secondary) +
           countLine("slide on one plane", lines.on_one_plane) +
           countLine("held by friction", lines.held_by_friction) +
           countLine("can slide", lines.wedge.critical - lines.held_by_friction) +
           shareLine("direct toppling", lines.direct, "lines of intersection") +
           shareLine("  oblique toppling", lines.oblique, "lines of intersection") +
           shareLine("  base planes", planes.base, "poles") +
           shareLine("flexural toppling", planes.flexural, "poles");
}

/// The rows of sets, as wide as the longest name.
std::string setsText(const KinematicsAnswer& answer) {
    std::size_t width = 5;
    for (const std::string& name : answer.source.sets) width = std::max(width, name.size() + 2);
    std::string lines =
        padded("set", width) + "  poles  mean plane       K  95 % of K          cone  planar  flexural\n";
    for (std::size_t s = 0; s < answer.sets.size(); ++s) {
        const FisherStatistics& set = answer.sets[s];
        const PlaneShares& planes = answer.analysis.sets[s];
        const std::string range = set.k_low ? text(*set.k_low, 1) + " to " + text(*set.k_high, 1) : "-";
        lines += padded(answer.source.sets[s], width) + padded(std::to_string(set.count), 7, true) + "  " +
                 padded(planeText(set.mean), 11) + padded(set.k ? text(*set.k, 1) : "-", 7, true) + "  " +
                 padded(range, 16) + padded(set.cone_95 ? text(degrees(*set.cone_95), 1) : "-", 6, true) +
                 padded(std::to_string(planes.planar.critical), 8, true) +
                 padded(std::to_string(planes.flexural.critical), 10, true) + "\n";
    }
    return lines;
}

std::string weighingText(const KinematicsAnswer& answer) {
    if (answer.source.weighted_by.empty()) return "";
    const PlaneShares& planes = answer.analysis.planes;
    const LineShares& lines = answer.analysis.lines;
    const auto share = [](const char* name, const Share& each) {
        return std::string(name) + " " + text(each.weightedPercent(), 2) + " %";
    };
    return line("by weight (" + answer.source.weighted_by + ")", "") + "  " + share("planar", planes.planar) +
           share(", wedge", lines.wedge) + share(", direct toppling", lines.direct) +
           share(", flexural toppling", planes.flexural) + "\n";
}

}  // namespace

Json kinematicsJson(const KinematicsAnswer& answer, const Common& common, const std::string& file) {
    const kinematics::Analysis& analysis = answer.analysis;
    const bool is_weighted = !answer.weighted.empty();
    Json direct = directJson(analysis.lines, is_weighted);
    direct["base_planes"] = baseJson(analysis.planes, is_weighted);
    Json sets = Json::array(), pairs = Json::array();
    for (std::size_t s = 0; s < answer.sets.size(); ++s) sets.push_back(setJson(answer, s));
    for (const kinematics::SetPair& pair : analysis.pairs) pairs.push_back(pairJson(answer, pair));
    const KinematicsQuestion& question = answer.question;
    return {
        {"poles", answer.source.poles.size()},
        {"slope",
         {{"dip_deg", given(question.face.dip)}, {"dip_direction_deg", given(question.face.dip_direction)}}},
        {"friction_deg", given(question.limits.friction)},
        {"lateral_deg", given(question.limits.lateral)},
        {"planar", planarJson(analysis.planes, is_weighted)},
        {"wedge", wedgeJson(analysis.lines, is_weighted)},
        {"direct_toppling", direct},
        {"flexural_toppling", shareJson(analysis.planes.flexural, is_weighted)},
        {"parallel_pairs", analysis.lines.parallel},
        {"sets", sets},
        {"set_pairs", pairs},
        {"sets_found", question.find_sets > 0},
        {"weights", weightsJson(answer)},
        {"notation", answer.source.notation.empty() ? Json(nullptr) : Json(answer.source.notation)},
        {"columns_passed_over", answer.source.passed_over},
        {"turned_upright", answer.source.is_tilted},
        {"warnings", answer.source.warnings},
        {"provenance", provenance(common, file)}};
}

std::string kinematicsText(const KinematicsAnswer& answer) {
    const KinematicsQuestion& question = answer.question;
    std::string head = line(
        "slope", text(degrees(question.face.dip), 1) + "/" + text(degrees(question.face.dip_direction), 1) +
                     ", friction " + text(degrees(question.limits.friction), 1) + " deg, lateral limits " +
                     text(degrees(question.limits.lateral), 1) + " deg");
    head += line("poles", std::to_string(answer.source.poles.size()) +
                              (answer.source.notation.empty() ? ", one for each plane that cuts the rock mass"
                                                              : ", read from " + answer.source.notation));
    if (answer.source.is_tilted) head += line("", "turned so that gravity points down");
    if (answer.analysis.lines.parallel > 0) {
        head +=
            line("parallel pairs", std::to_string(answer.analysis.lines.parallel) + ", without intersection");
    }
    for (const std::string& warning : answer.source.warnings) head += line("warning", warning);
    return head + "\n" + testsText(answer) + weighingText(answer) + "\n" + setsText(answer);
}

}  // namespace talus::tools
