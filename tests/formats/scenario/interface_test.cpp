// [[interface]]: another joint for one pair of blocks, and properties of its own.

#include <cmath>

#include "scenario_texts.h"

namespace talus::formats {

namespace {

constexpr double kDeg = 3.14159265358979323846 / 180;

std::string interface(const std::string& more) {
    return "[[interface]]\nbetween = [\"c1r1s1\", \"c1r2s1\"]\njoint = \"default\"\n" + more;
}

Joint jointOf(const std::string& text) {
    const Model model = readGood(text).model;
    REQUIRE(!model.pair_joints.empty());
    return model.joints[static_cast<std::size_t>(model.pair_joints.back().joint)];
}

}  // namespace

TEST_CASE("an interface takes its joint's properties but for those it names") {
    const Joint own = jointOf(properties() + stack() +
                              interface("friction_deg = 25\ncohesion = 7\nnormal_stiffness = 3e9\n"));
    CHECK(own.friction == doctest::Approx(25 * kDeg));
    CHECK(own.residual_friction == own.friction);  // nobody gave another
    CHECK(own.cohesion == 7);
    CHECK(own.normal_stiffness == 3e9);
    CHECK(own.shear_stiffness == 1e9);
    CHECK(own.tensile_strength == 0);
}

TEST_CASE("a residual angle of the joint stays, one of the interface wins") {
    const std::string base =
        material() + joint("default", "friction_deg = 30\nresidual_friction_deg = 22") + stack();
    CHECK(jointOf(base + interface("friction_deg = 25\n")).residual_friction == doctest::Approx(22 * kDeg));
    CHECK(jointOf(base + interface("residual_friction_deg = 20\n")).residual_friction ==
          doctest::Approx(20 * kDeg));
    CHECK(jointOf(base + interface("residual_friction_deg = 20\n")).friction == doctest::Approx(30 * kDeg));
}

TEST_CASE("without properties of its own an interface has the joint itself") {
    const Model model = readGood(properties() + stack() + interface("")).model;
    CHECK(model.joints.size() == 1);
    CHECK(model.pair_joints.back().joint == 0);
}

TEST_CASE("properties of an interface are checked like a joint's") {
    const auto wrong = parseScenario(properties() + stack() + interface("friction_deg = 95\n"), "bad.toml");
    REQUIRE_FALSE(wrong.ok());
    CHECK(format(wrong.errors().front()) ==
          "bad.toml:15:16: error: interface[0].friction_deg: found 95, allowed: at least 0 and less than 90");
}

}  // namespace talus::formats
