#pragma once
// What the mesh readers share: vertices by their coordinates, triangles with their lines.

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "talus/result.h"
#include "talus/rock_mass.h"

namespace talus::formats::mesh {

class SurfaceBuilder {
 public:
    SurfaceBuilder(std::string path, double scale) : path_(std::move(path)), scale_(scale) {}

    std::int32_t vertex(const Vec3& position);
    /// \param line  of the file, 0 in a binary one
    void triangle(const std::array<std::int32_t, 3>& corners, int line);
    /// A convex face with three or more corners. \return whether it is convex
    bool face(const std::vector<std::int32_t>& corners, int line);
    Error fault(int line, std::string message) const { return {"", std::move(message), path_, line, 0}; }
    /// Checks the surface; its faults name lines, or count triangles from 1.
    Result<TriangleSurface> finish();

 private:
    std::string path_;
    double scale_;
    TriangleSurface surface_;
    std::vector<int> lines_;
    std::map<std::array<double, 3>, std::int32_t> vertices_;
};

/// The words of a text, line by line.
class Words {
 public:
    explicit Words(std::string_view text) : rest_(text) {}

    bool nextLine();  ///< false at the end of the text
    int line() const { return line_; }
    std::string_view next();  ///< of this line; empty at its end
    /// Where the next line begins in the text, which is the whole one.
    std::size_t position(std::string_view text) const { return text.size() - rest_.size(); }

 private:
    std::string_view rest_, words_;
    int line_ = 0;
};

/// A finite number that fills the whole word.
inline std::optional<double> numberOf(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    if (read.ec != std::errc() || read.ptr != word.data() + word.size() || !std::isfinite(value)) return {};
    return value;
}

}  // namespace talus::formats::mesh
