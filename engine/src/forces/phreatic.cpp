#include "forces/phreatic.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "forces/contact_forces.h"
#include "forces/phreatic_folds.h"
#include "forces/water.h"
#include "forces/wet_walls.h"
#include "geometry/box_clip.h"
#include "geometry/parts.h"
#include "model/gravity.h"

namespace talus::phreatic {
namespace {

Vec3 placeOf(const PhreaticSurface::Point& point, const Vec3& origin) {
    return Vec3(point.x, 0, point.z) - origin;
}

/// Below a plane through a point.
Cell cellBelow(const Vec3& point, const Vec3& normal, const Vec3& down, double unit_weight) {
    Cell cell;
    cell.gradient = unit_weight / normal.dot(down) * normal;
    cell.p0 = -cell.gradient.dot(point);
    cell.steepest = cell.gradient.norm();
    return cell;
}

void addSide(Cell& cell, const Vec3& normal, double offset, double sign) {
    cell.sides[static_cast<std::size_t>(cell.side_count++)] = {normal, offset, sign};
}

/// Side of a polygon against a half plane normal . x <= offset. Near its line, where clipping decides, it
/// counts as across.
enum class Lies { inside, across, outside };
Lies liesTo(const Polygon& polygon, const Vec2& normal, double offset) {
    constexpr double kNearLine =
        1e-9;  // of the largest number; clipping takes a thousandth of that as on the line
    double least = kInfinity, most = -kInfinity, farthest = 0;
    for (const Vec2& corner : polygon) {
        const double height = normal.dot(corner);
        least = std::min(least, height);
        most = std::max(most, height);
        farthest = std::max(farthest, corner.squaredNorm());
    }
    const double near = kNearLine * (std::abs(offset) + std::sqrt(farthest) * normal.norm());
    return most < offset - near ? Lies::inside : least > offset + near ? Lies::outside : Lies::across;
}

/// The same for a body within `reach` of a point at `height` inside, for a unit normal. Across: its corners
/// must be tested.
Lies liesTo(double reach, double height) {
    constexpr double kNearPlane = 1e-8;  // more than where corners count as across
    const double farthest = reach + kNearPlane * (reach + std::abs(height));
    return height > farthest ? Lies::inside : height < -farthest ? Lies::outside : Lies::across;
}

LinearPressure pressureIn(const Cell& cell, const FaceFrame& face) {
    return {cell.p0 + cell.gradient.dot(face.origin),
            {cell.gradient.dot(face.e1), cell.gradient.dot(face.e2)}};
}

/// The part of a polygon between a cell's sides; null where there is none, or all of it is dry.
///
/// Most polygons lie wholly on one side of each plane and need no clipping: that halved a run's time. Most
/// lie far from it, so that their corners need no test: that halved the remaining time.
/// \param reach  of the farthest corner from the face's origin [m]
/// \param clipped  holds the part where it is not the whole
const Polygon* partIn(const Cell& cell, const Polygon& whole, double reach, const FaceFrame& face,
                      Polygon& clipped) {
    const double pressure = cell.p0 + cell.gradient.dot(face.origin);
    if (liesTo(cell.steepest * reach, pressure) == Lies::outside) return nullptr;  // dry
    const Polygon* polygon = &whole;
    for (int k = 0; k < cell.side_count; ++k) {
        const Side& side = cell.sides[static_cast<std::size_t>(k)];
        if (polygon->empty()) return nullptr;
        const double beyond = side.normal.dot(face.origin) - side.offset, most = -side.sign * beyond;
        Lies lies = liesTo(reach, most);
        if (lies == Lies::outside) return nullptr;
        if (lies == Lies::inside) continue;
        const Vec2 across = side.sign * Vec2(side.normal.dot(face.e1), side.normal.dot(face.e2));
        if (across.norm() <= 1e-12) {
            if (most < 0 || (most == 0 && side.sign > 0))  // a face along the side belongs to one of two
                return nullptr;
            continue;
        }
        lies = liesTo(*polygon, across, most);
        if (lies == Lies::outside) return nullptr;
        if (lies == Lies::inside) continue;
        clipped = clipHalfPlane(*polygon, across, most);
        polygon = &clipped;
    }
    return polygon;
}

Thrust thrustOn(const Cell& cell, const Polygon& whole, double reach, const FaceFrame& face) {
    Polygon clipped;
    const Polygon* part = partIn(cell, whole, reach, face, clipped);
    return part == nullptr ? Thrust{} : talus::thrustOn(*part, pressureIn(cell, face));
}

// --- a line
// -----------------------------------------------------------------------------------------------------------

std::vector<Cell> cellsBelowLine(const std::vector<PhreaticSurface::Point>& line, const Vec3& down,
                                 double unit_weight, const Vec3& origin) {
    const Vec3 across = acrossOf(down);
    std::vector<Cell> cells;
    const auto begin = [&](const Vec3& point, const Vec3& along) {
        cells.push_back(cellBelow(point, along.cross(Vec3::UnitY()), down, unit_weight));
    };
    const auto end = [&](const Vec3& point) {
        std::array<Side, 3>& sides = cells.back().sides;
        sides[1] = sides[0];  // the far side first
        sides[0] = {across, across.dot(point), 1};
        ++cells.back().side_count;
    };
    begin(placeOf(line.front(), origin), Vec3::UnitX());
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
        const Vec3 from = placeOf(line[k], origin), to = placeOf(line[k + 1], origin);
        end(from);
        begin(from, to - from);
        addSide(cells.back(), across, across.dot(from), -1);
    }
    const Vec3 last = placeOf(line.back(), origin);
    end(last);
    begin(last, Vec3::UnitX());
    addSide(cells.back(), across, across.dot(last), -1);
    return cells;
}

// --- a mesh
// -----------------------------------------------------------------------------------------------------------

using Edge = std::pair<std::int32_t, std::int32_t>;  ///< from the lower number to the higher one

/// Each as often as triangles have it, sorted.
std::vector<Edge> edgesOf(const TriangleSurface& mesh) {
    std::vector<Edge> edges;
    for (const auto& corners : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) edges.push_back(std::minmax(corners[k], corners[(k + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// \param edges  of the whole mesh
/// \param beyond  how far the table reaches beyond its rim, so that faces that stand below the rim are
/// pressed alike [m]
Cell cellBelowTriangle(const TriangleSurface& mesh, const std::vector<Edge>& edges,
                       const std::array<std::int32_t, 3>& corners, const Vec3& down, double unit_weight,
                       const Vec3& origin, double beyond) {
    const auto at = [&](std::int32_t v) -> Vec3 {
        return mesh.vertices[static_cast<std::size_t>(v)] - origin;
    };
    const Vec3 a = at(corners[0]), b = at(corners[1]), c = at(corners[2]);
    Cell cell = cellBelow(a, (b - a).cross(c - a), down, unit_weight);
    for (std::size_t k = 0; k < 3; ++k) {
        const Edge edge = std::minmax(corners[k], corners[(k + 1) % 3]);
        const Vec3 low = at(edge.first), normal = down.cross(at(edge.second) - low).normalized();
        const double sign = edge.first == corners[k] ? 1 : -1;
        const auto [first, last] = std::equal_range(edges.begin(), edges.end(), edge);
        addSide(cell, normal, normal.dot(low) + (last - first == 1 ? sign * beyond : 0), sign);
    }
    return cell;
}

struct Span {
    Vec2 low = Vec2::Constant(kInfinity), high = Vec2::Constant(-kInfinity);

    void take(const Vec2& point) {
        low = low.cwiseMin(point);
        high = high.cwiseMax(point);
    }
};

/// Bins that a span reaches into: calls with each one's number.
template <class Each>
void eachBin(const Cells& cells, const Span& span, const Each& each) {
    const auto place = [&](double at, double low, int count) {
        return static_cast<int>(std::clamp(std::floor((at - low) / cells.bin), 0.0, count - 1.0));
    };
    const int from_row = place(span.low.y(), cells.low.y(), cells.rows);
    const int to_row = place(span.high.y(), cells.low.y(), cells.rows);
    const int from = place(span.low.x(), cells.low.x(), cells.columns);
    const int to = place(span.high.x(), cells.low.x(), cells.columns);
    for (int row = from_row; row <= to_row; ++row)
        for (int column = from; column <= to; ++column)
            each(static_cast<std::size_t>(row) * static_cast<std::size_t>(cells.columns) +
                 static_cast<std::size_t>(column));
}

Vec2 acrossGravity(const Cells& cells, const Vec3& point) { return {cells.u.dot(point), cells.v.dot(point)}; }

/// About as many bins as triangles.
void sortIntoBins(const TriangleSurface& mesh, const Vec3& origin, Cells& cells) {
    std::vector<Span> spans(mesh.triangles.size());
    Span whole;
    for (std::size_t t = 0; t < spans.size(); ++t)
        for (const std::int32_t v : mesh.triangles[t]) {
            const Vec2 place = acrossGravity(cells, mesh.vertices[static_cast<std::size_t>(v)] - origin);
            spans[t].take(place);
            whole.take(place);
        }
    const Vec2 size = (whole.high - whole.low).cwiseMax(1e-9);
    cells.low = whole.low;
    cells.bin = std::sqrt(size.x() * size.y() / static_cast<double>(spans.size()));
    cells.bin = std::max(cells.bin, size.maxCoeff() / 1000);
    cells.columns = static_cast<int>(size.x() / cells.bin) + 1;
    cells.rows = static_cast<int>(size.y() / cells.bin) + 1;
    const std::size_t bins = static_cast<std::size_t>(cells.columns) * static_cast<std::size_t>(cells.rows);
    std::vector<std::vector<std::int32_t>> sorted(bins);
    for (std::size_t t = 0; t < spans.size(); ++t)
        eachBin(cells, spans[t],
                [&](std::size_t bin) { sorted[bin].push_back(static_cast<std::int32_t>(t)); });
    for (const std::vector<std::int32_t>& bin : sorted) {
        cells.bin_begin.push_back(cells.in_bin.size());
        cells.in_bin.insert(cells.in_bin.end(), bin.begin(), bin.end());
    }
    cells.bin_begin.push_back(cells.in_bin.size());
}

/// Calls with each cell that a polygon may reach into, once and in order.
template <class Each>
void eachCellNear(const Cells& cells, const Polygon& polygon, const FaceFrame& face, const Each& each) {
    if (cells.bin == 0) {
        for (const Cell& cell : cells.all) each(cell);
        return;
    }
    Span span;
    for (const Vec2& corner : polygon) span.take(acrossGravity(cells, face.toWorld(corner)));
    thread_local std::vector<std::int32_t> near;  // kept, so that a step allocates nothing
    near.clear();
    eachBin(cells, span, [&](std::size_t bin) {
        for (std::size_t k = cells.bin_begin[bin]; k < cells.bin_begin[bin + 1]; ++k)
            near.push_back(cells.in_bin[k]);
    });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    for (const std::int32_t cell : near) each(cells.all[static_cast<std::size_t>(cell)]);
}

// --- walls
// -----------------------------------------------------------------------------------------------------------

double reachOf(const Polygon& polygon) {
    double farthest = 0;
    for (const Vec2& corner : polygon) farthest = std::max(farthest, corner.squaredNorm());
    return std::sqrt(farthest);
}

/// On a polygon whose frame is relative to a block's centroid: `arm` to the frame's origin, model frame.
Wrench pressureOn(const Cells& cells, const Polygon& polygon, double reach, const FaceFrame& face,
                  const Vec3& arm) {
    Thrust sum;
    eachCellNear(cells, polygon, face, [&](const Cell& cell) {
        const Thrust thrust = thrustOn(cell, polygon, reach, face);
        sum.force += thrust.force;
        sum.moment_x += thrust.moment_x;
        sum.moment_y += thrust.moment_y;
    });
    const Vec3 first_moment = sum.force * arm + sum.moment_x * face.e1 + sum.moment_y * face.e2;
    return {-sum.force * face.e3, -first_moment.cross(face.e3)};
}

FaceFrame turned(const FaceFrame& own, const Vec3& position, const Vec3& arm, const Mat3& turn) {
    return {position + arm, turn * own.e1, turn * own.e2, turn * own.e3};
}

void makeCells(State& state) {
    PhreaticWalls& walls = state.phreatic;
    if (walls.cells && walls.cells_tilt == state.load.tilt && walls.cells_share == state.load.water_share)
        return;
    const Model& model = state.geometry->model;
    const PhreaticSurface& surface = *model.phreatic;
    const double unit_weight =
        surface.factor * surface.density * model.gravity.magnitude * state.load.water_share;
    walls.cells = std::make_shared<const Cells>(
        cellsOf(surface, downward(model.gravity, state.load.tilt), unit_weight, state.geometry->origin));
    walls.cells_tilt = state.load.tilt;
    walls.cells_share = state.load.water_share;
}

/// First wall of a block; nothing when it has none.
std::optional<std::size_t> firstWall(const PhreaticWalls& walls, std::int32_t block) {
    const auto first = std::lower_bound(walls.block.begin(), walls.block.end(), block);
    if (first == walls.block.end() || *first != block) return std::nullopt;
    return static_cast<std::size_t>(first - walls.block.begin());
}

/// The face of a block that a plane in the block's own frame lies in, whichever way it looks.
std::size_t faceIn(const Polyhedron& shape, const FaceFrame& plane) {
    std::size_t best = 0;
    double nearest = kInfinity;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) {
        const FaceFrame own = faceFrame(shape, f);
        const double off = own.e3.cross(plane.e3).norm() + std::abs(own.e3.dot(plane.origin - own.origin));
        if (off < nearest) nearest = off, best = f;
    }
    return best;
}

/// A wall wetted by another water has that water's pressure alone.
void leaveToOthers(State& state) {
    PhreaticWalls& walls = state.phreatic;
    for (std::size_t w = 0; w < state.wet.size(); ++w) {
        const auto first = firstWall(walls, state.wet.block[w]);
        if (!first) continue;
        const auto b = static_cast<std::size_t>(state.wet.block[w]);
        const Vec3 e1 = state.wet.e1.get(w), e2 = state.wet.e2.get(w);
        const FaceFrame own{state.wet.origin.get(w), e1, e2, e1.cross(e2)};
        const std::size_t wall = *first + faceIn(state.geometry->shape[b], own);
        if (walls.drained[wall] != 0) continue;
        const Mat3 turn = state.blocks.orientation.matrix(b);
        const Vec3 arm = turn * own.origin;
        const Polygon polygon = wetPolygon(state.wet, w);
        const Wrench less = pressureOn(*walls.cells, polygon, reachOf(polygon),
                                       turned(own, state.blocks.position.get(b), arm, turn), arm);
        walls.force[wall] -= less.force;
        walls.moment[wall] -= less.torque;
    }
}

// --- what is refused
// -----------------------------------------------------------------------------------------------------

bool isBelowSome(const Cells& cells, const Vec3& point) {
    bool found = false;
    const FaceFrame there{point, Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
    Polygon corner;
    corner.push(Vec2::Zero());
    eachCellNear(cells, corner, there, [&](const Cell& cell) {
        found = found || std::all_of(cell.sides.begin(), cell.sides.end(), [&](const Side& side) {
                    return side.sign * (side.normal.dot(point) - side.offset) <= 0;
                });
    });
    return found;
}

std::optional<Error> tooSmallMesh(const State& state) {
    const PhreaticSurface& surface = *state.geometry->model.phreatic;
    for (const Block& block : state.geometry->model.blocks) {
        if (block.motion != Motion::free) continue;
        for (const Vec3& corner : block.shape.vertices)
            if (!isBelowSome(*state.phreatic.cells, corner - state.geometry->origin))
                return Error{surface.field + ".obj", "does not cover block \"" + block.name +
                                                         "\", which has a corner at " + placeText(corner) +
                                                         "; allowed: a surface over all free blocks"};
    }
    return std::nullopt;
}

std::optional<Error> faultOf(State& state) {
    const PhreaticSurface& surface = *state.geometry->model.phreatic;
    const Vec3 down = downward(state.geometry->model.gravity, state.load.tilt);
    if (auto folded = foldedSurface(surface, down)) return folded;
    if (surface.mesh.triangles.empty()) return std::nullopt;
    makeCells(state);
    return tooSmallMesh(state);
}

}  // namespace

Cells cellsOf(const PhreaticSurface& surface, const Vec3& down, double unit_weight, const Vec3& origin) {
    Cells cells;
    if (surface.mesh.triangles.empty()) {
        cells.all = cellsBelowLine(surface.line, down, unit_weight, origin);
        return cells;
    }
    constexpr double kBeyond = 1e-6;  // of the extent
    const std::vector<Edge> edges = edgesOf(surface.mesh);
    const double beyond = kBeyond * surfaceExtent(surface.mesh);
    for (const auto& triangle : surface.mesh.triangles)
        cells.all.push_back(
            cellBelowTriangle(surface.mesh, edges, triangle, down, unit_weight, origin, beyond));
    cells.u = acrossOf(down);
    cells.v = cells.u.cross(down);
    sortIntoBins(surface.mesh, origin, cells);
    return cells;
}

Outline outlineIn(const Polyhedron& shape, std::size_t face) {
    Outline outline{faceFrame(shape, face), talus::outlineOf(shape, face)};
    outline.reach = reachOf(outline.corners);
    return outline;
}

double wetArea(const Cells& cells, const Polygon& polygon, const FaceFrame& face) {
    double sum = 0;
    const double reach = reachOf(polygon);
    eachCellNear(cells, polygon, face, [&](const Cell& cell) {
        Polygon clipped;
        const Polygon* part = partIn(cell, polygon, reach, face, clipped);
        if (part == nullptr || part->empty()) return;
        const Polygon wet = wetPart(*part, pressureIn(cell, face));
        if (!wet.empty()) sum += area(wet);
    });
    return sum;
}

Wrench pressureOn(const Cells& cells, const Outline& face, const Vec3& position, const Mat3& turn) {
    const Vec3 arm = turn * face.frame.origin;
    return pressureOn(cells, face.corners, face.reach, turned(face.frame, position, arm, turn), arm);
}

std::vector<Error> build(State& state, ForceParts& parts) {
    state.phreatic = {};
    const std::optional<PhreaticSurface>& surface = state.geometry->model.phreatic;
    if (!surface) return {};
    if (auto fault = faultOf(state)) return {std::move(*fault)};
    auto outlines = std::make_shared<std::vector<Outline>>();
    for (std::size_t b = 0; b < state.blocks.size(); ++b) {
        if (state.blocks.motion[b] != Motion::free) continue;
        parts.block.push_back(static_cast<std::int32_t>(b));
        parts.begin.push_back(state.phreatic.size());
        const Polyhedron& shape = state.geometry->shape[b];
        for (std::size_t f = 0; f < shape.faces.size(); ++f) {
            state.phreatic.block.push_back(static_cast<std::int32_t>(b));
            outlines->push_back(outlineIn(shape, f));
        }
    }
    state.phreatic.outlines = std::move(outlines);
    parts.begin.push_back(state.phreatic.size());
    state.phreatic.drained.assign(state.phreatic.size(), 0);
    state.phreatic.force.assign(state.phreatic.size(), Vec3::Zero());
    state.phreatic.moment.assign(state.phreatic.size(), Vec3::Zero());
    return {};
}

void update(State& state) {
    PhreaticWalls& walls = state.phreatic;
    if (walls.size() == 0) return;
    makeCells(state);
    Vec3 position = Vec3::Zero();
    Mat3 turn = Mat3::Identity();
    for (std::size_t w = 0; w < walls.size(); ++w) {
        if (w == 0 || walls.block[w] != walls.block[w - 1]) {
            const auto b = static_cast<std::size_t>(walls.block[w]);
            position = state.blocks.position.get(b);
            turn = state.blocks.orientation.matrix(b);
        }
        Wrench wrench;
        if (walls.drained[w] == 0) wrench = pressureOn(*walls.cells, (*walls.outlines)[w], position, turn);
        walls.force[w] = wrench.force;
        walls.moment[w] = wrench.torque;
    }
    leaveToOthers(state);
}

void drain(State& state) {
    const Model& model = state.geometry->model;
    if (!model.phreatic || model.phreatic->drains_at_aperture == kInfinity) return;
    const Interfaces& f = state.interfaces;
    const auto dry = [&](std::int32_t block, std::int32_t face) {
        if (const auto first = firstWall(state.phreatic, block))
            state.phreatic.drained[*first + static_cast<std::size_t>(face)] = 1;
    };
    for (std::size_t i = 0; i < f.size(); ++i) {
        if (f.kind[i] != InterfaceKind::faces ||
            relativePose(state, i).gap.x() <= model.phreatic->drains_at_aperture)
            continue;
        dry(f.block_a[i], f.face_a[i]);
        dry(f.block_b[i], f.face_b[i]);
    }
}

Wrench on(const State& state, const ForceParts& parts, std::size_t block) {
    const auto at =
        std::lower_bound(parts.block.begin(), parts.block.end(), static_cast<std::int32_t>(block));
    Wrench sum;
    if (at == parts.block.end() || static_cast<std::size_t>(*at) != block) return sum;
    const auto row = static_cast<std::size_t>(at - parts.block.begin());
    for (std::size_t w = parts.begin[row]; w < parts.begin[row + 1]; ++w)
        sum += Wrench{state.phreatic.force[w], state.phreatic.moment[w]};
    return sum;
}

std::vector<ForceArray> memory(const State& state) {
    const std::vector<std::uint8_t>& drained = state.phreatic.drained;
    if (drained.empty()) return {};
    return {{"drained", {drained.begin(), drained.end()}}};
}

void remember(State& state, std::span<const ForceArray> arrays) {
    for (const ForceArray& array : arrays)
        std::transform(array.values.begin(), array.values.end(), state.phreatic.drained.begin(),
                       [](double value) { return static_cast<std::uint8_t>(value != 0); });
}

}  // namespace talus::phreatic
