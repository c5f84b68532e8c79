#include "answers/factor_volume.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "cli/json.h"
#include "cli/text.h"
#include "report/csv.h"
#include "report/svg.h"
#include "talus/wet_joint_name.h"

namespace talus::tools {

namespace {

/// Failures of larger factors are not drawn, unless there are no others: factors near 1 matter.
constexpr double kMostDrawn = 5;
constexpr double kFromZero = 0.5, kBelow = 0.95;  ///< a curve above this factor is drawn from near its least
constexpr std::size_t kShortCurve = 12;           ///< curves of up to so many points are shown in full
constexpr double kWiden = 1.15;                   ///< of the volumes, beyond the ends of the curve

Json direction(const Vec3& direction) { return direction.norm() > 0 ? vector(direction) : Json(nullptr); }

std::string joined(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

std::string tipOf(const MovingGroup& group) {
    char words[96];
    std::snprintf(words, sizeof words, "%.4g m\u00b3, %.4g t: factor %.4g, ", group.volume, group.mass / 1000,
                  group.sliding.factor);
    return words + modeText(group.sliding);
}

/// A power of ten times 1, 2 or 5, at most this volume.
double roundedDown(double volume) {
    const double unit = std::pow(10.0, std::floor(std::log10(volume)));
    for (const double digit : {5.0, 2.0})
        if (volume >= digit * unit) return digit * unit;
    return unit;
}

double highestDrawn(const std::vector<MovingGroup>& curve) {
    const double least = curve.front().sliding.factor;
    return std::min(curve.back().sliding.factor, std::max(kMostDrawn, 2 * least));
}

}  // namespace

Json factorVolumeJson(const KeyBlockResult& result) {
    Json points = Json::array();
    for (const MovingGroup& group : result.factor_volume) {
        points.push_back({{"volume_m3", number(group.volume)},
                          {"mass_kg", number(group.mass)},
                          {"safety_factor", number(group.sliding.factor)},
                          {"mode", toString(group.sliding.mode)},
                          {"joints", group.sliding.joints},
                          {"direction", direction(group.sliding.direction)},
                          {"blocks", group.blocks}});
    }
    return points;
}

std::string factorVolumeCsv(const KeyBlockResult& result, const std::string& comments) {
    std::string out = comments + "volume_m3,mass_kg,safety_factor,mode,joints,blocks\n";
    for (const MovingGroup& group : result.factor_volume) {
        out += csvLine({csvNumber(group.volume), csvNumber(group.mass), csvNumber(group.sliding.factor),
                        toString(group.sliding.mode), joined(group.sliding.joints, " "),
                        joined(group.blocks, " ")});
    }
    return out;
}

Plot factorVolumePlot(const KeyBlockResult& result, const std::string& scenario) {
    const std::vector<MovingGroup>& curve = result.factor_volume;
    const double top = highestDrawn(curve);
    Plot plot{"factor-volume",
              std::filesystem::path(scenario).filename().string() +
                  ": least factor of safety of a failure of at least a volume",
              "The least factor of safety by limit equilibrium against the least volume of the failure.",
              {},
              {}};
    const double least = std::min(1.0, curve.front().sliding.factor);
    plot.y =
        axisOver("least factor of safety", least > kFromZero ? kBelow * least : 0, std::max(1.0, top), 8);
    plot.x = {"volume of the failure, at least (m\u00b3)"};
    plot.x.domain = {roundedDown(curve.front().volume / kWiden), curve.back().volume * kWiden};
    plot.x.logarithmic = true;
    Series stairs{"line", "path", "least factor", {}}, corners{"points", "dem", "", {}, {}, "circle", 2.4};
    double from = plot.x.domain[0];
    for (const MovingGroup& group : curve) {
        const double factor = group.sliding.factor;
        stairs.add({from, std::min(factor, top)});
        if (factor > top) break;
        stairs.add({group.volume, factor});
        corners.add({group.volume, factor}, tipOf(group));
        from = group.volume;
    }
    plot.series = {std::move(stairs), std::move(corners)};
    plot.references.push_back({'y', 1, {}, "rule", "", "factor 1"});
    return plot;
}

std::vector<const MovingGroup*> shownPoints(const KeyBlockResult& result) {
    const std::vector<MovingGroup>& curve = result.factor_volume;
    std::vector<const MovingGroup*> shown;
    double step = 0;
    for (const MovingGroup& group : curve) {
        const double now = roundedDown(group.volume);
        const bool is_end = &group == &curve.front() || &group == &curve.back();
        if (curve.size() > kShortCurve && now == step && !is_end) continue;
        shown.push_back(&group);
        step = now;
    }
    return shown;
}

std::string modeText(const Sliding& sliding) {
    if (sliding.mode == SlidingMode::falls) return sliding.direction.z() > 0 ? "is lifted" : "falls";
    std::vector<std::string> names;
    for (const std::string& joint : sliding.joints) names.push_back(jointText(joint));
    return (sliding.mode == SlidingMode::wedge ? "wedge on " : "slides on ") + joined(names, " and ");
}

}  // namespace talus::tools
