// `ends_at` of a joint set.

#include <doctest/doctest.h>

#include <algorithm>

#include "faults.h"
#include "talus/formats/fractures.h"

namespace talus::formats {

namespace {

/// Beds "B", and a set with these keys from line 13 on.
std::string rock(const std::string& keys) {
    return properties() + "[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [10, 2, 4] } }\n" +
           "[[joint_set]]\nname = \"B\"\ndip_deg = 0\ndip_direction_deg = 0\nspacing = 1\n[[joint_set]]\n" +
           keys;
}

const std::string kCross = "dip_deg = 90\ndip_direction_deg = 90\nspacing = 2\n";

}  // namespace

TEST_CASE("ends_at: cross joints between beds, with their own strength, and all are joints of their set") {
    const std::string text =
        joint("C", "friction_deg = 20") + rock(kCross + "name = \"C\"\nends_at = \"B\"\n");
    const Scenario scenario = readGood(text);
    CHECK(scenario.warnings.empty());
    // Three planes inside (one at either end of the box cuts nothing), four beds with six blocks each.
    CHECK(scenario.model.blocks.size() == 4 * 6);
    std::size_t of_cross = 0;
    for (const Block& block : scenario.model.blocks)
        of_cross += static_cast<std::size_t>(std::count_if(
            block.face_joint.begin(), block.face_joint.end(),
            [&](std::int32_t j) { return scenario.model.joints[static_cast<std::size_t>(j)].name == "C"; }));
    CHECK(of_cross == 4 * 5 * 2);
    const auto all = rockJoints(scenario);
    REQUIRE(all.ok());
    CHECK(std::count_if(all->begin(), all->end(), [](const RockJoint& j) { return j.set == "C"; }) >= 4 * 5);
    CHECK(std::none_of(all->begin(), all->end(), [](const RockJoint& j) { return j.disc.has_value(); }));
}

TEST_CASE("ends_at: faults") {
    const auto fault = [](const std::string& keys, int line, const std::string& key,
                          const std::string& words) {
        checkFault({rock(keys), line, "joint_set[1]" + key, words});
    };
    fault(kCross + "ends_at = \"X\"\n", 18, ".ends_at", "found the unknown joint set or single joint \"X\"");
    fault(kCross + "ends_at = \"B\"\norigin = [0, 0, 0]\n", 19, ".origin", "beside ends_at");
    fault("dip_deg = 0\ndip_direction_deg = 0\nspacing = 2\nends_at = \"B\"\n", 18, ".ends_at", "parallel");
    checkFault({properties() + "[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [1, 1, 1] } }\n" +
                    "[[joint_set]]\n" + kCross + "ends_at = \"B\"\n",
                13, "joint_set[0].ends_at", "no other joint has a name"});
}

}  // namespace talus::formats
