#include <algorithm>
#include <cmath>

#include "forces/water.h"
#include "forces/wet_walls.h"
#include "geometry/pressure.h"
#include "validate/findings.h"

namespace talus {
namespace {

/// Rows of a list by block, read entry by entry.
struct Rows {
    const std::vector<std::int64_t>& begin;
    std::vector<std::int64_t> next;

    explicit Rows(const std::vector<std::int64_t>& begins)
        : begin(begins), next(begins.begin(), begins.end() - 1) {}
    /// Where the next entry of a block has to be; -1 when its row is full.
    std::int64_t take(std::int32_t block) {
        const auto b = static_cast<std::size_t>(block);
        return next[b] < begin[b + 1] ? next[b]++ : -1;
    }
};

bool areRows(const std::vector<std::int64_t>& begin, std::size_t rows, std::size_t entries) {
    return begin.size() == rows + 1 && begin.front() == 0 &&
           begin.back() == static_cast<std::int64_t>(entries) && std::is_sorted(begin.begin(), begin.end());
}

bool isSized(const VectorArray& array, std::size_t n) {
    return array.x.size() == n && array.y.size() == n && array.z.size() == n;
}

bool areSized(const WetPatches& wet) {
    const std::size_t n = wet.size();
    for (const VectorArray* array : {&wet.origin, &wet.e1, &wet.e2, &wet.head, &wet.force, &wet.moment})
        if (!isSized(*array, n)) return false;
    return wet.water.size() == n && wet.interface.size() == n && wet.moments.size() == n &&
           wet.computed_position.size() == n && wet.computed_orientation.size() == n &&
           wet.vertex_x.size() == wet.vertex_y.size() && areRows(wet.vertex_begin, n, wet.vertex_x.size());
}

bool isConvex(const Polygon& polygon) {
    const double rounding = 1e-13 * extent(polygon) * extent(polygon);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 in = polygon.next(k) - polygon[k],
                   out = polygon.next((k + 1) % polygon.size()) - polygon.next(k);
        if (in.x() * out.y() - in.y() * out.x() < -rounding) return false;
    }
    return polygon.size() >= 3 && area(polygon) > 0;
}

bool areSame(const PolygonMoments& a, const PolygonMoments& b) {
    return a.area == b.area && a.centroid == b.centroid && a.second.xx == b.second.xx &&
           a.second.xy == b.second.xy && a.second.yy == b.second.yy;
}

void checkWall(const State& state, std::size_t w, Findings& findings) {
    const WetPatches& wet = state.wet;
    const Interfaces& f = state.interfaces;
    if (!findings.expect(wet.block[w] >= 0 && static_cast<std::size_t>(wet.block[w]) < state.blocks.size() &&
                             wet.interface[w] >= -1 && wet.interface[w] < static_cast<std::int32_t>(f.size()),
                         "wet wall", w, "it is not on a block, or of no interface"))
        return;
    if (wet.interface[w] >= 0) {
        const auto i = static_cast<std::size_t>(wet.interface[w]);
        findings.expect(wet.block[w] == f.block_a[i] || wet.block[w] == f.block_b[i], "wet wall", w,
                        "its interface is of other blocks");
    }
    findings.expect(areOrthonormal(wet.e1.get(w), wet.e2.get(w)), "wet wall", w,
                    "its tangents are not orthonormal");
    const Polygon polygon = wetPolygon(state.wet, w);
    if (findings.expect(isConvex(polygon), "wet wall", w, "it is not convex and counter-clockwise"))
        findings.expect(areSame(wet.moments[w], momentsOf(polygon)), "wet wall", w,
                        "its moments are not those of its polygon");
}

void checkWaters(const State& state, Findings& findings) {
    const WetPatches& wet = state.wet;
    const std::size_t waters = state.geometry->model.waters.size();
    findings.expect(state.drained.size() == waters && state.pressure.size() == waters &&
                        state.water_load.size() == waters,
                    "arrays of waters differ in size");
    if (!findings.expect(wet.water_begin.size() == waters + 1 && wet.water_begin.front() == 0 &&
                             wet.water_begin.back() == wet.size() &&
                             std::is_sorted(wet.water_begin.begin(), wet.water_begin.end()),
                         "wet walls are not rows by water"))
        return;
    for (std::size_t water = 0; water < waters; ++water)
        for (std::size_t w = wet.water_begin[water]; w < wet.water_begin[water + 1]; ++w)
            findings.expect(wet.water[w] == static_cast<std::int32_t>(water), "wet wall", w,
                            "it is not sorted by its water");
}

void checkWetRows(const State& state, Findings& findings) {
    const Incidence& incidence = state.incidence;
    const std::size_t n = state.blocks.size();
    if (!findings.expect(
            areRows(incidence.wet_begin, n, incidence.wet.size()) && incidence.wet.size() == state.wet.size(),
            "blocks' wet walls are not rows by block"))
        return;
    Rows rows(incidence.wet_begin);
    for (std::size_t w = 0; w < state.wet.size(); ++w) {
        const std::int64_t k = rows.take(state.wet.block[w]);
        findings.expect(k >= 0 && incidence.wet[static_cast<std::size_t>(k)] == static_cast<std::int32_t>(w),
                        "wet wall", w, "its block does not have it");
    }
    std::vector<std::int32_t> wet_blocks;
    for (std::size_t b = 0; b < n; ++b)
        if (incidence.wet_begin[b] < incidence.wet_begin[b + 1])
            wet_blocks.push_back(static_cast<std::int32_t>(b));
    findings.expect(wet_blocks == incidence.wet_blocks, "the list of blocks with wet walls is another");
}

}  // namespace

void checkIncidence(const State& state, Findings& findings) {
    const Incidence& incidence = state.incidence;
    const Interfaces& f = state.interfaces;
    if (!findings.expect(areRows(incidence.interface_begin, state.blocks.size(), 2 * f.size()) &&
                             incidence.interface.size() == 2 * f.size() &&
                             incidence.wrench.size() == 2 * f.size(),
                         "blocks' interfaces are not rows by block"))
        return;
    Rows rows(incidence.interface_begin);
    for (std::size_t i = 0; i < f.size(); ++i)
        for (const bool second : {false, true}) {
            const std::int64_t k = rows.take(second ? f.block_b[i] : f.block_a[i]);
            findings.expect(
                k >= 0 && incidence.interface[static_cast<std::size_t>(k)] == static_cast<std::int32_t>(i) &&
                    incidence.isB(k) == second && incidence.slotOf(k) == static_cast<std::size_t>(f.slot[i]),
                "interface", i, "a block does not have it, or not on its side and slot");
        }
}

void checkWalls(const State& state, Findings& findings) {
    const WetPatches& wet = state.wet;
    if (wet.water_begin.empty() && wet.size() == 0) return;  // not built yet: contacts come first
    if (!findings.expect(areSized(wet), "arrays of wet walls differ in size")) return;
    checkWaters(state, findings);
    for (std::size_t w = 0; w < wet.size(); ++w) checkWall(state, w, findings);
    if (findings.none()) checkWetRows(state, findings);
}

}  // namespace talus
