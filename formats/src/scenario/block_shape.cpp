#include "scenario/block_shape.h"

#include "scenario/places.h"
#include "talus/formats/mesh.h"
#include "talus/formats/scenario.h"
#include "talus/rock_mass.h"

namespace talus::formats::scenario {

namespace {

// Keeps the hull of a hostile list of points from taking minutes; real blocks have tens of vertices.
constexpr std::size_t kMaxVertices = 1000;
constexpr std::size_t kMaxParts = 1000;

using Shape = std::optional<Polyhedron>;

/// Faults of a mesh file are told at the key that names it, with their own place in front.
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

Shape readMesh(Report& report, TableReader& table, const std::string& folder) {
    MeshOptions options;
    options.scale = table.number("scale", kPositive).value_or(1);
    const auto file = table.text("mesh");
    if (!file) return std::nullopt;
    const auto mesh = take(
        table, "mesh", talus::formats::readMesh(file->starts_with('/') ? *file : folder + *file, options));
    if (!mesh) return std::nullopt;
    for (const std::string& note : mesh->notes) report.warn(table.fieldOf("mesh") + ": " + note);
    return take(table, "mesh", solidOf(mesh->surface));
}

}  // namespace

std::optional<Polyhedron> readShape(Report& report, TableReader& table, const std::string& folder) {
    static const std::vector<std::string> kKeys{"box", "vertices", "parts", "mesh"};
    const std::vector<std::string> given = table.present(kKeys);
    if (table.has("scale") && !table.has("mesh"))
        table.error("scale", "found scale without mesh, allowed: only together with a mesh");
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

}  // namespace talus::formats::scenario
