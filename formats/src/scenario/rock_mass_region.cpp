#include "scenario/rock_mass.h"
#include "talus/formats/mesh.h"
#include "talus/formats/scenario.h"

namespace talus::formats::scenario {

namespace {

constexpr std::size_t kMaxProfile = 1000;
using Region = std::optional<TriangleSurface>;

/// Faults of a mesh file are told at the key that names it, with their own place in front.
Region take(TableReader& region, const std::string& key, Result<TriangleSurface> surface) {
    if (surface) return std::move(*surface);
    for (Error error : surface.errors()) {
        error.field.clear();
        region.error(key, error.file.empty() ? error.message : format(error));
    }
    return std::nullopt;
}

Region readBox(TableReader& region) {
    auto box = region.table("box", {"min", "max"});
    if (!box) return std::nullopt;
    box->require({"min", "max"});
    const auto min = box->vector("min", kCoordinate), max = box->vector("max", kCoordinate);
    return min && max ? take(region, "box", boxSurface(*min, *max)) : std::nullopt;
}

std::optional<std::vector<Eigen::Vector2d>> readPoints(Report& report, TableReader& region) {
    const auto array = region.array("profile");
    if (!array) return std::nullopt;
    if (array->size() > kMaxProfile) {
        region.error("profile", "found " + std::to_string(array->size()) + " points, allowed: at most " +
                                    std::to_string(kMaxProfile));
        return std::nullopt;
    }
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = 0; i < array->size(); ++i) {
        const std::string field = elementField(region.fieldOf("profile"), i);
        report.mark(field, array->at(i).place());
        if (const auto point = readNumbers(report, array->at(i), field, kCoordinate, 2))
            points.emplace_back((*point)[0], (*point)[1]);
    }
    if (points.size() < array->size()) return std::nullopt;
    return points;
}

Region readProfile(Report& report, TableReader& region) {
    region.require({"y"});
    const auto y = region.numbers("y", kCoordinate, 2);
    const auto points = readPoints(report, region);
    if (!points || !y) return std::nullopt;
    const auto surface = extrudeProfile(*points, (*y)[0], (*y)[1]);
    if (surface) return *surface;
    for (const Error& error : surface.errors()) {
        const std::string field =
            error.field == "y" ? region.fieldOf("y") : region.fieldOf("profile") + error.field;
        report.add(report.placeOf(field).value_or(region.place()), field, error.message);
    }
    return std::nullopt;
}

bool isWithinRange(const TriangleSurface& surface) {
    for (const Vec3& v : surface.vertices)
        if (!(v.cwiseAbs().maxCoeff() <= kMaxLength)) return false;
    return true;
}

Region readMesh(TableReader& region, const std::string& key, const std::string& folder) {
    const double scale = region.number("scale", kPositive).value_or(1);
    const auto file = region.text(key);
    if (!file) return std::nullopt;
    const std::string path = file->starts_with('/') ? *file : folder + *file;
    Region surface = take(region, key, key == "stl" ? readStl(path, scale) : readObj(path, scale));
    if (!surface || isWithinRange(*surface)) return surface;
    region.error(key, "found coordinates beyond " + numberText(kMaxLength) +
                          " m, allowed: at most that; another scale, or an origin nearer by");
    return std::nullopt;
}

}  // namespace

std::optional<TriangleSurface> readRegion(Report& report, TableReader& table, const std::string& folder) {
    auto region = table.table("region", {"box", "profile", "y", "stl", "obj", "scale"});
    if (!region || !region->requireOneOf({"box", "profile", "stl", "obj"})) return std::nullopt;
    const bool is_mesh = region->has("stl") || region->has("obj");
    if (region->has("y") && !region->has("profile"))
        region->error("y", "found y without profile, allowed: only together with profile");
    if (region->has("scale") && !is_mesh)
        region->error("scale", "found scale without stl or obj, allowed: only together with a mesh");
    if (region->has("box")) return readBox(*region);
    if (region->has("profile")) return readProfile(report, *region);
    return readMesh(*region, region->has("stl") ? "stl" : "obj", folder);
}

}  // namespace talus::formats::scenario
