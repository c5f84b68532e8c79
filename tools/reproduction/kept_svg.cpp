// The side view of a kept run's end.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "reproduction/kept.h"
#include "talus/formats/export.h"

namespace talus::tools {

namespace {

constexpr double kWidth = 420, kMargin = 10;  // [px]
constexpr double kFloorShown = 0.1;           // of the floor's depth, and beside the blocks [m]

/// Model coordinates onto the drawing's metres: x to the right, gravity downwards.
struct Side {
    double cos_tilt = 1, sin_tilt = 0;

    Spot at(double x, double z) const { return {x * cos_tilt - z * sin_tilt, x * sin_tilt + z * cos_tilt}; }
};

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
        fit();
    }

    double height() const { return height_; }

    void drawBlocks(Svg& svg) const {
        for (const Drawn& drawn : blocks_) {
            const std::string& name = model_.blocks[drawn.block].name;
            if (!isFree(drawn.block)) continue;
            const FailureMode role = kept_.failure.roles[drawn.block];
            const bool stays = role == FailureMode::none;
            svg.polygon(pixels(drawn.outline), stays ? "stable" : talus::toString(role),
                        name + (stays ? ": stays" : std::string(": ") + talus::toString(role)));
        }
    }

    /// The floor's top as far as there are blocks, and a little more.
    void drawFloor(Svg& svg) const {
        const double low = low_x_ - kFloorShown, high = high_x_ + kFloorShown;
        svg.polygon(pixels({side_.at(low, -kFloorShown), side_.at(high, -kFloorShown), side_.at(high, 0),
                            side_.at(low, 0)}),
                    "fixed", "floor, fixed");
    }

    /// Between the rows of the two columns beside a fissure, up to the level water table.
    void drawWater(Svg& svg, int fissure, double table) const {
        const std::string ends[2] = {"c" + std::to_string(fissure) + "r1s1",
                                     "c" + std::to_string(fissure + 1) + "r1s1"};
        const double from = wall(ends[0], true), to = wall(ends[1], false);
        if (!std::isfinite(from) || !std::isfinite(to) || !std::isfinite(table)) return;
        const auto level = [&](double x) { return (table - x * side_.sin_tilt) / side_.cos_tilt; };
        if (from < to)
            svg.polygon(pixels({side_.at(from, 0), side_.at(to, 0), side_.at(to, level(to)),
                                side_.at(from, level(from))}),
                        "water", "water");
        const Spot mark = pixel(side_.at(to, level(to)));
        svg.polygon({mark, {mark.x - 5, mark.y - 8}, {mark.x + 5, mark.y - 8}}, "water");
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

    void fit() {
        for (std::size_t b = 0; b < model_.blocks.size(); ++b) {
            if (!isFree(b)) continue;
            for (auto v = kept_.geometry.vertex_begin[b]; v < kept_.geometry.vertex_begin[b + 1]; ++v) {
                const Vec3& vertex = vertices_[static_cast<std::size_t>(v)];
                low_x_ = std::min(low_x_, vertex.x()), high_x_ = std::max(high_x_, vertex.x());
                high_z_ = std::max(high_z_, vertex.z());
            }
        }
        Spot low{kInfinity, kInfinity}, high{-kInfinity, -kInfinity};
        for (const double x : {low_x_ - kFloorShown, high_x_ + kFloorShown})
            for (const double z : {-kFloorShown, high_z_}) {
                const Spot spot = side_.at(x, z);
                low = {std::min(low.x, spot.x), std::min(low.y, spot.y)};
                high = {std::max(high.x, spot.x), std::max(high.y, spot.y)};
            }
        scale_ = (kWidth - 2 * kMargin) / (high.x - low.x);
        left_ = low.x, top_ = high.y;
        height_ = scale_ * (high.y - low.y) + 2 * kMargin;
    }

    Spot pixel(Spot spot) const {
        return {kMargin + scale_ * (spot.x - left_), kMargin + scale_ * (top_ - spot.y)};
    }
    std::vector<Spot> pixels(std::vector<Spot> spots) const {
        for (Spot& spot : spots) spot = pixel(spot);
        return spots;
    }

    const KeptRun& kept_;
    const Model& model_;
    Side side_;
    std::vector<Vec3> vertices_;
    std::vector<Drawn> blocks_;
    double low_x_ = kInfinity, high_x_ = -kInfinity, high_z_ = -kInfinity;  ///< of the free blocks [m]
    double scale_ = 1, left_ = 0, top_ = 0, height_ = 0;
};

}  // namespace

Svg drawEnd(const KeptRun& kept, const std::vector<int>& fissures, const std::string& title) {
    const EndView view(kept);
    Svg svg(kWidth, view.height(), "The end of the failing run, " + title, seenText(kept));
    view.drawFloor(svg);
    const auto& tables = kept.last.water.table;
    for (std::size_t w = 0; w < fissures.size() && w < tables.size(); ++w)
        view.drawWater(svg, fissures[w], tables[w]);
    view.drawBlocks(svg);
    return svg;
}

}  // namespace talus::tools
