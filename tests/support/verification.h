#pragma once
// The scenarios of the verification manual.

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "talus/formats/scenario.h"

namespace talus::test {

/// \param name  of a file under bench/verification, without its ending
inline Model verification(const std::string& name) {
    auto scenario = formats::readScenario(TALUS_SOURCE_DIR "/bench/verification/" + name + ".toml");
    for (const Error& error : scenario.errors()) FAIL_CHECK(formats::format(error));
    REQUIRE(scenario.ok());
    return std::move(scenario->model);
}

}  // namespace talus::test
