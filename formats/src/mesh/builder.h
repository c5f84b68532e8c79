#pragma once
// Shared by the mesh readers: vertices by their coordinates, triangles with their lines.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/number.h"
#include "talus/result.h"
#include "talus/surface.h"

namespace talus::formats::mesh {

/// A surface as given in its file.
struct FileSurface {
    TriangleSurface surface;
    std::vector<int> lines;           ///< of each triangle; 0 in a binary file
    std::vector<std::int32_t> solid;  ///< of each triangle, index into `solids`; -1 before the first name
    std::vector<std::string> solids;  ///< names of the solids that the file tells apart
    bool single_precision = false;    ///< coordinates of seven digits
    std::optional<double> metres;     ///< its own unit, where the file says it
    std::vector<std::string> notes;   ///< what was left out, for the user: "has 3 TEXT, ..."
};

class SurfaceBuilder {
 public:
    explicit SurfaceBuilder(std::string path) : path_(std::move(path)) {}

    std::int32_t vertex(const Vec3& position);
    /// \param line  of the file, 0 in a binary one
    void triangle(const std::array<std::int32_t, 3>& corners, int line);
    /// A convex face with three or more corners. \return whether it is convex
    bool face(const std::vector<std::int32_t>& corners, int line);
    /// Triangles from here on are of a new solid, or of the one that has this name already.
    void beginSolid(std::string name);
    void continueSolid(const std::string& name);
    void setSinglePrecision() { file_.single_precision = true; }
    void setUnit(double metres) { file_.metres = metres; }
    void note(std::string what) { file_.notes.push_back(std::move(what)); }
    bool empty() const { return file_.surface.triangles.empty(); }
    Error fault(int line, std::string message) const { return {"", std::move(message), path_, line, 0}; }
    FileSurface finish() { return std::move(file_); }

 private:
    std::string path_;
    FileSurface file_;
    std::int32_t solid_ = -1;
    std::map<std::array<double, 3>, std::int32_t> vertices_;
    std::map<std::string, std::int32_t> solid_of_name_;
};

/// How points are thinned to a grid.
struct Thinning {
    double cell = 1;      ///< side of a cell [m], in the file's unit
    bool median = false;  ///< of the heights in a cell, else their mean
};

// The formats, each from a whole file's bytes.
Result<FileSurface> readStl(const std::string& bytes, SurfaceBuilder builder);
Result<FileSurface> readObj(const std::string& text, SurfaceBuilder builder);
Result<FileSurface> readPly(const std::string& text, SurfaceBuilder builder);
Result<FileSurface> readAsc(const std::string& text, SurfaceBuilder builder);
/// \param layer  none: faces of all layers
Result<FileSurface> readDxf(const std::string& text, const std::optional<std::string>& layer,
                            SurfaceBuilder builder);
Result<FileSurface> readXyz(const std::string& text, const Thinning& thinning, SurfaceBuilder builder);

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

}  // namespace talus::formats::mesh
