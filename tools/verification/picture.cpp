// Side view of a problem.

#include <algorithm>
#include <cmath>

#include "cli/json.h"
#include "report/figures.h"
#include "verification/manual.h"

namespace talus::tools {

namespace {

/// Seen along y, gravity down the page.
Spot fromTheSide(const Vec3& x, double tilt) {
    return {x.x() * std::cos(tilt) - x.z() * std::sin(tilt), x.x() * std::sin(tilt) + x.z() * std::cos(tilt)};
}

double turnOf(Spot o, Spot a, Spot b) { return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x); }

/// Their hull, counter-clockwise (Andrew's monotone chain).
std::vector<Spot> outline(std::vector<Spot> spots) {
    std::sort(spots.begin(), spots.end(),
              [](Spot a, Spot b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<Spot> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = hull.size();
        for (const Spot& spot : spots) {
            while (hull.size() >= begin + 2 && turnOf(hull[hull.size() - 2], hull.back(), spot) <= 0)
                hull.pop_back();
            hull.push_back(spot);
        }
        hull.pop_back();
        std::reverse(spots.begin(), spots.end());
    }
    return hull;
}

std::string roleOf(const Block& block, const std::vector<BlockMotion>& motions) {
    if (block.motion != Motion::free) return "fixed";
    const auto found = std::find_if(motions.begin(), motions.end(),
                                    [&](const BlockMotion& motion) { return motion.block == block.name; });
    if (found == motions.end() || !found->moving || found->mode == FailureMode::none) return "stable";
    return toString(found->mode);
}

double tiltOf(const VerifiedRow& row) {
    const Model& model = row.computed->scenario.model;
    const bool found = row.what.quantity == "critical_angle_deg" && row.value;
    return found ? row.computed->load : model.gravity.tilt;
}

/// Those farther back are drawn first.
std::vector<const Block*> backToFront(const Model& model) {
    std::vector<const Block*> blocks;
    for (const Block& block : model.blocks) blocks.push_back(&block);
    const auto front = [](const Block* block) {
        double y = kInfinity;
        for (const Vec3& vertex : block->shape.vertices) y = std::min(y, vertex.y());
        return y;
    };
    std::stable_sort(blocks.begin(), blocks.end(), [&](const Block* a, const Block* b) {
        if ((a->motion == Motion::free) != (b->motion == Motion::free)) return b->motion == Motion::free;
        return front(a) > front(b);
    });
    return blocks;
}

}  // namespace

Json problemPicture(const VerifiedRow& row) {
    Drawing drawing{.title = row.what.name,
                    .description = "The blocks of " + row.what.scenario + " seen from the side"};
    const double tilt = tiltOf(row);
    for (const Block* block : backToFront(row.computed->scenario.model)) {
        std::vector<Spot> spots;
        for (const Vec3& vertex : block->shape.vertices) spots.push_back(fromTheSide(vertex, tilt));
        drawing.shapes.push_back(
            {roleOf(*block, row.computed->motions), outline(std::move(spots)), block->name});
    }
    drawing.caption_title = row.what.name;
    const std::string file = scenarioName(row.what) + ".toml";
    drawing.links = {{"scenarios/" + file, file}};
    return toJson(drawing);
}

}  // namespace talus::tools
