#include "talus/polyhedron.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace talus {
namespace {

std::string text(double value) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
    return {buffer.data(), end};
}

/// Calls `visit(a, b, c)` for the fan of a face, corners relative to the face's first vertex: a block far
/// from the origin keeps its accuracy.
template <class Visit>
void forEachFanTriangle(const Polyhedron& shape, std::size_t face, Visit visit) {
    const auto& outline = shape.faces[face];
    const Vec3 origin = shape.vertices[outline[0]];
    for (std::size_t i = 2; i < outline.size(); ++i)
        visit(Vec3(shape.vertices[outline[i - 1]] - origin), Vec3(shape.vertices[outline[i]] - origin));
}

/// Newell's normal: the sum of the fan's cross products, twice the area vector.
Vec3 doubleAreaVector(const Polyhedron& shape, std::size_t face) {
    Vec3 sum = Vec3::Zero();
    forEachFanTriangle(shape, face, [&](const Vec3& b, const Vec3& c) { sum += b.cross(c); });
    return sum;
}

/// The side of the cube with as much volume per surface [m].
double sizeOfCube(const Polyhedron& shape) {
    double surface = 0;
    for (std::size_t f = 0; f < shape.faces.size(); ++f)
        if (!shape.isInner(f)) surface += shape.faceArea(f);
    return 6.0 * massProperties(shape).volume / surface;
}

/// Extents along many directions. A terrain of n triangles has n normals and some n vertices. But few
/// vertices are extreme in any direction, and the known ones already exclude most directions.
class Widths {
 public:
    explicit Widths(const Polyhedron& shape) : vertices_(shape.vertices) {}

    /// Along a unit vector; if it is at least `enough`, any value between that and the extent [m].
    double along(const Vec3& direction, double enough) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const std::size_t v : outermost_) {
            const double height = direction.dot(vertices_[v]);
            low = std::min(low, height);
            high = std::max(high, height);
        }
        if (high - low >= enough) return high - low;
        std::size_t lowest = 0, highest = 0;
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            const double height = direction.dot(vertices_[v]);
            if (height < low) low = height, lowest = v;
            if (height > high) high = height, highest = v;
            if (high - low >= enough) break;
        }
        if (vertices_.size() > kFew) outermost_.insert(outermost_.end(), {lowest, highest});
        return high - low;
    }

 private:
    static constexpr std::size_t kFew = 64;  // vertices; fewer are tested directly

    const std::vector<Vec3>& vertices_;
    std::vector<std::size_t> outermost_{};
};

std::vector<Error> checkBox(const Vec3& min, const Vec3& max) {
    std::vector<Error> errors;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string name(1, "xyz"[axis]);
        const std::string found =
            "min " + name + " = " + text(min[axis]) + ", max " + name + " = " + text(max[axis]);
        if (!std::isfinite(max[axis] - min[axis]))
            errors.push_back({"box", found + "; both must be finite"});
        else if (!(min[axis] < max[axis]))
            errors.push_back({"box", found + "; min must be below max"});
    }
    return errors;
}

}  // namespace

FaceList::FaceList(std::vector<Outline> outlines) : FaceList(std::move(outlines), {}, {}) {}

FaceList::FaceList(std::vector<Outline> outlines, std::vector<ConvexPart> parts, std::vector<Cover> covers)
    : lists_(std::make_shared<const Lists>(Lists{std::move(outlines), std::move(parts), std::move(covers)})) {
}

const FaceList::Lists& FaceList::lists() const {
    static const Lists kNone{};
    return lists_ ? *lists_ : kNone;
}

Vec3 Polyhedron::faceNormal(std::size_t face) const { return doubleAreaVector(*this, face).normalized(); }

double Polyhedron::faceArea(std::size_t face) const { return 0.5 * doubleAreaVector(*this, face).norm(); }

Vec3 Polyhedron::faceCentroid(std::size_t face) const {
    const Vec3 normal = faceNormal(face);
    Vec3 moment = Vec3::Zero();
    double area = 0;
    forEachFanTriangle(*this, face, [&](const Vec3& b, const Vec3& c) {
        const double weight = normal.dot(b.cross(c));
        moment += weight * (b + c) / 3.0;
        area += weight;
    });
    return vertices[faces[face][0]] + moment / area;
}

// Vertex 4 ix + 2 iy + iz has ix, iy, iz = 0 at min and 1 at max: the hull's lexicographic order.
Result<Polyhedron> makeBox(const Vec3& min, const Vec3& max) {
    if (auto errors = checkBox(min, max); !errors.empty()) return errors;
    Polyhedron box;
    box.vertices.reserve(8);
    for (int corner = 0; corner < 8; ++corner)
        box.vertices.emplace_back(corner & 4 ? max.x() : min.x(), corner & 2 ? max.y() : min.y(),
                                  corner & 1 ? max.z() : min.z());
    static const FaceList kFaces{{0, 1, 3, 2}, {4, 6, 7, 5},   // -x, +x
                                 {0, 4, 5, 1}, {2, 3, 7, 6},   // -y, +y
                                 {0, 2, 6, 4}, {1, 5, 7, 3}};  // -z, +z
    box.faces = kFaces;
    return box;
}

double smallestExtent(const Polyhedron& shape) {
    Widths widths(shape);
    double smallest = shape.partCount() > 1 ? sizeOfCube(shape) : std::numeric_limits<double>::infinity();
    for (std::size_t f = 0; f < shape.faces.size(); ++f)
        if (!shape.isInner(f)) smallest = std::min(smallest, widths.along(shape.faceNormal(f), smallest));
    return smallest;
}

}  // namespace talus
