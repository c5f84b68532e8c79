#pragma once
// What each key of a scenario and a sweep means, for editors, the guide's reference and whoever reads the
// schema. A key that has no line here, and a line that has no key, are missed by
// tests/formats/schema/schema_test.cpp.

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
