#pragma once
// Comparison of numbers far from 1: doctest's Approx alone allows a share of 1 more than the value.

#include <doctest/doctest.h>

namespace talus::test {

/// Equal but for a share of the value, which is not 0.
inline doctest::Approx near(double value, double share) {
    return doctest::Approx(value).epsilon(share).scale(0);
}

}  // namespace talus::test
