#pragma once
// The meaning of each key of a scenario and a sweep, for editors, the guide's reference and the schema.
// tests/formats/schema/schema_test.cpp finds keys without a line here, and lines without a key.

#include <span>
#include <string>
#include <string_view>

namespace talus::formats::schema {

struct Description {
    std::string_view field;  ///< "stack[].columns", "material.NAME.density"; a section by its name
    std::string_view text;   ///< without its unit, which scenario::unitOf says
};

std::span<const Description> scenarioDescriptions();
std::span<const Description> sweepDescriptions();

/// The line of a field ("" where there is none): its own, else that of a table which several sections have
/// ("box.min", what bolts are made of).
std::string_view descriptionOf(std::span<const Description> lines, std::string_view field);

/// Lines that hold for a key in more than one section begin with this.
inline constexpr std::string_view kAnywhere = "*.";

}  // namespace talus::formats::schema
