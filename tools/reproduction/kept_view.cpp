// The side view of a kept run's end.

#include <algorithm>
#include <cmath>

#include "reproduction/kept.h"
#include "reproduction/slope.h"
#include "talus/analysis.h"
#include "talus/formats/export.h"

namespace talus::tools {

namespace {

constexpr double kFloorShown = 0.1;  // of the floor's depth, and beside the blocks [m]

/// Outline of a convex body seen from its side (Andrew's monotone chain).
std::vector<Spot> outline(std::vector<Spot> spots) {
    std::sort(spots.begin(), spots.end(),
              [](Spot a, Spot b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    std::vector<Spot> hull;
    const auto turnsLeft = [&](Spot c) {
        const Spot a = hull[hull.size() - 2], b = hull.back();
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
    };
    for (int side = 0; side < 2; ++side) {
        const std::size_t start = hull.size();
        for (const Spot& spot : spots) {
            while (hull.size() >= start + 2 && !turnsLeft(spot)) hull.pop_back();
            hull.push_back(spot);
        }
        hull.pop_back();
        std::reverse(spots.begin(), spots.end());
    }
    return hull;
}

/// A block as it is drawn; those nearer to the reader are drawn later.
struct Drawn {
    std::vector<Spot> outline;
    double y = 0;  ///< of its middle; the reader looks along +y
    std::size_t block = 0;
};

class EndView {
 public:
    explicit EndView(const KeptRun& kept)
        : kept_(kept),
          model_(kept.scenario.model),
          side_{std::cos(kept.last.tilt), std::sin(kept.last.tilt)} {
        formats::SnapshotHeader header;
        header.geometry = kept.geometry;
        for (const Block& block : model_.blocks) header.names.push_back(block.name);
        vertices_ = formats::placedVertices(header, kept.last);
        for (std::size_t b = 0; b < model_.blocks.size(); ++b) blocks_.push_back(drawnBlock(b));
        std::stable_sort(blocks_.begin(), blocks_.end(),
                         [](const Drawn& a, const Drawn& b) { return a.y > b.y; });
    }

    void addBlocks(Drawing& drawing) const {
        for (const Drawn& drawn : blocks_) {
            const std::string& name = model_.blocks[drawn.block].name;
            if (!isFree(drawn.block)) continue;
            const FailureMode role = kept_.failure.roles[drawn.block];
            const bool stays = role == FailureMode::none;
            drawing.shapes.push_back(
                {stays ? "stable" : talus::toString(role), drawn.outline,
                 name + (stays ? ": stays" : std::string(": ") + talus::toString(role))});
        }
    }

    /// The floor's top as far as there are blocks, and a little more.
    void addFloor(Drawing& drawing) const {
        double low = kInfinity, high = -kInfinity;
        for (std::size_t b = 0; b < model_.blocks.size(); ++b) {
            if (!isFree(b)) continue;
            for (auto v = kept_.geometry.vertex_begin[b]; v < kept_.geometry.vertex_begin[b + 1]; ++v) {
                const double x = vertices_[static_cast<std::size_t>(v)].x();
                low = std::min(low, x), high = std::max(high, x);
            }
        }
        drawing.shapes.push_back(
            {"fixed", side_.box(low - kFloorShown, -kFloorShown, high + kFloorShown, 0), "floor, fixed"});
    }

    /// Between the rows of the two columns beside a fissure, up to the level water table.
    void addWater(Drawing& drawing, int fissure, double table) const {
        const std::string ends[2] = {"c" + std::to_string(fissure) + "r1s1",
                                     "c" + std::to_string(fissure + 1) + "r1s1"};
        const double from = wall(ends[0], true), to = wall(ends[1], false);
        if (!std::isfinite(from) || !std::isfinite(to) || !std::isfinite(table)) return;
        const auto level = [&](double x) { return (table - x * side_.sin_tilt) / side_.cos_tilt; };
        if (from < to)
            drawing.shapes.push_back(
                {"water",
                 {side_.at(from, 0), side_.at(to, 0), side_.at(to, level(to)), side_.at(from, level(from))},
                 "water"});
        addLevelMark(drawing, side_.at(to, level(to)));
    }

 private:
    bool isFree(std::size_t b) const { return model_.blocks[b].motion == Motion::free; }

    Drawn drawnBlock(std::size_t b) const {
        Drawn drawn;
        drawn.block = b;
        std::vector<Spot> spots;
        const auto first = static_cast<std::size_t>(kept_.geometry.vertex_begin[b]);
        const auto last = static_cast<std::size_t>(kept_.geometry.vertex_begin[b + 1]);
        for (std::size_t v = first; v < last; ++v) {
            spots.push_back(side_.at(vertices_[v].x(), vertices_[v].z()));
            drawn.y += vertices_[v].y() / static_cast<double>(last - first);
        }
        drawn.outline = outline(std::move(spots));
        return drawn;
    }

    /// The farthest x of a block towards +x or -x.
    double wall(const std::string& name, bool uphill) const {
        for (std::size_t b = 0; b < model_.blocks.size(); ++b) {
            if (model_.blocks[b].name != name) continue;
            const auto begin = vertices_.begin() + kept_.geometry.vertex_begin[b];
            const auto end = vertices_.begin() + kept_.geometry.vertex_begin[b + 1];
            const auto by_x = [](const Vec3& u, const Vec3& v) { return u.x() < v.x(); };
            return uphill ? std::max_element(begin, end, by_x)->x() : std::min_element(begin, end, by_x)->x();
        }
        return uphill ? kInfinity : -kInfinity;
    }

    const KeptRun& kept_;
    const Model& model_;
    SideView side_;
    std::vector<Vec3> vertices_;
    std::vector<Drawn> blocks_;
};

}  // namespace

Drawing drawEnd(const KeptRun& kept, const std::vector<int>& fissures, const std::string& title) {
    const EndView view(kept);
    Drawing drawing{"The end of the failing run, " + title, seenText(kept)};
    view.addFloor(drawing);
    const auto& tables = kept.last.water.table;
    for (std::size_t w = 0; w < fissures.size() && w < tables.size(); ++w)
        view.addWater(drawing, fissures[w], tables[w]);
    view.addBlocks(drawing);
    return drawing;
}

}  // namespace talus::tools
