#pragma once
// The water of a model at the start, as outlines for pictures.

#include <vector>

#include "talus/model.h"

namespace talus::tools {

/// The wet parts of the walls of fissures, in the model frame [m]. Water between two heads has no table, so
/// none is drawn.
std::vector<std::vector<Vec3>> wetOutlines(const Model& model);

/// The water table of a slope as lines along both of its ends and along its points.
std::vector<std::vector<Vec3>> waterTable(const Model& model);

}  // namespace talus::tools
