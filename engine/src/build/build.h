#pragma once
// From the description of a slope to the state that moves.

#include <memory>

#include "state/arrays.h"
#include "talus/analysis.h"
#include "talus/result.h"

namespace talus {

/// Blocks, their shapes and inertia, the first search for interfaces, contact points, wet walls. The state is
/// unstressed and without velocity, with the model's own tilt and damping and full loads. Errors (fields of
/// the model): shapes without volume, blocks that overlap, pairs that do not touch, water without a wall, two
/// waters on one place, `grid N` on patches that are not rectangles; an interruption.
Result<State> buildState(std::shared_ptr<const Model> description, bool parallel,
                         const Control& control = {});
Result<State> buildState(Model model, bool parallel, const Control& control = {});

/// For a model that the caller keeps as long as the state lives: a copy takes 400 MB for a million blocks.
std::shared_ptr<const Model> keptByCaller(const Model& model);

}  // namespace talus
