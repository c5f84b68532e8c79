#include "scenario/slope_turn.h"

#include <array>
#include <cmath>

#include "scenario/reading.h"

namespace talus::formats::scenario {

namespace {

/// Sine and cosine, exactly 0 or 1 where they are: a face that looks north has no rounding in it.
std::array<double, 2> sineAndCosine(double angle_deg) {
    const double rest = std::fmod(angle_deg, 360);
    const double positive = rest < 0 ? rest + 360 : rest;
    if (positive == 0) return {0, 1};
    if (positive == 90) return {1, 0};
    if (positive == 180) return {0, -1};
    if (positive == 270) return {-1, 0};
    return {std::sin(positive * kRadPerDeg), std::cos(positive * kRadPerDeg)};
}

}  // namespace

SlopeTurn::SlopeTurn(double azimuth_deg, bool faces_plus_x)
    : azimuth_(azimuth_deg * kRadPerDeg), is_given_(true) {
    // The azimuth's direction is (sin, cos); the profile's x points there, or away from it.
    const auto [east, north] = sineAndCosine(azimuth_deg);
    cosine_ = faces_plus_x ? east : 0 - east;
    sine_ = faces_plus_x ? north : 0 - north;
}

}  // namespace talus::formats::scenario
