#pragma once
// Scenario texts the tests are made of, and short ways to read them.

#include <doctest/doctest.h>

#include <string>

#include "talus/formats/scenario.h"

namespace talus::formats {

inline std::string material() { return "[material.granite]\ndensity = 2700.0\n"; }  // 2 lines

inline std::string joint(const std::string& name = "default", const std::string& more = "friction_deg = 30") {
    return "[joint." + name + "]\nnormal_stiffness = 2e9\nshear_stiffness = 1e9\n" + more + "\n";  // 4 lines
}

/// Lines 1 to 6 of most texts below.
inline std::string properties() { return material() + joint(); }

/// Five lines and those of `more`.
inline std::string stack(const std::string& more = "",
                         const std::string& counts = "columns = 3\nrows = 2\nslices = 2\n") {
    return "[[stack]]\n" + counts + "block = [0.2, 0.1, 0.05]\n" + more;
}

/// Three lines and those of `more`: a unit box.
inline std::string block(const std::string& name, const std::string& more = "") {
    return "[[block]]\nname = \"" + name + "\"\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\n" + more;
}

inline constexpr int kPropertiesLines = 6;

inline Scenario readGood(const std::string& text) {
    auto scenario = parseScenario(text, "good.toml");
    for (const Error& error : scenario.errors()) FAIL_CHECK(format(error));
    REQUIRE(scenario.ok());
    return *scenario;
}

inline std::vector<Error> readBad(const std::string& text) {
    const auto scenario = parseScenario(text, "bad.toml");
    CHECK_FALSE(scenario.ok());
    return scenario.errors();
}

inline std::string all(const std::vector<Error>& errors) {
    std::string text;
    for (const Error& error : errors) text += format(error) + "\n";
    return text;
}

}  // namespace talus::formats
