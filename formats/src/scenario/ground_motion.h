#pragma once
// [ground_motion]: a record of accelerations or velocities in a CSV file.

#include <optional>
#include <string>
#include <string_view>

#include "scenario/force_reader.h"
#include "talus/model.h"

namespace talus::formats::scenario {

/// What is taken off accelerations: nothing, their mean, or their straight line.
enum class Baseline : std::uint8_t { none, mean, line };

/// The motion that a record tells of, times `scale`; none, and `fault` says why and in which line.
std::optional<GroundMotion> parseGroundMotion(std::string_view text, double scale, Baseline baseline,
                                              std::string& fault);

/// Adds the record to the model; a run that says no duration_s lasts as long as it.
void readGroundMotion(const ForceReader& from, Model& model);

}  // namespace talus::formats::scenario
