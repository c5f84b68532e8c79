// Doubled triangles, triangles that face the wrong way, holes.

#include "talus/mend_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "rock_mass/holes.h"
#include "rock_mass/surface_faults.h"

namespace talus {

namespace {

using namespace rock_mass;

using Triangle = std::array<std::int32_t, 3>;

bool runs(const Triangle& triangle, std::int32_t from, std::int32_t to) {
    for (std::size_t i = 0; i < 3; ++i)
        if (triangle[i] == from && triangle[(i + 1) % 3] == to) return true;
    return false;
}

/// Two triangles that share an edge which no third one has.
struct Neighbour {
    std::size_t triangle = 0;
    bool faces_alike = false;
};

class Mending {
 public:
    Mending(const TriangleSurface& surface, const MendLimits& limits) : limits_(limits) {
        result_.surface = surface;
        result_.source.resize(surface.triangles.size());
        std::iota(result_.source.begin(), result_.source.end(), std::size_t{0});
    }

    MendedSurface run() {
        dropDoubled();
        if (!result_.doubled.empty()) repairAgain();
        faceAlike();
        closeHoles();
        faceOutwards();
        return std::move(result_);
    }

 private:
    std::vector<Triangle>& triangles() { return result_.surface.triangles; }

    Vec3 middleOf(std::size_t triangle) const {
        Vec3 sum = Vec3::Zero();
        for (std::size_t i = 0; i < 3; ++i) sum += cornerOf(result_.surface, triangle, i);
        return sum / 3;
    }

    void dropDoubled() {
        std::set<Triangle> known;
        std::size_t kept = 0;
        for (std::size_t t = 0; t < triangles().size(); ++t) {
            Triangle corners = triangles()[t];
            std::sort(corners.begin(), corners.end());
            if (!known.insert(corners).second) {
                result_.doubled.push_back(middleOf(t));
                continue;
            }
            triangles()[kept] = triangles()[t];
            result_.source[kept++] = result_.source[t];
        }
        triangles().resize(kept);
        result_.source.resize(kept);
    }

    /// Edges that doubled triangles hid may have T-junctions.
    void repairAgain() {
        SurfaceRepair repaired = repairSurface(result_.surface, limits_.tolerance);
        for (std::size_t& source : repaired.source) source = result_.source[source];
        result_.surface = std::move(repaired.surface);
        result_.source = std::move(repaired.source);
    }

    std::vector<std::vector<Neighbour>> neighbours() {
        std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> edges;
        for (std::size_t t = 0; t < triangles().size(); ++t) {
            for (std::size_t i = 0; i < 3; ++i)
                edges[std::minmax(triangles()[t][i], triangles()[t][(i + 1) % 3])].push_back(t);
        }
        std::vector<std::vector<Neighbour>> all(triangles().size());
        for (const auto& [edge, sharing] : edges) {
            if (sharing.size() != 2) continue;
            const std::size_t a = sharing[0], b = sharing[1];
            const bool alike = runs(triangles()[a], edge.first, edge.second) !=
                               runs(triangles()[b], edge.first, edge.second);
            all[a].push_back({b, alike});
            all[b].push_back({a, alike});
        }
        return all;
    }

    /// In each piece to the side of its majority.
    void faceAlike() {
        const auto beside = neighbours();
        enum class Sense : std::uint8_t { unknown, kept, turned };
        std::vector<Sense> sense(triangles().size(), Sense::unknown);
        std::vector<std::size_t> piece;
        for (std::size_t start = 0; start < sense.size(); ++start) {
            if (sense[start] != Sense::unknown) continue;
            sense[start] = Sense::kept;
            piece.assign(1, start);
            std::size_t turned = 0;
            for (std::size_t k = 0; k < piece.size(); ++k) {
                const std::size_t own = piece[k];
                turned += sense[own] == Sense::turned ? 1 : 0;
                for (const Neighbour& next : beside[own]) {
                    if (sense[next.triangle] != Sense::unknown) continue;
                    const bool turns = next.faces_alike == (sense[own] == Sense::turned);
                    sense[next.triangle] = turns ? Sense::turned : Sense::kept;
                    piece.push_back(next.triangle);
                }
            }
            const Sense wrong = 2 * turned > piece.size() ? Sense::kept : Sense::turned;
            std::sort(piece.begin(), piece.end());
            for (const std::size_t t : piece)
                if (sense[t] == wrong) turn(t), result_.turned.push_back(middleOf(t));
        }
    }

    void turn(std::size_t triangle) { std::swap(triangles()[triangle][0], triangles()[triangle][1]); }

    void closeHoles() {
        std::vector<Outline> outlines = openOutlines(result_.surface);
        if (limits_.keeps_rim && !outlines.empty()) {
            const auto plan = [&](const Outline& outline) {
                return std::abs(areaVectorOf(outline, result_.surface).z());
            };
            outlines.erase(
                std::max_element(outlines.begin(), outlines.end(),
                                 [&](const Outline& a, const Outline& b) { return plan(a) < plan(b); }));
        }
        for (const Outline& outline : outlines) {
            const SurfaceHole hole = holeOf(outline, result_.surface);
            if (!(hole.width <= limits_.largest_hole)) {
                result_.too_wide.push_back(hole);
                continue;
            }
            const std::vector<Triangle> lid = lidOf(outline, result_.surface);
            (lid.empty() ? result_.unclear : result_.closed).push_back(hole);
            triangles().insert(triangles().end(), lid.begin(), lid.end());
            result_.source.resize(triangles().size(), MendedSurface::kMade);
        }
    }

    /// Not a terrain, nor several pieces, of which one may be a cavity.
    void faceOutwards() {
        if (limits_.keeps_rim || !checkedWithoutEdges() || surfaceVolume(result_.surface) >= 0) return;
        for (std::size_t t = 0; t < triangles().size(); ++t) {
            turn(t);
            result_.turned.push_back(middleOf(t));
        }
    }

    /// Closed, and one piece.
    bool checkedWithoutEdges() {
        if (!facetErrors(result_.surface, false).empty()) return false;
        const auto beside = neighbours();
        std::vector<bool> seen(beside.size());
        std::vector<std::size_t> piece(1, 0);
        seen[0] = true;
        for (std::size_t k = 0; k < piece.size(); ++k) {
            for (const Neighbour& next : beside[piece[k]])
                if (!seen[next.triangle]) seen[next.triangle] = true, piece.push_back(next.triangle);
        }
        return piece.size() == seen.size();
    }

    MendLimits limits_;
    MendedSurface result_;
};

}  // namespace

MendedSurface mendSurface(const TriangleSurface& surface, const MendLimits& limits) {
    return Mending(surface, limits).run();
}

}  // namespace talus
