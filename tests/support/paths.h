#pragma once
// Equilibrium paths of small models.

#include <doctest/doctest.h>

#include <utility>

#include "build/build.h"
#include "equilibrium/release.h"
#include "search/load_axis.h"
#include "support/models.h"

namespace talus::test {

/// As built, with nothing acting on it yet.
inline State unloaded(const Model& model) {
    State state = *buildState(model, false);
    state.load.gravity_share = state.load.water_share = 0;
    state.searches_around = true;
    return state;
}

/// An assembly in equilibrium under its weight, at the tilt and with the strength of its model, and the load
/// that is varied from there.
struct LoadedPath {
    using MakeAxis = search::LoadAxis (*)(const Model&, const SearchRules&);

    Model model;
    SearchRules rules{};
    search::LoadAxis weight, axis;
    equilibrium::EquilibriumPath path;

    explicit LoadedPath(Model given, MakeAxis make_axis = search::tiltAxis, SearchRules own_rules = {})
        : model(std::move(given)),
          rules(own_rules),
          weight(search::weightAxis(1e-4)),
          axis(make_axis(model, rules)),
          path(unloaded(model), rules, false, nullptr) {
        path.vary(weight.loading, 0);
        REQUIRE((equilibrium::release(path, 1, path.parting(), 0.1) == equilibrium::Released::rests));
        path.vary(axis.loading, axis.start);
    }
};

}  // namespace talus::test
