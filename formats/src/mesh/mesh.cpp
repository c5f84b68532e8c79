// From a file's triangles to a closed surface: scaled, shifted, repaired, simplified, closed.

#include "talus/formats/mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "mesh/builder.h"
#include "toml/file_text.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using mesh::FileSurface;
using toml::numberText;

constexpr double kSevenDigits = 1e-6;  // of the extent: default tolerance of the repair
constexpr double kSinglePrecision = 0x1p-24;
constexpr double kTooCoarse = 1e-4;  // of the extent: coordinates that are no finer are told
constexpr double kRoundShift = 100;  // [m]

Error unknownEnding(const std::string& path) {
    return {"", "found " + toml::quoted(path) + ", allowed: a file that ends in .stl, .obj, .ply or .asc"};
}

/// One of the formats; by_name where the name tells none.
MeshFormat formatOf(const std::string& path, MeshFormat format) {
    if (format != MeshFormat::by_name) return format;
    std::string end = path.substr(path.size() - std::min<std::size_t>(4, path.size()));
    for (char& c : end) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    constexpr std::pair<std::string_view, MeshFormat> kEndings[]{{".stl", MeshFormat::stl},
                                                                 {".obj", MeshFormat::obj},
                                                                 {".ply", MeshFormat::ply},
                                                                 {".asc", MeshFormat::asc}};
    for (const auto& [ending, known] : kEndings)
        if (end == ending) return known;
    return format;
}

Result<FileSurface> surfaceOf(const std::string& bytes, const std::string& path, MeshFormat format) {
    switch (formatOf(path, format)) {
        case MeshFormat::stl:
            return mesh::readStl(bytes, mesh::SurfaceBuilder(path));
        case MeshFormat::obj:
            return mesh::readObj(bytes, mesh::SurfaceBuilder(path));
        case MeshFormat::ply:
            return mesh::readPly(bytes, mesh::SurfaceBuilder(path));
        case MeshFormat::asc:
            return mesh::readAsc(bytes, mesh::SurfaceBuilder(path));
        case MeshFormat::by_name:
            break;
    }
    return unknownEnding(path);
}

std::string shortText(double value, int digits = 6) {
    char buffer[40];
    return {buffer,
            std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, digits).ptr};
}

std::string placeText(const Vec3& p) {
    return "(" + shortText(p.x(), 10) + ", " + shortText(p.y(), 10) + ", " + shortText(p.z(), 10) + ")";
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + (count == 1 ? one : many);
}

class MeshReader {
 public:
    MeshReader(const std::string& path, const MeshOptions& options) : path_(path), options_(options) {}

    Result<MeshSurface> read(const std::string& bytes) {
        auto file = surfaceOf(bytes, path_, options_.format);
        if (!file) return file.errors();
        file_ = std::move(*file);
        place();
        if (auto errors = repair(); !errors.empty()) return errors;
        auto closed = close(result_.surface);
        if (!closed) return closed.errors();
        if (options_.simplify && *options_.simplify > 0) {
            closed = simplified(std::move(*closed));
            if (!closed) return closed.errors();
        }
        result_.surface = std::move(*closed);
        return std::move(result_);
    }

 private:
    /// Into metres and near the origin.
    void place() {
        auto& vertices = file_.surface.vertices;
        Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
        for (Vec3& v : vertices) {
            v *= options_.scale;
            low = low.cwiseMin(v);
            high = high.cwiseMax(v);
        }
        if (vertices.empty()) return;
        const double farthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
        noteDigits(farthest, (high - low).maxCoeff());
        result_.shift = options_.shift.value_or(Vec3::Zero());
        const double in_plan =
            std::max(low.head<2>().cwiseAbs().maxCoeff(), high.head<2>().cwiseAbs().maxCoeff());
        if (!options_.shift && in_plan > options_.farthest) {
            for (int axis : {0, 1}) result_.shift[axis] = kRoundShift * std::floor(low[axis] / kRoundShift);
            note("lies at " + placeText(low) + " m, so [" + numberText(result_.shift.x()) + ", " +
                 numberText(result_.shift.y()) +
                 ", 0] is subtracted from its coordinates; all other coordinates are relative to that point, "
                 "too (set shift for another one)");
        }
        for (Vec3& v : vertices) v = v - result_.shift + Vec3::Zero();
    }

    void noteDigits(double farthest, double extent) {
        if (!file_.single_precision || farthest * kSinglePrecision < kTooCoarse * extent) return;
        note("has coordinates of seven digits, which at " + shortText(farthest) + " m are " +
             shortText(2 * farthest * kSinglePrecision) +
             " m apart: write it in double precision, as text, or with coordinates closer to the origin");
    }

    std::vector<Error> repair() {
        if (file_.surface.triangles.empty()) return {{"", "found no triangles, allowed: a surface", path_}};
        const double tolerance = options_.tolerance.value_or(kSevenDigits * surfaceExtent(file_.surface));
        SurfaceRepair repaired = repairSurface(file_.surface, tolerance);
        source_ = std::move(repaired.source);
        result_.surface = std::move(repaired.surface);
        if (repaired.changed())
            note("was repaired within " + shortText(tolerance) +
                 " m: " + counted(repaired.merged, " duplicate vertex, ", " duplicate vertices, ") +
                 counted(repaired.split, " T-junction, ", " T-junctions, ") +
                 counted(repaired.dropped, " triangle without a width", " triangles without a width") +
                 "; the first at " + placeText(repaired.place));
        return {};
    }

    /// The surface as the region's boundary.
    Result<TriangleSurface> close(const TriangleSurface& surface) {
        if (options_.open) return opened(surface);
        if (!options_.base) {
            if (auto errors = checkSurface(surface); !errors.empty()) return told(std::move(errors));
            return surface;
        }
        auto closed = closeTerrain(surface, *options_.base);
        if (!closed) return told(closed.errors());
        if (closed->turned) note("was turned over, because all its triangles face down");
        return std::move(closed->surface);
    }

    /// A terrain's own triangles, once it is known that it can be closed.
    Result<TriangleSurface> opened(const TriangleSurface& surface) {
        double low = std::numeric_limits<double>::infinity();
        for (const Vec3& v : surface.vertices) low = std::min(low, v.z());
        auto closed = closeTerrain(surface, low - surfaceExtent(surface));
        if (!closed) return told(closed.errors());
        return upturned(surface, closed->surface);
    }

    Result<TriangleSurface> simplified(TriangleSurface closed) {
        const std::size_t before = result_.surface.triangles.size();
        // A terrain's sides follow its rim.
        TriangleSurface coarse = options_.base ? upturned(result_.surface, closed) : std::move(closed);
        coarse = simplifySurface(coarse, *options_.simplify);
        note("was simplified from " + std::to_string(before) + " to " +
             std::to_string(coarse.triangles.size()) + " triangles; no part of it has moved farther than " +
             shortText(*options_.simplify) + " m");
        Result<TriangleSurface> result = coarse;
        if (options_.base) {
            auto again = closeTerrain(std::move(coarse), *options_.base);
            result = again ? Result<TriangleSurface>(std::move(again->surface)) : again.errors();
        } else if (auto errors = checkSurface(coarse); !errors.empty()) {
            result = errors;
        }
        if (result) return result;
        return Error{"simplify", "the simplified surface does not separate inside from outside (" +
                                     result.errors()[0].message + "), allowed: a smaller deviation"};
    }

    /// The terrain's own triangles, as they were closed.
    static TriangleSurface upturned(const TriangleSurface& terrain, const TriangleSurface& closed) {
        TriangleSurface own = terrain;
        std::copy_n(closed.triangles.begin(), own.triangles.size(), own.triangles.begin());
        return own;
    }

    /// Faults of triangles by their lines, else counted from 1.
    std::vector<Error> told(std::vector<Error> errors) const {
        // Of a terrain without a base every edge of its rim is told.
        if (!options_.base && !errors.empty() && errors[0].message.find("found an open surface") == 0)
            errors[0].message += "; for an open terrain give the elevation of its base";
        for (Error& error : errors) {
            if (error.field == "base") continue;
            error.file = path_;
            if (const auto own = triangleIn(error.field, 0)) {
                error.line = file_.lines[source_[*own]];
                error.message = "triangle " + std::to_string(source_[*own] + 1) + ": " + error.message;
            }
            error.field.clear();
            nameTriangles(error.message);
        }
        return errors;
    }

    static constexpr std::string_view kTriangles = "triangles[";

    /// The number in "triangles[N]" at this place of a text.
    std::optional<std::size_t> triangleIn(std::string_view text, std::size_t at) const {
        if (!text.substr(std::min(at, text.size())).starts_with(kTriangles)) return std::nullopt;
        std::size_t triangle = 0;
        const char* digits = text.data() + at + kTriangles.size();
        std::from_chars(digits, text.data() + text.size(), triangle);
        return triangle < source_.size() ? std::optional(triangle) : std::nullopt;
    }

    void nameTriangles(std::string& message) const {
        for (std::size_t at = message.find(kTriangles); at != std::string::npos;
             at = message.find(kTriangles, at + 1)) {
            const auto triangle = triangleIn(message, at);
            if (!triangle) continue;
            const int line = file_.lines[source_[*triangle]];
            message.replace(at, message.find(']', at) + 1 - at,
                            "triangle " + std::to_string(source_[*triangle] + 1) +
                                (line > 0 ? " (line " + std::to_string(line) + ")" : ""));
        }
    }

    void note(const std::string& what) { result_.notes.push_back(path_ + " " + what); }

    const std::string& path_;
    const MeshOptions& options_;
    FileSurface file_;
    std::vector<std::size_t> source_;  ///< of each repaired triangle
    MeshSurface result_;
};

}  // namespace

Result<MeshSurface> readMesh(const std::string& path, const MeshOptions& options) {
    if (formatOf(path, options.format) == MeshFormat::by_name) return unknownEnding(path);
    const auto bytes = toml::readFileText(path);
    return bytes ? parseMesh(*bytes, path, options) : bytes.errors();
}

Result<MeshSurface> parseMesh(const std::string& bytes, const std::string& path, const MeshOptions& options) {
    return MeshReader(path, options).read(bytes);
}

}  // namespace talus::formats
