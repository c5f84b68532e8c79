// Free surfaces in networks drawn at random have one answer, and every network has one.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "support/draw.h"
#include "support/flows.h"
#include "support/slower.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr const char* kRock =
    "[material.rock]\ndensity = 2600.0\n[joint.default]\nfriction_deg = 35.0\n"
    "normal_stiffness = 1e10\nshear_stiffness = 1e9\n[joint.bedding]\nfriction_deg = 30.0\n"
    "normal_stiffness = 1e10\nshear_stiffness = 1e9\n";

std::string boundary(const std::string& where, const std::string& what) {
    static int count = 0;
    return "[[flow.boundary]]\nname = \"b" + std::to_string(++count) + "\"\n" + where + "\n" + what + "\n";
}

/// Equal apertures, or beds that conduct up to a thousand times as much as other joints, or as little.
std::string apertures(Draw& draw) {
    const std::string all = "[flow]\naperture = 1e-4\n";
    if (draw.one(0, 1) == 0) return all;
    std::ostringstream text;
    text << all << "[flow.joint.bedding]\naperture = " << draw.magnitude(1e-5, 1e-3) << "\n";
    return text.str();
}

std::string head(double value) { return "head = " + std::to_string(value); }

std::string box(double x, double z) {
    std::ostringstream text;
    text << "box = { min = [" << x - 0.01 << ", -1, " << z - 0.01 << "], max = [" << x + 0.01 << ", 2, "
         << z + 0.01 << "] }";
    return text.str();
}

/// A head, or nothing but outlets.
std::string lowEnd(Draw& draw, double upstream) {
    const std::string outlet = "outlet = true";
    return boundary("face = \"-x\"", draw.one(0, 1) == 0 ? outlet : head(draw.between(0.05, 0.4) * upstream));
}

std::string dam(Draw& draw) {
    const int columns = draw.one(6, 16), rows = draw.one(5, 14);
    const double length = draw.between(0.3, 1.2), height = draw.between(0.3, 1.2);
    const double upstream = draw.between(0.5, 0.95) * rows * height;
    std::ostringstream text;
    text << kRock << "[[stack]]\ncolumns = " << columns << "\nrows = " << rows << "\nslices = 1\nblock = ["
         << length << ", 1.0, " << height << "]\n[flow]\naperture = 1e-4\n";
    if (draw.one(0, 1) == 0)
        text << boundary(box(draw.one(1, columns - 1) * length, draw.one(0, rows / 4) * height),
                         "outlet = true");
    text << boundary("face = \"+x\"", head(upstream)) << lowEnd(draw, upstream);
    return text.str();
}

std::string jointSet(Draw& draw, double dip, int direction, double spacing) {
    std::ostringstream text;
    text << "[[joint_set]]\nname = \"s" << direction << "\"\ndip_deg = " << dip
         << "\ndip_direction_deg = " << direction << "\nspacing = " << spacing << "\n";
    if (direction == 270) text << "joint = \"bedding\"\n";
    if (draw.one(0, 1) == 0)
        text << "spacing_law = \"uniform\"\nspacing_spread = " << draw.between(0.1, 0.35) << "\n";
    return text.str();
}

std::string slope(Draw& draw) {
    std::ostringstream text;
    text << kRock
         << "[rock_mass]\nregion = { y = [0, 1], profile = [[0, -2], [18, -2], [18, 12], [6, 12], [0, 0]] }\n"
            "fixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }]\nmin_thickness = 0.001\n"
         << jointSet(draw, draw.between(5, 35), 270, draw.between(0.6, 1.4))
         << jointSet(draw, draw.between(60, 88), 90, draw.between(0.6, 1.4)) << apertures(draw)
         << boundary("box = { min = [16, 0, -2], max = [18, 1, 12] }", head(draw.between(6.5, 10.5)))
         << boundary("face = \"-x\"", "outlet = true") << boundary("face = \"+z\"", "outlet = true");
    return text.str();
}

std::string boxInSpace(Draw& draw) {
    const double height = draw.between(6, 9), upstream = draw.between(0.55, 0.85) * height;
    std::ostringstream text;
    text << kRock << "[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [" << draw.between(7, 12) << ", "
         << draw.between(5, 8) << ", " << height
         << "] } }\nfixed = [{ boundary = \"-z\" }]\nmin_thickness = 0.001\n"
         << jointSet(draw, draw.between(5, 30), 270, draw.between(1.2, 2.2))
         << jointSet(draw, draw.between(70, 88), 90, draw.between(1.2, 2.2))
         << jointSet(draw, draw.between(75, 89), 0, draw.between(1.5, 3)) << apertures(draw)
         << boundary("face = \"+x\"", head(upstream)) << lowEnd(draw, upstream);
    return text.str();
}

Model modelOf(const std::string& text) {
    auto scenario = formats::parseScenario(text, "drawn.toml");
    REQUIRE(scenario.ok());
    return scenario->model;
}

SteadyFlow solved(const Model& model) {
    auto flow = steadyFlow(model);
    for (const Error& error : flow.errors()) FAIL_CHECK(error.field, ": ", error.message);
    REQUIRE(flow.ok());
    CHECK(largestImbalance(*flow) <= 1e-9);
    CHECK(flow->inflow_sum == doctest::Approx(flow->outflow_sum).epsilon(1e-9));
    return *flow;
}

}  // namespace

TEST_CASE("free surface: every network drawn at random has one, which rounding does not move") {
    constexpr unsigned kDraws = kTriesFew ? 3 : 12;
    constexpr double kMoved = 1 + 1e-12;  // a viscosity larger by this moves the discharge as much
    for (const auto& drawn : std::vector<std::function<std::string(Draw&)>>{dam, slope, boxInSpace})
        for (unsigned seed = 1; seed <= kDraws; ++seed) {
            CAPTURE(seed);
            Draw draw(seed);
            const std::string text = drawn(draw);
            CAPTURE(text);
            Model model = modelOf(text);
            const SteadyFlow found = solved(model);
            model.flow->viscosity *= kMoved;
            const SteadyFlow moved = solved(model);
            CHECK(moved.inflow_sum == doctest::Approx(found.inflow_sum).epsilon(1e-8));
            CHECK(moved.highest_surface == doctest::Approx(found.highest_surface).epsilon(1e-6));
        }
}
