// A terrain closed by sides and a base.

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "rock_mass/place_text.h"
#include "rock_mass/plane_polygon.h"
#include "rock_mass/surface_faults.h"

namespace talus {

namespace {

using namespace rock_mass;

/// A closed run of open edges, counter-clockwise in plan where the surface lies inside of it.
struct Rim {
    std::vector<std::int32_t> vertices;
    std::size_t triangle = 0;  ///< at its first edge
    double area = 0;           ///< in plan; negative about a hole [m^2]
};

class Closing {
 public:
    Closing(TriangleSurface terrain, double base) : surface_(std::move(terrain)), base_(base) {}

    Result<ClosedTerrain> run() {
        if (auto errors = facetErrors(surface_, true); !errors.empty()) return errors;
        lookUp();
        if (auto errors = findRims(); !errors.empty()) return errors;
        if (auto errors = pieceErrors(); !errors.empty()) return errors;
        if (auto error = baseError()) return *error;
        std::vector<PlanePoint> plan;
        for (const std::int32_t v : rims_[0].vertices) plan.push_back(at(v).head<2>());
        if (auto error = planError(plan)) return *error;
        const auto floor = triangulate(plan);
        if (floor.empty())
            return Error{triangleField(rims_[0].triangle),
                         "found a terrain too narrow in plan, allowed: a rim whose sides do not touch"};
        const std::size_t own = surface_.triangles.size();
        close(floor);
        if (auto errors = sideErrors(own); !errors.empty()) return errors;
        return ClosedTerrain{std::move(surface_), turned_};
    }

 private:
    const Vec3& at(std::int32_t vertex) const { return surface_.vertices[static_cast<std::size_t>(vertex)]; }

    /// Its area in plan decides whether it faces up or down as a whole; overhangs may face down.
    void lookUp() {
        double plan = 0;
        for (std::size_t t = 0; t < surface_.triangles.size(); ++t) plan += areaVector(surface_, t).z();
        turned_ = plan < 0;
        if (turned_)
            for (auto& triangle : surface_.triangles) std::swap(triangle[0], triangle[1]);
    }

    std::vector<Error> findRims() {
        std::map<std::int32_t, OpenEdge> leaving;
        for (const OpenEdge& edge : openEdges(surface_))
            if (!leaving.emplace(edge.from, edge).second)
                return {{triangleField(edge.triangle),
                         "found a terrain whose parts are connected only by a point, at " +
                             placeText(at(edge.from)) + ", allowed: one rim around all of it"}};
        while (!leaving.empty()) {
            Rim rim;
            rim.triangle = leaving.begin()->second.triangle;
            std::vector<PlanePoint> plan;
            for (auto edge = leaving.begin(); edge != leaving.end();) {
                rim.vertices.push_back(edge->first);
                plan.push_back(at(edge->first).head<2>());
                const std::int32_t next = edge->second.to;
                leaving.erase(edge);
                edge = leaving.find(next);
            }
            rim.area = 0.5 * doubleArea(plan);
            rims_.push_back(std::move(rim));
        }
        std::stable_sort(rims_.begin(), rims_.end(),
                         [](const Rim& a, const Rim& b) { return a.area > b.area; });
        if (rims_.empty())
            return {{"",
                     "found a closed surface with a base, allowed: an open terrain, or a closed surface "
                     "without base"}};
        return {};
    }

    /// The piece each vertex belongs to, by its first vertex.
    std::vector<std::int32_t> pieces() const {
        std::vector<std::int32_t> root(surface_.vertices.size());
        std::iota(root.begin(), root.end(), 0);
        const auto rootOf = [&](std::int32_t v) {
            while (root[static_cast<std::size_t>(v)] != v) {
                auto& up = root[static_cast<std::size_t>(v)];
                v = up = root[static_cast<std::size_t>(up)];
            }
            return v;
        };
        for (const auto& triangle : surface_.triangles)
            for (const std::int32_t v : triangle) {
                const auto [low, high] = std::minmax({rootOf(triangle[0]), rootOf(v)});
                root[static_cast<std::size_t>(high)] = low;
            }
        for (std::size_t v = 0; v < root.size(); ++v) root[v] = rootOf(static_cast<std::int32_t>(v));
        return root;
    }

    std::vector<Error> pieceErrors() const {
        std::vector<Error> errors;
        const std::vector<std::int32_t> piece = pieces();
        std::vector<std::int32_t> known{piece[static_cast<std::size_t>(rims_[0].vertices[0])]};
        for (std::size_t t = 0; t < surface_.triangles.size() && errors.size() < kMostFaults; ++t) {
            const std::int32_t own = piece[static_cast<std::size_t>(surface_.triangles[t][0])];
            if (std::find(known.begin(), known.end(), own) != known.end()) continue;
            known.push_back(own);
            errors.push_back({triangleField(t),
                              "found a second piece of terrain, apart from the largest, near " +
                                  placeText(cornerOf(surface_, t, 0)) + ", allowed: a terrain in one piece"});
        }
        for (std::size_t r = 1; r < rims_.size() && errors.size() < kMostFaults; ++r) {
            const Rim& rim = rims_[r];
            if (piece[static_cast<std::size_t>(rim.vertices[0])] != known[0]) continue;
            Vec3 middle = Vec3::Zero();
            for (const std::int32_t v : rim.vertices)
                middle += at(v) / static_cast<double>(rim.vertices.size());
            errors.push_back({triangleField(rim.triangle),
                              "found a hole with " + std::to_string(rim.vertices.size()) + " edges about " +
                                  placeText(middle) + ", from " + placeText(at(rim.vertices[0])) +
                                  " on, allowed: a terrain without holes"});
        }
        return errors;
    }

    std::optional<Error> baseError() const {
        const auto lowest = std::min_element(surface_.vertices.begin(), surface_.vertices.end(),
                                             [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
        if (base_ < lowest->z()) return std::nullopt;
        return Error{"base", "found " + numberText(base_) +
                                 ", allowed: below the terrain, whose lowest point is " + placeText(*lowest)};
    }

    std::optional<Error> planError(const std::vector<PlanePoint>& plan) const {
        const auto& rim = rims_[0].vertices;
        for (std::size_t i = 0; i < plan.size(); ++i)
            if (plan[i] == plan[(i + 1) % plan.size()])
                return Error{triangleField(rims_[0].triangle),
                             "found an upright edge in the terrain's rim, at " + placeText(at(rim[i])) +
                                 ", allowed: a rim whose corners lie apart in plan"};
        const auto fault = polygonFault(plan);
        if (!fault) return std::nullopt;
        return Error{triangleField(rims_[0].triangle),
                     "found a rim that meets itself in plan, at " + placeText(at(rim[fault->first])) +
                         " and " + placeText(at(rim[fault->second])) +
                         ", allowed: a rim that can be closed by upright sides"};
    }

    /// Sides and base, seen from outside counter-clockwise; the rim goes round counter-clockwise in plan.
    void close(const std::vector<std::array<std::int32_t, 3>>& floor) {
        const auto& rim = rims_[0].vertices;
        const auto first = static_cast<std::int32_t>(surface_.vertices.size());
        const auto count = static_cast<std::int32_t>(rim.size());
        for (const std::int32_t v : rim) surface_.vertices.emplace_back(at(v).x(), at(v).y(), base_);
        for (std::int32_t i = 0; i < count; ++i) {
            const std::int32_t next = (i + 1) % count, a = rim[static_cast<std::size_t>(i)],
                               b = rim[static_cast<std::size_t>(next)];
            surface_.triangles.push_back({first + i, first + next, b});
            surface_.triangles.push_back({first + i, b, a});
        }
        for (const auto& [a, b, c] : floor) surface_.triangles.push_back({first + a, first + c, first + b});
    }

    /// Faults of the whole; triangles made here have no number in the user's file.
    std::vector<Error> sideErrors(std::size_t own) const {
        auto errors = checkSurface(surface_);
        for (Error& error : errors)
            for (std::size_t t = own; t < surface_.triangles.size(); ++t) {
                const std::string made = triangleField(t);
                if (error.field == made) error.field.clear();
                if (const auto place = error.message.find(made); place != std::string::npos)
                    error.message.replace(place, made.size(), "the side or base below the terrain's rim");
            }
        return errors;
    }

    TriangleSurface surface_;
    double base_;  ///< [m]
    bool turned_ = false;
    std::vector<Rim> rims_;  ///< the outer one first
};

}  // namespace

Result<ClosedTerrain> closeTerrain(TriangleSurface terrain, double base) {
    return Closing(std::move(terrain), base).run();
}

}  // namespace talus
