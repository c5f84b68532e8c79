// Rock masses that are cut, not stacked, against limit equilibrium: the scenarios of bench/verification.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/verification.h"
#include "talus/analysis.h"

namespace talus {

using test::verification;

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

double checkFactor(const std::string& name, double expected, double tolerance) {
    const auto result = safetyFactor(verification(name), {});
    REQUIRE(result.ok());
    REQUIRE((result->status == SearchStatus::found));
    const double factor = 0.5 * (result->low + result->high);
    MESSAGE(name, ": factor of safety ", factor, ", expected ", expected);
    CHECK(std::abs(factor - expected) <= tolerance * expected);
    return factor;
}

void checkAngle(const std::string& name, double expected_deg, double tolerance_deg) {
    const auto result = criticalAngle(verification(name), {});
    REQUIRE(result.ok());
    REQUIRE((result->status == SearchStatus::found));
    const double angle = 0.5 * (result->low + result->high) / kDegree;
    MESSAGE(name, ": critical angle ", angle, " deg, expected ", expected_deg);
    CHECK(std::abs(angle - expected_deg) <= tolerance_deg);
}

}  // namespace

TEST_CASE("cut rock: wedge on two planes, factor of safety by limit equilibrium within 0.5 %") {
    checkFactor("wedge-phi-30", 0.877, 0.005);
    // Without cohesion the factor of safety is tan(phi) / tan(critical phi).
    const double factor = checkFactor("wedge-phi-35", 1.064, 0.005);
    const double critical = std::atan(std::tan(35 * kDegree) / factor) / kDegree;
    MESSAGE("wedge: critical friction angle ", critical, " deg, expected 33.36");
    CHECK(std::abs(critical - 33.36) <= 0.05);
    checkFactor("wedge-phi-40", 1.275, 0.005);
}

TEST_CASE("cut rock: Hoek and Bray's plane failure with a tension crack, within 0.5 %") {
    checkFactor("hoek-bray-60m", 1.0935, 0.002);
    checkFactor("hoek-bray-crack-0m", 1.544, 0.005);
    checkFactor("hoek-bray-crack-1m", 1.464, 0.005);
    checkFactor("hoek-bray-crack-2m", 1.363, 0.005);
    checkFactor("hoek-bray-crack-3m", 1.247, 0.005);
    checkFactor("hoek-bray-crack-4m", 1.119, 0.005);
}

TEST_CASE("cut rock: the paper's joint sets give the paper's slope") {
    checkAngle("table3-dry", 19.5, 0.02);
    checkAngle("table3-fissure-5", 17.16, 0.02);
}

TEST_CASE("cut rock: a block of two convex parts overturns as one body") {
    checkAngle("bracket", 12.54, 0.02);
}

TEST_CASE("cut rock: Goodman and Bray's slope topples near their friction angle") {
    const auto result = safetyFactor(verification("goodman-bray"), {});
    REQUIRE(result.ok());
    REQUIRE((result->status == SearchStatus::found));
    const double factor = 0.5 * (result->low + result->high);
    const double required = std::atan(std::tan(38.15 * kDegree) / factor) / kDegree;
    MESSAGE("required friction angle ", required, " deg, limiting friction on every side 38.15 deg");
    CHECK(std::abs(required - 38.15) < 1.0);  // theirs is a bound, not the answer
}

}  // namespace talus
