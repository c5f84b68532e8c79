#pragma once
// Tests that need what is not everywhere: a browser, Node, VTK.

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

namespace talus::test {

/// Says what a test lacks here. Where nothing may be skipped (TALUS_NO_SKIP is set, as CI does) it fails.
inline void skip(const std::string& lacking) {
    if (std::getenv("TALUS_NO_SKIP") != nullptr)
        FAIL("may not be skipped here: ", lacking);
    else
        MESSAGE("skipped: ", lacking);
}

}  // namespace talus::test
