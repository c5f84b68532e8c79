#include "answers/flow_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include "report/svg_writer.h"

namespace talus::tools {

namespace {

constexpr double kWidth = 720, kMargin = 40, kKey = 60;  // [px]
constexpr double kMostHeight = 640;                      // of the section [px]
constexpr std::string_view kStyle =
    ".page{fill:#ffffff}.text{font:12px sans-serif;fill:#222222}.dry{stroke:#c8c8c8;stroke-width:1;"
    "fill:none}.wet{stroke-width:2.5}.surface{fill:#d62728}";

/// White to dark blue, for 0 to 1.
std::string colourOf(double share) {
    const std::array<double, 3> light{173, 216, 240}, dark{8, 48, 107};
    std::array<char, 8> text{};
    std::array<int, 3> c{};
    for (std::size_t k = 0; k < 3; ++k)
        c[k] = static_cast<int>(std::lround(light[k] + share * (dark[k] - light[k])));
    std::snprintf(text.data(), text.size(), "#%02x%02x%02x", c[0], c[1], c[2]);
    return text.data();
}

struct Side {
    std::array<Vec3, 2> ends;
    double pressure;  ///< mean [Pa]
};

/// The outer side of each triangle of a fan: the joint as it is seen along y.
std::vector<Side> sidesOf(const SteadyFlow& flow) {
    std::vector<Side> sides;
    for (const auto& corners : flow.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = static_cast<std::size_t>(corners[k]),
                       b = static_cast<std::size_t>(corners[(k + 1) % 3]);
            sides.push_back({{flow.nodes[a], flow.nodes[b]}, 0.5 * (flow.pressure[a] + flow.pressure[b])});
        }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& a, const Side& b) { return a.pressure < b.pressure; });
    return sides;
}

/// From metres to pixels.
struct View {
    double x = 0, z = 0, scale = 1, height = 0;

    Spot at(const Vec3& p) const {
        return {kMargin + scale * (p.x() - x), kMargin + height - scale * (p.z() - z)};
    }
};

View viewOf(const SteadyFlow& flow) {
    Vec3 low = Vec3::Constant(kInfinity), high = -low;
    for (const Vec3& p : flow.nodes) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const Vec3 size = (high - low).cwiseMax(1e-9);
    View view{low.x(), low.z()};
    view.scale = std::min((kWidth - 2 * kMargin) / size.x(), kMostHeight / size.z());
    view.height = view.scale * size.z();
    return view;
}

void drawKey(SvgWriter& svg, double most, double y) {
    constexpr int kSteps = 40;
    constexpr double kLength = 240, kThickness = 12;
    for (int k = 0; k < kSteps; ++k) {
        const double from = kMargin + kLength * k / kSteps, to = kMargin + kLength * (k + 1) / kSteps;
        svg.shape({{from, y}, {to, y}, {to, y + kThickness}, {from, y + kThickness}}, false, "key", "",
                  colourOf((k + 0.5) / kSteps));
    }
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "0 to %.3g kPa; grey: dry; red: free surface", 1e-3 * most);
    svg.label({kMargin + kLength + 12, y + kThickness - 1}, text.data());
}

}  // namespace

std::string flowSvg(const SteadyFlow& flow, std::string_view title) {
    SvgWriter svg;
    if (flow.nodes.empty()) return svg.file(kWidth, kMargin, title, title, kStyle);
    const View view = viewOf(flow);
    const double most = *std::max_element(flow.pressure.begin(), flow.pressure.end());
    std::set<std::array<long, 4>> drawn;  // places in tenths of a pixel: edges behind each other are one
    for (const Side& side : sidesOf(flow)) {
        const bool wet = side.pressure > 0 && most > 0;
        Spot a = view.at(side.ends[0]), b = view.at(side.ends[1]);
        if (std::pair(b.x, b.y) < std::pair(a.x, a.y)) std::swap(a, b);
        const auto tenth = [](double x) { return std::lround(10 * x); };
        if (!drawn.insert({tenth(a.x), tenth(a.y), tenth(b.x), tenth(b.y)}).second) continue;
        const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
        if (length < 1e-6) continue;
        if (!wet) {
            svg.line(a, b, "dry");
            continue;
        }
        const double nx = -1.5 * dy / length, ny = 1.5 * dx / length;
        svg.shape({{a.x + nx, a.y + ny}, {b.x + nx, b.y + ny}, {b.x - nx, b.y - ny}, {a.x - nx, a.y - ny}},
                  false, "wet", "", colourOf(side.pressure / most));
    }
    for (const Vec3& p : flow.free_surface) svg.symbol("circle", view.at(p), 2.5, "surface");
    drawKey(svg, most, view.height + 1.6 * kMargin);
    return svg.file(kWidth, view.height + 2 * kMargin + kKey, title,
                    "Joints seen along y, coloured by the pressure of their water.", kStyle);
}

}  // namespace talus::tools
