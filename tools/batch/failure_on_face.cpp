#include "batch/failure_on_face.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace talus::tools::batch {

namespace {

constexpr double kOnFace = 1e-6;   ///< of the face's extent
constexpr double kSameWay = 0.99;  ///< cosine between the normals of a cell and of the block's face it is on

bool isWithin(const Polyhedron& shape, std::size_t face, const Vec3& normal, const Vec3& point,
              double tolerance) {
    const auto& outline = shape.faces[face];
    for (std::size_t k = 0; k < outline.size(); ++k) {
        const Vec3& a = shape.vertices[static_cast<std::size_t>(outline[k])];
        const Vec3& b = shape.vertices[static_cast<std::size_t>(outline[(k + 1) % outline.size()])];
        if (normal.dot((b - a).cross(point - a)) < -tolerance * (b - a).norm()) return false;
    }
    return true;
}

}  // namespace

FaceIndex::FaceIndex(const Face& face) : face_(face), by_x_(face.cells.size()) {
    std::iota(by_x_.begin(), by_x_.end(), std::size_t{0});
    std::stable_sort(by_x_.begin(), by_x_.end(), [&](std::size_t a, std::size_t b) {
        return face.cells[a].centre.x() < face.cells[b].centre.x();
    });
    Vec3 low = Vec3::Constant(kInfinity), high = -low;
    for (const FaceCell& cell : face.cells) {
        low = low.cwiseMin(cell.centre);
        high = high.cwiseMax(cell.centre);
    }
    if (!face.cells.empty()) tolerance_ = kOnFace * std::max((high - low).norm(), face.cell_size);
}

void FaceIndex::addCellsOn(const Polyhedron& shape, std::size_t face, std::vector<std::size_t>& cells) const {
    const Vec3 normal = shape.faceNormal(face), middle = shape.faceCentroid(face);
    double least = kInfinity, most = -kInfinity;
    for (const std::int32_t vertex : shape.faces[face]) {
        least = std::min(least, shape.vertices[static_cast<std::size_t>(vertex)].x());
        most = std::max(most, shape.vertices[static_cast<std::size_t>(vertex)].x());
    }
    const auto first =
        std::lower_bound(by_x_.begin(), by_x_.end(), least - tolerance_,
                         [&](std::size_t cell, double x) { return face_.cells[cell].centre.x() < x; });
    for (auto at = first; at != by_x_.end(); ++at) {
        const FaceCell& cell = face_.cells[*at];
        if (cell.centre.x() > most + tolerance_) break;
        if (std::abs(normal.dot(cell.centre - middle)) <= tolerance_ && normal.dot(cell.normal) >= kSameWay &&
            isWithin(shape, face, normal, cell.centre, tolerance_))
            cells.push_back(*at);
    }
}

FailureOnFace FaceIndex::failureOf(const Model& model, const std::vector<std::size_t>& failing) const {
    FailureOnFace failure;
    std::vector<std::uint8_t> taken(face_.cells.size(), 0);  // a centre on an edge counts for the first block
    double left_over = 0, face_area = 0;
    for (const std::size_t block : failing) {
        const Polyhedron& shape = model.blocks[block].shape;
        std::vector<std::size_t> cells;
        for (std::size_t f = 0; f < shape.faces.size(); ++f)
            if (!shape.isInner(f)) addCellsOn(shape, f, cells);
        std::erase_if(cells, [&](std::size_t cell) { return std::exchange(taken[cell], 1) != 0; });
        const double volume = massProperties(shape).volume;
        failure.volume += volume;
        double area = 0;
        for (const std::size_t cell : cells) area += face_.cells[cell].area;
        if (cells.empty()) left_over += volume;
        for (const std::size_t cell : cells) failure.cells.push_back({cell, volume / area});
        face_area += area;
    }
    for (FailureOnFace::Share& share : failure.cells) share.volume_per_area += left_over / face_area;
    if (failure.cells.empty()) failure.hidden_volume = left_over;
    std::sort(failure.cells.begin(), failure.cells.end(),
              [](const auto& a, const auto& b) { return a.cell < b.cell; });
    return failure;
}

}  // namespace talus::tools::batch
