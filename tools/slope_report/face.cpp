#include "slope_report/face.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace talus::tools {

namespace {

constexpr double kSameOffset = 1e-7;  ///< of the model's size
constexpr double kSameNormal = 1e-5;  ///< length of the difference of unit normals
constexpr double kUpright = 1e-6;     ///< upward component of a normal

struct FaceOfBlock {
    Vec3 normal = Vec3::UnitZ();  ///< outward
    double offset = 0;            ///< of its plane, along `side` times the normal [m]
    double area = 0;              ///< [m^2]
    double side = 1;              ///< +1 or -1, so that both sides of a plane have one offset
};

double sideOf(const Vec3& normal) {
    for (int k = 0; k < 3; ++k)
        if (std::abs(normal[k]) > kSameNormal) return normal[k] > 0 ? 1 : -1;
    return 1;
}

std::vector<FaceOfBlock> facesOf(const Model& model) {
    std::vector<FaceOfBlock> faces;
    for (const Block& block : model.blocks) {
        for (std::size_t f = 0; f < block.shape.faces.size(); ++f) {
            if (block.shape.isInner(f)) continue;
            FaceOfBlock face{block.shape.faceNormal(f), 0, block.shape.faceArea(f), 1};
            face.side = sideOf(face.normal);
            face.offset = face.side * face.normal.dot(block.shape.faceCentroid(f));
            faces.push_back(face);
        }
    }
    std::stable_sort(faces.begin(), faces.end(),
                     [](const FaceOfBlock& a, const FaceOfBlock& b) { return a.offset < b.offset; });
    return faces;
}

/// All faces in one plane.
struct Plane {
    Vec3 normal = Vec3::UnitZ();  ///< of the first of them, outward
    double offset = 0;            ///< as of its faces [m]
    double side = 1;
    double area = 0;  ///< [m^2]
    bool both_sides = false;
};

/// \param faces  sorted by offset
std::vector<Plane> planesOf(const std::vector<FaceOfBlock>& faces, double size) {
    std::vector<Plane> planes;
    std::size_t first = 0;  // of the planes that have the offset of the last face
    for (std::size_t k = 0; k < faces.size(); ++k) {
        const FaceOfBlock& face = faces[k];
        if (k > 0 && face.offset - faces[k - 1].offset > kSameOffset * size) first = planes.size();
        const auto known = std::find_if(
            planes.begin() + static_cast<std::ptrdiff_t>(first), planes.end(), [&](const Plane& plane) {
                return (plane.side * plane.normal - face.side * face.normal).norm() < kSameNormal;
            });
        if (known == planes.end()) {
            planes.push_back({face.normal, face.offset, face.side, face.area, false});
        } else {
            known->both_sides |= known->side != face.side;
            known->area += face.area;
        }
    }
    return planes;
}

/// Corners of the model's blocks.
std::vector<Vec3> cornersOf(const Model& model) {
    std::vector<Vec3> corners;
    for (const Block& block : model.blocks)
        corners.insert(corners.end(), block.shape.vertices.begin(), block.shape.vertices.end());
    return corners;
}

bool isBehind(const std::vector<Vec3>& corners, const Plane& plane, double tolerance) {
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
        return plane.normal.dot(corner) <= plane.side * plane.offset + tolerance;
    });
}

}  // namespace

std::optional<kinematics::Face> faceOf(const Model& model) {
    const std::vector<Vec3> corners = cornersOf(model);
    if (corners.empty()) return std::nullopt;
    Vec3 low = corners.front(), high = low;
    for (const Vec3& corner : corners) low = low.cwiseMin(corner), high = high.cwiseMax(corner);
    const double size = (high - low).norm();
    Vec3 sum = Vec3::Zero();
    for (const Plane& plane : planesOf(facesOf(model), size)) {
        const bool is_upright = std::abs(plane.normal.z()) < kUpright;
        if (plane.both_sides || plane.normal.z() < -kUpright) continue;
        if (is_upright && isBehind(corners, plane, kSameOffset * size)) continue;
        const Vec3 normal = kinematics::normalUnderGravity(plane.normal, model.gravity).normalized();
        if (kinematics::dipOfPlane(normal) >= kLeastFaceDip) sum += plane.area * normal;
    }
    if (!(sum.norm() > 0)) return std::nullopt;
    const Vec3 mean = sum.normalized();
    const auto down = kinematics::dipVector(mean);
    if (!down) return std::nullopt;
    return kinematics::Face{kinematics::dipOfPlane(mean), kinematics::trendOf(*down)};
}

}  // namespace talus::tools
