#pragma once
// A model checked before anything moves: what needs geometry, and which blocks touch.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "talus/control.h"
#include "talus/model.h"
#include "talus/result.h"

namespace talus {

/// A model as built, before anything moves.
struct ModelCheck {
    std::vector<std::string> warnings;  ///< allowed, but probably not intended
    std::size_t interfaces = 0;         ///< of faces, edges or vertices that touch
    std::size_t contact_points = 0;     ///< of these
    std::size_t idle_interfaces = 0;    ///< places kept where vertices and edges may meet before the next
                                        ///< search
};

/// Checks what needs geometry: blocks that overlap, water on faces that are not there, pairs that do not
/// touch. Empty when the model can be built. \param found  if given, takes what was found on the way
std::vector<Error> checkModel(const Model& model, const Control& control = {}, ModelCheck* found = nullptr);

/// Two blocks that share at least one interface at the start, and the joint between them.
struct TouchingPair {
    std::int32_t block_a = 0, block_b = 0;  ///< a < b
    std::int32_t joint = 0;                 ///< of the first interface they share
};

/// All pairs that touch, in the order of their blocks. Errors: as of checkModel.
Result<std::vector<TouchingPair>> touchingPairs(const Model& model);

}  // namespace talus
