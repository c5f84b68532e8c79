#include "limit_analysis/section.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

namespace talus::limit {
namespace {

constexpr double kPlaceRounding = 1e-7;  // of the length scale: places that are the same but for rounding
constexpr double kEqual = 1e-9;          // of a weight

/// A place as a whole number; the offset keeps places on a round grid off the border between two numbers.
std::int64_t cellOf(double place, double width) { return std::llround(place / width + 0.381966); }

/// Which body of the section, and which slice, each body is.
struct Slices {
    std::vector<std::int32_t> group, slice;
    std::vector<double> plane;  ///< y of each slice [m]
    std::int32_t groups = 0;
};

std::optional<Slices> slicesOf(const Assembly& assembly, double same) {
    Slices slices;
    const double width = 1e3 * same;
    std::map<std::pair<std::int64_t, std::int64_t>, std::int32_t> groups;
    std::map<std::int64_t, std::int32_t> planes;
    for (const Body& body : assembly.bodies) {
        const Vec3& c = body.centroid;
        const auto group = static_cast<std::int32_t>(groups.size());
        slices.group.push_back(
            groups.try_emplace({cellOf(c.x(), width), cellOf(c.z(), width)}, group).first->second);
        const auto plane = planes.try_emplace(cellOf(c.y(), width), planes.size());
        if (plane.second) slices.plane.push_back(c.y());
        slices.slice.push_back(plane.first->second);
    }
    slices.groups = static_cast<std::int32_t>(groups.size());
    if (groups.size() * planes.size() != assembly.bodies.size()) return std::nullopt;
    return slices;
}

/// Body `group` of the first slice; the same weight, place and water in every slice.
bool bodiesEqual(const Assembly& assembly, const Slices& slices, const Loads& water, double same) {
    std::vector<std::size_t> first(static_cast<std::size_t>(slices.groups), assembly.bodies.size());
    for (std::size_t b = 0; b < assembly.bodies.size(); ++b) {
        std::size_t& model = first[static_cast<std::size_t>(slices.group[b])];
        if (slices.slice[b] == 0) model = b;
    }
    for (std::size_t b = 0; b < assembly.bodies.size(); ++b) {
        const std::size_t k = first[static_cast<std::size_t>(slices.group[b])];
        if (k == assembly.bodies.size()) return false;
        const Body &body = assembly.bodies[b], &model = assembly.bodies[k];
        Vec3 apart = body.centroid - model.centroid;
        apart.y() -= slices.plane[static_cast<std::size_t>(slices.slice[b])] - slices.plane[0];
        const double weight = kEqual * model.weight;
        const Vec3 force = water[b].force - water[k].force;
        if (apart.norm() > same || std::abs(body.weight - model.weight) > weight || force.norm() > weight ||
            std::abs(water[b].torque.y() - water[k].torque.y()) > weight * model.radius ||
            std::abs(water[b].force.y()) > weight ||
            std::hypot(water[b].torque.x(), water[b].torque.z()) > weight * model.radius)
            return false;
    }
    return true;
}

/// Points of one slice between two bodies of the section.
using Interface = std::tuple<std::int32_t, std::int32_t, std::int32_t>;  // groups (or kFixed), joint
using Points = std::map<Interface, std::vector<ContactPoint>>;

/// The points of each slice; nothing where one does not lie in a slice or has a slope across it.
std::optional<std::vector<Points>> pointsBySlice(const Assembly& assembly, const Slices& slices) {
    std::vector<Points> result(slices.plane.size());
    const auto groupOf = [&](std::int32_t body) {
        return body == kFixed ? kFixed : slices.group[static_cast<std::size_t>(body)];
    };
    for (const ContactPoint& point : assembly.points) {
        const bool both = point.body_a != kFixed && point.body_b != kFixed;
        const std::int32_t group_a = groupOf(point.body_a), group_b = groupOf(point.body_b);
        const double across = std::abs(point.axes(1, 2));
        if (across > 1 - kPlaceRounding && both && group_a == group_b) continue;  // between two slices
        const auto slice = static_cast<std::size_t>(
            slices.slice[static_cast<std::size_t>(point.body_a == kFixed ? point.body_b : point.body_a)]);
        const bool within = !both || slices.slice[static_cast<std::size_t>(point.body_a)] ==
                                         slices.slice[static_cast<std::size_t>(point.body_b)];
        if (across > kPlaceRounding || !within) return std::nullopt;
        result[slice][{group_a, group_b, point.joint}].push_back(point);
    }
    return result;
}

/// Whether `points` has one like this at `place`.
bool holds(const std::vector<ContactPoint>& points, const ContactPoint& like, const Vec3& place,
           double same) {
    return std::any_of(points.begin(), points.end(), [&](const ContactPoint& point) {
        return (point.place - place).norm() <= same &&
               (point.axes.col(2) - like.axes.col(2)).norm() <= kPlaceRounding &&
               std::abs(point.area - like.area) <= 1e-6 * like.area;
    });
}

/// Whether the points of a slice are their own mirror image, and those of the first slice.
bool pointsEqual(const Points& points, double plane, const Points& first, double first_plane, double same) {
    if (points.size() != first.size()) return false;
    for (const auto& [interface, of_interface] : points) {
        const auto model = first.find(interface);
        if (model == first.end() || model->second.size() != of_interface.size()) return false;
        for (const ContactPoint& point : of_interface) {
            const Vec3& p = point.place;
            if (!holds(of_interface, point, {p.x(), 2 * plane - p.y(), p.z()}, same) ||
                !holds(model->second, point, {p.x(), p.y() - plane + first_plane, p.z()}, same))
                return false;
        }
    }
    return true;
}

/// The section: each body and each pair of mirrored points with the weight and area of all slices.
Assembly folded(const Assembly& assembly, const Slices& slices, const Points& points, double same) {
    const auto count = static_cast<double>(slices.plane.size());
    Assembly section;
    section.plane_section = true;
    section.bodies.resize(static_cast<std::size_t>(slices.groups));
    for (std::size_t b = 0; b < assembly.bodies.size(); ++b) {
        if (slices.slice[b] != 0) continue;
        Body& body = section.bodies[static_cast<std::size_t>(slices.group[b])];
        body = assembly.bodies[b];
        body.weight *= count;
    }
    for (const std::int32_t body : assembly.body_of_block)
        section.body_of_block.push_back(body < 0 ? body : slices.group[static_cast<std::size_t>(body)]);
    for (const auto& [interface, of_interface] : points)
        for (ContactPoint point : of_interface) {
            const double aside = point.place.y() - slices.plane[0];
            if (aside < -same) continue;
            point.area *= aside > same ? 2 * count : count;
            point.place.y() = slices.plane[0];
            std::tie(point.body_a, point.body_b, std::ignore) = interface;
            section.points.push_back(point);
        }
    return section;
}

}  // namespace

Assembly foldToSection(Assembly assembly, const Loads& water, double length_scale) {
    const double same = kPlaceRounding * length_scale;
    if (assembly.bodies.empty()) return assembly;
    const std::optional<Slices> slices = slicesOf(assembly, same);
    if (!slices || !bodiesEqual(assembly, *slices, water, same)) return assembly;
    const auto points = pointsBySlice(assembly, *slices);
    if (!points) return assembly;
    for (std::size_t k = 0; k < points->size(); ++k)
        if (!pointsEqual((*points)[k], slices->plane[k], points->front(), slices->plane[0], same))
            return assembly;
    return folded(assembly, *slices, points->front(), same);
}

}  // namespace talus::limit
