#include "rock_mass/cell.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/face_frame.h"
#include "geometry/polygon.h"

namespace talus::rock_mass {

namespace {

using Edge = std::pair<std::int32_t, std::int32_t>;
using Outline = std::vector<std::int32_t>;

std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
    a ^= b + 0x9e3779b97f4a7c15ULL + (a << 6) + (a >> 2);
    a ^= a >> 31;
    return a * 0xbf58476d1ce4e5b9ULL;
}

/// One whole number for an edge, in the order of pairs: it sorts faster.
std::uint64_t edgeKey(std::int32_t from, std::int32_t to) {
    return static_cast<std::uint64_t>(from) << 32U | static_cast<std::uint64_t>(to);
}

/// Edges of the faces without a twin, sorted by their start; nothing if an edge occurs twice.
bool openEdges(const std::vector<CellFace>& faces, std::vector<Edge>& open) {
    std::vector<std::uint64_t> edges;
    for (const CellFace& face : faces)
        for (std::size_t i = 0; i < face.outline.size(); ++i)
            edges.push_back(edgeKey(face.outline[i], face.outline[i + 1 < face.outline.size() ? i + 1 : 0]));
    std::sort(edges.begin(), edges.end());
    if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
    for (const std::uint64_t edge : edges) {
        const auto from = static_cast<std::int32_t>(edge >> 32U), to = static_cast<std::int32_t>(edge);
        if (!std::binary_search(edges.begin(), edges.end(), edgeKey(to, from))) open.emplace_back(from, to);
    }
    return true;
}

/// One simple cycle through all edges, or nothing. \pre sorted by their start
Outline cycleOf(const std::vector<Edge>& edges) {
    if (edges.size() < 3) return {};
    Outline cycle;
    std::int32_t at = edges[0].first;
    do {
        cycle.push_back(at);
        const auto next = std::lower_bound(edges.begin(), edges.end(), Edge{at, -1});
        if (next == edges.end() || next->first != at) return {};
        if (next + 1 != edges.end() && (next + 1)->first == at) return {};
        at = next->second;
    } while (at != edges[0].first && cycle.size() <= edges.size());
    return cycle.size() == edges.size() ? cycle : Outline{};
}

/// A cell that a plane may cut: on which side its corners are, and where the plane meets its edges. Both are
/// found once, for the two parts and for all faces of a corner or an edge.
class CellAtPlane {
 public:
    CellAtPlane(const Cell& cell, const Plane& plane, VertexTable& vertices)
        : cell_(cell), plane_(plane), vertices_(vertices) {
        for (const CellFace& face : cell.faces)
            for (const std::int32_t v : face.outline) sides_.push_back(vertices.side(plane, v));
    }

    /// Whether a corner is below (-1) or above (1).
    bool reaches(int side) const { return std::find(sides_.begin(), sides_.end(), side) != sides_.end(); }

    /// The part on one side (`sign` -1 below, 1 above), closed by a face in the plane; no faces if it cannot
    /// be closed.
    Cell part(std::int32_t index, int sign) {
        Cell part;
        std::size_t first = 0;
        for (const CellFace& face : cell_.faces) {
            Outline outline = partOf(face.outline, first, sign);
            first += face.outline.size();
            if (!outline.empty()) part.faces.push_back({face.plane, face.outward, std::move(outline)});
        }
        std::vector<Edge> open;
        Outline cap = openEdges(part.faces, open) ? cycleOf(open) : Outline{};
        if (cap.empty()) return {};
        std::reverse(cap.begin(), cap.end());
        part.faces.push_back({index, sign < 0, std::move(cap)});
        return part;
    }

 private:
    /// The part of an outline, with what lies in the plane. \param first  its first corner in `sides_`
    Outline partOf(const Outline& outline, std::size_t first, int sign) {
        Outline part;
        bool has_inside = false;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const std::size_t next = i + 1 < outline.size() ? i + 1 : 0;
            const int side_a = sign * sides_[first + i], side_b = sign * sides_[first + next];
            has_inside = has_inside || side_a > 0;
            if (side_a >= 0) part.push_back(outline[i]);
            if (side_a * side_b < 0) part.push_back(cut(outline[i], outline[next]));
        }
        part.erase(std::unique(part.begin(), part.end()), part.end());
        while (part.size() > 1 && part.front() == part.back()) part.pop_back();
        if (part.size() < 3 || !has_inside) part.clear();
        return part;
    }

    std::int32_t cut(std::int32_t a, std::int32_t b) {
        const Edge edge = std::minmax(a, b);
        const auto known =
            std::find_if(cuts_.begin(), cuts_.end(), [&](const auto& c) { return c.first == edge; });
        if (known != cuts_.end()) return known->second;
        cuts_.emplace_back(edge, vertices_.cut(plane_, a, b));
        return cuts_.back().second;
    }

    const Cell& cell_;
    const Plane& plane_;
    VertexTable& vertices_;
    std::vector<int> sides_;                           ///< of the corners of all faces in turn
    std::vector<std::pair<Edge, std::int32_t>> cuts_;  ///< edges, and the vertex at which each is cut
};

/// Removes vertices at which only two faces of a cell meet: they lie on a straight edge.
void dropStraightVertices(Cell& cell) {
    std::vector<std::int32_t> used;
    for (const CellFace& face : cell.faces) used.insert(used.end(), face.outline.begin(), face.outline.end());
    std::sort(used.begin(), used.end());
    for (CellFace& face : cell.faces)
        std::erase_if(face.outline, [&](std::int32_t v) {
            const auto [first, last] = std::equal_range(used.begin(), used.end(), v);
            return last - first < 3;
        });
}

bool isReversed(const Outline& a, const Outline& b) {
    if (a.size() != b.size()) return false;
    const auto start = std::find(b.begin(), b.end(), a[0]);
    if (start == b.end()) return false;
    const auto offset = static_cast<std::size_t>(start - b.begin());
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[(offset + b.size() - i) % b.size()]) return false;
    return true;
}

/// Whether all of `other` lies behind the faces of `cell`, the one at `except` left out.
bool liesBehind(const Cell& cell, std::size_t except, const Cell& other, const std::vector<Plane>& planes,
                const VertexTable& vertices) {
    for (std::size_t f = 0; f < cell.faces.size(); ++f) {
        if (f == except) continue;
        const Plane& plane = planes[static_cast<std::size_t>(cell.faces[f].plane)];
        const int outside = cell.faces[f].outward ? 1 : -1;
        for (const CellFace& face : other.faces)
            for (const std::int32_t v : face.outline)
                if (vertices.side(plane, v) == outside) return false;
    }
    return true;
}

/// Makes one face of all those in one plane. False if they do not join up.
bool joinFaces(std::vector<CellFace>& faces) {
    const auto key = [](const CellFace& face) { return std::pair(face.plane, face.outward); };
    std::stable_sort(faces.begin(), faces.end(),
                     [&](const CellFace& a, const CellFace& b) { return key(a) < key(b); });
    std::vector<CellFace> joined;
    for (std::size_t i = 0; i < faces.size();) {
        std::vector<CellFace> same;
        const auto first = key(faces[i]);
        for (; i < faces.size() && key(faces[i]) == first; ++i) same.push_back(std::move(faces[i]));
        if (same.size() > 1) {
            std::vector<Edge> open;
            same[0].outline = openEdges(same, open) ? cycleOf(open) : Outline{};
            if (same[0].outline.empty()) return false;
        }
        joined.push_back(std::move(same[0]));
    }
    faces = std::move(joined);
    return true;
}

Polygon projected(const CellFace& face, const FaceFrame& frame, bool reversed, const VertexTable& vertices) {
    Polygon polygon;
    for (std::size_t i = 0; i < face.outline.size(); ++i)
        polygon.push(frame.toPlane(vertices[face.outline[reversed ? face.outline.size() - 1 - i : i]]));
    return polygon;
}

void keepDistinct(std::vector<std::int32_t>& numbers) {
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

std::int64_t VertexTable::stepOf(double coordinate) const {
    return static_cast<std::int64_t>(std::floor(coordinate / cell_));
}

std::uint64_t VertexTable::keyOf(std::int64_t x, std::int64_t y, std::int64_t z) {
    return mixed(mixed(mixed(0, static_cast<std::uint64_t>(x)), static_cast<std::uint64_t>(y)),
                 static_cast<std::uint64_t>(z));
}

std::int32_t VertexTable::findIn(std::uint64_t key, const Vec3& position) const {
    const auto bucket = first_.find(key);
    if (bucket == first_.end()) return -1;
    std::int32_t v = bucket->second;
    while (v >= 0 && ((*this)[v] - position).cwiseAbs().maxCoeff() > weld_)
        v = next_[static_cast<std::size_t>(v)];
    return v;
}

std::int32_t VertexTable::find(const Vec3& position) const {
    // The buckets that a cube of the weld distance about the position reaches: often one.
    std::array<std::int64_t, 3> low, high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = position[static_cast<Eigen::Index>(axis)];
        low[axis] = stepOf(at - weld_);
        high[axis] = stepOf(at + weld_);
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z) {
        for (std::int64_t y = low[1]; y <= high[1]; ++y) {
            for (std::int64_t x = low[0]; x <= high[0]; ++x)
                if (const std::int32_t v = findIn(keyOf(x, y, z), position); v >= 0) return v;
        }
    }
    return -1;
}

std::int32_t VertexTable::add(const Vec3& position) {
    if (const std::int32_t known = find(position); known >= 0) return known;
    const auto vertex = static_cast<std::int32_t>(positions_.size());
    const auto [bucket, is_new] =
        first_.try_emplace(keyOf(stepOf(position.x()), stepOf(position.y()), stepOf(position.z())), vertex);
    positions_.push_back(position);
    next_.push_back(is_new ? -1 : bucket->second);
    bucket->second = vertex;
    return vertex;
}

std::int32_t VertexTable::cut(const Plane& plane, std::int32_t a, std::int32_t b) {
    if (a > b) std::swap(a, b);  // the same bits from both sides of a face
    const Vec3 from = (*this)[a], to = (*this)[b];
    const double height_a = plane.height(from), height_b = plane.height(to);
    const double share = height_a / (height_a - height_b);
    // From the nearer end, where the rounding is smaller.
    return add(share <= 0.5 ? Vec3(from + share * (to - from)) : Vec3(to + (1 - share) * (from - to)));
}

Split split(const Cell& cell, const std::vector<Plane>& planes, std::int32_t index, VertexTable& vertices) {
    CellAtPlane at(cell, planes[static_cast<std::size_t>(index)], vertices);
    if (!at.reaches(1)) return {Split::Kind::below};
    if (!at.reaches(-1)) return {Split::Kind::above};
    Split result{Split::Kind::cut, at.part(index, -1), at.part(index, 1)};
    if (result.lower.faces.size() < 4 || result.upper.faces.size() < 4) result.kind = Split::Kind::failed;
    return result;
}

Cell boxCell(const Vec3& min, const Vec3& max, std::vector<Plane>& planes, VertexTable& vertices) {
    std::array<std::int32_t, 8> corner;
    for (int c = 0; c < 8; ++c)
        corner[static_cast<std::size_t>(c)] =
            vertices.add({c & 4 ? max.x() : min.x(), c & 2 ? max.y() : min.y(), c & 1 ? max.z() : min.z()});
    // As in makeBox.
    constexpr std::array<std::array<std::size_t, 4>, 6> kFaces = {
        {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
    Cell cell;
    for (std::size_t f = 0; f < 6; ++f) {
        const auto axis = static_cast<Eigen::Index>(f / 2);
        const double sign = f % 2 == 0 ? -1 : 1;
        const double offset = f % 2 == 0 ? -min[axis] : max[axis];
        CellFace face{static_cast<std::int32_t>(planes.size()), true, {}};
        for (const std::size_t c : kFaces[f]) face.outline.push_back(corner[c]);
        cell.faces.push_back(std::move(face));
        planes.push_back({sign * Vec3::Unit(axis), offset, kSurface, 0});
    }
    return cell;
}

bool merge(const Cell& a, const Cell& b, const std::vector<Plane>& planes, const VertexTable& vertices,
           Cell& merged) {
    for (std::size_t i = 0; i < a.faces.size(); ++i)
        for (std::size_t j = 0; j < b.faces.size(); ++j) {
            if (a.faces[i].plane != b.faces[j].plane || a.faces[i].outward == b.faces[j].outward) continue;
            if (!isReversed(a.faces[i].outline, b.faces[j].outline)) continue;
            if (!liesBehind(a, i, b, planes, vertices) || !liesBehind(b, j, a, planes, vertices))
                return false;
            merged.faces.clear();
            for (std::size_t f = 0; f < a.faces.size(); ++f)
                if (f != i) merged.faces.push_back(a.faces[f]);
            for (std::size_t f = 0; f < b.faces.size(); ++f)
                if (f != j) merged.faces.push_back(b.faces[f]);
            if (!joinFaces(merged.faces)) return false;
            dropStraightVertices(merged);
            return std::all_of(merged.faces.begin(), merged.faces.end(),
                               [](const CellFace& face) { return face.outline.size() >= 3; });
        }
    return false;
}

double thickness(const std::vector<const Cell*>& cells, const std::vector<Plane>& planes,
                 const VertexTable& vertices) {
    std::vector<std::int32_t> corners, sides;
    for (const Cell* cell : cells)
        for (const CellFace& face : cell->faces) {
            corners.insert(corners.end(), face.outline.begin(), face.outline.end());
            sides.push_back(face.plane);
        }
    keepDistinct(corners);
    keepDistinct(sides);
    double thinnest = std::numeric_limits<double>::infinity();
    for (const std::int32_t side : sides) {
        const Plane& plane = planes[static_cast<std::size_t>(side)];
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::int32_t v : corners) {
            const double height = plane.height(vertices[v]);
            low = std::min(low, height);
            high = std::max(high, height);
            if (high - low >= thinnest) break;  // normal to this plane it is no thinner
        }
        thinnest = std::min(thinnest, high - low);
    }
    return thinnest;
}

double sharedArea(const CellFace& a, const CellFace& b, const std::vector<Plane>& planes,
                  const VertexTable& vertices) {
    if (a.plane != b.plane || a.outward == b.outward) return 0;
    const Vec3 normal = (a.outward ? 1 : -1) * planes[static_cast<std::size_t>(a.plane)].normal;
    const FaceFrame frame = faceFrame(vertices[a.outline[0]], vertices[a.outline[1]], normal);
    const Polygon outline_a = projected(a, frame, false, vertices),
                  outline_b = projected(b, frame, true, vertices);
    const Polygon common = intersect(outline_a, outline_b);
    return common.empty() ? 0 : area(common);
}

double volume(const Cell& cell, const VertexTable& vertices) {
    const Vec3 origin = vertices[cell.faces[0].outline[0]];
    double sixfold = 0;
    for (const CellFace& face : cell.faces)
        for (std::size_t i = 2; i < face.outline.size(); ++i)
            sixfold +=
                (vertices[face.outline[0]] - origin)
                    .dot((vertices[face.outline[i - 1]] - origin).cross(vertices[face.outline[i]] - origin));
    return sixfold / 6;
}

Vec3 centre(const Cell& cell, const VertexTable& vertices) {
    Vec3 sum = Vec3::Zero();
    std::size_t count = 0;
    for (const CellFace& face : cell.faces)
        for (const std::int32_t v : face.outline) {
            sum += vertices[v];
            ++count;
        }
    return sum / static_cast<double>(count);
}

}  // namespace talus::rock_mass
