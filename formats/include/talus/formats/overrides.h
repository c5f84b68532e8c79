#pragma once
// Values put into a scenario's model in place of those its file gave, without reading it again. The model is
// then the one that reading the file with these values gives, to the bit: properties that follow others
// follow them here too.
//
// Fields whose values a model holds as they are: joint.NAME.KEY (all properties), material.NAME.density,
// gravity.magnitude and .tilt_deg, damping.KEY, and water[i]'s depth, elevation, head[k], density and
// drains_at_aperture, as far as the file gives the level that way. Everything else decides which blocks and
// faces there are, or is a setting; that takes the reader.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "talus/formats/scenario.h"

namespace talus::formats {

/// Whether a field is one of those.
bool canOverride(const Scenario& scenario, std::string_view field);

/// Puts a value, in the file's unit, in its place. False, and nothing is changed, when canOverride says no or
/// the value is not allowed there: the reader then says in its own words what is wrong.
bool applyOverride(Scenario& scenario, std::string_view field, double value);

/// A property of the joint between two blocks that touch.
struct PairOverride {
    std::int32_t block_a = 0, block_b = 0;
    std::int32_t joint = 0;    ///< between them so far; one that the file names
    std::size_t property = 0;  ///< place in kJointProperties
    double value = 0;          ///< in its unit
};

/// Gives pairs joints of their own, as one [[interface]] each would: an entry of the file is extended, others
/// are added in the order of `overrides`. False, and nothing is changed, when a value is not allowed.
bool overridePairs(Scenario& scenario, const std::vector<PairOverride>& overrides);

}  // namespace talus::formats
