// Plane failure with water by the distributions of E. Hoek and J. W. Bray (Rock Slope Engineering, 1981),
// against limit equilibrium. Water belongs to the part of a joint that bounds the slide: how far the joints
// and the model go on in fixed rock changes nothing.

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "support/models.h"
#include "support/plane_slope.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

double factorOf(const PlaneSlope& slope) {
    const auto scenario = formats::parseScenario(slope.scenario(), "plane.toml");
    REQUIRE(scenario.ok());
    const auto result = safetyFactor(scenario->model, {.interval = false, .upper_bound = Beside::never});
    REQUIRE(result.ok());
    REQUIRE((result->status == SearchStatus::found));
    return result->answer;
}

std::vector<std::string> warningsOf(const PlaneSlope& slope) {
    const auto scenario = formats::parseScenario(slope.scenario(), "plane.toml");
    const auto result = safetyFactor(scenario->model, {.interval = false, .upper_bound = Beside::never});
    REQUIRE(result.ok());
    return result->warnings;
}

void check(const PlaneSlope& slope, double by_hand) {
    CAPTURE(slope.scenario());
    CHECK(factorOf(slope) == doctest::Approx(by_hand).epsilon(0.003));
}

std::string filled(double percent, const std::string& peak, bool crack) {
    return "percent_filled = " + std::to_string(percent) + "\npeak = \"" + peak + "\"\n" +
           (crack ? "crack = \"crack\"\n" : "");
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("plane failure: percent filled, and where the pressure is greatest") {
        for (const double base : {-5.0, -20.0})
            for (const double percent : {40.0, 100.0}) {
                PlaneSlope cracked{.base = base};
                const double top = cracked.height, share = percent / 100;
                double level = cracked.foot() + share * (top - cracked.foot());
                cracked.water = filled(percent, "crack-base", true);
                check(cracked, cracked.factor(level, [&](double z) {
                    return kWater * (level - cracked.foot()) * z / cracked.foot();
                }));
                level = share * top;
                cracked.water = filled(percent, "half-height", true);
                check(cracked,
                      cracked.factor(level, [&](double z) { return kWater * std::min(level - z, z); }));
                if (percent == 100) continue;  // hardly anything would hold it
                // At the toe the pressure lifts the tip; cohesion there would be lost.
                cracked.cohesion = 0;
                cracked.water = filled(percent, "toe", true);
                check(cracked, cracked.factor(level, [&](double z) { return kWater * (level - z); }));
            }
    }

    TEST_CASE("plane failure: filled to 0 % is dry, and nobody is warned of that") {
        PlaneSlope slope;
        const double dry = factorOf(slope);
        for (const char* peak : {"crack-base", "half-height", "toe"}) {
            slope.water = filled(0, peak, true);
            CHECK(factorOf(slope) == doctest::Approx(dry).epsilon(1e-9));
            const auto told = warningsOf(slope);
            CHECK(std::none_of(told.begin(), told.end(), [](const std::string& warning) {
                return warning.find("wets no free block") != std::string::npos;
            }));
        }
    }

    TEST_CASE("plane failure: a closed volume above the level at which it runs over is an error") {
        PlaneSlope slope;
        slope.water =
            "elevation = 0\n[[water]]\njoint = \"crack\"\nvolume = \"closed\"\nopening = 0.04\nelevation = ";
        const auto errors = [&](const std::string& level) {
            PlaneSlope filled = slope;
            filled.water += level + "\n";
            return safetyFactor(formats::parseScenario(filled.scenario(), "plane.toml")->model,
                                {.interval = false, .upper_bound = Beside::never})
                .errors();
        };
        CHECK(errors("30").empty());
        REQUIRE(errors("32").size() == 1);
        CHECK(errors("32")[0].field == "water[1].elevation");
        CHECK(errors("32")[0].message.find("filled to 32 m, 2 m above the level at which it runs over") !=
              std::string::npos);
    }

    TEST_CASE("plane failure: a crack that cuts nothing is named") {
        PlaneSlope slope{.crack_at = -1};
        slope.water = filled(50, "crack-base", true) +
                      "[[single_joint]]\nname = \"crack\"\npoint = [1000, 0, 0]\ndip_deg = 90\n"
                      "dip_direction_deg = 270\n";
        const auto errors = formats::parseScenario(slope.scenario(), "plane.toml").errors();
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].message.find("found the joint \"crack\", which cuts no block") == 0);
    }

    TEST_CASE("plane failure of 60 m without a crack, peak at half height: Hoek's Sau Mau Ping") {
        PlaneSlope slope{.height = 60,
                         .face_deg = 50,
                         .plane_deg = 35,
                         .crack_at = -1,
                         .density = 2700,
                         .cohesion = 100e3,
                         .friction_deg = 35};
        const auto dry = [](double) { return 0.0; };
        const auto wet = [](double z) { return kWater * std::min(60 - z, z); };
        CHECK(slope.factor(0, dry) == doctest::Approx(1.6494).epsilon(2e-4));
        CHECK(slope.factor(60, wet) == doctest::Approx(0.9803).epsilon(2e-4));
        check(slope, slope.factor(0, dry));
        slope.water = filled(100, "half-height", false);
        check(slope, slope.factor(60, wet));
        slope.k_h = 0.08;
        check(slope, slope.factor(60, wet));
        CHECK(slope.factor(60, wet) == doctest::Approx(0.8295).epsilon(2e-4));
        slope.water.clear();
        check(slope, slope.factor(0, dry));
        CHECK(slope.factor(0, dry) == doctest::Approx(1.4300).epsilon(2e-4));
    }

    TEST_CASE(
        "heads and depths count from the ends of the joint at the slide, however deep the model is cut") {
        for (const double base : {-5.0, -20.0}) {
            PlaneSlope slope{.base = base};
            const double head = 5.435, level = slope.foot() + head;
            const double by_hand =
                slope.factor(level, [&](double z) { return kWater * head * z / slope.foot(); });
            slope.water = "head = [5.435, 0.0]\n[[water]]\njoint = \"crack\"\ndepth = 5.435\n";
            check(slope, by_hand);
            slope.water = "elevation = " + std::to_string(level) +
                          "\ndaylights = \"straight\"\n[[water]]\njoint = \"crack\"\nelevation = " +
                          std::to_string(level) + "\n";
            check(slope, by_hand);
        }
    }
}
