#pragma once
// Background of a kinematic analysis' stereonet: contours, critical zones, and the curves that bound them.

#include <string_view>

#include "answers/kinematics.h"
#include "report/net.h"

namespace talus::tools {

/// The look of all that is on the net and of the legend.
extern const std::string_view kNetStyle;
inline constexpr std::size_t kNetColours = 7;  ///< of sets and of contours; the style has as many
/// "set3": a class of the style by number, over and over.
std::string numbered(const char* kind, std::size_t k);

/// Contours that were drawn.
struct NetLevels {
    double step = 0;  ///< [%]
    std::size_t count = 0;
};

/// By the density of poles or lines, filled. \param weights  one each
NetLevels drawContours(SvgWriter& svg, const Net& net, const std::vector<Vec3>& axes,
                       const std::vector<double>& weights, const kinematics::Counting& counting);

/// The critical zones of poles or of lines, shaded by the margins of the tests themselves
/// (talus/kinematics.h), so shading and counts agree.
void drawZones(SvgWriter& svg, const Net& net, const KinematicsQuestion& question, bool intersections);

/// Face, friction, lateral limits, and what else bounds the zones.
void drawLimits(SvgWriter& svg, const Net& net, const KinematicsQuestion& question, bool intersections);

}  // namespace talus::tools
