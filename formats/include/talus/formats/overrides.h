#pragma once
// Values put into a scenario's model in place of those its file gave, without reading it again. The model is
// then the one that reading the file with these values gives, to the bit: properties that follow others
// follow them here too. Warnings are those of these values.
//
// Fields whose values a model holds directly: joint.NAME.KEY (all properties), material.NAME.density,
// gravity.magnitude and .tilt_deg, damping.KEY, and water[i]'s depth, elevation, head[k], density and
// drains_at_aperture, if the file gives the level that way. All other fields define blocks and faces or are
// settings, and need the reader.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "talus/formats/scenario.h"

namespace talus::formats {

/// Whether a field is one of those.
bool canOverride(const Scenario& scenario, std::string_view field);

/// Sets a field to a value in the file's unit. False, without any change, when canOverride is false or the
/// value is not allowed: the reader then gives the error.
bool applyOverride(Scenario& scenario, std::string_view field, double value);

/// A property of the joint between two blocks that touch.
struct PairOverride {
    std::int32_t block_a = 0, block_b = 0;
    std::int32_t joint = 0;    ///< between them so far; one that the file names
    std::size_t property = 0;  ///< place in kJointProperties
    double value = 0;          ///< in its unit
};

/// Gives pairs their own joints, as one [[interface]] each: an entry of the file is extended, others are
/// added in the order of `overrides`. False, and nothing is changed, when a value is not allowed.
bool overridePairs(Scenario& scenario, const std::vector<PairOverride>& overrides);

}  // namespace talus::formats
