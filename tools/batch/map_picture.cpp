#include "batch/map_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "cli/text.h"
#include "report/csv.h"
#include "report/svg.h"
#include "report/svg_writer.h"
#include "report/visible_faces.h"

namespace talus::tools::batch {

namespace {

constexpr double kWidth = 900, kMargin = 20, kFoot = 84, kMostHigh = 620;  // [px]
constexpr double kElevation = 20 * kDegree;       ///< of the eye before a slope: benches can be told
constexpr double kElevationAbove = 60 * kDegree;  ///< over level ground
constexpr double kAzimuthAbove = 180 * kDegree;   ///< likewise: from the south, north is up
constexpr double kBarLong = 320, kBarHigh = 14;   // [px]
constexpr int kBarSteps = 64;
constexpr std::string_view kStyle = R"css(
.page{fill:#fff}
.cell{stroke:#3b342b;stroke-width:.5;stroke-opacity:.3;stroke-linejoin:round}
.bar{stroke:#1a1a1a;fill:none}
.swatch{stroke:#3b342b;stroke-width:.7}
.text{fill:#1a1a1a;font:14px system-ui,sans-serif}
.caption{fill:#1a1a1a;font:600 15px system-ui,sans-serif}
)css";

// C. A. Brewer's scale YlOrRd, which people with any colour vision can order.
constexpr std::array<std::array<double, 3>, 7> kScale{{{255, 237, 160},
                                                       {254, 217, 118},
                                                       {254, 178, 76},
                                                       {253, 141, 60},
                                                       {252, 78, 42},
                                                       {227, 26, 28},
                                                       {150, 0, 38}}};
constexpr std::array<std::uint8_t, 3> kNever{222, 222, 218};  ///< lies on no failure

/// Three digits that count.
std::string figure(double value) {
    if (value == 0) return "0";
    const int decimals = 2 - static_cast<int>(std::floor(std::log10(value)));
    return text(value, std::clamp(decimals, 0, 9));
}

double valueOf(const FailureMap& map, MapQuantity quantity, std::size_t cell) {
    return quantity == MapQuantity::probability ? map.probability(cell) : map.volume_per_area[cell];
}

View viewOf(const FailureMap& map) {
    if (!map.face.outlook) return {kAzimuthAbove, kElevationAbove};
    return {std::atan2(map.face.outlook->x(), map.face.outlook->y()), kElevation};
}

std::string tipOf(const FailureMap& map, std::size_t cell) {
    const Interval interval = map.interval(cell);
    const Vec3& centre = map.face.cells[cell].centre;
    return "probability " + figure(map.probability(cell)) + " (" + figure(interval.low) + " to " +
           figure(interval.high) + ", " + std::to_string(map.hits[cell]) + " of " + std::to_string(map.runs) +
           " runs), " + figure(map.volume_per_area[cell]) + " m3/m2; at x " + text(centre.x(), 1) + ", y " +
           text(centre.y(), 1) + ", z " + text(centre.z(), 1) + " m";
}

/// Pieces of the cells that look at the reader, the farthest first.
std::vector<PaintedPolygon> painted(const FailureMap& map, const Camera& camera) {
    std::vector<PaintedPolygon> polygons;
    for (std::size_t c = 0; c < map.face.cells.size(); ++c) {
        const FaceCell& cell = map.face.cells[c];
        if (!(cell.normal.dot(camera.towards) > 1e-6)) continue;
        for (const auto& piece : cell.pieces) {
            PaintedPolygon polygon;
            for (const Vec3& point : piece) polygon.corners.push_back(camera.seen(point));
            polygon.sides.assign(piece.size(), Side::none);
            polygon.source = c;
            polygons.push_back(std::move(polygon));
        }
    }
    return paintOrder(std::move(polygons));
}

/// From the picture's metres to pixels.
struct Sheet {
    Vec3 low = Vec3::Constant(kInfinity), high = -low;
    double scale = 1, foot = 0;

    explicit Sheet(const std::vector<PaintedPolygon>& polygons) {
        for (const PaintedPolygon& polygon : polygons)
            for (const Vec3& point : polygon.corners) {
                low = low.cwiseMin(point);
                high = high.cwiseMax(point);
            }
        if (polygons.empty()) low = high = Vec3::Zero();
        scale = std::min((kWidth - 2 * kMargin) / std::max(high.x() - low.x(), 1e-9),
                         kMostHigh / std::max(high.y() - low.y(), 1e-9));
        foot = 2 * kMargin + scale * (high.y() - low.y());
    }
    Spot spot(const Vec3& point) const {
        const double left = 0.5 * (kWidth - scale * (high.x() - low.x()));
        return {left + scale * (point.x() - low.x()), kMargin + scale * (high.y() - point.y())};
    }
};

void drawScale(const Sheet& sheet, SvgWriter& svg) {
    const double bar = niceStep(sheet.high.x() - sheet.low.x(), 6), from = kWidth - kMargin - 70;
    const double begin = from - sheet.scale * bar, base = sheet.foot + 30;
    svg.line({begin, base}, {from, base}, "bar");
    for (const double x : {begin, from}) svg.line({x, base - 4}, {x, base + 4}, "bar");
    svg.label({from + 8, base + 5}, csvNumber(bar) + " m");
}

void drawColourBar(const FailureMap& map, MapQuantity quantity, double top, SvgWriter& svg) {
    const double end = scaleEnd(map, quantity);
    const auto box = [&](double left, double right, const char* role,
                         const std::array<std::uint8_t, 3>& colour) {
        const double high = top + 20, low = high + kBarHigh;
        svg.shape({{left, high}, {right, high}, {right, low}, {left, low}}, false, role, "",
                  hexColour(colour), true);
    };
    const double from = kMargin + 110;
    svg.label({kMargin, top + 10}, scaleTitle(quantity), "start", "caption");
    box(kMargin, kMargin + kBarHigh, "swatch", kNever);
    svg.label({kMargin + kBarHigh + 6, top + 32}, "none");
    for (int k = 0; k < kBarSteps; ++k)
        box(from + kBarLong * k / kBarSteps, from + kBarLong * (k + 1) / kBarSteps, "tone",
            mapColour((k + 0.5) / kBarSteps));
    for (const double share : {0.0, 0.5, 1.0})
        svg.label({from + kBarLong * share, top + 52}, csvNumber(share * end), "middle");
}

}  // namespace

std::array<std::uint8_t, 3> mapColour(double share) {
    if (!(share > 0)) return kNever;
    const double place = std::min(share, 1.0) * static_cast<double>(kScale.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), kScale.size() - 2);
    const double part = place - static_cast<double>(below);
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t k = 0; k < 3; ++k)
        colour[k] = static_cast<std::uint8_t>(
            std::lround((1 - part) * kScale[below][k] + part * kScale[below + 1][k]));
    return colour;
}

std::string scaleTitle(MapQuantity quantity) {
    return quantity == MapQuantity::probability ? "Probability of failure"
                                                : "Expected failing volume, m\u00b3 per m\u00b2";
}

std::string hexColour(const std::array<std::uint8_t, 3>& colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", colour[0], colour[1], colour[2]);
    return text;
}

double scaleEnd(const FailureMap& map, MapQuantity quantity) {
    const double most =
        quantity == MapQuantity::probability ? map.largestProbability() : map.largestVolumePerArea();
    if (!(most > 0)) return 1;
    const double power = std::pow(10, std::floor(std::log10(most)));
    for (const double digits : {1, 2, 5})
        if (most <= digits * power * (1 + 1e-12)) return digits * power;
    return 10 * power;
}

std::string mapSvg(const FailureMap& map, MapQuantity quantity) {
    const Camera camera(viewOf(map));
    const std::vector<PaintedPolygon> polygons = painted(map, camera);
    const Sheet sheet(polygons);
    const double end = scaleEnd(map, quantity);
    SvgWriter svg;
    for (const PaintedPolygon& polygon : polygons) {
        std::vector<Spot> spots;
        for (const Vec3& corner : polygon.corners) spots.push_back(sheet.spot(corner));
        svg.shape(spots, false, "cell", tipOf(map, polygon.source),
                  hexColour(mapColour(valueOf(map, quantity, polygon.source) / end)));
    }
    drawColourBar(map, quantity, sheet.foot, svg);
    drawScale(sheet, svg);
    return svg.file(kWidth, sheet.foot + kFoot,
                    quantity == MapQuantity::probability ? "Probability of failure over the face"
                                                         : "Expected failing volume over the face",
                    "", kStyle);
}

std::string viewText(const FailureMap& map) {
    const View view = viewOf(map);
    const double azimuth = std::fmod(degrees(view.azimuth) + 360, 360);
    return "Seen from azimuth " + text(azimuth, 0) + "\u00b0, " + text(degrees(view.elevation), 0) +
           "\u00b0 above the horizon.";
}

}  // namespace talus::tools::batch
