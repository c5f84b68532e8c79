#include "talus/wet_joint_name.h"

#include <doctest/doctest.h>

#include <string>

using namespace talus;

TEST_SUITE("engine") {
    TEST_CASE("wet joint name: it is read as it is written, and people read a percentage") {
        for (const std::string joint : {"default", "default@18.5deg"})
            for (const double share : {0.001, 0.4, 0.585, 1.0}) {
                const std::string name = WetJointName{joint, share}.text();
                CAPTURE(name);
                const auto read = readWetJointName(name);
                REQUIRE(read);
                CHECK(read->joint == joint);
                CHECK(read->share == share);
            }
        CHECK(jointText("default@0.4wet") == "default (40 % wet)");
        CHECK(jointText("clay@18.5deg@0.585wet") == "clay@18.5deg (58.5 % wet)");
    }

    TEST_CASE("wet joint name: other names stay as they are") {
        for (const std::string name :
             {"default", "default@18.5deg", "wet", "@wet", "a@0.5 wet", "a@0.5wets"}) {
            CAPTURE(name);
            CHECK_FALSE(readWetJointName(name));
            CHECK(jointText(name) == name);
        }
    }
}
