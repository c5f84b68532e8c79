// A picture of the blocks. Only faces that look at the reader and that no other block covers are drawn, the farther
// ones first.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include "report/blocks_files.h"
#include "report/svg.h"
#include "report/svg_writer.h"

namespace talus::tools {

namespace {

constexpr double kWidth = 900, kMargin = 20;  // [px]
constexpr std::string_view kStyle = R"css(
.page{fill:#fff}
.block{stroke:#3b342b;stroke-width:.7;stroke-linejoin:round}
.bar{stroke:#1a1a1a}
.text{fill:#1a1a1a;font:13px system-ui,sans-serif}
)css";

/// Right, up and towards the reader.
struct Camera {
    Vec3 right, up, towards;

    explicit Camera(const View& view)
        : right(-std::cos(view.azimuth), std::sin(view.azimuth), 0),
          towards(std::sin(view.azimuth) * std::cos(view.elevation),
                  std::cos(view.azimuth) * std::cos(view.elevation), std::sin(view.elevation)) {
        up = towards.cross(right);
    }
};

struct Bounds {
    Vec3 min = Vec3::Constant(kInfinity), max = Vec3::Constant(-kInfinity);

    void add(const Vec3& point) {
        min = min.cwiseMin(point);
        max = max.cwiseMax(point);
    }
};

/// Looks up the block at a point, by a grid over the blocks' bounds.
class BlockFinder {
 public:
    explicit BlockFinder(const Model& model) : model_(model) {
        for (const Block& block : model.blocks) {
            bounds_.emplace_back();
            for (const Vec3& v : block.shape.vertices) bounds_.back().add(v);
            all_.add(bounds_.back().min);
            all_.add(bounds_.back().max);
        }
        const double volume = (all_.max - all_.min).prod();
        cell_ = std::cbrt(volume / static_cast<double>(model.blocks.size()));
        for (std::size_t b = 0; b < bounds_.size(); ++b) {
            const auto low = cellOf(bounds_[b].min), high = cellOf(bounds_[b].max);
            for (auto x = low[0]; x <= high[0]; ++x)
                for (auto y = low[1]; y <= high[1]; ++y)
                    for (auto z = low[2]; z <= high[2]; ++z) blocks_[key(x, y, z)].push_back(b);
        }
    }

    double size() const { return (all_.max - all_.min).norm(); }

    bool isInside(const Vec3& point) const {
        const auto [x, y, z] = cellOf(point);
        const auto found = blocks_.find(key(x, y, z));
        if (found == blocks_.end()) return false;
        return std::any_of(found->second.begin(), found->second.end(),
                           [&](std::size_t b) { return contains(b, point); });
    }

 private:
    std::array<std::int64_t, 3> cellOf(const Vec3& point) const {
        std::array<std::int64_t, 3> cell;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto axis = static_cast<Eigen::Index>(i);
            cell[i] = static_cast<std::int64_t>(std::floor((point[axis] - all_.min[axis]) / cell_));
        }
        return cell;
    }
    static std::int64_t key(std::int64_t x, std::int64_t y, std::int64_t z) {
        return x + (y + (z << 21)) * (std::int64_t{1} << 21);
    }

    bool contains(std::size_t b, const Vec3& point) const {
        if ((point.array() < bounds_[b].min.array()).any() || (point.array() > bounds_[b].max.array()).any())
            return false;
        return talus::contains(model_.blocks[b].shape, point);
    }

    const Model& model_;
    std::vector<Bounds> bounds_;
    Bounds all_;
    double cell_ = 1;
    std::unordered_map<std::int64_t, std::vector<std::size_t>> blocks_;
};

struct VisibleFace {
    std::size_t block = 0, face = 0;
    double depth = 0;  ///< towards the reader [m]
    Vec3 normal = Vec3::Zero();
};

/// Whether other blocks lie against the whole face, as far as its middle, its corners and the middles of its
/// sides tell.
bool isCovered(const BlockFinder& finder, const Polyhedron& shape, std::size_t f, const Vec3& normal,
               const Vec3& centroid) {
    const Vec3 off = 1e-5 * finder.size() * normal;
    if (!finder.isInside(centroid + off)) return false;
    const auto& outline = shape.faces[f];
    const auto covered = [&](const Vec3& rim) {
        return finder.isInside(rim + 0.05 * (centroid - rim) + off);
    };
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vec3& a = shape.vertices[static_cast<std::size_t>(outline[i])];
        const Vec3& b = shape.vertices[static_cast<std::size_t>(outline[(i + 1) % outline.size()])];
        if (!covered(a) || !covered(0.5 * (a + b))) return false;
    }
    return true;
}

std::vector<VisibleFace> visibleFaces(const Model& model, const Camera& camera) {
    const BlockFinder finder(model);
    std::vector<VisibleFace> visible;
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        const Polyhedron& shape = model.blocks[b].shape;
        for (std::size_t f = 0; f < shape.faces.size(); ++f) {
            if (shape.isInner(f)) continue;
            const Vec3 normal = shape.faceNormal(f), centroid = shape.faceCentroid(f);
            if (normal.dot(camera.towards) <= 1e-9 || isCovered(finder, shape, f, normal, centroid)) continue;
            visible.push_back({b, f, camera.towards.dot(centroid), normal});
        }
    }
    std::stable_sort(visible.begin(), visible.end(),
                     [](const VisibleFace& a, const VisibleFace& b) { return a.depth < b.depth; });
    return visible;
}

/// Lambert shading under a light from the upper left; each block a little different, so that joints show.
std::string colour(const Block& block, std::size_t index, const Vec3& normal, const Camera& camera) {
    const Vec3 light = (0.9 * camera.towards + 0.8 * Vec3::UnitZ() - 0.7 * camera.right).normalized();
    const double tint = 0.94 + 0.12 * static_cast<double>((index * 2654435761u >> 8) % 16) / 15;
    const double shade = tint * (0.62 + 0.38 * std::max(0.0, normal.dot(light)));
    const Vec3 rock = block.motion == Motion::free ? Vec3(222, 203, 170) : Vec3(176, 180, 186);
    char text[8];
    const auto level = [&](double value) {
        return static_cast<unsigned>(std::clamp(shade * value, 0.0, 255.0));
    };
    std::snprintf(text, sizeof text, "#%02x%02x%02x", level(rock.x()), level(rock.y()), level(rock.z()));
    return text;
}

/// Millimetres to kilometres, without trailing noise.
std::string lengthText(double metres) {
    char text[32];
    std::snprintf(text, sizeof text, "%g m", metres);
    return text;
}

}  // namespace

std::string blocksSvg(const Model& model, const View& view, std::string_view title) {
    const Camera camera(view);
    Bounds flat;
    for (const Block& block : model.blocks)
        for (const Vec3& v : block.shape.vertices) flat.add({camera.right.dot(v), camera.up.dot(v), 0});
    const double scale = (kWidth - 2 * kMargin) / std::max(flat.max.x() - flat.min.x(), 1e-12);
    const double height = scale * (flat.max.y() - flat.min.y()) + 2 * kMargin + 30;
    const auto pixel = [&](const Vec3& x) {
        return Spot{kMargin + scale * (camera.right.dot(x) - flat.min.x()),
                    kMargin + scale * (flat.max.y() - camera.up.dot(x))};
    };
    SvgWriter svg;
    for (const VisibleFace& visible : visibleFaces(model, camera)) {
        const Block& block = model.blocks[visible.block];
        std::vector<Spot> outline;
        for (const std::int32_t v : block.shape.faces[visible.face])
            outline.push_back(pixel(block.shape.vertices[static_cast<std::size_t>(v)]));
        svg.shape(outline, false, "block", block.name, colour(block, visible.block, visible.normal, camera));
    }
    const double bar = niceStep(flat.max.x() - flat.min.x(), 6), base = height - 14;
    const double end = kMargin + scale * bar;
    svg.line({kMargin, base}, {end, base}, "bar");
    for (const double x : {kMargin, end}) svg.line({x, base - 4}, {x, base + 4}, "bar");
    svg.label({end + 8, base + 4}, lengthText(bar));
    return svg.file(kWidth, height, title, "", kStyle);
}

}  // namespace talus::tools
