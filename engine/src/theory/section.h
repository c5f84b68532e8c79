#pragma once
// The two-dimensional section of a model for the closed formulas: columns side by side above each bed. Other
// models have no section and no prediction: nothing rather than a guess.

#include <cstdint>
#include <optional>
#include <vector>

#include "talus/model.h"
#include "theory/limit_equilibrium.h"

namespace talus::theory {

/// Loads of one column above one bed, for the full width of the model. "Front" is the side towards -x.
struct Body {
    double length = 0;                   ///< along x [m]
    double height = 0;                   ///< above the bed [m]
    double weight = 0;                   ///< [N]
    double weight_moment = 0;            ///< weight times height of the centroid above the bed [N m]
    double tan_friction = 0;             ///< of the bed
    double cohesion_force = 0;           ///< C times base area [N]
    double back_thrust = 0;              ///< water on the back face, per cos(tilt) [N]
    double back_moment = 0;              ///< of it about the bed's level [N m]
    double front_thrust = 0;             ///< water on the front face, per cos(tilt) [N]
    double front_moment = 0;             ///< of it about the bed's level [N m]
    double uplift = 0;                   ///< water under the base, per cos(tilt) [N]
    double uplift_front = 0;             ///< its moment about the front edge [N m]
    std::vector<std::int32_t> blocks{};  ///< of the model
};

/// All columns above one bed level; a column that ends below it is empty.
struct Bed {
    int level = 1;  ///< 1 is the floor
    double z = 0;   ///< of the bed, in the model [m]
    std::vector<std::optional<Body>> columns;
};

struct Section {
    std::vector<Bed> beds;
};

/// Columns `first` to `last` of a bed as one rigid mass. All of them must be there.
Mass massOf(const Bed& bed, std::size_t first, std::size_t last);

/// The section seen from the other side of the y axis: what moves uphill in `section` moves downhill in it.
Section mirrored(const Section& section);

std::optional<Section> stackSection(const Model& model);   ///< one regular stack in "stack" bond
std::optional<Section> singleSection(const Model& model);  ///< one free box on one fixed block

}  // namespace talus::theory
