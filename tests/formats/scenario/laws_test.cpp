// What a scenario may say of a joint's law of strength, and what it may not.

#include "faults.h"

namespace talus::formats {

TEST_CASE("scenario errors: laws of strength") {
    const auto fault = [](const std::string& keys, int line, const std::string& key,
                          const std::string& fragment) {
        checkFault(
            {material() + joint("default", keys) + stack(), 5 + line, "joint.default" + key, fragment});
    };
    const std::string rough = "law = \"barton-bandis\"\njrc = 8\njcs = 5e7\nresidual_friction_deg = 28\n";
    CHECK(readGood(material() + joint("default", rough) + stack()).model.joints[0].max_friction ==
          doctest::Approx(70 * 3.14159265358979323846 / 180));
    fault("law = \"mohr\"\nfriction_deg = 30", 1, ".law",
          "found \"mohr\", allowed: \"coulomb\", \"barton-bandis\", \"envelope\", \"power\"");
    fault("law = 3\nfriction_deg = 30", 1, ".law", "found");
    fault(rough + "friction_deg = 30", 5, ".friction_deg",
          "found in a joint of law \"barton-bandis\", allowed:");
    fault(rough + "cohesion = 0", 5, ".cohesion", "allowed: normal_stiffness, shear_stiffness");
    fault(rough + "max_friction_deg = 81", 5, ".max_friction_deg", "at most 80");
    fault(rough + "shear_strength = [[0, 0], [1, 1]]", 5, ".shear_strength", "barton-bandis");
    fault("law = \"barton-bandis\"\njrc = 21\njcs = 5e7\nresidual_friction_deg = 28", 2, ".jrc",
          "at most 20");
    fault("law = \"barton-bandis\"\njrc = 8\njcs = 0\nresidual_friction_deg = 28", 3, ".jcs",
          "greater than 0");
    fault("law = \"barton-bandis\"\njrc = 8\njcs = 5e7", -2, ".residual_friction_deg", "missing");
    fault("friction_deg = 30\njrc = 8", 2, ".jrc", "found in a joint of law \"coulomb\"");
    fault("law = \"power\"\na = 1.2\nb = 1.1", 3, ".b", "greater than 0 and at most 1");
    fault("law = \"power\"\na = -1\nb = 0.8", 2, ".a", "greater than 0");
    fault("law = \"power\"\na = 1", -2, ".b", "missing");
    const std::string table = "law = \"envelope\"\nshear_strength = ";
    fault("law = \"envelope\"", -2, ".shear_strength", "missing");
    fault(table + "[[0, 1]]", 2, ".shear_strength", "found 1 points, allowed: two or more");
    fault(table + "[[1, 0], [2, 1]]", 2, ".shear_strength[0]", "a first normal stress of 1, allowed: 0");
    fault(table + "[[0, 0], [2, 1], [2, 3]]", 2, ".shear_strength[2]",
          "allowed: greater than the one before, 2");
    fault(table + "[[0, 0], [2, 1], [3, 0.5]]", 2, ".shear_strength[2]",
          "allowed: at least the one before, 1");
    fault(table + "[[0, 0], [2, -1]]", 2, ".shear_strength[1][1]", "at least 0");
    fault(table + "[[0, 0], [2, 1, 1]]", 2, ".shear_strength[1]", "found an array of 3 values");
    checkFault({material() + joint("default", rough) + stack("bed_friction_deg = [20, 25]\n"), 16,
                "stack[0].bed_friction_deg", "law \"coulomb\""});
    checkFault(
        {material() + joint("default", rough) + stack() +
             "[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoint = \"default\"\nfriction_deg = 3\n",
         19, "interface[0].friction_deg", "found in a joint of law"});
}

TEST_CASE("strength over time: read for every law, and taken over by joints of bed levels and interfaces") {
    const std::string table = "strength_over_time = [[0, 1.5], [10, 0.25]]\n";
    const std::vector<LevelPoint> expected{{0, 1.5}, {10, 0.25}};
    for (const char* keys : {"friction_deg = 30\n", "law = \"power\"\na = 1.2\nb = 0.9\n"}) {
        const Scenario scenario = readGood(material() + joint("default", keys + table) + stack() +
                                           "[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoint = "
                                           "\"default\"\nshear_stiffness = 1e9\n");
        REQUIRE(scenario.model.joints.size() == 2);
        for (const Joint& each : scenario.model.joints) CHECK(each.strength_over_time == expected);
    }
    const Scenario beds = readGood(material() + joint("default", "friction_deg = 30\n" + table) +
                                   stack("bed_friction_deg = [20, 25]\n"));
    REQUIRE(beds.model.joints.size() == 3);
    for (const Joint& each : beds.model.joints) CHECK(each.strength_over_time == expected);
    CHECK(readGood(material() + joint("default", "friction_deg = 30") + stack())
              .model.joints[0]
              .strength_over_time.empty());
}

TEST_CASE("scenario errors: strength of wet joints") {
    const auto fault = [](const std::string& value, const std::string& fragment) {
        checkFault(
            {material() + joint("default", "friction_deg = 30\nwet_strength_factor = " + value) + stack(), 7,
             "joint.default.wet_strength_factor", fragment});
    };
    fault("0", "found 0, allowed: at least 0.001 and at most 1");
    fault("1.2", "found 1.2, allowed: at least 0.001 and at most 1");
    fault("-0.5", "found -0.5, allowed: at least 0.001 and at most 1");
    fault("nan", "nan");
    fault("\"weak\"", "a string");
    for (const char* keys : {"friction_deg = 30\n", "law = \"power\"\na = 1.2\nb = 0.9\n"})
        CHECK(
            readGood(material() + joint("default", std::string(keys) + "wet_strength_factor = 0.7") + stack())
                .model.joints[0]
                .wet_strength_factor == 0.7);
}

TEST_CASE("scenario errors: strength over time") {
    const auto fault = [](const std::string& value, const std::string& place, const std::string& fragment) {
        checkFault(
            {material() + joint("default", "friction_deg = 30\nstrength_over_time = " + value) + stack(), 7,
             "joint.default.strength_over_time" + place, fragment});
    };
    fault("[]", "", "found an empty array, allowed: [[time s, factor], ...]");
    fault("0.5", "", "allowed: an array");
    fault("[3]", "[0]", "allowed: an array of 2 numbers");
    fault("[[0, 1], [1]]", "[1]", "array of 2 numbers");
    fault("[[0, 1], [5, 0.5], [5, 0.4]]", "[2]", "found the time 5, allowed: greater than the one before, 5");
    fault("[[-1, 1]]", "[0][0]", "at least 0");
    fault("[[0, 1], [5, 0]]", "[1][1]", "found 0, allowed: at least 0.001 and less than 10");
    fault("[[0, -0.5]]", "[0][1]", "found -0.5, allowed: at least 0.001 and less than 10");
    fault("[[0, 80]]", "[0][1]", "found 80, allowed: at least 0.001 and less than 10");
    fault("[[0, nan]]", "[0][1]", "found nan, allowed: a finite number");
    fault("[[0, \"half\"]]", "[0][1]", "half");
    checkFault({material() + joint("default", "friction_deg = 30") + stack() +
                    "[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoint = "
                    "\"default\"\nstrength_over_time = [[0, 1]]\n",
                15, "interface[0].strength_over_time", "unknown"});
}

}  // namespace talus::formats
