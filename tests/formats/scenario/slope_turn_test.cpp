// Profiles turned to an azimuth: with joints and water turned alike, all is the same as without.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "faults.h"
#include "talus/analysis.h"
#include "talus/polyhedron.h"

namespace talus::formats {

namespace {

constexpr double kDeg = std::numbers::pi / 180;

/// A slope that looks to 270 + `turn` degrees, and its joints. \param azimuth  "" or the key
std::string slope(const std::string& profile, const std::string& azimuth, double turn) {
    const auto direction = [&](double degrees) { return std::to_string(degrees + turn) + "\n"; };
    return properties() + "[rock_mass]\nregion = { profile = " + profile + ", y = [0, 8]" + azimuth +
           " }\nfixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }]\n" +
           "[[joint_set]]\ndip_deg = 28\nspacing = 2.0\ndip_direction_deg = " + direction(270) +
           "[[joint_set]]\ndip_deg = 85\nspacing = 5.0\ndip_direction_deg = " + direction(95) +
           "[[joint_set]]\ndip_deg = 90\nspacing = 5.0\ndip_direction_deg = " + direction(0) +
           "[[water]]\nsurface = [[0, 1], [8, 4]]\n";
}

const std::string kRising = "[[0, -2], [18, -2], [18, 12], [5, 12], [0, 0]]";
const std::string kFalling = "[[0, -2], [0, 12], [13, 12], [18, 0], [18, -2]]";

Vec3 turnedBy(const Vec3& p, double azimuth_deg) {
    const double angle = (270 - azimuth_deg) * kDeg;  // counter-clockwise seen from above
    return {p.x() * std::cos(angle) - p.y() * std::sin(angle),
            p.x() * std::sin(angle) + p.y() * std::cos(angle), p.z()};
}

}  // namespace

TEST_CASE("slope azimuth: blocks of a turned slope are those of the slope, turned") {
    const Scenario plain = readGood(slope(kRising, "", 0));
    CHECK(plain.warnings.empty());
    for (const double azimuth : {235.0, 0.0, 90.0, -30.0}) {
        CAPTURE(azimuth);
        const Scenario turned =
            readGood(slope(kRising, ", slope_azimuth_deg = " + std::to_string(azimuth), azimuth - 270));
        REQUIRE(turned.model.blocks.size() == plain.model.blocks.size());
        CHECK(turned.warnings.size() == 1);
        CHECK(turned.warnings[0].find("still tilt towards -x (270 degrees)") != std::string::npos);
        CHECK(turned.model.seismic.azimuth == doctest::Approx(azimuth * kDeg).epsilon(1e-12));
        // Numbered anew from the bottom up, then by x: each has its like.
        for (const Block& block : plain.model.blocks) {
            const MassProperties mass = massProperties(block.shape);
            const Vec3 place = turnedBy(mass.centroid, azimuth);
            const auto like =
                std::find_if(turned.model.blocks.begin(), turned.model.blocks.end(), [&](const Block& other) {
                    return (massProperties(other.shape).centroid - place).norm() < 1e-8;
                });
            REQUIRE(like != turned.model.blocks.end());
            CHECK(massProperties(like->shape).volume == doctest::Approx(mass.volume).epsilon(1e-9));
            CHECK(like->motion == block.motion);
        }
    }
}

TEST_CASE("slope azimuth: 270, or 90 where the +x end is the lower one, changes no bit") {
    for (const auto& [profile, azimuth] : {std::pair(kRising, "270"), std::pair(kFalling, "90")}) {
        const Scenario plain = readGood(slope(profile, "", 0));
        const Scenario same = readGood(slope(profile, std::string(", slope_azimuth_deg = ") + azimuth, 0));
        CHECK(same.warnings.empty());
        REQUIRE(same.model.blocks.size() == plain.model.blocks.size());
        for (std::size_t b = 0; b < plain.model.blocks.size(); ++b)
            CHECK(same.model.blocks[b].shape.vertices == plain.model.blocks[b].shape.vertices);
    }
}

TEST_CASE("slope azimuth: the factor of safety is the same for any azimuth of the slope") {
    const auto factor = [](const Scenario& scenario) {
        const auto result = safetyFactor(scenario.model);
        REQUIRE(result.ok());
        return result->answer;
    };
    const double plain = factor(readGood(slope(kRising, "", 0)));
    const double turned = factor(readGood(slope(kRising, ", slope_azimuth_deg = 235", -35)));
    CHECK(turned == doctest::Approx(plain).epsilon(2e-3));
}

TEST_CASE("slope azimuth: faults") {
    const auto region = [](const std::string& keys) {
        return properties() + "[rock_mass]\nregion = { " + keys +
               " }\n[[joint_set]]\ndip_deg = 30\ndip_direction_deg = 265\nspacing = 3\n";
    };
    const std::string field = "rock_mass.region.slope_azimuth_deg";
    checkFault({region("box = { min = [0, 0, 0], max = [1, 1, 1] }, slope_azimuth_deg = 3"), 8, field,
                "without profile"});
    checkFault({region("profile = " + kRising + ", y = [0, 8], slope_azimuth_deg = 400"), 8, field,
                "found 400, allowed: at least -360 and at most 360"});
    checkFault(
        {region("profile = [[0, 0], [4, 0], [4, 2], [2, 4], [0, 2]], y = [0, 8], slope_azimuth_deg = 3"), 8,
         field, "as high at its least as at its greatest x (2 m)"});
}

}  // namespace talus::formats
