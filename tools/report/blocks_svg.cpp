// A picture of the blocks: their visible faces, the farther ones first, with a legend.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

#include "report/blocks_files.h"
#include "report/hidden_parts.h"
#include "report/svg.h"
#include "report/svg_writer.h"
#include "report/visible_faces.h"
#include "report/wet_outlines.h"

namespace talus::tools {

namespace {

constexpr double kWidth = 900, kMargin = 20, kFoot = 56;  // [px]
constexpr double kHead = 26, kRow = 20;                   // of a heading, of the legend's lines [px]
constexpr double kLeastLine = 0.7;                        // [px] shorter is a speck
constexpr double kLetter = 7.7, kLine = 13.5;             // of names, with the gap beside them [px]
constexpr double kMostHigh = 1080;                        // of the blocks: fits a sheet [px]
constexpr double kCompass = 0.036;                        // radius, of the picture's larger side
constexpr std::string_view kStyle = R"css(
.page{fill:#fff}
.block{stroke-width:.9;stroke-linejoin:round}
.crease{stroke:#3b342b;stroke-width:.35;stroke-opacity:.35;fill:none}
.rim{stroke:#3b342b;stroke-width:.8;fill:none;stroke-linecap:round}
.joint{stroke:#1e1a15;stroke-width:1.3;fill:none;stroke-linecap:round}
.water{fill:#1c7ed6;fill-opacity:.3;stroke:#1c7ed6;stroke-width:.8}
.table{fill:none;stroke:#1c7ed6;stroke-width:1.6;stroke-dasharray:7 3}
.bar{stroke:#1a1a1a;fill:none}
.needle{fill:#1a1a1a}
.swatch{stroke:#3b342b;stroke-width:.7}
.text{fill:#1a1a1a;font:13px system-ui,sans-serif}
.caption{fill:#1a1a1a;font:600 14px system-ui,sans-serif}
.name{fill:#1a1a1a;font:12.5px system-ui,sans-serif;paint-order:stroke;stroke:#fff;stroke-opacity:.7;stroke-width:2.5px}
)css";

/// Lambert shading under a light from the upper left; each block a little different, so that joints show.
std::string colour(const BlockLook& look, std::size_t index, const Vec3& normal, const Camera& camera) {
    const Vec3 light = (0.9 * camera.towards + 0.8 * camera.level - 0.7 * camera.right).normalized();
    const double tint = 0.94 + 0.12 * static_cast<double>((index * 2654435761u >> 8) % 16) / 15;
    const double shade = tint * (0.62 + 0.38 * std::max(0.0, normal.dot(light)));
    char text[8];
    const auto level = [&](double value) {
        return static_cast<unsigned>(std::clamp(shade * value, 0.0, 255.0));
    };
    std::snprintf(text, sizeof text, "#%02x%02x%02x", level(look.red), level(look.green), level(look.blue));
    return text;
}

/// From the picture's metres to pixels.
class Sheet {
 public:
    Sheet(const Model& model, const Camera& camera, double head) : head_(head) {
        for (const Block& block : model.blocks)
            for (const Vec3& v : block.shape.vertices) add(camera.seen(v));
        scale_ = std::min((kWidth - 2 * kMargin) / std::max(high_.x() - low_.x(), 1e-12),
                          kMostHigh / std::max(high_.y() - low_.y(), 1e-12));
    }
    Spot spot(const Vec3& seen) const {
        const double left = 0.5 * (kWidth - scale_ * (high_.x() - low_.x()));
        return {left + scale_ * (seen.x() - low_.x()), head_ + kMargin + scale_ * (high_.y() - seen.y())};
    }
    std::vector<Spot> spots(const std::vector<Vec3>& seen) const {
        std::vector<Spot> list;
        for (const Vec3& point : seen) list.push_back(spot(point));
        return list;
    }
    double scale() const { return scale_; }
    double metresAcross() const { return high_.x() - low_.x(); }
    double foot() const { return head_ + scale_ * (high_.y() - low_.y()) + 2 * kMargin; }

 private:
    void add(const Vec3& seen) {
        low_ = low_.cwiseMin(seen);
        high_ = high_.cwiseMax(seen);
    }

    Vec3 low_ = Vec3::Constant(kInfinity), high_ = Vec3::Constant(-kInfinity);
    double head_, scale_ = 1;
};

const char* roleOf(Side side) {
    return side == Side::joint ? "joint" : side == Side::rim ? "rim" : side == Side::crease ? "crease" : "";
}

void drawPolygon(const Model& model, const Painting& painting, const VisibleFace& face,
                 const PaintedPolygon& polygon, const Camera& camera, const Sheet& sheet, SvgWriter& svg) {
    const Block& block = model.blocks[face.block];
    const BlockLook& look = painting.looks[painting.look_of_block[face.block]];
    const std::vector<Spot> spots = sheet.spots(polygon.corners);
    // Of its own colour around, so that no gap shows between two pieces.
    svg.shape(spots, false, "block", block.name, colour(look, face.block, face.normal, camera), true);
}

void drawLine(const SeenLine& line, const Sheet& sheet, SvgWriter& svg) {
    const Spot from = sheet.spot(line.from), to = sheet.spot(line.to);
    if (std::hypot(to.x - from.x, to.y - from.y) > kLeastLine) svg.line(from, to, roleOf(line.side));
}

// --- names
// -----------------------------------------------------------------------------------------------------------

bool isIn(const PaintedPolygon& polygon, const Vec3& point) {
    const auto& corners = polygon.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
        if ((b.x() - a.x()) * (point.y() - a.y()) - (b.y() - a.y()) * (point.x() - a.x()) < 0) return false;
    }
    return true;
}

/// Where a name of this many letters stands on a piece of a block that nothing painted later covers.
std::optional<Vec3> placeOfName(const std::vector<PaintedPolygon>& painted, std::size_t at,
                                std::size_t letters, double scale) {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : painted[at].corners) middle += corner;
    middle /= static_cast<double>(painted[at].corners.size());
    const double half = 0.5 * kLetter * static_cast<double>(letters) / scale, high = 0.5 * kLine / scale;
    for (const double x : {-half, 0.0, half})
        for (const double y : {-high, high}) {
            const Vec3 point = middle + Vec3(x, y, 0);
            if (!isIn(painted[at], point)) return std::nullopt;
            for (std::size_t k = at + 1; k < painted.size(); ++k)
                if (isIn(painted[k], point)) return std::nullopt;
        }
    return middle;
}

/// A piece of a block's face that is as wide and high as its name.
struct NamePlace {
    std::size_t piece;
    double area;  ///< [m2]
};

double areaOf(const PaintedPolygon& polygon) {
    double twice = 0;
    const auto& corners = polygon.corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
        twice += a.x() * b.y() - b.x() * a.y();
    }
    return 0.5 * std::abs(twice);
}

bool isAsLarge(const PaintedPolygon& polygon, double wide, double high) {
    Vec3 low = Vec3::Constant(kInfinity), top = -low;
    for (const Vec3& corner : polygon.corners) {
        low = low.cwiseMin(corner);
        top = top.cwiseMax(corner);
    }
    return top.x() - low.x() >= wide && top.y() - low.y() >= high;
}

/// Puts a block's name on its largest visible face with room for it. A name stays within the visible part of
/// its own block, so that none lies on another.
void drawNames(const Model& model, const VisibleFaces& visible, const std::vector<PaintedPolygon>& painted,
               const Sheet& sheet, SvgWriter& svg) {
    const auto block_of = [&](std::size_t piece) { return visible.faces[painted[piece].source].block; };
    std::vector<NamePlace> places;
    for (std::size_t k = 0; k < painted.size(); ++k) {
        const double letters = static_cast<double>(model.blocks[block_of(k)].name.size());
        if (isAsLarge(painted[k], kLetter * letters / sheet.scale(), kLine / sheet.scale()))
            places.push_back({k, areaOf(painted[k])});
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const NamePlace& a, const NamePlace& b) { return a.area > b.area; });
    std::set<std::size_t> named;
    for (const NamePlace& place : places) {
        const std::size_t block = block_of(place.piece);
        const std::string& name = model.blocks[block].name;
        if (named.contains(block)) continue;
        if (const auto middle = placeOfName(painted, place.piece, name.size(), sheet.scale())) {
            const Spot spot = sheet.spot(*middle);
            svg.label({spot.x, spot.y + 4}, name, "middle", "name");
            named.insert(block);
        }
    }
}

// --- what explains it
// ------------------------------------------------------------------------------------------------

/// Millimetres to kilometres, without trailing noise.
std::string lengthText(double metres) {
    char text[32];
    std::snprintf(text, sizeof text, "%g m", metres);
    return text;
}

void drawScale(const Sheet& sheet, double base, const std::string& remark, SvgWriter& svg) {
    const double bar = niceStep(sheet.metresAcross(), 6), end = kMargin + sheet.scale() * bar;
    svg.line({kMargin, base}, {end, base}, "bar");
    for (const double x : {kMargin, end}) svg.line({x, base - 4}, {x, base + 4}, "bar");
    svg.label({end + 8, base + 4}, lengthText(bar) + (remark.empty() ? "" : "; " + remark));
}

/// The ring of the horizon as it is seen, with north; in plan a circle. It grows with the picture.
struct Compass {
    double radius, high;  ///< of the ring, of half of it with its letter [px]

    Compass(const Camera& camera, double width, double height)
        : radius(std::clamp(kCompass * std::max(width, height), 28.0, 64.0)),
          high((radius + 9) * std::abs(camera.towards.z()) + 12) {}
};

void drawCompass(const Camera& camera, const Compass& compass, Spot middle, SvgWriter& svg) {
    const double radius = compass.radius;
    const auto at = [&](double bearing, double size) {
        const Vec3 seen = camera.seen({std::sin(bearing), std::cos(bearing), 0});
        return Spot{middle.x + size * seen.x(), middle.y - size * seen.y()};
    };
    std::vector<Spot> ring;
    for (int k = 0; k <= 48; ++k) ring.push_back(at(k * M_PI / 24, radius));
    svg.shape(ring, true, "bar");
    svg.shape({at(0, radius), at(M_PI * 0.9, 0.45 * radius), middle, at(-M_PI * 0.9, 0.45 * radius)}, false,
              "needle", "north");
    const Spot letter = at(0, radius + 9);
    svg.label({letter.x, letter.y + 4}, "N", "middle");
}

struct LegendEntry {
    std::string role, words, fill;
    bool line = false;
};

std::vector<LegendEntry> legendOf(const Model& model, const Painting& painting, const VisibleFaces& visible,
                                  bool wet, const Camera& camera) {
    const auto any = [&](std::size_t look) {
        return std::any_of(visible.faces.begin(), visible.faces.end(), [&](const VisibleFace& face) {
            return painting.look_of_block[face.block] == look;
        });
    };
    const bool joints =
        std::any_of(visible.polygons.begin(), visible.polygons.end(), [](const auto& polygon) {
            return std::find(polygon.sides.begin(), polygon.sides.end(), Side::joint) != polygon.sides.end();
        });
    std::vector<LegendEntry> entries;
    const Vec3 lit = camera.towards;
    for (std::size_t k = 0; k < painting.looks.size(); ++k) {
        const BlockLook& look = painting.looks[k];
        if (any(k)) entries.push_back({"swatch", look.words, colour(look, 0, lit, camera)});
    }
    if (joints) entries.push_back({"joint", "joint", "", true});
    if (wet) entries.push_back({"water", "water, seen through the rock", ""});
    if (model.phreatic) entries.push_back({"table", "water table", "", true});
    return entries;
}

/// In lines that end before `right`. Returns the height of those after the first.
double drawLegend(const std::vector<LegendEntry>& entries, double base, double right, SvgWriter& svg) {
    const double first = base;
    double x = kMargin;
    for (const LegendEntry& entry : entries) {
        const double wide = (entry.line ? 28 : 20) + 7.2 * static_cast<double>(entry.words.size());
        if (x > kMargin && x + wide > right) x = kMargin, base += kRow;
        if (entry.line)
            svg.line({x, base - 4}, {x + 22, base - 4}, entry.role);
        else
            svg.shape({{x, base - 10}, {x + 14, base - 10}, {x + 14, base + 1}, {x, base + 1}}, false,
                      entry.role, "", entry.fill);
        svg.label({x + (entry.line ? 28 : 20), base}, entry.words);
        x += wide + 22;
    }
    return base - first;
}

}  // namespace

Painting paintedByMotion(const Model& model) {
    Painting painting{{{"free", 222, 203, 170}, {"fixed", 176, 180, 186}, {"driven", 176, 180, 186}}, {}};
    for (const Block& block : model.blocks)
        painting.look_of_block.push_back(block.motion == Motion::free    ? 0
                                         : block.motion == Motion::fixed ? 1
                                                                         : 2);
    return painting;
}

std::string blocksSvg(const Model& model, const View& view, std::string_view title) {
    return blocksSvg(model, view, title, paintedByMotion(model));
}

std::string blocksSvg(const Model& model, const View& view, std::string_view title,
                      const Painting& painting) {
    const Camera camera(view);
    const Sheet sheet(model, camera, painting.heading.empty() ? 0 : kHead);
    const VisibleFaces visible = visibleFaces(model, camera);
    const SeenParts seen_parts = seenParts(paintOrder(visible.polygons));
    SvgWriter svg;
    for (const PaintedPolygon& polygon : seen_parts.polygons)
        drawPolygon(model, painting, visible.faces[polygon.source], polygon, camera, sheet, svg);
    for (const SeenLine& line : seen_parts.lines) drawLine(line, sheet, svg);
    const std::vector<std::vector<Vec3>> wet = wetOutlines(model);
    const auto seen = [&](std::vector<Vec3> points) {
        for (Vec3& point : points) point = camera.seen(point);
        return sheet.spots(points);
    };
    for (const auto& outline : wet) svg.shape(seen(outline), false, "water");
    for (const auto& line : waterTable(model)) svg.shape(seen(line), true, "table");
    drawNames(model, visible, seen_parts.polygons, sheet, svg);
    const double foot = sheet.foot();
    const Compass compass(camera, kWidth, foot);
    if (!painting.heading.empty()) svg.label({kMargin, kHead}, painting.heading, "start", "caption");
    drawScale(sheet, foot + 10, painting.remark, svg);
    const double compass_left = kWidth - kMargin - 2 * compass.radius - 32;
    const double more =
        drawLegend(legendOf(model, painting, visible, !wet.empty(), camera), foot + 40, compass_left, svg);
    drawCompass(camera, compass, {kWidth - kMargin - compass.radius - 16, foot + compass.high}, svg);
    return svg.file(kWidth, foot + std::max(kFoot + more, 2 * compass.high + 8), title, "", kStyle);
}

}  // namespace talus::tools
