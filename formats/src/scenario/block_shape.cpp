#include "scenario/block_shape.h"

#include <algorithm>

#include "scenario/mending.h"
#include "scenario/places.h"
#include "talus/formats/mesh.h"
#include "talus/formats/scenario.h"
#include "talus/rock_mass.h"

namespace talus::formats::scenario {

namespace {

// Limits the time of a hull to seconds; real blocks have tens of vertices.
constexpr std::size_t kMaxVertices = 1000;
constexpr std::size_t kMaxParts = 1000;
constexpr std::size_t kMaxSolidName = 60;  // bytes

using Shape = std::optional<Polyhedron>;

/// Faults of a mesh file are reported at the key that names it, with their own place in front.
template <class T>
std::optional<T> take(TableReader& table, std::string_view key, Result<T> made) {
    if (made) return std::move(*made);
    for (Error error : made.errors()) {
        error.field.clear();
        table.error(key, error.file.empty() ? error.message : format(error));
    }
    return std::nullopt;
}

Shape readBox(TableReader& table) {
    const auto box = readCorners(table, "box");
    return box ? take(table, "box", makeBox(box->min, box->max)) : std::nullopt;
}

Shape readHull(Report& report, TableReader& table) {
    const auto array = table.array("vertices");
    if (!array) return std::nullopt;
    if (array->size() < 4 || array->size() > kMaxVertices) {
        table.error("vertices", "found " + std::to_string(array->size()) + " points, allowed: 4 to " +
                                    std::to_string(kMaxVertices));
        return std::nullopt;
    }
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < array->size(); ++i)
        if (const auto point =
                readVector(report, array->at(i), elementField(table.fieldOf("vertices"), i), kCoordinate))
            points.push_back(*point);
    return points.size() == array->size() ? take(table, "vertices", convexHull(points)) : std::nullopt;
}

Shape readConvex(Report& report, const FieldNode& entry) {
    TableReader part(report, entry.node, entry.field, {"box", "vertices"});
    if (!part.requireOneOf({"box", "vertices"})) return std::nullopt;
    return part.has("box") ? readBox(part) : readHull(report, part);
}

Shape readParts(Report& report, TableReader& table) {
    const std::vector<FieldNode> entries = table.tables("parts");
    if (entries.empty() || entries.size() > kMaxParts) {
        if (table.array("parts"))
            table.error("parts", "found " + std::to_string(entries.size()) + " parts, allowed: 1 to " +
                                     std::to_string(kMaxParts));
        return std::nullopt;
    }
    std::vector<Polyhedron> parts;
    for (const FieldNode& entry : entries)
        if (auto part = readConvex(report, entry)) parts.push_back(std::move(*part));
    if (parts.size() < entries.size()) return std::nullopt;
    auto body = joinParts(parts);
    if (body) return std::move(*body);
    for (const Error& error : body.errors()) {
        const std::string field = table.fieldOf("parts") + error.field;
        report.add(report.placeOf(field).value_or(table.placeOf("parts")), field, error.message);
    }
    return std::nullopt;
}

const std::vector<std::string> kMeshOptions{"scale", "tolerance", "repair", "largest_hole", "layer"};

MeshOptions readOptions(TableReader& table) {
    MeshOptions options;
    options.scale = table.number("scale", kPositive).value_or(1);
    options.tolerance = table.number("tolerance", kLength);
    readMending(table, options);
    options.layer = table.text("layer");
    return options;
}

std::string pathOf(const std::string& file, const std::string& folder) {
    return file.starts_with('/') ? file : folder + file;
}

void warn(Report& report, TableReader& table, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) report.warn(table.fieldOf("mesh") + ": " + note);
}

Shape readMesh(Report& report, TableReader& table, const std::string& folder) {
    const MeshOptions options = readOptions(table);
    const auto file = table.text("mesh");
    if (!file) return std::nullopt;
    const auto mesh = take(table, "mesh", talus::formats::readMesh(pathOf(*file, folder), options));
    if (!mesh) return std::nullopt;
    warn(report, table, mesh->notes);
    return take(table, "mesh", solidOf(mesh->surface));
}

/// Options of a mesh stand only beside one.
void checkOptions(TableReader& table) {
    if (table.has("mesh")) return;
    for (const std::string& key : table.present(kMeshOptions))
        table.error(key, "found " + key + " without mesh, allowed: only together with a mesh");
}

}  // namespace

std::optional<Polyhedron> readShape(Report& report, TableReader& table, const std::string& folder) {
    static const std::vector<std::string> kKeys{"box", "vertices", "parts", "mesh"};
    const std::vector<std::string> given = table.present(kKeys);
    checkOptions(table);
    if (given.size() > 1) {
        table.error(given[1], "found both " + given[0] + " and " + given[1] + ", allowed: one of them");
        return std::nullopt;
    }
    if (given.empty()) {
        for (const std::string& key : kKeys)
            if (table.isMeant(key)) return std::nullopt;
        table.error("box", "missing; a block needs box = { min, max }, vertices, parts or mesh");
        return std::nullopt;
    }
    if (given[0] == "box") return readBox(table);
    if (given[0] == "vertices") return readHull(report, table);
    return given[0] == "parts" ? readParts(report, table) : readMesh(report, table, folder);
}

namespace {

/// Names of blocks are short and print everywhere.
bool isFitName(std::string_view name) {
    return !name.empty() && name.size() <= kMaxSolidName &&
           std::all_of(name.begin(), name.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

std::vector<NamedShape> readSolidShapes(Report& report, TableReader& table, const std::string& folder) {
    for (const char* key : {"box", "vertices", "parts"}) {
        if (table.has(key)) {
            table.error(key, "found " + std::string(key) +
                                 " beside each_solid, allowed: each_solid only together with a mesh");
        }
    }
    checkOptions(table);
    const MeshOptions options = readOptions(table);
    const auto file = table.text("mesh");
    if (!file) {
        if (!table.isMeant("mesh")) table.require({"mesh"});
        return {};
    }
    auto solids = take(table, "mesh", readSolids(pathOf(*file, folder), options));
    if (!solids) return {};
    warn(report, table, solids->notes);
    std::vector<NamedShape> shapes;
    for (const MeshSolids::Solid& solid : solids->solids) {
        const std::string name = isFitName(solid.name) ? solid.name : std::to_string(shapes.size() + 1);
        auto shape = solidOf(solid.surface);
        if (shape) {
            shapes.push_back({name, std::move(*shape)});
            continue;
        }
        for (const Error& error : shape.errors())
            table.error("mesh", "solid " + quoted(name) + ": " + error.message);
    }
    return shapes;
}

const std::vector<std::string>& shapeKeys() {
    static const std::vector<std::string> kKeys = [] {
        std::vector<std::string> keys{"box", "vertices", "parts", "mesh", "each_solid"};
        keys.insert(keys.end(), kMeshOptions.begin(), kMeshOptions.end());
        return keys;
    }();
    return kKeys;
}

}  // namespace talus::formats::scenario
