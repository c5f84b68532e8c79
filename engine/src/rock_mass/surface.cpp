// What is wrong with a surface of triangles.

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "rock_mass/place_text.h"
#include "rock_mass/surface_faults.h"

namespace talus {

namespace rock_mass {

namespace {

constexpr double kFlatArea = 1e-14;  // of the extent squared: a triangle of less has no direction

/// An edge of a triangle, in its sense.
struct Side {
    std::int32_t from = 0, to = 0;
    std::size_t triangle = 0;

    std::int32_t low() const { return std::min(from, to); }
    std::int32_t high() const { return std::max(from, to); }
};

/// All sides of all triangles, those of one edge together, in the order of their triangles.
std::vector<Side> sidesByEdge(const TriangleSurface& surface) {
    std::vector<Side> sides;
    sides.reserve(3 * surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            sides.push_back({surface.triangles[t][i], surface.triangles[t][(i + 1) % 3], t});
    std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::pair(a.low(), a.high()) < std::pair(b.low(), b.high());
    });
    return sides;
}

/// Calls `use(first, last)` for the sides of each edge.
template <class Use>
void eachEdge(const std::vector<Side>& sides, const Use& use) {
    for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
        while (next < sides.size() && sides[next].low() == sides[i].low() &&
               sides[next].high() == sides[i].high())
            ++next;
        use(i, next);
    }
}

std::vector<Error> indexErrors(const TriangleSurface& surface) {
    std::vector<Error> errors;
    const auto count = static_cast<std::int32_t>(surface.vertices.size());
    for (std::size_t v = 0; v < surface.vertices.size() && errors.size() < kMostFaults; ++v)
        if (!surface.vertices[v].allFinite())
            errors.push_back({"vertices[" + std::to_string(v) + "]", "coordinates must be finite"});
    for (std::size_t t = 0; t < surface.triangles.size() && errors.size() < kMostFaults; ++t)
        for (const std::int32_t v : surface.triangles[t])
            if (v < 0 || v >= count)
                errors.push_back({triangleField(t), "found vertex " + std::to_string(v) + ", allowed: 0 to " +
                                                        std::to_string(count - 1)});
    return errors;
}

std::vector<Error> flatErrors(const TriangleSurface& surface, double extent) {
    std::vector<Error> errors;
    for (std::size_t t = 0; t < surface.triangles.size() && errors.size() < kMostFaults; ++t)
        if (areaVector(surface, t).norm() <= kFlatArea * extent * extent)
            errors.push_back({triangleField(t), "found a triangle without area at " +
                                                    placeText(cornerOf(surface, t, 0)) +
                                                    ", allowed: three corners that span a plane"});
    return errors;
}

std::string edgeText(const TriangleSurface& surface, const Side& side) {
    return "the edge from " + placeText(surface.vertices[static_cast<std::size_t>(side.from)]) + " to " +
           placeText(surface.vertices[static_cast<std::size_t>(side.to)]);
}

/// Of two triangles that face opposite ways, the one that does so against more of its neighbours is reported,
/// once.
std::vector<Error> oppositeErrors(const TriangleSurface& surface, const std::vector<Side>& sides) {
    std::vector<std::size_t> at;
    std::unordered_map<std::size_t, int> conflicts;
    eachEdge(sides, [&](std::size_t i, std::size_t next) {
        if (next - i != 2 || sides[i].from != sides[i + 1].from) return;
        at.push_back(i);
        ++conflicts[sides[i].triangle];
        ++conflicts[sides[i + 1].triangle];
    });
    std::vector<Error> errors;
    std::vector<std::size_t> told;
    const auto isTold = [&](std::size_t t) { return std::find(told.begin(), told.end(), t) != told.end(); };
    for (const std::size_t i : at) {
        const Side &a = sides[i], &b = sides[i + 1];
        if (isTold(a.triangle) || isTold(b.triangle) || errors.size() >= kMostFaults) continue;
        const bool first = conflicts[a.triangle] >= conflicts[b.triangle];
        told.push_back((first ? a : b).triangle);
        errors.push_back({triangleField(told.back()),
                          "found triangles that face opposite ways along " + edgeText(surface, a) +
                              ": this one and " + triangleField((first ? b : a).triangle) +
                              ", allowed: corners counter-clockwise seen from outside"});
    }
    return errors;
}

std::vector<Error> edgeErrors(const TriangleSurface& surface, bool may_be_open) {
    const std::vector<Side> sides = sidesByEdge(surface);
    std::vector<Error> errors;
    eachEdge(sides, [&](std::size_t i, std::size_t next) {
        const std::size_t count = next - i;
        if (errors.size() >= kMostFaults || count == 2 || (count == 1 && may_be_open)) return;
        errors.push_back({triangleField(sides[i].triangle),
                          count == 1 ? "found an open surface: " + edgeText(surface, sides[i]) +
                                           " has one triangle only, allowed: two"
                                     : "found a non-manifold surface: " + edgeText(surface, sides[i]) +
                                           " has " + std::to_string(count) + " triangles, allowed: two"});
    });
    for (Error& error : oppositeErrors(surface, sides))
        if (errors.size() < kMostFaults) errors.push_back(std::move(error));
    return errors;
}

}  // namespace

std::string triangleField(std::size_t triangle) { return "triangles[" + std::to_string(triangle) + "]"; }

std::vector<OpenEdge> openEdges(const TriangleSurface& surface) {
    const std::vector<Side> sides = sidesByEdge(surface);
    std::vector<OpenEdge> open;
    eachEdge(sides, [&](std::size_t i, std::size_t next) {
        if (next - i == 1) open.push_back({sides[i].from, sides[i].to, sides[i].triangle});
    });
    std::stable_sort(open.begin(), open.end(),
                     [](const OpenEdge& a, const OpenEdge& b) { return a.triangle < b.triangle; });
    return open;
}

std::vector<Error> facetErrors(const TriangleSurface& surface, bool may_be_open) {
    if (surface.triangles.empty())
        return {{"", std::string("found no triangles, allowed: ") +
                         (may_be_open ? "a terrain" : "a closed surface")}};
    auto errors = indexErrors(surface);
    if (errors.empty()) errors = flatErrors(surface, surfaceExtent(surface));
    if (errors.empty()) errors = edgeErrors(surface, may_be_open);
    return errors;
}

}  // namespace rock_mass

double surfaceExtent(const TriangleSurface& surface) {
    if (surface.vertices.empty()) return 0;
    Vec3 min = surface.vertices[0], max = min;
    for (const Vec3& p : surface.vertices) min = min.cwiseMin(p), max = max.cwiseMax(p);
    return (max - min).maxCoeff();
}

double surfaceVolume(const TriangleSurface& surface) {
    if (surface.vertices.empty()) return 0;
    const Vec3 origin = surface.vertices[0];
    double sixfold = 0;
    for (const auto& [a, b, c] : surface.triangles)
        sixfold += (surface.vertices[static_cast<std::size_t>(a)] - origin)
                       .dot((surface.vertices[static_cast<std::size_t>(b)] - origin)
                                .cross(surface.vertices[static_cast<std::size_t>(c)] - origin));
    return sixfold / 6;
}

std::vector<Error> checkSurface(const TriangleSurface& surface) {
    auto errors = rock_mass::facetErrors(surface, false);
    if (errors.empty()) errors = rock_mass::crossingErrors(surface);
    if (!errors.empty()) return errors;
    const double volume = surfaceVolume(surface);
    if (!(volume > 0))
        return {{"", "found an inverted surface, which faces inwards (volume " +
                         rock_mass::numberText(volume) +
                         " m3), allowed: triangles counter-clockwise seen from outside"}};
    return {};
}

}  // namespace talus
