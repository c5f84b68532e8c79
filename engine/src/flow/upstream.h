#pragma once
// Flow through one triangle whose corners conduct differently.
//
// A linear head gives corner i of a full triangle the inflow q_i = sum of c_ij (h_i - h_j), with the
// conductances c of its sides. Water that leaves a corner flows with the relative conductivity of that corner
// (Forsyth, Wu and Pruess 1995, Advances in Water Resources 18, 25):
//
//   no obtuse angle:         i -> j:    k_u c_ij (h_i - h_j)   along each side
//   an obtuse angle at hub:  i -> hub:  k_u q_i                from either other corner
//   u: i where the flow is positive, else the other end
//
// The side opposite to an obtuse angle has c < 0. Along it water would flow towards the higher head; its share
// goes through the hub instead. With c = 0 both forms are the same. With k = 1 each is the full triangle.
//
// Without obtuse angles the derivative of the balances is an M-matrix: heads that balance are unique (Ortega
// and Rheinboldt 1970, Iterative Solution of Nonlinear Equations in Several Variables, 13.5). A mean of k over
// the triangle has no such property: bench/studies/free-surface.md has what came of it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace talus::flow {

using Corners = std::array<double, 3>;

struct TriangleFlow {
    Corners inflow{};                          ///< at each corner [m^3/s]
    std::array<Corners, 3> by_head{};          ///< [corner][of which head] with k as it is [m^2/s]
    std::array<Corners, 3> by_conductivity{};  ///< [corner][of which k] [m^3/s]
};

/// From corner i to j, of a full triangle: sum of c_m (h_m - h_j).
struct Path {
    std::size_t i = 0, j = 0;
    Corners c{};  ///< sums to zero [m^2/s]
};

inline void add(const Path& path, const Corners& heads, const Corners& conductivity, TriangleFlow& to) {
    double full = 0;
    for (std::size_t m = 0; m < 3; ++m) full += path.c[m] * (heads[m] - heads[path.j]);
    const std::size_t upstream = full > 0 ? path.i : path.j;
    for (const auto& [corner, sign] : {std::pair{path.i, 1.0}, std::pair{path.j, -1.0}}) {
        to.inflow[corner] += sign * conductivity[upstream] * full;
        to.by_conductivity[corner][upstream] += sign * full;
        for (std::size_t m = 0; m < 3; ++m)
            to.by_head[corner][m] += sign * conductivity[upstream] * path.c[m];
    }
}

inline Path along(std::size_t i, std::size_t j, double conductance) {
    Path path{i, j, {}};
    path.c[i] = conductance;
    path.c[j] = -conductance;
    return path;
}

/// \param conductance   of the sides between corners 0-1, 1-2, 2-0 [m^2/s]
/// \param conductivity  k, relative, at the corners
inline TriangleFlow triangleFlow(const Corners& conductance, const Corners& heads,
                                 const Corners& conductivity) {
    const auto least = std::ranges::min_element(conductance) - conductance.begin();
    const auto a = static_cast<std::size_t>(least), b = (a + 1) % 3, hub = (a + 2) % 3;
    const Path between = along(a, b, conductance[a]);
    Path of_a = along(a, hub, conductance[hub]), of_b = along(b, hub, conductance[b]);
    const bool is_obtuse = conductance[a] < 0;
    for (std::size_t m = 0; is_obtuse && m < 3; ++m) of_a.c[m] += between.c[m], of_b.c[m] -= between.c[m];
    TriangleFlow flow;
    if (!is_obtuse) add(between, heads, conductivity, flow);
    add(of_a, heads, conductivity, flow);
    add(of_b, heads, conductivity, flow);
    return flow;
}

}  // namespace talus::flow
