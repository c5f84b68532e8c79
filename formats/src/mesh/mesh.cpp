// From a file's triangles to a closed surface: scaled, shifted, repaired, mended, simplified, closed.

#include "talus/formats/mesh.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "mesh/builder.h"
#include "mesh/mend_notes.h"
#include "mesh/mesh_format.h"
#include "mesh/solids.h"
#include "toml/file_text.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using mesh::FileSurface;
using mesh::placeText;
using mesh::shortText;
using toml::numberText;

constexpr double kSevenDigits = 1e-6;  // of the extent: default tolerance of the repair
constexpr double kMended = 1e-4;       // of the extent: the same where a surface is to be mended
constexpr double kSmallHole = 0.05;    // of the extent: holes no wider are closed, if they are to be mended
constexpr double kSinglePrecision = 0x1p-24;
constexpr double kTooCoarse = 1e-4;  // of the extent: coarser coordinates give a warning
constexpr double kRoundShift = 100;  // [m]

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + (count == 1 ? one : many);
}

class MeshReader {
 public:
    MeshReader(const std::string& path, const MeshOptions& options) : path_(path), options_(options) {}

    Result<MeshSurface> read(const std::string& bytes) {
        if (auto errors = begin(bytes); !errors.empty()) return errors;
        mend(result_.surface);
        auto closed = close(result_.surface);
        if (!closed) return closed.errors();
        if (options_.simplify && *options_.simplify > 0) {
            closed = simplified(std::move(*closed));
            if (!closed) return closed.errors();
        }
        result_.surface = std::move(*closed);
        return std::move(result_);
    }

    Result<MeshSolids> readSolids(const std::string& bytes) {
        if (auto errors = begin(bytes); !errors.empty()) return errors;
        std::vector<std::int32_t> solid;
        for (const std::size_t source : source_) solid.push_back(file_.solid[source]);
        auto parts = mesh::solidsOf(result_.surface, solid, file_.solids);
        if (!parts) return told(parts.errors());
        MeshSolids solids;
        std::vector<Error> errors;
        const std::vector<std::size_t> whole = std::move(source_);
        for (mesh::SolidPart& part : *parts) {
            source_.clear();
            for (const std::size_t own : part.source) source_.push_back(whole[own]);
            mend(part.surface);
            for (Error& error : told(checkSurface(part.surface))) errors.push_back(std::move(error));
            solids.solids.push_back({std::move(part.name), std::move(part.surface)});
        }
        if (!errors.empty()) return errors;
        solids.shift = result_.shift;
        solids.notes = std::move(result_.notes);
        return solids;
    }

 private:
    /// As the file has it, near the origin, with its vertices merged.
    std::vector<Error> begin(const std::string& bytes) {
        auto file = mesh::surfaceOf(bytes, path_, options_);
        if (!file) return file.errors();
        file_ = std::move(*file);
        for (const std::string& what : file_.notes) note(what);
        noteUnit();
        place();
        return repair();
    }

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

    void noteUnit() {
        if (!file_.metres || std::abs(*file_.metres / options_.scale - 1) < 1e-6) return;
        note("has a unit of " + shortText(*file_.metres) + " m by its header, and was read with " +
             shortText(options_.scale) + " m (scale says it otherwise)");
    }

    void noteDigits(double farthest, double extent) {
        if (!file_.single_precision || farthest * kSinglePrecision < kTooCoarse * extent) return;
        note("has coordinates of seven digits, which at " + shortText(farthest) + " m are " +
             shortText(2 * farthest * kSinglePrecision) +
             " m apart: write it in double precision, as text, or with coordinates closer to the origin");
    }

    std::vector<Error> repair() {
        if (file_.surface.triangles.empty()) return {{"", "found no triangles, allowed: a surface", path_}};
        const double tolerance = repairTolerance();
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

    double repairTolerance() const {
        return options_.tolerance.value_or((options_.mend ? kMended : kSevenDigits) *
                                           surfaceExtent(file_.surface));
    }

    void mend(TriangleSurface& surface) {
        if (!options_.mend) return;
        const double largest = options_.largest_hole.value_or(kSmallHole * surfaceExtent(surface));
        MendedSurface mended =
            mendSurface(surface, {repairTolerance(), largest, options_.base.has_value() || options_.open});
        for (std::size_t& source : mended.source)
            if (source != MendedSurface::kMade) source = source_[source];
        source_ = std::move(mended.source);
        for (const std::string& what : mesh::mendNotes(mended, largest)) note(what);
        open_holes_ = mended.too_wide.empty()
                          ? ""
                          : "; repair closes holes no wider than largest_hole, " + shortText(largest) + " m";
        surface = std::move(mended.surface);
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
        // For a terrain without a base every edge of its rim is a fault.
        if (!options_.base && !errors.empty() && errors[0].message.find("found an open surface") == 0)
            errors[0].message += "; for an open terrain give the elevation of its base";
        if (!errors.empty()) errors[0].message += open_holes_;
        for (Error& error : errors) {
            if (error.field == "base") continue;
            error.file = path_;
            if (const auto own = triangleIn(error.field, 0)) {
                if (!isMade(*own)) error.line = file_.lines[source_[*own]];
                error.message = triangleText(*own) + ": " + error.message;
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

    bool isMade(std::size_t triangle) const { return source_[triangle] == MendedSurface::kMade; }
    std::string triangleText(std::size_t triangle) const {
        return isMade(triangle) ? "a triangle that closes a hole"
                                : "triangle " + std::to_string(source_[triangle] + 1);
    }

    void nameTriangles(std::string& message) const {
        for (std::size_t at = message.find(kTriangles); at != std::string::npos;
             at = message.find(kTriangles, at + 1)) {
            const auto triangle = triangleIn(message, at);
            if (!triangle) continue;
            const int line = isMade(*triangle) ? 0 : file_.lines[source_[*triangle]];
            message.replace(
                at, message.find(']', at) + 1 - at,
                triangleText(*triangle) + (line > 0 ? " (line " + std::to_string(line) + ")" : ""));
        }
    }

    void note(const std::string& what) { result_.notes.push_back(path_ + " " + what); }

    const std::string& path_;
    const MeshOptions& options_;
    FileSurface file_;
    std::vector<std::size_t> source_;  ///< of each repaired triangle, kMade where it closes a hole
    std::string open_holes_;           ///< what errors say where holes were too wide to be closed
    MeshSurface result_;
};

}  // namespace

Result<MeshSurface> readMesh(const std::string& path, const MeshOptions& options) {
    if (mesh::formatOf(path, options.format) == MeshFormat::by_name) return mesh::unknownEnding(path);
    const auto bytes = toml::readFileText(path);
    return bytes ? parseMesh(*bytes, path, options) : bytes.errors();
}

Result<MeshSurface> parseMesh(const std::string& bytes, const std::string& path, const MeshOptions& options) {
    return MeshReader(path, options).read(bytes);
}

Result<MeshSolids> readSolids(const std::string& path, const MeshOptions& options) {
    if (mesh::formatOf(path, options.format) == MeshFormat::by_name) return mesh::unknownEnding(path);
    const auto bytes = toml::readFileText(path);
    return bytes ? parseSolids(*bytes, path, options) : bytes.errors();
}

Result<MeshSolids> parseSolids(const std::string& bytes, const std::string& path,
                               const MeshOptions& options) {
    return MeshReader(path, options).readSolids(bytes);
}

}  // namespace talus::formats
