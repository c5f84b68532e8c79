#include "answers/kinematics_net.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "cli/text.h"
#include "report/contours.h"
#include "talus/rock_mass.h"

namespace talus::tools {

namespace {

using namespace kinematics;

constexpr double kReach = 1.04;  ///< of sampled fields, in radii of the net, over whose edge they are cut off
constexpr std::size_t kZoneSide =
    261;  ///< points along a side of a zone's field: 2 px apart, as wide as a line
/// Points along a side of the contours' field: as many as `kMostDensities` poles or lines times points allow,
/// half a second.
constexpr double kMostDensities = 2e7, kLeastSide = 41, kMostSide = 161;

Field fieldOf(const Net& net, std::size_t side, const std::function<double(const Vec3&)>& value) {
    return sampled(side, kReach, [&](Spot at) { return value(net.lineAt(at)); });
}

void drawAbove(SvgWriter& svg, const Net& net, const Field& field, double level, const std::string& role) {
    auto rings = ringsAbove(field, level);
    for (auto& ring : rings)
        for (Spot& spot : ring) spot = net.onPage(spot);
    svg.area(rings, role);
}

/// A round step of which at most kNetColours lie below `most` [%].
double levelStep(double most) {
    double step = 0.5;
    for (const double next : {1.0, 2.0, 3.0, 4.0, 5.0, 10.0, 15.0})
        if (step * (kNetColours + 0.5) < most) step = next;
    return step;
}

/// Poles of planes whose dip vectors lie in the face: tan(dip) = tan(dip of the face) cos(off its dip
/// direction).
std::vector<Spot> daylightEnvelope(const Net& net, const Face& face) {
    std::vector<Spot> spots;
    for (int k = -90; k <= 90; ++k) {
        const double off = radians(k);
        const double dip = std::atan2(std::sin(face.dip) * std::max(0.0, std::cos(off)), std::cos(face.dip));
        spots.push_back(net.onPage(Vec3(-upwardNormal(dip, face.dip_direction + off))));
    }
    return spots;
}

}  // namespace

const std::string_view kNetStyle = R"css(
.page{fill:#fff}
.text{fill:#1a1a1a;font:15px system-ui,sans-serif}
.small{fill:#4d4d4d;font:14px system-ui,sans-serif}
.caption{fill:#1a1a1a;font:600 17px system-ui,sans-serif}
.name{fill:#1a1a1a;font:600 14px system-ui,sans-serif;paint-order:stroke;stroke:#fff;stroke-width:3px}
.frame{stroke:#1a1a1a;stroke-width:1.5;fill:none}
.grid{stroke:#c8c8c8;stroke-width:.7;fill:none}
.pole{stroke:#fff;stroke-width:.5}
.critical{stroke:#1a1a1a;stroke-width:1.3}
.line{fill:#666}
.linecritical{fill:#b00020}
)css"
                                   R"css(
.set0{fill:#0072b2}.set1{fill:#d55e00}.set2{fill:#009e73}.set3{fill:#cc79a7}.set4{fill:#7a2f6b}
.set5{fill:#b38600}.set6{fill:#1a1a1a}
.mean{stroke-width:1.8;fill:none}
.mean0{stroke:#0072b2}.mean1{stroke:#d55e00}.mean2{stroke:#009e73}.mean3{stroke:#cc79a7}
.mean4{stroke:#7a2f6b}.mean5{stroke:#b38600}.mean6{stroke:#1a1a1a}
.level0{fill:#eef3f7}.level1{fill:#dfe9f1}.level2{fill:#cddde9}.level3{fill:#b8cee0}.level4{fill:#a1bdd5}
.level5{fill:#88abc9}.level6{fill:#6e98bc}
)css"
                                   R"css(
.face{stroke:#1a1a1a;stroke-width:3;fill:none}
.friction{stroke:#b00020;stroke-width:2;fill:none;stroke-dasharray:9 4}
.daylight{stroke:#00684a;stroke-width:2;fill:none}
.lateral{stroke:#444;stroke-width:1.6;fill:none;stroke-dasharray:3 4}
.slip{stroke:#7a2f6b;stroke-width:2;fill:none;stroke-dasharray:12 3 3 3}
.slides{fill:#d62728;fill-opacity:.28}
.second{fill:#f2b600;fill-opacity:.38}
.topples{fill:#8e44ad;fill-opacity:.26}
.oblique{fill:#2f8f9d;fill-opacity:.25}
)css";

std::string numbered(const char* kind, std::size_t k) { return kind + std::to_string(k % kNetColours); }

NetLevels drawContours(SvgWriter& svg, const Net& net, const std::vector<Vec3>& axes,
                       const std::vector<double>& weights, const Counting& counting) {
    const double side = std::sqrt(kMostDensities / static_cast<double>(axes.size()));
    const Field field =
        fieldOf(net, static_cast<std::size_t>(std::clamp(side, kLeastSide, kMostSide)),
                [&](const Vec3& line) { return 100 * poleDensity(line, axes, weights, counting); });
    const double most = *std::max_element(field.values.begin(), field.values.end());
    NetLevels levels{levelStep(most)};
    for (; levels.step * static_cast<double>(levels.count + 1) < most; ++levels.count) {
        drawAbove(svg, net, field, levels.step * static_cast<double>(levels.count + 1),
                  numbered("level", levels.count));
    }
    return levels;
}

void drawZones(SvgWriter& svg, const Net& net, const KinematicsQuestion& question, bool intersections) {
    const Face& face = question.face;
    const Limits& limits = question.limits;
    const auto draw = [&](const char* role, const std::function<double(const Vec3&)>& margin) {
        drawAbove(svg, net, fieldOf(net, kZoneSide, margin), kSameAngle, role);
    };
    if (!intersections) {
        draw("slides", [&](const Vec3& pole) { return planarMargin(-pole, face, limits); });
        draw("topples", [&](const Vec3& pole) { return flexuralTopplingMargin(pole, face, limits); });
        return;
    }
    draw("slides", [&](const Vec3& line) { return wedgeMargin(line, face, limits.friction); });
    draw("second", [&](const Vec3& line) { return secondaryWedgeMargin(line, face, limits.friction); });
    draw("topples", [&](const Vec3& line) { return directTopplingMargin(line, face, limits); });
    draw("oblique", [&](const Vec3& line) { return obliqueTopplingMargin(line, face, limits); });
}

void drawLimits(SvgWriter& svg, const Net& net, const KinematicsQuestion& question, bool intersections) {
    const Face& face = question.face;
    const Limits& limits = question.limits;
    svg.shape(net.greatCircle(upwardNormal(face.dip, face.dip_direction)), true, "face");
    for (const double side : {-limits.lateral, limits.lateral}) {
        const double to = face.dip_direction + side;
        const Vec3 end(std::sin(to), std::cos(to), 0);
        svg.line(net.onPage(end), net.onPage(Vec3(-end)), "lateral");
    }
    if (intersections) {
        // A line lies as far from the middle as it lacks of vertical, a pole as far as its plane dips.
        svg.shape(net.cone(0.5 * std::numbers::pi - limits.friction), true, "friction");
        svg.shape(net.greatCircle(upwardNormal(limits.friction, face.dip_direction)), true, "friction");
        svg.shape(net.cone(face.dip), true, "slip");
        return;
    }
    svg.shape(net.cone(limits.friction), true, "friction");
    svg.shape(daylightEnvelope(net, face), true, "daylight");
    if (face.dip > limits.friction) {
        svg.shape(net.greatCircle(upwardNormal(face.dip - limits.friction, face.dip_direction)), true,
                  "slip");
    }
}

}  // namespace talus::tools
