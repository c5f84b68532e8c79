#include "batch/face_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace talus::tools::batch {

namespace {

constexpr double kSamePlane = 1e-7;     ///< of the region's extent: how far a vertex lies off a plane
constexpr double kSameNormal = 1e-6;    ///< length of the difference of unit normals
constexpr double kUpright = 1e-6;       ///< upward component of a normal
constexpr double kSameWay = 0.5;        ///< cosine of 60 degrees, between a side and the way of the slope
constexpr double kLeastSlope = 1e-3;    ///< horizontal share of a surface's area that makes it a slope
constexpr double kWhole = 1e-9;         ///< of its area that a whole cell may miss by rounding
constexpr double kDefaultCells = 2000;  ///< shows a face of 20 m by 100 m by the square metre

using Flat = Eigen::Vector2d;

/// Triangles of one plane that share edges.
struct Plane {
    std::vector<std::size_t> triangles;
    Vec3 normal = Vec3::UnitZ();  ///< outward
    Vec3 point = Vec3::Zero();
    double area = 0;  ///< [m^2]
    bool is_base = false, is_side = false;
};

Vec3 corner(const TriangleSurface& surface, std::size_t triangle, std::size_t k) {
    return surface.vertices[static_cast<std::size_t>(surface.triangles[triangle][k])];
}

/// Twice its area, along its outward normal.
Vec3 areaVector(const TriangleSurface& surface, std::size_t triangle) {
    const Vec3 a = corner(surface, triangle, 0);
    return (corner(surface, triangle, 1) - a).cross(corner(surface, triangle, 2) - a);
}

/// For each triangle, those beyond its edges. \pre a closed surface
std::vector<std::array<std::size_t, 3>> neighboursOf(const TriangleSurface& surface) {
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> with_edge;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            with_edge[{surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]}] = t;
    std::vector<std::array<std::size_t, 3>> neighbours(surface.triangles.size());
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            neighbours[t][k] = with_edge.at({surface.triangles[t][(k + 1) % 3], surface.triangles[t][k]});
    return neighbours;
}

class Surface {
 public:
    explicit Surface(const TriangleSurface& surface)
        : surface_(surface), neighbours_(neighboursOf(surface)), extent_(surfaceExtent(surface)) {
        findPlanes();
        markBase();
        outlook_ = findOutlook();
        markSides();
    }

    const std::vector<Plane>& planes() const { return planes_; }
    const std::optional<Vec3>& outlook() const { return outlook_; }

 private:
    void findPlanes() {
        constexpr auto kNone = std::numeric_limits<std::size_t>::max();
        plane_of_.assign(surface_.triangles.size(), kNone);
        for (std::size_t seed = 0; seed < surface_.triangles.size(); ++seed) {
            if (plane_of_[seed] != kNone) continue;
            plane_of_[seed] = planes_.size();
            planes_.push_back({{seed}, areaVector(surface_, seed).normalized(), corner(surface_, seed, 0)});
            Plane& plane = planes_.back();
            for (std::size_t k = 0; k < plane.triangles.size(); ++k) {
                plane.area += 0.5 * areaVector(surface_, plane.triangles[k]).norm();
                for (const std::size_t next : neighbours_[plane.triangles[k]]) {
                    if (plane_of_[next] != kNone || !isIn(plane, next)) continue;
                    plane_of_[next] = plane_of_[seed];
                    plane.triangles.push_back(next);
                }
            }
            std::sort(plane.triangles.begin(), plane.triangles.end());
        }
    }

    bool isIn(const Plane& plane, std::size_t triangle) const {
        if ((areaVector(surface_, triangle).normalized() - plane.normal).norm() > kSameNormal) return false;
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(plane.normal.dot(corner(surface_, triangle, k) - plane.point)) >
                kSamePlane * extent_)
                return false;
        return true;
    }

    bool hasAllBehind(const Plane& plane) const {
        return std::all_of(surface_.vertices.begin(), surface_.vertices.end(), [&](const Vec3& vertex) {
            return plane.normal.dot(vertex - plane.point) <= kSamePlane * extent_;
        });
    }

    void markBase() {
        for (Plane& plane : planes_) plane.is_base = plane.normal.z() < -kUpright && hasAllBehind(plane);
    }

    std::optional<Vec3> findOutlook() const {
        Vec3 sum = Vec3::Zero();
        double area = 0;
        for (const Plane& plane : planes_) {
            if (plane.normal.z() <= kUpright) continue;
            sum += plane.area * Vec3(plane.normal.x(), plane.normal.y(), 0);
            area += plane.area;
        }
        if (!(sum.norm() > kLeastSlope * area)) return std::nullopt;
        return sum.normalized();
    }

    void markSides() {
        if (!outlook_) return;
        for (Plane& plane : planes_)
            plane.is_side = std::abs(plane.normal.z()) <= kUpright && touchesBase(plane) &&
                            plane.normal.dot(*outlook_) < kSameWay;
    }

    bool touchesBase(const Plane& plane) const {
        return std::any_of(plane.triangles.begin(), plane.triangles.end(), [&](std::size_t triangle) {
            const auto& beside = neighbours_[triangle];
            return std::any_of(beside.begin(), beside.end(),
                               [&](std::size_t next) { return planes_[plane_of_[next]].is_base; });
        });
    }

    const TriangleSurface& surface_;
    std::vector<std::array<std::size_t, 3>> neighbours_;
    double extent_;
    std::vector<Plane> planes_;
    std::vector<std::size_t> plane_of_;  ///< per triangle
    std::optional<Vec3> outlook_;
};

/// The part of a convex polygon with `sign` times the coordinate `axis` at most `sign` times `at`.
std::vector<Flat> clipped(const std::vector<Flat>& polygon, int axis, double sign, double at) {
    std::vector<Flat> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Flat &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        const double beyond_a = sign * (a[axis] - at), beyond_b = sign * (b[axis] - at);
        if (beyond_a <= 0) kept.push_back(a);
        if ((beyond_a < 0 && beyond_b > 0) || (beyond_a > 0 && beyond_b < 0)) {
            Flat cut = a + beyond_a / (beyond_a - beyond_b) * (b - a);
            cut[axis] = at;  // both sides of a cut have the same corners
            kept.push_back(cut);
        }
    }
    return kept;
}

double areaOf(const std::vector<Flat>& polygon) {
    double twice = 0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Flat &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
        twice += a.x() * b.y() - b.x() * a.y();
    }
    return 0.5 * twice;
}

/// Divides a plane into equal rectangles along its strike and its dip.
class Grid {
 public:
    Grid(const TriangleSurface& surface, const Plane& plane, double size) : plane_(plane) {
        const Vec3 strike = Vec3::UnitZ().cross(plane.normal);
        along_ = strike.norm() > kUpright ? Vec3(strike.normalized()) : Vec3(Vec3::UnitX());
        up_ = plane.normal.cross(along_);
        for (const std::size_t triangle : plane.triangles) {
            triangles_.push_back({});
            for (std::size_t k = 0; k < 3; ++k)
                triangles_.back().push_back(flat(corner(surface, triangle, k)));
            for (const Flat& spot : triangles_.back()) {
                low_ = low_.cwiseMin(spot);
                high_ = high_.cwiseMax(spot);
            }
        }
        for (int axis = 0; axis < 2; ++axis)
            count_[axis] = std::max(1.0, std::round((high_[axis] - low_[axis]) / size));
    }

    double count() const { return count_[0] * count_[1]; }

    void addCells(std::vector<FaceCell>& cells) const {
        std::map<std::pair<int, int>, FaceCell> at;
        std::map<std::pair<int, int>, double> largest;
        for (const auto& triangle : triangles_) addPieces(triangle, at, largest);
        for (auto& [place, cell] : at) {
            if (isWhole(cell)) makeOne(place, cell);
            cells.push_back(std::move(cell));
        }
    }

 private:
    Flat flat(const Vec3& point) const {
        return {along_.dot(point - plane_.point), up_.dot(point - plane_.point)};
    }
    Vec3 place(const Flat& spot) const { return plane_.point + spot.x() * along_ + spot.y() * up_; }
    double border(int axis, double k) const {
        return k >= count_[axis] ? high_[axis] : low_[axis] + k / count_[axis] * (high_[axis] - low_[axis]);
    }

    double width(int axis) const { return (high_[axis] - low_[axis]) / count_[axis]; }

    bool isWhole(const FaceCell& cell) const { return cell.area >= (1 - kWhole) * width(0) * width(1); }

    /// A rectangle in place of the pieces of several triangles.
    void makeOne(const std::pair<int, int>& at, FaceCell& cell) const {
        const double left = border(0, at.first), right = border(0, at.first + 1);
        const double low = border(1, at.second), high = border(1, at.second + 1);
        cell.pieces = {{place({left, low}), place({right, low}), place({right, high}), place({left, high})}};
        cell.centre = place({0.5 * (left + right), 0.5 * (low + high)});
        cell.area = (right - left) * (high - low);
    }

    /// First and last cell that a triangle may lie in.
    std::pair<int, int> range(const std::vector<Flat>& triangle, int axis) const {
        const auto [least, most] =
            std::minmax_element(triangle.begin(), triangle.end(),
                                [axis](const Flat& a, const Flat& b) { return a[axis] < b[axis]; });
        const double wide = width(axis);
        const auto cell = [&](double value) {
            const double k = wide > 0 ? std::floor((value - low_[axis]) / wide) : 0;
            return static_cast<int>(std::clamp(k, 0.0, count_[axis] - 1));
        };
        return {std::max(0, cell((*least)[axis]) - 1), cell((*most)[axis])};
    }

    void addPieces(const std::vector<Flat>& triangle, std::map<std::pair<int, int>, FaceCell>& at,
                   std::map<std::pair<int, int>, double>& largest) const {
        const auto [left, right] = range(triangle, 0);
        for (int i = left; i <= right; ++i) {
            const auto strip = clipped(clipped(triangle, 0, -1, border(0, i)), 0, 1, border(0, i + 1));
            if (strip.size() < 3) continue;
            const auto [lowest, highest] = range(strip, 1);
            for (int j = lowest; j <= highest; ++j) {
                const auto piece = clipped(clipped(strip, 1, -1, border(1, j)), 1, 1, border(1, j + 1));
                if (piece.size() < 3 || !(areaOf(piece) > 0)) continue;
                add(piece, at[{i, j}], largest[{i, j}]);
            }
        }
    }

    void add(const std::vector<Flat>& piece, FaceCell& cell, double& largest) const {
        const double area = areaOf(piece);
        cell.area += area;
        cell.normal = plane_.normal;
        cell.pieces.push_back({});
        for (const Flat& spot : piece) cell.pieces.back().push_back(place(spot));
        if (!(area > largest)) return;
        largest = area;
        const Flat sum = std::accumulate(piece.begin(), piece.end(), Flat(0, 0));
        cell.centre = place(sum / static_cast<double>(piece.size()));
    }

    const Plane& plane_;
    Vec3 along_ = Vec3::UnitX(), up_ = Vec3::UnitY();
    std::vector<std::vector<Flat>> triangles_;
    Flat low_ = Flat::Constant(std::numeric_limits<double>::infinity()), high_ = -low_;
    Flat count_ = Flat::Ones();
};

/// To 1, 2 or 5 times a power of ten, the nearest by ratio.
double rounded(double size) {
    const double power = std::pow(10, std::floor(std::log10(size)));
    const double square = (size / power) * (size / power);
    return power * (square < 2 ? 1 : square < 10 ? 2 : square < 50 ? 5 : 10);
}

}  // namespace

std::optional<Face> divideFace(const TriangleSurface& region, std::optional<double> cell_size) {
    const Surface surface(region);
    Face face;
    face.outlook = surface.outlook();
    std::vector<const Plane*> planes;
    double area = 0;
    for (const Plane& plane : surface.planes()) {
        if (plane.is_base || plane.is_side) continue;
        planes.push_back(&plane);
        area += plane.area;
    }
    face.cell_size = cell_size ? *cell_size : rounded(std::sqrt(area / kDefaultCells));
    double count = 0;
    for (const Plane* plane : planes) count += Grid(region, *plane, face.cell_size).count();
    if (count > static_cast<double>(kMostCells)) return std::nullopt;
    for (const Plane* plane : planes) Grid(region, *plane, face.cell_size).addCells(face.cells);
    for (const FaceCell& cell : face.cells) face.area += cell.area;
    return face;
}

}  // namespace talus::tools::batch
