#pragma once
// The kernel's source.

#include "equilibrium/elimination_view.h"
#include "equilibrium/six_lanes.h"

namespace talus::equilibrium {
namespace {

/// Takes the products of all columns' blocks of two numbers, below and beside.
TALUS_KERNEL void takeProducts(const EliminationView& view, std::size_t lower, std::size_t upper,
                               double* from) {
    Columns c = loadBlock(from);
    for (std::size_t a = 0; a < view.column_count; ++a)
        takeProduct(loadBlock(view.columns[a].lower + kBlock * lower), view.columns[a].upper + kBlock * upper,
                    c);
    storeBlock(from, c);
}

void eliminate(const EliminationView& view) {
    for (std::size_t p = 0; p < view.count; ++p) {
        for (std::size_t t = 0; t < view.target_count && t < p; ++t) {
            const std::size_t at = kBlock * static_cast<std::size_t>(view.place[p]);
            takeProducts(view, p, t, view.targets[t].lower + at);
            takeProducts(view, t, p, view.targets[t].upper + at);
        }
        if (p < view.target_count) takeProducts(view, p, p, view.targets[p].diagonal);
    }
}

}  // namespace
}  // namespace talus::equilibrium
