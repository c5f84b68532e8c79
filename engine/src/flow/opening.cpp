#include "flow/opening.h"

namespace talus::flow {
namespace {

/// How a block has moved since the model was built.
struct Displacement {
    Vec3 from, to;  ///< its centroid, then and now [m]
    Mat3 turn;

    Displacement(const State& state, std::int32_t block) {
        const auto b = static_cast<std::size_t>(block);
        from = state.geometry->initial_position.get(b);
        to = state.blocks.position.get(b);
        turn = state.blocks.orientation.matrix(b) * state.geometry->initial_orientation.matrix(b).transpose();
    }
    Vec3 at(const Vec3& x) const { return (to - from) + (turn * (x - from) - (x - from)); }
};

}  // namespace

std::vector<double> openings(const State& state, const Network& network) {
    std::vector<double> opened;
    opened.reserve(kPlaces * network.triangles.size());
    for (std::size_t t = 0; t < network.triangles.size(); ++t) {
        const Patch& patch = network.patch(t);
        const Displacement a(state, patch.block_a), b(state, patch.block_b);
        const Vec3 normal = a.turn * patch.normal;
        const std::array<Vec3, 3> x{network.corner(t, 0), network.corner(t, 1), network.corner(t, 2)};
        for (const Vec3& place : {Vec3((x[0] + x[1] + x[2]) / 3), x[0], x[1], x[2]})
            opened.push_back(normal.dot(b.at(place) - a.at(place)));
    }
    return opened;
}

}  // namespace talus::flow
