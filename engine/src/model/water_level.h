#pragma once
// The level of a water over time.

#include "talus/model.h"

namespace talus {

/// Depth or elevation of a water at a time: linear between the entries of its table, constant beyond [m].
double levelAt(const Water& water, double time);

}  // namespace talus
