#pragma once
// Values of a model over time.

#include <vector>

#include "talus/model.h"

namespace talus {

/// The value of a table over time: linear between its entries, constant beyond. \pre there are some
double valueAt(const std::vector<LevelPoint>& table, double time);

/// The integral of that from one time to a later one, exact. \pre as of valueAt
double integralOver(const std::vector<LevelPoint>& table, double from, double to);

/// Depth or elevation of a water [m]; 0 where it has none.
double levelAt(const Water& water, double time);

/// Factor of a load's force or pressure; 1 by default.
double factorAt(const AppliedLoad& load, double time);

/// frictionAngle of a joint with its strength at a time [rad].
double frictionAngleAt(const Joint& joint, double time);

/// strengthAt of each joint.
std::vector<Joint> strengthsAt(std::vector<Joint> joints, double time);

}  // namespace talus
