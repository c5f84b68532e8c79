#include "mesh/solids.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "toml/wording.h"

namespace talus::formats::mesh {

namespace {

using Corners = std::array<std::int32_t, 3>;
using Edge = std::pair<std::int32_t, std::int32_t>;

/// A triangle with one of its edges, of one solid.
struct Side {
    std::int32_t solid = -1;
    Edge edge;
    std::size_t triangle = 0;
};

class Parting {
 public:
    Parting(const TriangleSurface& surface, std::vector<std::int32_t> solid,
            const std::vector<std::string>& names)
        : surface_(surface), solid_(std::move(solid)), names_(names), root_(surface.triangles.size()) {
        std::map<std::pair<std::int32_t, Corners>, std::size_t> known;
        for (std::size_t t = 0; t < root_.size(); ++t) {
            Corners corners = surface.triangles[t];
            std::sort(corners.begin(), corners.end());
            root_[t] = known.try_emplace({solid_[t], corners}, t).first->second;
        }
    }

    Result<std::vector<SolidPart>> run() {
        if (namesPartOneSolid()) std::fill(solid_.begin(), solid_.end(), -1);
        if (auto error = join()) return *error;
        return parts();
    }

 private:
    /// By edge, those of one solid together; not of doubled triangles.
    std::vector<Side> sides() const {
        std::vector<Side> all;
        all.reserve(3 * solid_.size());
        for (std::size_t t = 0; t < solid_.size(); ++t) {
            for (std::size_t i = 0; i < 3 && root_[t] == t; ++i) {
                all.push_back({solid_[t],
                               std::minmax(surface_.triangles[t][i], surface_.triangles[t][(i + 1) % 3]), t});
            }
        }
        std::stable_sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
            return std::pair(a.edge, a.solid) < std::pair(b.edge, b.solid);
        });
        return all;
    }

    /// Groups of an OBJ file may be the sides of one body.
    bool namesPartOneSolid() const {
        const std::vector<Side> all = sides();
        for (std::size_t i = 0, next = 0; i < all.size(); i = next) {
            while (next < all.size() && all[next].edge == all[i].edge) ++next;
            if (next - i == 2 && all[i].solid != all[i + 1].solid) return true;
        }
        return false;
    }

    std::size_t rootOf(std::size_t triangle) {
        while (root_[triangle] != triangle) triangle = root_[triangle] = root_[root_[triangle]];
        return triangle;
    }

    std::optional<Error> join() {
        const std::vector<Side> all = sides();
        for (std::size_t i = 0, next = 0; i < all.size(); i = next) {
            while (next < all.size() && all[next].edge == all[i].edge && all[next].solid == all[i].solid)
                ++next;
            if (next - i > 2) return touching(all[i], next - i);
            if (next - i < 2) continue;
            const auto [low, high] = std::minmax({rootOf(all[i].triangle), rootOf(all[i + 1].triangle)});
            root_[high] = low;
        }
        return std::nullopt;
    }

    Error touching(const Side& side, std::size_t count) const {
        const auto place = [&](std::int32_t v) {
            const Vec3& p = surface_.vertices[static_cast<std::size_t>(v)];
            return "(" + toml::numberText(p.x()) + ", " + toml::numberText(p.y()) + ", " +
                   toml::numberText(p.z()) + ")";
        };
        return {"triangles[" + std::to_string(side.triangle) + "]",
                "found " + std::to_string(count) + " triangles at the edge from " + place(side.edge.first) +
                    " to " + place(side.edge.second) +
                    ", allowed: two; solids that touch have to be told apart by their names (o or g in "
                    "OBJ, solid in STL, a polyface mesh each in DXF)"};
    }

    std::vector<SolidPart> parts() {
        std::vector<SolidPart> all;
        std::vector<std::size_t> part_of_root(root_.size(), SIZE_MAX);
        std::map<std::string, std::size_t> times;
        for (std::size_t t = 0; t < root_.size(); ++t) {
            std::size_t& part = part_of_root[rootOf(t)];
            if (part == SIZE_MAX) {
                part = all.size();
                std::string name = solid_[t] < 0 ? "" : names_[static_cast<std::size_t>(solid_[t])];
                if (const std::size_t time = ++times[name]; time > 1 && !name.empty())
                    name += "-" + std::to_string(time);
                all.push_back({std::move(name), {}, {}});
            }
            all[part].source.push_back(t);
        }
        for (SolidPart& part : all) addSurface(part);
        return all;
    }

    void addSurface(SolidPart& part) const {
        std::map<std::int32_t, std::int32_t> number;
        for (const std::size_t t : part.source) {
            auto triangle = surface_.triangles[t];
            for (std::int32_t& v : triangle) {
                const auto [known, is_new] =
                    number.try_emplace(v, static_cast<std::int32_t>(part.surface.vertices.size()));
                if (is_new) part.surface.vertices.push_back(surface_.vertices[static_cast<std::size_t>(v)]);
                v = known->second;
            }
            part.surface.triangles.push_back(triangle);
        }
    }

    const TriangleSurface& surface_;
    std::vector<std::int32_t> solid_;
    const std::vector<std::string>& names_;
    std::vector<std::size_t> root_;  ///< of each triangle: the first with its corners, then of its solid
};

}  // namespace

Result<std::vector<SolidPart>> solidsOf(const TriangleSurface& surface,
                                        const std::vector<std::int32_t>& solid,
                                        const std::vector<std::string>& names) {
    return Parting(surface, solid, names).run();
}

}  // namespace talus::formats::mesh
