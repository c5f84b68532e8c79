#include "mesh/builder.h"

#include <algorithm>

namespace talus::formats::mesh {

std::int32_t SurfaceBuilder::vertex(const Vec3& position) {
    const Vec3 x = scale_ * position + Vec3::Zero();  // + 0 turns -0 into 0
    const auto [place, is_new] =
        vertices_.try_emplace({x.x(), x.y(), x.z()}, static_cast<std::int32_t>(surface_.vertices.size()));
    if (is_new) surface_.vertices.push_back(x);
    return place->second;
}

void SurfaceBuilder::triangle(const std::array<std::int32_t, 3>& corners, int line) {
    surface_.triangles.push_back(corners);
    lines_.push_back(line);
}

bool SurfaceBuilder::face(const std::vector<std::int32_t>& corners, int line) {
    const auto at = [&](std::size_t i) -> const Vec3& {
        return surface_.vertices[static_cast<std::size_t>(corners[i])];
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

Result<TriangleSurface> SurfaceBuilder::finish() {
    std::vector<Error> errors = checkSurface(surface_);
    for (Error& error : errors) {
        error.file = path_;
        std::size_t triangle = 0;
        const std::string_view field = error.field;
        if (!field.starts_with("triangles[")) continue;
        std::from_chars(field.data() + 10, field.data() + field.size(), triangle);
        error.line = lines_[triangle];
        error.field.clear();
        error.message = "triangle " + std::to_string(triangle + 1) + ": " + error.message;
    }
    if (!errors.empty()) return errors;
    return std::move(surface_);
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
