#include "mesh/builder.h"

#include <algorithm>

namespace talus::formats::mesh {

std::int32_t SurfaceBuilder::vertex(const Vec3& position) {
    const Vec3 x = position + Vec3::Zero();  // + 0 turns -0 into 0
    const auto [place, is_new] = vertices_.try_emplace(
        {x.x(), x.y(), x.z()}, static_cast<std::int32_t>(file_.surface.vertices.size()));
    if (is_new) file_.surface.vertices.push_back(x);
    return place->second;
}

void SurfaceBuilder::triangle(const std::array<std::int32_t, 3>& corners, int line) {
    file_.surface.triangles.push_back(corners);
    file_.lines.push_back(line);
    file_.solid.push_back(solid_);
}

void SurfaceBuilder::beginSolid(std::string name) {
    solid_ = static_cast<std::int32_t>(file_.solids.size());
    file_.solids.push_back(std::move(name));
}

void SurfaceBuilder::continueSolid(const std::string& name) {
    const auto [known, is_new] =
        solid_of_name_.try_emplace(name, static_cast<std::int32_t>(file_.solids.size()));
    if (is_new)
        beginSolid(name);
    else
        solid_ = known->second;
}

bool SurfaceBuilder::face(const std::vector<std::int32_t>& corners, int line) {
    const auto at = [&](std::size_t i) -> const Vec3& {
        return file_.surface.vertices[static_cast<std::size_t>(corners[i])];
    };
    std::vector<Vec3> normals;  // of the triangles of its fan: they all face one way
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 2; i < corners.size(); ++i) {
        normals.push_back((at(i - 1) - at(0)).cross(at(i) - at(0)));
        sum += normals.back();
    }
    if (corners.size() > 3 &&
        std::any_of(normals.begin(), normals.end(), [&](const Vec3& normal) { return normal.dot(sum) <= 0; }))
        return false;
    for (std::size_t i = 2; i < corners.size(); ++i) triangle({corners[0], corners[i - 1], corners[i]}, line);
    return true;
}

bool Words::nextLine() {
    if (rest_.empty()) return false;
    const auto end = std::min(rest_.find('\n'), rest_.size());
    words_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++line_;
    return true;
}

std::string_view Words::next() {
    constexpr std::string_view kSpace = " \t\r\f\v";
    words_.remove_prefix(std::min(words_.find_first_not_of(kSpace), words_.size()));
    const auto end = std::min(words_.find_first_of(kSpace), words_.size());
    const std::string_view word = words_.substr(0, end);
    words_.remove_prefix(end);
    return word;
}

}  // namespace talus::formats::mesh
