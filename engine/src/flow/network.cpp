#include "flow/network.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace talus::flow {
namespace {

/// The normal of the rock face that an edge lies on and that looks most its way; without one, that way.
Vec3 rockNormal(const Network& network, std::size_t triangle, const Vec3& begin, const Vec3& end,
                const Vec3& in_plane) {
    const auto patch = static_cast<std::size_t>(network.patch_of[triangle]);
    Vec3 normal = in_plane;
    double most = 0;
    for (const RockFace& face : network.beside[patch]) {
        const double off = std::max(std::abs(face.normal.dot(begin) - face.offset),
                                    std::abs(face.normal.dot(end) - face.offset));
        const double looks = face.normal.dot(in_plane);
        if (off <= network.same[patch] && looks > most) most = looks, normal = face.normal;
    }
    return normal;
}

}  // namespace

std::vector<OpenEdge> openEdges(const Network& network) {
    struct Begun {
        Side nodes;
        std::size_t triangle, corner;  ///< the corner that it begins at
    };
    std::vector<Begun> sides;
    for (std::size_t t = 0; t < network.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) sides.push_back({network.side(t, k), t, k});
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Begun& a, const Begun& b) { return a.nodes < b.nodes; });
    std::vector<OpenEdge> open;
    for (std::size_t s = 0; s < sides.size(); ++s) {
        const auto same = [&](std::size_t other) { return sides[other].nodes == sides[s].nodes; };
        if ((s > 0 && same(s - 1)) || (s + 1 < sides.size() && same(s + 1))) continue;
        const auto [nodes, t, k] = sides[s];
        const Vec3 &begin = network.corner(t, k), &end = network.corner(t, (k + 1) % 3);
        const Vec3 in_plane = (end - begin).cross(network.patch(t).normal).normalized();
        open.push_back({t, {nodes.first, nodes.second}, rockNormal(network, t, begin, end, in_plane)});
    }
    return open;
}

std::vector<std::int32_t> connectedParts(const Network& network) {
    std::vector<std::int32_t> above(network.nodes.size());
    std::iota(above.begin(), above.end(), 0);
    const auto top = [&](std::int32_t node) {
        const auto up = [&](std::int32_t n) -> std::int32_t& { return above[static_cast<std::size_t>(n)]; };
        while (up(node) != node) node = up(node) = up(up(node));
        return node;
    };
    for (const auto& [a, b, c] : network.triangles)
        for (const std::int32_t other : {b, c}) {
            const auto [low, high] = std::minmax({top(a), top(other)});
            above[static_cast<std::size_t>(high)] = low;
        }
    std::vector<std::int32_t> number(network.nodes.size(), -1);
    std::int32_t count = 0;
    for (std::size_t n = 0; n < number.size(); ++n) {
        std::int32_t& of_top = number[static_cast<std::size_t>(top(static_cast<std::int32_t>(n)))];
        if (of_top < 0) of_top = count++;
        number[n] = of_top;
    }
    return number;
}

}  // namespace talus::flow
