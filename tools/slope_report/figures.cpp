// The figures of a report, each as picture and table.

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "answers/factor_volume.h"
#include "answers/search_lines.h"
#include "answers/search_picture.h"
#include "answers/search_plot.h"
#include "cli/text.h"
#include "report/csv.h"
#include "report/svg.h"
#include "slope_report/provenance_lines.h"
#include "slope_report/slope_report.h"

namespace talus::tools {

namespace {

const char* motionName(Motion motion) {
    return motion == Motion::fixed ? "fixed" : motion == Motion::driven ? "driven" : "free";
}

/// Outcome of each block: "fails", "fails as group 2", "failed before", "stands".
std::unordered_map<std::string, std::string> fates(const SearchResult& result) {
    std::unordered_map<std::string, std::string> fates;
    for (const std::string& name : leftOut(result)) fates[name] = "failed before";
    for (const std::string& name : result.moving_blocks) fates[name] = "fails";
    for (std::size_t g = 1; g < result.groups.size(); ++g) {
        for (const std::string& name : result.groups[g].blocks)
            fates[name] = "fails as group " + std::to_string(g + 1);
    }
    return fates;
}

std::string slopeCsv(const SlopeReport& report, const std::string& comments) {
    const auto of = fates(report.search.result);
    std::string out = comments + "block,motion,fate,volume_m3,mass_kg,x_m,y_m,z_m\n";
    for (const Block& block : report.search.scenario.model.blocks) {
        const MassProperties mass = massProperties(block.shape);
        const auto fate = of.find(block.name);
        out += csvLine({block.name, motionName(block.motion), fate == of.end() ? "stands" : fate->second,
                        csvNumber(mass.volume), csvNumber(block.density * mass.volume),
                        csvNumber(mass.centroid.x()), csvNumber(mass.centroid.y()),
                        csvNumber(mass.centroid.z())});
    }
    return out;
}

std::string pathCsv(const SearchReport& search, const std::string& comments) {
    std::string out = comments + "displacement_m," + search.search.load->key + "\n";
    for (const PathPoint& point : search.result.path)
        out += csvLine({csvNumber(point.displacement), csvNumber(point.load / search.search.load->scale)});
    return out;
}

std::string polesCsv(const KinematicsAnswer& answer, const std::string& comments) {
    std::string out = comments + "dip_deg,dip_direction_deg,set\n";
    for (const kinematics::Pole& pole : answer.source.poles) {
        const auto down = kinematics::dipVector(pole.normal);
        out += csvLine({csvNumber(degrees(kinematics::dipOfPlane(pole.normal))),
                        csvNumber(down ? degrees(kinematics::trendOf(*down)) : 0.0),
                        answer.source.sets[pole.set]});
    }
    return out;
}

/// Of pairs of planes that meet, up to so many.
constexpr std::size_t kMostLines = 100'000;

std::string linesCsv(const KinematicsAnswer& answer, const std::string& comments) {
    std::string out = comments + "trend_deg,plunge_deg,set_a,set_b\n";
    const auto& poles = answer.source.poles;
    std::size_t count = 0;
    for (std::size_t i = 0; i < poles.size(); ++i) {
        for (std::size_t j = i + 1; j < poles.size() && count < kMostLines; ++j) {
            const auto line = kinematics::intersection(poles[i].normal, poles[j].normal);
            if (!line) continue;
            ++count;
            out += csvLine({csvNumber(degrees(kinematics::trendOf(*line))),
                            csvNumber(degrees(kinematics::plungeOf(*line))), answer.source.sets[poles[i].set],
                            answer.source.sets[poles[j].set]});
        }
    }
    return out;
}

void addStereonets(const SlopeReport& report, const std::string& comments,
                   std::vector<ReportFigure>& figures) {
    if (!report.kinematics) return;
    const KinematicsAnswer& answer = report.kinematics->answer;
    const std::string title = "Kinematics of " + fileName(report);
    const auto net = [&](std::size_t view) {
        return kinematicsSvg(answer, netPicture(kNetViews[view], kNetProjections[0], kNetContours[0], 1),
                             title);
    };
    figures.push_back({"stereonet-poles",
                       "Poles of the planes, lower hemisphere, equal-area: planar sliding and flexural "
                       "toppling.",
                       net(0), polesCsv(answer, comments)});
    figures.push_back({"stereonet-intersections",
                       "Lines of intersection of the planes: wedge sliding and direct toppling.", net(1),
                       linesCsv(answer, comments)});
}

void addSensitivity(const SlopeReport& report, const std::string& comments,
                    std::vector<ReportFigure>& figures) {
    if (report.sensitivity.empty()) return;
    const SearchReport& search = report.search;
    const auto answer =
        search.result.status == SearchStatus::found ? std::optional(search.result.answer) : std::nullopt;
    const auto plot = sensitivityPlot(report.sensitivity, search.search, answer, search.scenario.path);
    if (!plot) return;
    figures.push_back({"sensitivity", "The answer with each quantity less (open) and more (filled).",
                       svgFile(*plot, true), sensitivityCsv(report.sensitivity, search.search, comments)});
}

}  // namespace

std::vector<ReportFigure> figuresOf(const SlopeReport& report) {
    const SearchReport& search = report.search;
    const std::string comments = provenanceLines(report);
    std::vector<ReportFigure> figures;
    figures.push_back({"slope",
                       "The blocks. Those that fail are coloured by group and drawn as they move; the scale "
                       "bar is in metres.",
                       searchPicture(search.search, search.result, search.scenario),
                       slopeCsv(report, comments)});
    if (!search.result.path.empty()) {
        const double failure = failureDisplacement(search.result, search.scenario.model);
        figures.push_back(
            {"load-displacement",
             "Load against the displacement of the block that has come farthest. Each point "
             "is an equilibrium.",
             svgFile(searchPlot(search.search, search.result, search.scenario.path, failure), true),
             pathCsv(search, comments)});
    }
    if (!report.key_blocks.factor_volume.empty()) {
        figures.push_back({"factor-volume",
                           "The least factor of safety of a failure of at least a volume, by limit "
                           "equilibrium, translation only.",
                           svgFile(factorVolumePlot(report.key_blocks, search.scenario.path), true),
                           factorVolumeCsv(report.key_blocks, comments)});
    }
    addStereonets(report, comments, figures);
    addSensitivity(report, comments, figures);
    return figures;
}

}  // namespace talus::tools
