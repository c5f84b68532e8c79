#pragma once
// A text with one fault, and where it must be found.

#include <string>

#include "scenario_texts.h"

namespace talus::formats {

struct Fault {
    std::string text;
    int line;              ///< expected, of the whole text
    std::string field;     ///< expected
    std::string fragment;  ///< expected within the message
};

/// Exactly the one error expected.
inline void checkFault(const Fault& fault) {
    CAPTURE(fault.text);
    const auto errors = readBad(fault.text);
    CAPTURE(all(errors));
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].field == fault.field);
    CHECK(errors[0].line == fault.line);
    CHECK(errors[0].column >= 1);
    CHECK(errors[0].file == "bad.toml");
    CHECK_MESSAGE(errors[0].message.find(fault.fragment) != std::string::npos, errors[0].message, " lacks ",
                  fault.fragment);
}

/// The first error, with its field; "accepted" where there is none.
inline std::string refusalOf(const std::string& text) {
    const auto scenario = parseScenario(text, "slope.toml");
    if (scenario.ok()) return "accepted";
    const Error& error = scenario.errors().front();
    CHECK(error.line > 0);
    return error.field + ": " + error.message;
}

}  // namespace talus::formats
