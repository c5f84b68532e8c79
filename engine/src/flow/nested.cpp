#include "flow/nested.h"

#include <utility>

#include "flow/cubic_law.h"

namespace talus::flow {
namespace {

template <class T>
std::vector<T> first(const std::vector<T>& of, std::size_t count) {
    return {of.begin(), of.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// Of the triangle whose four parts begin with this one: each of the first three has one of its corners.
template <class T>
std::array<T, 3> cornersOfWhole(const std::vector<std::array<T, 3>>& parts, std::size_t begin) {
    return {parts[begin][0], parts[begin + 1][1], parts[begin + 2][2]};
}

std::vector<Corners> coarser(const std::vector<Corners>& aperture) {
    std::vector<Corners> coarse;
    for (std::size_t t = 0; t < aperture.size(); t += 4) coarse.push_back(cornersOfWhole(aperture, t));
    return coarse;
}

Conditions firstOf(const Conditions& conditions, std::size_t nodes) {
    return {first(conditions.of, nodes), first(conditions.boundary, nodes),
            first(conditions.elevation, nodes), first(conditions.head, nodes)};
}

/// Heads are linear along each side.
std::vector<double> withMiddles(std::vector<double> head, const std::vector<Side>& halved) {
    for (const auto& [a, b] : halved)
        head.push_back(0.5 * (head[static_cast<std::size_t>(a)] + head[static_cast<std::size_t>(b)]));
    return head;
}

}  // namespace

Network coarser(const Network& network) {
    const std::vector<Side>& halved = network.halved.back();
    Network coarse;
    coarse.nodes = first(network.nodes, network.nodes.size() - halved.size());
    coarse.patches = network.patches;
    coarse.beside = network.beside;
    coarse.same = network.same;
    coarse.halved = first(network.halved, network.halved.size() - 1);
    coarse.size = network.size;
    coarse.height = network.height;
    for (std::size_t t = 0; t < network.triangles.size(); t += 4) {
        coarse.triangles.push_back(cornersOfWhole(network.triangles, t));
        coarse.patch_of.push_back(network.patch_of[t]);
    }
    return coarse;
}

std::vector<Corners> transmissivities(const std::vector<Corners>& aperture, const Flow& flow,
                                      double unit_weight) {
    std::vector<Corners> along;
    const auto alongSide = [&](double from, double to) {
        return taperedTransmissivity(unit_weight, from, to, flow.viscosity);
    };
    along.reserve(aperture.size());
    for (const Corners& b : aperture)
        along.push_back({alongSide(b[0], b[1]), alongSide(b[1], b[2]), alongSide(b[2], b[0])});
    return along;
}

Heads nestedHeads(const Network& network, const Conditions& conditions, const std::vector<Corners>& aperture,
                  const Flow& flow, double unit_weight, const Telling& telling) {
    std::vector<double> begin;
    int iterations = 0;
    if (!network.halved.empty()) {
        const Network coarse = coarser(network);
        Heads heads = nestedHeads(coarse, firstOf(conditions, coarse.nodes.size()), coarser(aperture), flow,
                                  unit_weight, telling);
        iterations = heads.iterations;
        if (heads.found) begin = withMiddles(std::move(heads.head), network.halved.back());
    }
    Heads heads = solveHeads(network, conditions, transmissivities(aperture, flow, unit_weight),
                             flow.free_surface, {}, telling, begin);
    heads.iterations += iterations;
    return heads;
}

}  // namespace talus::flow
