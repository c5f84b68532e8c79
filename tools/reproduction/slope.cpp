#include "reproduction/slope.h"

#include <algorithm>
#include <cmath>

namespace talus::tools {
namespace {

constexpr double kWidth = 340, kMargin = 10;                   // [px]
constexpr double kFloorThickness = 0.1, kFloorOverhang = 0.2;  // [m]
constexpr double kThinnestWater = 0.02;  // water in a closed joint has no width of its own [m]

/// Model coordinates x (uphill), z (normal to the floor) onto pixels, the floor tilted.
struct View {
    double cos_tilt = 1, sin_tilt = 0, scale = 1;
    Spot shift{};

    Spot at(double x, double z) const {
        return {shift.x + scale * (x * cos_tilt - z * sin_tilt),
                shift.y - scale * (x * sin_tilt + z * cos_tilt)};
    }
    std::vector<Spot> box(double x0, double z0, double x1, double z1) const {
        return {at(x0, z0), at(x1, z0), at(x1, z1), at(x0, z1)};
    }
};

/// Rectangle around all that is drawn, in model units.
struct Extent {
    double x0, z0, x1, z1;
};

Extent extentOf(const StackShape& stack) {
    return {-kFloorOverhang, -kFloorThickness, stack.columns * stack.block.x() + kFloorOverhang,
            stack.rows * stack.block.z()};
}

/// Fits the tilted extent into the drawing's width; `height` returns what it needs [px].
View fittedView(const Extent& extent, double tilt, double& height) {
    View view{std::cos(tilt), std::sin(tilt), 1, {}};
    const auto corners = view.box(extent.x0, extent.z0, extent.x1, extent.z1);
    const auto byX = [](Spot a, Spot b) { return a.x < b.x; };
    const auto byY = [](Spot a, Spot b) { return a.y < b.y; };
    const auto [left, right] = std::minmax_element(corners.begin(), corners.end(), byX);
    const auto [top, bottom] = std::minmax_element(corners.begin(), corners.end(), byY);
    view.scale = (kWidth - 2 * kMargin) / (right->x - left->x);
    view.shift = {kMargin - view.scale * left->x, kMargin - view.scale * top->y};
    height = view.scale * (bottom->y - top->y) + 2 * kMargin;
    return view;
}

std::string blockName(int column, int row) {
    return "c" + std::to_string(column) + "r" + std::to_string(row) + "s1";
}

const BlockMotion* motionOf(const SearchResult& search, const std::string& block) {
    for (const BlockMotion& motion : search.motions) {
        if (motion.block == block) return &motion;
    }
    return nullptr;
}

/// Factor that enlarges the first slice's motion to what is drawn.
double enlargement(const PaperRun& run) {
    double farthest = 0;
    for (const BlockMotion& motion : run.search.motions) {
        if (motion.moving)
            farthest = std::max(farthest, std::hypot(motion.translation.x(), motion.translation.z()));
    }
    return farthest > 0 ? kDrawnMotion / farthest : 0;
}

std::string roleClass(const BlockMotion* motion) {
    if (!motion || !motion->moving) return "stable";
    return motion->mode == FailureMode::none ? "stable" : talus::toString(motion->mode);
}

std::string blockTip(const std::string& name, const BlockMotion* motion) {
    if (!motion || !motion->moving) return name + ": stays";
    return name + ": " + talus::toString(motion->mode) + ", mobilised friction " +
           text(motion->mobilised_friction, 2);
}

/// Shift of a block in the drawing [m].
Vec3 drawnShift(const BlockMotion* motion, double enlarged) {
    return motion && motion->moving ? Vec3(enlarged * motion->translation) : Vec3(Vec3::Zero());
}

void drawBlocks(Svg& svg, const PaperRun& run, const View& view, double enlarged) {
    const StackShape& stack = *run.what.scenario.model.stack;
    const double b = stack.block.x(), h = stack.block.z();
    for (int column = 1; column <= stack.columns; ++column) {
        for (int row = 1; row <= stack.rows; ++row) {
            const std::string name = blockName(column, row);
            const BlockMotion* motion = motionOf(run.search, name);
            const Vec3 shift = drawnShift(motion, enlarged);
            const double x = (column - 1) * b + shift.x(), z = (row - 1) * h + shift.z();
            svg.polygon(view.box(x, z, x + b, z + h), roleClass(motion), blockTip(name, motion));
        }
    }
}

/// How far the wall in front of a fissure has moved away from it in the drawing [m].
double opening(const PaperRun& run, int fissure, double enlarged) {
    const StackShape& stack = *run.what.scenario.model.stack;
    double widest = 0;
    for (int row = 1; row <= stack.rows; ++row) {
        const Vec3 front = drawnShift(motionOf(run.search, blockName(fissure, row)), enlarged);
        const Vec3 back = drawnShift(motionOf(run.search, blockName(fissure + 1, row)), enlarged);
        widest = std::max(widest, back.x() - front.x());
    }
    return widest;
}

/// Water between the two walls; its surface is level, so it stands higher on the model's z at the downhill
/// wall.
void drawWaterBody(Svg& svg, const View& view, double back, double width, double depth) {
    const double rise = width * view.sin_tilt / view.cos_tilt;
    const std::vector<Spot> body{view.at(back, 0), view.at(back, depth), view.at(back - width, depth + rise),
                                 view.at(back - width, 0)};
    svg.polygon(body, "water", "water, " + text(depth, 2) + " m deep");
}

/// The usual mark of a water level: a triangle on its point.
void drawLevelMark(Svg& svg, Spot at) {
    svg.polygon({at, {at.x - 5, at.y - 8}, {at.x + 5, at.y - 8}}, "water");
    svg.line({at.x - 9, at.y}, {at.x + 9, at.y}, "water-line");
}

void drawTilt(Svg& svg, const PaperRun& run, const View& view) {
    const Spot corner = view.at(-kFloorOverhang, -kFloorThickness);
    const double reach = 120;
    svg.line(corner, {corner.x + reach, corner.y}, "dots");
    const auto angle = criticalDeg(run);
    const std::string shown_angle = angle ? text(*angle, 2) + "\u00b0" : "no answer";
    svg.label({corner.x + reach + 6, corner.y - 1}, shown_angle, "start", "caption");
}

}  // namespace

Svg drawSlope(const PaperRun& run) {
    const auto tilt_deg = criticalDeg(run) ? criticalDeg(run) : theoryDeg(run);
    double height = 0;
    const StackShape stack = run.what.scenario.model.stack.value_or(StackShape{});
    const Extent extent = extentOf(stack);
    const View view = fittedView(extent, radians(tilt_deg.value_or(0)), height);
    Svg svg(kWidth, height, "Slope, " + label(run.what),
            "The slope tilted by its critical angle; " + movingText(run));
    svg.polygon(view.box(extent.x0, extent.z0, extent.x1, 0), "fixed", "floor, fixed");
    const double enlarged = enlargement(run);
    const auto water = [&](bool open) {
        for (const int fissure : run.what.fissures) {
            const double gap = opening(run, fissure, enlarged);
            if ((gap > kThinnestWater) != open) continue;
            const double back = fissure * stack.block.x() +
                                drawnShift(motionOf(run.search, blockName(fissure + 1, 1)), enlarged).x();
            drawWaterBody(svg, view, back, open ? gap : kThinnestWater, run.what.water_depth);
        }
    };
    water(true);
    if (run.what.scenario.model.stack) drawBlocks(svg, run, view, enlarged);
    water(false);
    for (const int fissure : run.what.fissures) {
        drawLevelMark(svg, view.at(fissure * stack.block.x() - 0.01, run.what.water_depth));
    }
    drawTilt(svg, run, view);
    return svg;
}

}  // namespace talus::tools
