#pragma once
// A state is what it should be: for tests to ask after every update of the contacts.

#include <doctest/doctest.h>

#include <string>

#include "validate/validate.h"

namespace talus::test {

/// \param forces whether the interfaces' wrenches were computed for the state as it is
inline void checkValid(const State& state, bool forces = false) {
    for (const std::string& finding : validate(state)) FAIL_CHECK(finding);
    if (!forces || !validate(state).empty()) return;
    for (const std::string& finding : validateForces(state)) FAIL_CHECK(finding);
}

}  // namespace talus::test
