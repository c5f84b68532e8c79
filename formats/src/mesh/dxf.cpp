// DXF as text: the faces of its section ENTITIES. 3DFACE has three or four corners (codes 10 to 13, 20 to 23,
// 30 to 33). POLYLINE with flag 64 is a polyface mesh: VERTEX entities with its places, then others with the
// numbers of a face's corners, negative before an edge that is not drawn. With flag 16 it is a polygon mesh
// of M times N places. Everything else is left out and reported. (AutoCAD's DXF reference, section ENTITIES.)

#include "mesh/dxf.h"

#include <array>
#include <cmath>
#include <set>

#include "files/number.h"
#include "mesh/builder.h"
#include "toml/wording.h"

namespace talus::formats {

namespace {

using mesh::DxfEntity;
using mesh::FileSurface;
using mesh::SurfaceBuilder;

constexpr std::string_view kBinary = "AutoCAD Binary DXF";
constexpr int kClosedInM = 1, kSplineFit = 4, kPolygonMesh = 16, kClosedInN = 32, kPolyface = 64, kFace = 128;

/// Numbers that faces are made of: coordinates, flags and counts.
bool isRead(int code) { return (code >= 10 && code <= 33) || (code >= 70 && code <= 74); }

/// Of a polyface mesh: numbers of its corners as they stand, 0 for none.
struct Face {
    std::array<double, 4> corners;
    int line = 0;
};

/// One polyface or polygon mesh.
struct Mesh {
    DxfEntity head;
    std::vector<std::int32_t> places{};
    std::vector<Face> faces{};
};

class DxfReader {
 public:
    DxfReader(const std::string& text, const std::optional<std::string>& layer, SurfaceBuilder& builder)
        : pairs_(text), layer_(layer), builder_(builder) {}

    Result<FileSurface> read() {
        std::string section;
        bool ended = false;
        bool more = pairs_.next();
        while (more && !ended) {
            if (pairs_.is(0, "EOF")) {
                ended = true;
            } else if (pairs_.is(0, "SECTION")) {
                more = pairs_.next();
                section = more && pairs_.code() == 2 ? pairs_.value() : "";
                if (more) more = pairs_.next();
            } else if (section == "ENTITIES" && pairs_.code() == 0 && !pairs_.is(0, "ENDSEC")) {
                if (auto fault = readEntity(more)) return *fault;
            } else {
                if (section == "HEADER") readUnit();
                more = pairs_.next();
            }
        }
        if (pairs_.isFaulty()) {
            return fault(pairs_.line(), "found " + toml::quoted(pairs_.value()) +
                                            " in place of a group code, allowed: DXF as text, pairs of "
                                            "lines with a whole number and its value");
        }
        if (!ended)
            return fault(pairs_.line(), "found the end of the file without EOF, allowed: a whole file");
        if (auto fault = finishMesh()) return *fault;
        return finish();
    }

 private:
    using Fault = std::optional<Error>;

    Error fault(int line, std::string message) const { return builder_.fault(line, std::move(message)); }

    /// Of the header: the name of a variable, then its value.
    void readUnit() {
        if (pairs_.code() == 9) is_unit_ = pairs_.value() == "$INSUNITS";
        if (!is_unit_ || pairs_.code() != 70) return;
        if (const auto metres = mesh::dxfUnit(pairs_.value())) builder_.setUnit(*metres);
    }

    /// From its type to the next entity's.
    Fault readEntity(bool& more) {
        DxfEntity entity{std::string(pairs_.value())};
        entity.line = pairs_.line();
        const bool is_taken = entity.type == "3DFACE" || entity.type == "POLYLINE" || entity.type == "VERTEX";
        while ((more = pairs_.next()) && pairs_.code() != 0) {
            if (pairs_.code() == 8) entity.layer = pairs_.value();
            if (!is_taken || !isRead(pairs_.code())) continue;
            const auto number = numberOf(pairs_.value());
            if (!number) {
                return fault(pairs_.line(), "found " + toml::quoted(pairs_.value()) + " for group code " +
                                                std::to_string(pairs_.code()) + " of " + entity.type +
                                                ", allowed: a finite number");
            }
            entity.numbers[pairs_.code()] = *number;
        }
        return take(entity);
    }

    Fault take(const DxfEntity& entity) {
        if (entity.type == "VERTEX" && polyline_) return takeVertex(entity);
        if (auto fault = finishMesh()) return fault;
        if (entity.type == "SEQEND") return std::nullopt;
        const bool is_mesh = entity.type == "POLYLINE" && (entity.flags() & (kPolygonMesh | kPolyface)) != 0;
        if (entity.type == "POLYLINE") polyline_ = Mesh{entity};
        if (!is_mesh && entity.type != "3DFACE") {
            ++left_out_[entity.type];
            return std::nullopt;
        }
        layers_.insert(entity.layer);
        if (layer_ && entity.layer != *layer_) {
            ++on_other_layers_;
            return std::nullopt;
        }
        return entity.type == "3DFACE" ? takeFace(entity) : std::nullopt;
    }

    Fault takeFace(const DxfEntity& face) {
        for (const int code : {10, 20, 11, 21, 12, 22}) {
            if (!face.has(code)) {
                return fault(face.line, "found a 3DFACE without group code " + std::to_string(code) +
                                            ", allowed: three or four corners");
            }
        }
        std::vector<std::int32_t> corners;
        for (const int k : {0, 1, 2, 3}) {
            if (k == 3 && !face.has(13)) break;
            const Vec3 place(face.number(10 + k), face.number(20 + k), face.number(30 + k));
            corners.push_back(builder_.vertex(place));
        }
        builder_.continueSolid(face.layer);
        return add(corners, face.line);
    }

    Fault takeVertex(const DxfEntity& vertex) {
        if (!isWanted(polyline_->head)) return std::nullopt;
        const bool is_face = (vertex.flags() & kFace) != 0 && (vertex.flags() & kPolyface) == 0;
        if (is_face) {
            polyline_->faces.push_back(
                {{vertex.number(71), vertex.number(72), vertex.number(73), vertex.number(74)}, vertex.line});
        } else {
            polyline_->places.push_back(
                builder_.vertex({vertex.number(10), vertex.number(20), vertex.number(30)}));
        }
        return std::nullopt;
    }

    bool isWanted(const DxfEntity& head) const {
        return (head.flags() & (kPolygonMesh | kPolyface)) != 0 && (!layer_ || head.layer == *layer_);
    }

    Fault finishMesh() {
        if (!polyline_) return std::nullopt;
        const Mesh mesh = std::move(*polyline_);
        polyline_.reset();
        if (!isWanted(mesh.head)) return std::nullopt;
        builder_.beginSolid(mesh.head.layer);
        return (mesh.head.flags() & kPolyface) != 0 ? addPolyface(mesh) : addPolygonMesh(mesh);
    }

    Fault addPolyface(const Mesh& mesh) {
        for (const Face& face : mesh.faces) {
            std::vector<std::int32_t> corners;
            for (const double number : face.corners) {
                const double index = std::abs(number);
                if (index == 0) continue;
                if (!(index <= static_cast<double>(mesh.places.size())) || index != std::floor(index)) {
                    return fault(face.line, "found the corner " + toml::numberText(number) +
                                                " of a polyface mesh, allowed: 1 to " +
                                                std::to_string(mesh.places.size()) + ", its vertices");
                }
                corners.push_back(mesh.places[static_cast<std::size_t>(index) - 1]);
            }
            if (corners.size() < 3) {
                return fault(face.line, "found a face with " + std::to_string(corners.size()) +
                                            " corners, allowed: three or four");
            }
            if (auto fault = add(corners, face.line)) return fault;
        }
        return std::nullopt;
    }

    Fault addPolygonMesh(const Mesh& mesh) {
        const double rows = mesh.head.number(71), columns = mesh.head.number(72);
        if ((mesh.head.flags() & kSplineFit) != 0)
            return fault(mesh.head.line, "found a smoothed polygon mesh, allowed: one as it was measured");
        if (!(rows >= 2 && columns >= 2) || rows * columns != static_cast<double>(mesh.places.size())) {
            return fault(mesh.head.line, "found a polygon mesh of " + toml::numberText(rows) + " times " +
                                             toml::numberText(columns) + " with " +
                                             std::to_string(mesh.places.size()) +
                                             " vertices, allowed: as many as that, at least 2 times 2");
        }
        const auto m = static_cast<std::size_t>(rows), n = static_cast<std::size_t>(columns);
        const bool round_m = (mesh.head.flags() & kClosedInM) != 0;
        const bool round_n = (mesh.head.flags() & kClosedInN) != 0;
        for (std::size_t i = 0; i + (round_m ? 0 : 1) < m; ++i) {
            for (std::size_t j = 0; j + (round_n ? 0 : 1) < n; ++j) {
                const auto place = [&](std::size_t a, std::size_t b) {
                    return mesh.places[(a % m) * n + b % n];
                };
                builder_.triangle({place(i, j), place(i + 1, j), place(i + 1, j + 1)}, mesh.head.line);
                builder_.triangle({place(i, j), place(i + 1, j + 1), place(i, j + 1)}, mesh.head.line);
            }
        }
        return std::nullopt;
    }

    /// Triangles are often written with a corner twice.
    Fault add(std::vector<std::int32_t> corners, int line) {
        if (corners.size() == 4) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (corners[k] == corners[(k + 1) % 4]) {
                    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(k));
                    break;
                }
            }
        }
        if (builder_.face(corners, line)) return std::nullopt;
        return fault(line, "found a face that is not convex, allowed: convex faces, or triangles");
    }

    Result<FileSurface> finish() {
        if (builder_.empty()) return noFaces();
        if (!left_out_.empty())
            builder_.note("has " + mesh::countedText(left_out_) + " besides its faces, which are left out");
        if (on_other_layers_ > 0) {
            builder_.note("has " + std::to_string(on_other_layers_) +
                          " faces or meshes on other layers than " + toml::quoted(*layer_) +
                          ", which are left out");
        }
        return builder_.finish();
    }

    Error noFaces() const {
        if (!layers_.empty() && layer_) {
            std::string list;
            for (const std::string& layer : layers_) list += (list.empty() ? "" : ", ") + toml::quoted(layer);
            return fault(0, "found no faces on layer " + toml::quoted(*layer_) +
                                ", allowed: a layer that has some: " + list);
        }
        std::set<std::string_view> remedies;
        for (const auto& [type, count] : left_out_)
            if (const auto remedy = mesh::dxfRemedy(type); !remedy.empty()) remedies.insert(remedy);
        std::string advice;
        for (const std::string_view remedy : remedies) advice += "; " + std::string(remedy);
        return fault(0, "found no faces" + (left_out_.empty() ? "" : " but " + mesh::countedText(left_out_)) +
                            ", allowed: 3DFACE, and POLYLINE that is a polyface or polygon mesh" + advice);
    }

    mesh::DxfPairs pairs_;
    const std::optional<std::string>& layer_;
    SurfaceBuilder& builder_;
    bool is_unit_ = false;          ///< the header's variable is $INSUNITS
    std::optional<Mesh> polyline_;  ///< whose vertices are read
    std::map<std::string, std::size_t> left_out_;
    std::set<std::string> layers_;  ///< that have faces
    std::size_t on_other_layers_ = 0;
};

}  // namespace

Result<FileSurface> mesh::readDxf(const std::string& text, const std::optional<std::string>& layer,
                                  SurfaceBuilder builder) {
    if (text.starts_with(kBinary))
        return builder.fault(0, "found a binary DXF file, allowed: DXF as text (ASCII)");
    return DxfReader(text, layer, builder).read();
}

}  // namespace talus::formats
