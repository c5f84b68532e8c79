// Fixed blocks that touch are one body. A block that slides over blocks whose tops are level is pressed into
// its joint; it must not hang on the edge between them, however soft the joint is.

#include <doctest/doctest.h>

#include <sstream>
#include <string>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kFriction = 27.0;  // [deg]

void box(std::ostringstream& out, const char* name, const Vec3& min, const Vec3& max, bool fixed) {
    out << "\n[[block]]\nname = \"" << name << "\"\nfixed = " << (fixed ? "true" : "false")
        << "\nbox = {min = [" << min.x() << ", " << min.y() << ", " << min.z() << "], max = [" << max.x()
        << ", " << max.y() << ", " << max.z() << "]}\n";
}

/// A block 1 m long on level ground that is cut in two at a distance behind its front [m].
std::string overSeam(double stiffness, double behind_front, double height) {
    std::ostringstream out;
    out << "[joint]\nnormal_stiffness = " << stiffness << "\nshear_stiffness = " << 0.4 * stiffness
        << "\nfriction_deg = " << kFriction << "\n";
    box(out, "ahead", {-3, 0, -1}, {behind_front, 1, 0}, true);
    box(out, "below", {behind_front, 0, -1}, {3, 1, 0}, true);
    box(out, "block", {0, 0, 0}, {1, 1, height}, false);
    return out.str();
}

double angleOf(const std::string& text) {
    CAPTURE(text);
    const auto scenario = formats::parseScenario(text, "seam.toml");
    REQUIRE(scenario.ok());
    const auto found = criticalAngle(scenario->model);
    REQUIRE(found.ok());
    REQUIRE((found->status == SearchStatus::found));
    return degrees(found->answer);
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("a block slides over the edge between two fixed blocks as over one") {
        for (const double stiffness : {1e7, 1e8, 1e9, 1e10})
            for (const double behind_front : {-0.25, 0.0, 1e-4, 0.3})
                CHECK(angleOf(overSeam(stiffness, behind_front, 0.5)) ==
                      doctest::Approx(kFriction).epsilon(1e-3));
    }
}
