#include "report/joints_svg.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cli/text.h"
#include "report/net.h"
#include "report/svg_writer.h"
#include "talus/angles.h"
#include "talus/pole_statistics.h"

namespace talus::tools {

namespace {

constexpr double kNet = 240, kMargin = 44, kLegend = 380;  // radius of the net and beside it [px]
constexpr double kPanel = 360, kPlotHeight = 300;          // of a distribution [px]
/// Colour-blind safe (Okabe and Ito), those that show on white.
constexpr std::size_t kColours = 7;
constexpr std::string_view kStyle = R"css(
.page{fill:#fff}
.text{fill:#1a1a1a;font:13px system-ui,sans-serif}
.small{fill:#595959;font:12px system-ui,sans-serif}
.caption{fill:#1a1a1a;font:600 14px system-ui,sans-serif}
.frame{stroke:#1a1a1a;stroke-width:1.2;fill:none}
.grid{stroke:#ddd;stroke-width:1;fill:none}
.pole{stroke:#fff;stroke-width:.4;fill-opacity:.75}
)css"
                                    R"css(
.set0{fill:#0072b2}.set1{fill:#d55e00}.set2{fill:#009e73}.set3{fill:#cc79a7}.set4{fill:#7a2f6b}.set5{fill:#b38600}.set6{fill:#1a1a1a}
.curve{stroke-width:2;fill:none}
.curve0{stroke:#0072b2}.curve1{stroke:#d55e00}.curve2{stroke:#009e73}.curve3{stroke:#cc79a7}.curve4{stroke:#7a2f6b}.curve5{stroke:#b38600}.curve6{stroke:#1a1a1a}
)css";

struct Poles {
    std::string set;
    std::vector<Vec3> normals;
    std::vector<double> radii;  ///< of discs [m]
};

/// By set, in the order in which they first cut.
std::vector<Poles> bySet(const std::vector<formats::RockJoint>& joints) {
    std::vector<Poles> sets;
    std::map<std::string, std::size_t> place;
    for (const formats::RockJoint& joint : joints) {
        const auto [found, is_new] = place.try_emplace(joint.set, sets.size());
        if (is_new) sets.push_back({joint.set, {}, {}});
        sets[found->second].normals.push_back(joint.normal);
        if (joint.disc) sets[found->second].radii.push_back(joint.disc->radius);
    }
    return sets;
}

/// "F1: 312 poles, mean 40/265, K 18"
std::string words(const Poles& poles) {
    const kinematics::FisherStatistics statistics = kinematics::fisherStatistics(poles.normals);
    const auto [dip, direction] = dipOf(statistics.mean);
    std::string line = poles.set + ": " + std::to_string(poles.normals.size()) +
                       (poles.normals.size() == 1 ? " pole, " : " poles, mean ") + text(degrees(dip), 0) +
                       "/" + text(degrees(direction), 0);
    if (statistics.k) line += ", K " + text(*statistics.k, 1);
    return line;
}

std::string number(const char* kind, std::size_t set) { return kind + std::to_string(set % kColours); }

/// Decades that hold all values; a decade at least.
std::pair<double, double> decades(const std::vector<std::vector<double>>& curves) {
    double low = kInfinity, high = 0;
    for (const auto& values : curves)
        for (const double v : values) low = std::min(low, v), high = std::max(high, v);
    const double from = std::floor(std::log10(low)), to = std::ceil(std::log10(high));
    return {from, to > from ? to : from + 1};
}

/// Shares below a size, one step curve for each list of values.
void drawShares(SvgWriter& svg, Spot corner, const std::string& caption, const std::string& quantity,
                std::vector<std::vector<double>> curves, const std::vector<std::string>& names,
                const std::vector<std::size_t>& colours) {
    const auto [from, to] = decades(curves);
    const auto x = [&, from = from, to = to](double value) {
        return corner.x + kPanel * (std::log10(value) - from) / (to - from);
    };
    const auto y = [&](double share) { return corner.y + kPlotHeight * (1 - share); };
    svg.label({corner.x, corner.y - 14}, caption, "start", "caption");
    for (int k = 0; k <= 4; ++k) {
        svg.line({corner.x, y(0.25 * k)}, {corner.x + kPanel, y(0.25 * k)}, "grid");
        svg.label({corner.x - 8, y(0.25 * k) + 4}, text(0.25 * k, 2), "end", "small");
    }
    const double step = std::max(1.0, std::ceil((to - from) / 6));
    for (double d = from; d <= to; d += step) {
        const double at = std::pow(10, d);
        svg.line({x(at), y(0)}, {x(at), y(1)}, "grid");
        for (const double between : {2 * at, 5 * at})
            if (to - from < 2.5 && d < to) {
                svg.line({x(between), y(0)}, {x(between), y(1)}, "grid");
                svg.label({x(between), y(0) + 18}, text(between, std::max(0, static_cast<int>(-d))), "middle",
                          "small");
            }
        svg.label({x(at), y(0) + 18}, text(at, std::max(0, static_cast<int>(-d))), "middle", "small");
    }
    svg.box({corner.x, y(1)}, {corner.x + kPanel, y(0)}, "frame");
    svg.label({corner.x + 0.5 * kPanel, y(0) + 38}, quantity, "middle", "text");
    for (std::size_t c = 0; c < curves.size(); ++c) {
        auto& values = curves[c];
        std::sort(values.begin(), values.end());
        std::vector<Spot> steps{{x(values[0]), y(0)}};
        const auto count = static_cast<double>(values.size());
        for (std::size_t k = 0; k < values.size(); ++k) {
            steps.push_back({x(values[k]), y(static_cast<double>(k) / count)});
            steps.push_back({x(values[k]), y(static_cast<double>(k + 1) / count)});
        }
        svg.shape(steps, true, "curve " + number("curve", colours[c]));
        const double line = y(0) + 60 + 20 * static_cast<double>(c);
        svg.line({corner.x, line - 4}, {corner.x + 22, line - 4}, "curve " + number("curve", colours[c]));
        svg.label({corner.x + 30, line}, names[c] + ": " + std::to_string(values.size()));
    }
}

}  // namespace

std::string stereonetSvg(const std::vector<formats::RockJoint>& joints, std::string_view title) {
    SvgWriter svg;
    const Net net({kMargin + kNet, kMargin + kNet}, kNet, Projection::equal_area);
    net.draw(svg, "equal-area, lower hemisphere; rings: poles of planes dipping 30 and 60");
    const std::vector<Poles> sets = bySet(joints);
    double line = kMargin + 20;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        std::set<std::pair<long, long>> drawn;  // many of one place are one
        for (const Vec3& normal : sets[s].normals) {
            const Spot at = net.onPage(Vec3(-normal));
            if (!drawn.emplace(std::lround(100 * at.x), std::lround(100 * at.y)).second) continue;
            const auto [dip, direction] = dipOf(normal);
            svg.symbol("circle", at, 4, "pole " + number("set", s),
                       sets[s].set + " " + text(degrees(dip), 1) + "/" + text(degrees(direction), 1));
        }
        const double left = 2 * (kMargin + kNet) + 20;
        svg.symbol("circle", {left, line - 4}, 5, "pole " + number("set", s));
        svg.label({left + 14, line}, words(sets[s]));
        line += 22;
    }
    svg.label({2 * (kMargin + kNet) + 20, line + 6}, "dip / dip direction, degrees", "start", "small");
    return svg.file(2 * (kMargin + kNet) + kLegend, 2 * (kMargin + kNet), title,
                    "Poles of " + std::to_string(joints.size()) + " joint planes on the lower hemisphere",
                    kStyle);
}

std::string sizesSvg(const std::vector<formats::RockJoint>& joints, const Model& model,
                     std::string_view title) {
    SvgWriter svg;
    std::vector<std::vector<double>> radii;
    std::vector<std::string> names;
    std::vector<std::size_t> colours;  // those of the stereonet
    const std::vector<Poles> sets = bySet(joints);
    for (std::size_t s = 0; s < sets.size(); ++s) {
        if (sets[s].radii.empty()) continue;
        radii.push_back(sets[s].radii);
        names.push_back(sets[s].set + ", discs");
        colours.push_back(s);
    }
    std::vector<double> volumes;
    for (const Block& block : model.blocks) volumes.push_back(massProperties(block.shape).volume);
    double left = kMargin + 20;
    if (!radii.empty()) {
        drawShares(svg, {left, kMargin}, "Discs no larger than", "radius [m]", radii, names, colours);
        left += kPanel + kMargin + 40;
    }
    drawShares(svg, {left, kMargin}, "Blocks no larger than", "volume [m3]", {volumes}, {"blocks"},
               {kColours - 1});
    const double lines = static_cast<double>(std::max<std::size_t>(1, radii.size()));
    return svg.file(left + kPanel + kMargin, kMargin + kPlotHeight + 70 + 20 * lines, title,
                    "Cumulative distributions of sizes", kStyle);
}

}  // namespace talus::tools
