#pragma once
// Small models drawn at random, as scenario files, instead of chosen ones.

#include <array>
#include <cstdint>
#include <string>

namespace talus::test {

enum class ModelKind : std::uint8_t {
    stack,       ///< equal blocks in columns of equal height
    wet_stack,   ///< with water in a fissure
    columns,     ///< side by side, of any width and height, in one piece or several
    wall,        ///< rows of blocks of any length
    arch,        ///< part of a ring on two abutments
    wedge,       ///< on two planes
    steps,       ///< columns on steps that rise uphill
    rock_slope,  ///< cut by two or three joint sets
};
inline constexpr std::array kModelKinds{ModelKind::stack, ModelKind::wet_stack, ModelKind::columns,
                                        ModelKind::wall,  ModelKind::arch,      ModelKind::wedge,
                                        ModelKind::steps, ModelKind::rock_slope};
const char* nameOf(ModelKind kind);

/// The text of a scenario file; the same for the same kind and seed.
std::string drawnScenario(ModelKind kind, unsigned seed);

}  // namespace talus::test
