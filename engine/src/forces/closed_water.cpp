#include "forces/closed_water.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "forces/enclosed_volume.h"
#include "forces/leak.h"
#include "forces/water_table.h"
#include "forces/wet_walls.h"
#include "model/gravity.h"
#include "model/over_time.h"

namespace talus {
namespace {

// Of the surface of the fissure as built: a first slope that is far too small would leap over every bound.
constexpr double kLeastSlope = 0.1;
// Halving alone takes 53 steps from the height of a fissure to the last bit of a level.
constexpr int kMostSteps = 200;
// Of the height of a fissure: what of its walls counts as their foot, where it leaks. Joints of rock masses
// are cut block by block, and their lowest corners agree to some 1e-6.
constexpr double kFoot = 0.01;

bool isClosed(const State& state, std::size_t water) { return state.geometry->model.waters[water].closed; }
bool counts(const State& state, std::size_t water) {
    return state.closed.size() > 0 && state.closed.begun[water] != 0;
}

FaceFrame placed(const WetPatches& wet, std::size_t w, const Vec3& position, const Mat3& turn) {
    const Vec3 e1 = wet.e1.get(w), e2 = wet.e2.get(w);
    return {position + turn * wet.origin.get(w), turn * e1, turn * e2, turn * e1.cross(e2)};
}

FaceFrame wallAtStart(const State& state, std::size_t w) {
    const auto b = static_cast<std::size_t>(state.wet.block[w]);
    return placed(state.wet, w, state.geometry->initial_position.get(b),
                  state.geometry->initial_orientation.matrix(b));
}

FaceFrame wallNow(const State& state, std::size_t w) {
    const auto b = static_cast<std::size_t>(state.wet.block[w]);
    return placed(state.wet, w, state.blocks.position.get(b), state.blocks.orientation.matrix(b));
}

template <class Each>
void eachWall(const State& state, std::size_t water, const Each& each) {
    for (std::size_t w = state.wet.water_begin[water]; w < state.wet.water_begin[water + 1]; ++w) each(w);
}

Vec3 upNow(const State& state) { return -downward(state.geometry->model.gravity, state.load.tilt); }

/// Which way the first wall of a water looks, as built: others look the same way, or stand opposite.
Vec3 aheadOf(const State& state, std::size_t water) {
    return wallAtStart(state, state.wet.water_begin[water]).e3;
}

/// Walls in fixed rock hold no volume where the joint does not reach so far (EndWalls): how deep a model is
/// cut changes nothing.
EndWalls endsOf(const State& state, std::size_t water) {
    return {*state.geometry, state.geometry->model.waters[water]};
}

double volumeUnder(const State& state, std::size_t water, const WaterTable& table) {
    std::array<double, 2> walls{};  // of both sides
    double swept = 0;
    const EndWalls ends = endsOf(state, water);
    const Vec3 ahead = aheadOf(state, water);
    eachWall(state, water, [&](std::size_t w) {
        const Polygon wall = wetPolygon(state.wet, w);
        const FaceFrame start = wallAtStart(state, w);
        if (ends.counts(state.wet.block[w]))
            walls[start.e3.dot(ahead) > 0 ? 0 : 1] += areaBelow(wall, start, table);
        swept += sweptBelow(wall, start, wallNow(state, w), table);
    });
    return state.geometry->model.waters[water].opening * std::max(walls[0], walls[1]) + swept;
}

/// Levels between which a volume is looked for [m].
struct Levels {
    double low = 0;   ///< nothing is wet below it
    double high = 0;  ///< it runs over above it
};

Levels levelsOf(const State& state, std::size_t water, const TableHeight& heights, const Vec3& up) {
    double low = kInfinity;
    std::array<double, 2> top{-kInfinity, -kInfinity};  // of both sides
    const Vec3 ahead = aheadOf(state, water);
    const EndWalls ends = endsOf(state, water);
    eachWall(state, water, [&](std::size_t w) {
        const FaceFrame start = wallAtStart(state, w), now = wallNow(state, w);
        double& side = top[start.e3.dot(ahead) > 0 ? 0 : 1];
        const bool holds = ends.counts(state.wet.block[w]);
        for (const Vec2& v : wetPolygon(state.wet, w)) {
            const double was = up.dot(start.toWorld(v));
            if (holds) low = std::min({low, was, up.dot(now.toWorld(v))});
            side = std::max(side, was);
        }
    });
    const auto [lower, upper] = std::minmax(top[0], top[1]);
    const double end = lower > -kInfinity ? lower : upper;  // in what is left of a model one side may be gone
    return {heights.levelOf(low),
            std::min(state.geometry->model.waters[water].overflow, heights.levelOf(end))};
}

/// The level of a volume, from a guess: secants between bounds, halving where they leave those. The highest
/// where even that is too low, which is looked at only when a secant comes so far.
/// \param slope     of `excess`, roughly
/// \param rounding  of `excess`: a level whose excess is no larger is found
/// \pre  excess(low) <= 0
template <class Excess>
double findLevel(const Excess& excess, Levels within, double guess, double slope, double rounding) {
    const double highest = within.high;
    bool looked = false;
    double level = std::clamp(guess, within.low, highest), at_level = excess(level);
    for (int k = 0; k < kMostSteps && std::abs(at_level) > rounding; ++k) {
        (at_level > 0 ? within.high : within.low) = level;
        double next = level - at_level / slope;
        if (next >= highest && !looked) {
            looked = true;
            if (level == highest || excess(highest) <= 0) return highest;
        }
        if (!(next > within.low && next < within.high)) next = 0.5 * (within.low + within.high);
        if (next == level) break;
        const double at_next = excess(next);
        slope = (at_next - at_level) / (next - level);
        level = next, at_level = at_next;
    }
    return level;
}

/// The level follows from the volume, and what stands too high runs over.
void settle(State& state, std::size_t water) {
    ClosedWaters& closed = state.closed;
    const Vec3 up = upNow(state);
    const TableHeight heights = tableHeight(state, water, state.load.tilt);
    const auto volumeAt = [&](double level) { return volumeUnder(state, water, {up, heights.at(level)}); };
    const Levels within = levelsOf(state, water, heights, up);
    const double volume = closed.volume[water], guess = closed.level[water];
    // Of the fissure as built, a prism; what it holds now may be more.
    const double surface = state.geometry->model.waters[water].opening * closed.width[water];
    const double capacity = surface * (within.high - within.low);
    const double slope = guess > within.low && volume > 0 ? volume / (guess - within.low) : surface;
    const double rounding = std::numeric_limits<double>::epsilon() * std::max(capacity, volume);
    const double level = findLevel([&](double at) { return volumeAt(at) - volume; }, within, guess,
                                   std::max(slope, kLeastSlope * surface), rounding);
    closed.level[water] = level;
    if (level < within.high) return;
    const double most = volumeAt(within.high);
    closed.run_over[water] += std::max(0.0, volume - most);
    closed.volume[water] = std::min(volume, most);
}

/// By how much the walls have parted at their foot since they were built, on the mean of either side [m].
double footOpening(const State& state, std::size_t water, const WaterTable& top_of_foot) {
    std::array<double, 2> areas{}, receded{};  // of both sides
    const Vec3 ahead = aheadOf(state, water);
    const EndWalls ends = endsOf(state, water);
    eachWall(state, water, [&](std::size_t w) {
        if (!ends.counts(state.wet.block[w])) return;  // fixed rock below the foot
        const FaceFrame start = wallAtStart(state, w);
        const Polygon foot = wetPart(wetPolygon(state.wet, w), top_of_foot.depthOn(start));
        if (foot.empty()) return;
        const std::size_t side = start.e3.dot(ahead) > 0 ? 0 : 1;
        areas[side] += area(foot);
        receded[side] -= area(foot) * start.height(wallNow(state, w).toWorld(centroid(foot)));
    });
    double opening = 0;
    for (const std::size_t side : {0, 1})
        if (areas[side] > 0) opening += receded[side] / areas[side];
    return opening;
}

/// k of forces/leak.h: what leaks per second over what is there [1/s].
double leakRate(const State& state, std::size_t water) {
    const Water& model = state.geometry->model.waters[water];
    const ClosedWaters& closed = state.closed;
    const Vec3 up = upNow(state);
    const TableHeight heights = tableHeight(state, water, state.load.tilt);
    const Levels within = levelsOf(state, water, heights, up);
    const double top_of_foot = within.low + kFoot * (within.high - within.low);
    const double opening = footOpening(state, water, {up, heights.at(top_of_foot)});
    const Leak leak{std::max(0.0, model.leak_aperture + opening), model.leak_length,
                    model.density * state.geometry->model.gravity.magnitude};
    const double height = closed.level[water] - within.low;
    if (height > 0 && closed.volume[water] > 0)
        return closed.width[water] * leak.under(heights.per_level * height) / closed.volume[water];
    return leak.under(heights.per_level) / model.opening;  // of the fissure as built, a prism
}

/// What inflow and rain bring from one time to a later one [m^3].
double gainOf(const Water& water, double width, double from, double to) {
    double gain = water.inflow.empty() ? 0.0 : width * integralOver(water.inflow, from, to);
    if (!water.rain.empty()) gain += width * water.catchment * integralOver(water.rain, from, to);
    return gain;
}

/// Up to the present time.
void takeInflow(State& state, std::size_t water) {
    ClosedWaters& closed = state.closed;
    const Water& model = state.geometry->model.waters[water];
    const double from = std::exchange(closed.time[water], state.load.time), to = state.load.time;
    if (!(to > from)) return;
    const double gain = gainOf(model, closed.width[water], from, to);
    if (!(model.leak_aperture > 0)) {
        closed.volume[water] += gain;
        return;
    }
    const double before = closed.volume[water] + gain;
    closed.volume[water] = volumeLeft(closed.volume[water], gain, leakRate(state, water), to - from);
    closed.leaked[water] += before - closed.volume[water];
}

bool anyLeaks(const State& state) {
    const auto& waters = state.geometry->model.waters;
    return std::any_of(waters.begin(), waters.end(),
                       [](const Water& water) { return water.closed && water.leak_aperture > 0; });
}

/// Horizontal extent of a water's walls along their joint [m].
double widthOf(const State& state, std::size_t water, const Vec3& up) {
    const Vec3 along = aheadOf(state, water).cross(up).normalized();
    double low = kInfinity, high = -kInfinity;
    const EndWalls ends = endsOf(state, water);
    eachWall(state, water, [&](std::size_t w) {
        if (!ends.counts(state.wet.block[w])) return;
        const FaceFrame start = wallAtStart(state, w);
        for (const Vec2& v : wetPolygon(state.wet, w)) {
            const double x = along.dot(start.toWorld(v));
            low = std::min(low, x), high = std::max(high, x);
        }
    });
    return high - low;
}

}  // namespace

void buildClosedWater(State& state) {
    const auto& waters = state.geometry->model.waters;
    state.closed = {};
    if (std::none_of(waters.begin(), waters.end(), [](const Water& water) { return water.closed; })) return;
    state.closed.begun.assign(waters.size(), 0);
    for (auto* numbers : {&state.closed.volume, &state.closed.level, &state.closed.time,
                          &state.closed.run_over, &state.closed.leaked, &state.closed.width})
        numbers->assign(waters.size(), 0.0);
    for (std::size_t water = 0; water < waters.size(); ++water)
        if (waters[water].closed) state.closed.width[water] = widthOf(state, water, upNow(state));
}

void beginClosedWater(State& state) {
    ClosedWaters& closed = state.closed;
    for (std::size_t water = 0; water < closed.size(); ++water) {
        if (!isClosed(state, water)) continue;
        closed.begun[water] = 1;
        closed.time[water] = state.load.time;
        closed.run_over[water] = closed.leaked[water] = 0;
        closed.level[water] = levelAt(state.geometry->model.waters[water], 0);
        closed.volume[water] = volumeBelow(state, water, closed.level[water]);
    }
}

void updateClosedWater(State& state) {
    for (std::size_t water = 0; water < state.closed.size(); ++water) {
        if (!counts(state, water)) continue;
        takeInflow(state, water);
        settle(state, water);
    }
}

double levelNow(const State& state, std::size_t water, double time) {
    return counts(state, water) ? state.closed.level[water]
                                : levelAt(state.geometry->model.waters[water], time);
}

double volumeBelow(const State& state, std::size_t water, double level) {
    const TableHeight heights = tableHeight(state, water, state.load.tilt);
    return volumeUnder(state, water, {upNow(state), heights.at(level)});
}

std::vector<WaterReport> closedWaterReports(const State& state) {
    std::vector<WaterReport> reports;
    for (std::size_t water = 0; water < state.closed.size(); ++water)
        if (counts(state, water))
            reports.push_back({state.geometry->model.waters[water].field, state.closed.level[water],
                               state.closed.volume[water], state.closed.run_over[water],
                               state.closed.leaked[water]});
    return reports;
}

std::vector<ForceArray> closedWaterMemory(const State& state) {
    const ClosedWaters& closed = state.closed;
    if (closed.size() == 0) return {};
    std::vector<ForceArray> memory{{"begun", {closed.begun.begin(), closed.begun.end()}},
                                   {"volume", closed.volume},
                                   {"level", closed.level},
                                   {"time", closed.time},
                                   {"run_over", closed.run_over}};
    if (anyLeaks(state)) memory.push_back({"leaked", closed.leaked});  // files without leaks stay readable
    return memory;
}

void rememberClosedWater(State& state, std::span<const ForceArray> arrays) {
    ClosedWaters& closed = state.closed;
    if (closed.size() == 0) return;
    for (std::size_t water = 0; water < closed.size(); ++water)
        closed.begun[water] = arrays[0].values[water] != 0 && isClosed(state, water) ? 1 : 0;
    closed.volume = arrays[1].values;
    closed.level = arrays[2].values;
    closed.time = arrays[3].values;
    closed.run_over = arrays[4].values;
    if (arrays.size() > 5) closed.leaked = arrays[5].values;
}

Enclosure enclosureOf(const State& state, std::size_t water, double level) {
    const TableHeight heights = tableHeight(state, water, state.load.tilt);
    const WaterTable table{upNow(state), heights.at(level)};
    Enclosure enclosure;
    enclosure.runs_over = levelsOf(state, water, heights, table.up).high;
    const Vec3 ahead = aheadOf(state, water);
    enclosure.dip = std::acos(std::min(1.0, std::abs(ahead.dot(table.up))));
    eachWall(state, water, [&](std::size_t w) {
        const FaceFrame start = wallAtStart(state, w);
        enclosure.below[start.e3.dot(ahead) > 0 ? 0 : 1] += areaBelow(wetPolygon(state.wet, w), start, table);
    });
    return enclosure;
}

}  // namespace talus
