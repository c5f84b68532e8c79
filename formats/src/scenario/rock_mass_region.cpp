#include <algorithm>

#include "scenario/mending.h"
#include "scenario/rock_mass.h"
#include "talus/formats/mesh.h"
#include "talus/formats/scenario.h"

namespace talus::formats::scenario {

namespace {

constexpr std::size_t kMaxProfile = 1000;
constexpr Interval kAzimuthDeg{-360, 360, false, false};
using Surface = std::optional<TriangleSurface>;

/// Faults of a mesh file are reported at the key that names it, with their own place in front.
Surface take(TableReader& region, const std::string& key, Result<TriangleSurface> surface) {
    if (surface) return std::move(*surface);
    for (Error error : surface.errors()) {
        error.field.clear();
        region.error(key, error.file.empty() ? error.message : format(error));
    }
    return std::nullopt;
}

Surface readBox(TableReader& region) {
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

/// Height of the ground at either end of a profile, at its least and its greatest x.
std::pair<double, double> endsOf(const std::vector<Eigen::Vector2d>& profile) {
    const auto ground = [&](double x) {
        double highest = -kMaxLength;
        for (const auto& point : profile)
            if (point.x() == x) highest = std::max(highest, point.y());
        return highest;
    };
    const auto [least, greatest] = std::minmax_element(
        profile.begin(), profile.end(), [](const auto& a, const auto& b) { return a.x() < b.x(); });
    return {ground(least->x()), ground(greatest->x())};
}

/// `slope_azimuth_deg`: which way the side of the lower end looks.
SlopeTurn readTurn(TableReader& region, const std::vector<Eigen::Vector2d>& profile) {
    const auto azimuth = region.number("slope_azimuth_deg", kAzimuthDeg);
    if (!azimuth || profile.empty()) return {};
    const auto [at_least_x, at_greatest_x] = endsOf(profile);
    if (at_least_x == at_greatest_x) {
        region.error("slope_azimuth_deg",
                     "found a profile whose ground is as high at its least as at its greatest x (" +
                         numberText(at_least_x) +
                         " m), allowed: one with a lower end, which the slope faces");
    }
    return {*azimuth, at_greatest_x < at_least_x};
}

Surface readProfile(Report& report, TableReader& region, SlopeTurn& turn) {
    region.require({"y"});
    const auto y = region.numbers("y", kCoordinate, 2);
    const auto points = readPoints(report, region);
    turn = readTurn(region, points.value_or(std::vector<Eigen::Vector2d>{}));
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

const std::vector<std::pair<std::string, MeshFormat>> kMeshKeys{
    {"mesh", MeshFormat::by_name}, {"stl", MeshFormat::stl}, {"obj", MeshFormat::obj},
    {"ply", MeshFormat::ply},      {"asc", MeshFormat::asc}, {"dxf", MeshFormat::dxf},
    {"xyz", MeshFormat::xyz}};
/// Keys that say what to make of a mesh.
const std::vector<std::string> kMeshOptions{"scale",  "shift",        "base",  "tolerance", "simplify",
                                            "repair", "largest_hole", "layer", "cell_m",    "cell_height"};

Surface readMeshFile(Report& report, TableReader& region, const std::string& key, MeshFormat kind,
                     const std::string& folder) {
    MeshOptions options;
    options.format = kind;
    options.farthest = kMaxLength;
    options.scale = region.number("scale", kPositive).value_or(1);
    options.shift = region.vector("shift", kAnyNumber);
    options.base = region.number("base", kCoordinate);
    options.tolerance = region.number("tolerance", kLength);
    options.simplify = region.number("simplify", kLength);
    readMending(region, options);
    options.layer = region.text("layer");
    options.cell = region.number("cell_m", kSize);
    if (const auto height = region.choice("cell_height", {"mean", "median"})) options.median = *height == 1;
    const auto file = region.text(key);
    if (!file || (region.has("cell_m") && !options.cell)) return std::nullopt;
    auto mesh = readMesh(file->starts_with('/') ? *file : folder + *file, options);
    if (!mesh) {
        for (Error error : mesh.errors()) {
            const std::string at = error.field.empty() ? key : error.field;
            error.field.clear();
            region.error(at, error.file.empty() ? error.message : format(error));
        }
        return std::nullopt;
    }
    for (std::string& note : mesh->notes) report.warn(region.fieldOf(key) + ": " + std::move(note));
    if (isWithinRange(mesh->surface)) return std::move(mesh->surface);
    region.error(key, "found coordinates beyond " + numberText(kMaxLength) +
                          " m, allowed: at most that; another scale or shift");
    return std::nullopt;
}

}  // namespace

std::optional<Region> readRegion(Report& report, TableReader& table, const std::string& folder) {
    std::vector<std::string> shapes{"box", "profile"}, keys{"box", "profile", "y", "slope_azimuth_deg"};
    for (const auto& [key, kind] : kMeshKeys) shapes.push_back(key), keys.push_back(key);
    keys.insert(keys.end(), kMeshOptions.begin(), kMeshOptions.end());
    auto region = table.table("region", keys);
    if (!region || !region->requireOneOf(shapes)) return std::nullopt;
    for (const std::string key : {"y", "slope_azimuth_deg"}) {
        if (region->has(key) && !region->has("profile"))
            region->error(key, "found " + key + " without profile, allowed: only together with profile");
    }
    if (region->has("box") || region->has("profile"))
        for (const std::string& key : region->present(kMeshOptions))
            region->error(key, "found " + key + " without a mesh, allowed: only together with a mesh");
    const auto made = [](Surface surface, bool is_mesh, const SlopeTurn& turn = {}) {
        return surface ? std::optional(Region{std::move(*surface), is_mesh, turn}) : std::nullopt;
    };
    if (region->has("box")) return made(readBox(*region), false);
    if (region->has("profile")) {
        SlopeTurn turn;
        auto surface = readProfile(report, *region, turn);
        return made(std::move(surface), false, turn);
    }
    for (const auto& [key, kind] : kMeshKeys)
        if (region->has(key)) return made(readMeshFile(report, *region, key, kind, folder), true);
    return std::nullopt;
}

}  // namespace talus::formats::scenario
