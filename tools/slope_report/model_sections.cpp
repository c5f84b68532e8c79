#include <algorithm>
#include <cmath>
#include <cstdio>

#include "answers/search_lines.h"
#include "cli/block_names.h"
#include "cli/text.h"
#include "report/numbers.h"
#include "slope_report/provenance_lines.h"
#include "slope_report/sections.h"

namespace talus::tools {

namespace {

constexpr double kKilo = 1e3, kGiga = 1e9;
constexpr std::size_t kMostRows = 30;  ///< of bolts and of waters

std::string strengthText(const Joint& joint) {
    switch (joint.law) {
        case StrengthLaw::coulomb:
            return text(degrees(joint.friction), 1) + "\u00b0, " + figureText(joint.cohesion / kKilo) +
                   " kPa" +
                   (joint.tensile_strength > 0
                        ? ", tensile " + figureText(joint.tensile_strength / kKilo) + " kPa"
                        : "");
        case StrengthLaw::barton_bandis:
            return "Barton-Bandis: JRC " + figureText(joint.jrc) + ", JCS " +
                   figureText(joint.jcs / (kKilo * kKilo)) + " MPa, " +
                   text(degrees(joint.residual_friction), 1) + "\u00b0";
        case StrengthLaw::envelope:
            return "envelope of " + std::to_string(joint.shear_strength.size()) + " points";
        case StrengthLaw::power:
            break;
    }
    return "power law: a " + figureText(joint.a) + ", b " + figureText(joint.b);
}

/// The factors between which strength changes.
std::string overTimeText(const Joint& joint) {
    if (joint.strength_over_time.empty()) return "";
    double low = joint.strength_over_time.front().value, high = low;
    for (const LevelPoint& point : joint.strength_over_time)
        low = std::min(low, point.value), high = std::max(high, point.value);
    const std::string range =
        low == high ? "" : ", from " + figureText(low) + " to " + figureText(high) + " over time";
    return "; times " + figureText(strengthFactor(joint, 0)) + " at time 0" + range;
}

std::string wetText(const Joint& joint) {
    return joint.wet_strength_factor == 1 ? ""
                                          : "; times " + figureText(joint.wet_strength_factor) + " where wet";
}

void addJoints(const Model& model, HtmlPage& page) {
    std::vector<std::vector<std::string>> rows;
    for (const Joint& joint : model.joints) {
        rows.push_back({joint.name, strengthText(joint) + overTimeText(joint) + wetText(joint),
                        figureText(joint.normal_stiffness / kGiga),
                        figureText(joint.shear_stiffness / kGiga)});
    }
    page.table("Joints: friction angle and cohesion, stiffness in GPa/m",
               {{"joint", true}, {"strength", true}, {"normal stiffness"}, {"shear stiffness"}}, rows);
}

std::string gravityText(const Gravity& gravity) {
    std::string words = figureText(gravity.magnitude) + " m/s\u00b2";
    if (gravity.tilt != 0) words += ", model tilted by " + text(degrees(gravity.tilt), 2) + "\u00b0";
    if (gravity.direction) words += ", direction given";
    return words;
}

std::string seismicText(const Seismic& seismic) {
    if (seismic.horizontal == 0 && seismic.vertical == 0) return "";
    return "horizontal " + figureText(seismic.horizontal) + " towards " + text(degrees(seismic.azimuth), 0) +
           "\u00b0, vertical " + figureText(seismic.vertical) + " of the weight";
}

std::string blockCounts(const Model& model) {
    std::size_t free = 0;
    double volume = 0, mass = 0;
    for (const Block& block : model.blocks) {
        if (block.motion != Motion::free) continue;
        const double its = massProperties(block.shape).volume;
        ++free, volume += its, mass += block.density * its;
    }
    return std::to_string(model.blocks.size()) + ", of which " + std::to_string(free) +
           " are free to move: " + amountText(volume, mass);
}

std::string levelText(const Water& water) {
    if (water.kind == Water::Level::head)
        return "heads " + figureText(water.head[0]) + " m and " + figureText(water.head[1]) + " m";
    const char* kind = water.kind == Water::Level::depth ? "depth " : "elevation ";
    if (water.level.empty()) return kind;
    const std::string now = kind + figureText(water.level.front().value) + " m";
    return water.level.size() > 1 ? now + " at first, varies with time" : now;
}

std::string falloffText(const Water& water) {
    switch (water.daylight) {
        case Water::Daylight::straight:
            return "falls in a straight line to the lower end";
        case Water::Daylight::half_height:
            return "hydrostatic to half the wet height, then to zero";
        case Water::Daylight::closed:
            break;
    }
    return "hydrostatic";
}

void addWaters(const Model& model, HtmlPage& page) {
    if (model.phreatic) {
        page.paragraph("Water table: every face below it feels the pressure of the depth below it, times " +
                       figureText(model.phreatic->factor) + ".");
    }
    if (model.waters.empty()) return;
    std::vector<std::vector<std::string>> rows;
    for (std::size_t w = 0; w < std::min(kMostRows, model.waters.size()); ++w) {
        const Water& water = model.waters[w];
        rows.push_back({water.field, levelText(water), falloffText(water), figureText(water.density),
                        water.pair ? "2" : std::to_string(water.walls.size())});
    }
    page.table(
        "Water in joints",
        {{"water", true}, {"level", true}, {"pressure", true}, {"density (kg/m\u00b3)"}, {"wet faces"}},
        rows);
    if (model.waters.size() > kMostRows)
        page.paragraph("and " + std::to_string(model.waters.size() - kMostRows) + " more", "muted");
}

void addBolts(const SlopeReport& report, HtmlPage& page) {
    const Model& model = report.search.scenario.model;
    if (model.bolts.empty()) return;
    std::vector<std::vector<std::string>> rows;
    for (std::size_t b = 0; b < std::min(kMostRows, model.bolts.size()); ++b) {
        const Bolt& bolt = model.bolts[b];
        rows.push_back({bolt.name, bolt.grouted ? "grouted" : "free length",
                        text((bolt.end - bolt.head).norm(), 2), figureText(bolt.yield_force / kKilo),
                        figureText(bolt.pretension / kKilo)});
    }
    page.table("Bolts",
               {{"bolt", true}, {"kind", true}, {"length (m)"}, {"yield force (kN)"}, {"pretension (kN)"}},
               rows);
    if (model.bolts.size() > kMostRows)
        page.paragraph("and " + std::to_string(model.bolts.size() - kMostRows) + " more", "muted");
    page.heading("Bolts at the answer");
    ResultLines lines = supportLines(report.search);
    const std::size_t more = lines.size() - std::min(lines.size(), kMostRows);
    lines.resize(lines.size() - more);
    std::vector<std::string> items;
    for (const ResultLine& line : lines) items.push_back(line.content);
    page.list(items);
    if (more > 0) page.paragraph("and " + std::to_string(more) + " more", "muted");
}

}  // namespace

std::string figureText(double value) {
    char words[32];
    std::snprintf(words, sizeof words, "%.4g", value + 0.0);
    return words;
}

std::string capitalised(std::string text) {
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text;
}

std::string blocksText(const std::vector<std::string>& names, std::size_t limit) {
    return std::to_string(names.size()) + (names.size() == 1 ? " block: " : " blocks: ") +
           compactNames(names, limit);
}

void addQuestion(const SlopeReport& report, HtmlPage& page) {
    const SearchReport& search = report.search;
    const Model& model = search.scenario.model;
    page.section("question", "What was asked");
    std::vector<std::pair<std::string, std::string>> items{
        {"scenario", fileName(report)},
        {"analysis", std::string(search.search.name) + " (" + report.analysis.because + ")"},
        {"question", std::string(search.search.about) + "."},
        {"gravity", gravityText(model.gravity)},
        {"blocks", blockCounts(model)},
        {"contacts", std::to_string(search.result.interfaces) + " interfaces, " +
                         std::to_string(search.result.contact_points) + " contact points"}};
    if (const std::string shaken = seismicText(model.seismic); !shaken.empty())
        items.emplace_back("earthquake", shaken);
    if (!model.loads.empty()) items.emplace_back("loads", std::to_string(model.loads.size()));
    page.facts(items);
    addJoints(model, page);
}

void addWaterAndBolts(const SlopeReport& report, HtmlPage& page) {
    const Model& model = report.search.scenario.model;
    page.section("water-and-bolts", "Water and bolts");
    if (!model.hasWater()) page.paragraph("The scenario has no water.");
    addWaters(model, page);
    if (model.bolts.empty()) page.paragraph("The scenario has no bolts.");
    addBolts(report, page);
}

void addKinematicTests(const SlopeKinematics& kinematics, HtmlPage& page) {
    const KinematicsAnswer& answer = kinematics.answer;
    const auto angle = [](double radians) { return text(degrees(radians), 1) + "\u00b0"; };
    page.facts({{"face", text(degrees(kinematics.face.value.dip), 1) + "/" +
                             text(degrees(kinematics.face.value.dip_direction), 1) +
                             " (dip/dip direction): " + kinematics.face.because},
                {"friction", angle(kinematics.friction.value) + ": " + kinematics.friction.because},
                {"lateral limits", angle(answer.question.limits.lateral) + " to each side"}});
    const auto share = [](const char* name, const kinematics::Share& counted, const char* of) {
        return std::vector<std::string>{name, std::to_string(counted.critical), std::to_string(counted.total),
                                        text(counted.percent(), 1), of};
    };
    const auto& planes = answer.analysis.planes;
    const auto& lines = answer.analysis.lines;
    page.table("Kinematic tests", {{"failure", true}, {"critical"}, {"of"}, {"%"}, {"what is counted", true}},
               {share("planar sliding", planes.planar, "planes"),
                share("wedge sliding", lines.wedge, "lines of intersection"),
                share("direct toppling", lines.direct, "lines of intersection"),
                share("flexural toppling", planes.flexural, "planes")});
    std::vector<std::vector<std::string>> rows;
    for (std::size_t s = 0; s < answer.sets.size(); ++s) {
        const kinematics::FisherStatistics& set = answer.sets[s];
        const auto down = kinematics::dipVector(set.mean);
        rows.push_back({answer.source.sets[s], std::to_string(set.count),
                        text(degrees(kinematics::dipOfPlane(set.mean)), 1) + "/" +
                            text(down ? degrees(kinematics::trendOf(*down)) : 0.0, 1),
                        set.k ? text(*set.k, 1) : "-",
                        std::to_string(answer.analysis.sets[s].planar.critical),
                        std::to_string(answer.analysis.sets[s].flexural.critical)});
    }
    page.table("Joint sets",
               {{"set", true}, {"planes"}, {"mean plane"}, {"Fisher K"}, {"planar"}, {"flexural"}}, rows);
}

}  // namespace talus::tools
