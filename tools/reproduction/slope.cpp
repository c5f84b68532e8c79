#include "reproduction/slope.h"

#include <algorithm>
#include <cmath>

#include "cli/json.h"
#include "cli/text.h"
#include "talus/analysis.h"

namespace talus::tools {
namespace {

constexpr double kFloorThickness = 0.1, kFloorOverhang = 0.2;  // [m]
constexpr double kThinnestWater = 0.02;  // water in a closed joint has no width of its own [m]

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

void addBlocks(Drawing& drawing, const PaperRun& run, const SideView& view, double enlarged) {
    const StackShape& stack = *run.what.scenario.model.stack;
    const double b = stack.block.x(), h = stack.block.z();
    for (int column = 1; column <= stack.columns; ++column) {
        for (int row = 1; row <= stack.rows; ++row) {
            const std::string name = blockName(column, row);
            const BlockMotion* motion = motionOf(run.search, name);
            const Vec3 shift = drawnShift(motion, enlarged);
            const double x = (column - 1) * b + shift.x(), z = (row - 1) * h + shift.z();
            drawing.shapes.push_back(
                {roleClass(motion), view.box(x, z, x + b, z + h), blockTip(name, motion)});
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
Shape waterBody(const SideView& view, double back, double width, double depth) {
    const double rise = width * view.sin_tilt / view.cos_tilt;
    return {"water",
            {view.at(back, 0), view.at(back, depth), view.at(back - width, depth + rise),
             view.at(back - width, 0)},
            "water, " + text(depth, 2) + " m deep"};
}

/// Water in open fissures lies behind the blocks, in closed ones before them, or it would not be seen.
void addWater(Drawing& drawing, const PaperRun& run, const SideView& view, double enlarged, bool open) {
    for (const int fissure : run.what.fissures) {
        const double gap = opening(run, fissure, enlarged);
        if ((gap > kThinnestWater) != open) continue;
        const double back = fissure * run.what.scenario.model.stack->block.x() +
                            drawnShift(motionOf(run.search, blockName(fissure + 1, 1)), enlarged).x();
        drawing.shapes.push_back(waterBody(view, back, open ? gap : kThinnestWater, run.what.water_depth));
    }
}

/// The horizontal at the floor's lower end, and the angle.
void addTilt(Drawing& drawing, const PaperRun& run, const SideView& view) {
    const Spot corner = view.at(-kFloorOverhang, -kFloorThickness);
    constexpr double kReach = 0.67, kBeside = 0.03;
    drawing.shapes.push_back({"dots", {corner, {corner.x + kReach, corner.y}}, "", true});
    const auto angle = criticalDeg(run);
    drawing.label = {Spot{corner.x + kReach + kBeside, corner.y},
                     angle ? text(*angle, 2) + "\u00b0" : "no answer"};
}

}  // namespace

void addLevelMark(Drawing& drawing, Spot at) {
    constexpr double kHalf = 0.028, kHeight = 0.045;  // [m]
    drawing.shapes.push_back({"water", {at, {at.x - kHalf, at.y + kHeight}, {at.x + kHalf, at.y + kHeight}}});
    drawing.shapes.push_back({"water-line", {{at.x - 2 * kHalf, at.y}, {at.x + 2 * kHalf, at.y}}, "", true});
}

Json slopeColours() {
    Json colours = Json::array();
    for (const auto& [role, words] : {std::pair{"stable", "stays"},
                                      {"sliding", "slides"},
                                      {"mixed", "slides and turns"},
                                      {"toppling", "topples"},
                                      {"fixed", "floor, fixed"},
                                      {"water", "water"}})
        colours.push_back({{"role", role}, {"text", words}});
    return colours;
}

Drawing drawSlope(const PaperRun& run) {
    const double tilt = radians((criticalDeg(run) ? criticalDeg(run) : theoryDeg(run)).value_or(0));
    const SideView view{std::cos(tilt), std::sin(tilt)};
    const auto& stack = run.what.scenario.model.stack;
    const double length = stack ? stack->columns * stack->block.x() : 0;
    Drawing drawing{"Slope, " + label(run.what),
                    "The slope tilted by its critical angle; " + movingText(run)};
    drawing.shapes.push_back(
        {"fixed", view.box(-kFloorOverhang, -kFloorThickness, length + kFloorOverhang, 0), "floor, fixed"});
    if (stack) {
        const double enlarged = enlargement(run);
        addWater(drawing, run, view, enlarged, true);
        addBlocks(drawing, run, view, enlarged);
        addWater(drawing, run, view, enlarged, false);
        for (const int fissure : run.what.fissures)
            addLevelMark(drawing, view.at(fissure * stack->block.x() - 0.01, run.what.water_depth));
    }
    addTilt(drawing, run, view);
    return drawing;
}

}  // namespace talus::tools
