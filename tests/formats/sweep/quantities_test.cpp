// Whatever a scenario says of loads, bolts, earthquakes, water tables and laws of strength can be varied.

#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <iomanip>
#include <sstream>

#include "formats/scenario/scenario_texts.h"
#include "talus/formats/sweep.h"
#include "tools/program.h"

namespace talus::formats {

namespace {

const std::string kSlope = properties() +
                           R"(
[gravity]
direction = [-0.3, 0.0, -1.0]
[seismic]
horizontal = 0.01
[joint.rough]
law = "barton-bandis"
jrc = 8.0
jcs = 5e7
residual_friction_deg = 28.0
normal_stiffness = 1e10
shear_stiffness = 1e10
[joint.fitted]
law = "power"
a = 1.2
b = 0.8
normal_stiffness = 1e10
shear_stiffness = 1e10
[joint.measured]
law = "envelope"
shear_strength = [[0.0, 0.0], [1e5, 9e4]]
normal_stiffness = 1e10
shear_stiffness = 1e10
[[block]]
name = "floor"
box = { min = [-5, -5, -4], max = [5, 5, 0] }
fixed = true
[[block]]
name = "key"
box = { min = [0, 0, 0], max = [2, 2, 1] }
[[load]]
block = "key"
force = [0.0, 0.0, -5e3]
point = [1.0, 1.0, 1.0]
[[load]]
block = "key"
face = "+z"
pressure = 100.0
factor = [[0.0, 1.0], [1.0, 2.0]]
[[bolt]]
kind = "grouted"
head = [1.0, 1.0, 1.0]
end = [1.0, 1.0, -2.0]
area = 1e-4
modulus = 2e11
yield_force = 1e4
pretension = 1e3
bond_stiffness = 1e7
bond_strength = 1e4
shear_stiffness = 1e6
rupture_strain = 0.05
[[bolt_pattern]]
box = { min = [0, 0, 0.9], max = [2, 2, 1.1] }
face = "+z"
spacing = [1.0, 1.0]
length = 3.0
plunge_deg = 90
trend_deg = 0
kind = "anchored"
area = 1e-4
modulus = 2e11
yield_force = 1e4
[[water]]
surface = [[-5.0, 0.1], [5.0, 0.3]]
factor = 0.9
[ground_motion]
acceleration = [[0.0, 0.0, 0.0, 0.0], [1.0, 2.0, 0.0, 0.0]]
)";

struct Quantity {
    const char* field;
    double value;
    const char* unit;
    std::function<double(const Model&)> of;
};

const Joint& jointOf(const Model& model, const std::string& name) {
    return *std::find_if(model.joints.begin(), model.joints.end(),
                         [&](const Joint& joint) { return joint.name == name; });
}

const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all{
        {"gravity.direction[0]", -0.4, "", [](const Model& m) { return m.gravity.direction->x(); }},
        {"seismic.horizontal", 0.2, "", [](const Model& m) { return m.seismic.horizontal; }},
        {"seismic.vertical", 0.1, "", [](const Model& m) { return m.seismic.vertical; }},
        {"load[0].force[2]", -7e3, "N", [](const Model& m) { return m.loads[0].force.z(); }},
        {"load[0].point[0]", 0.5, "m", [](const Model& m) { return m.loads[0].point->x(); }},
        {"load[1].pressure", 300, "Pa", [](const Model& m) { return m.loads[1].pressure; }},
        {"load[1].factor[1][1]", 3, "", [](const Model& m) { return m.loads[1].factor[1].value; }},
        {"bolt[0].pretension", 2e3, "N", [](const Model& m) { return m.bolts[0].pretension; }},
        {"bolt[0].yield_force", 3e4, "N", [](const Model& m) { return m.bolts[0].yield_force; }},
        {"bolt[0].area", 2e-4, "m^2", [](const Model& m) { return m.bolts[0].area; }},
        {"bolt[0].modulus", 1e11, "Pa", [](const Model& m) { return m.bolts[0].modulus; }},
        {"bolt[0].bond_stiffness", 2e7, "N/m^2", [](const Model& m) { return m.bolts[0].bond_stiffness; }},
        {"bolt[0].bond_strength", 2e4, "N/m", [](const Model& m) { return m.bolts[0].bond_strength; }},
        {"bolt[0].shear_stiffness", 2e6, "N/m", [](const Model& m) { return m.bolts[0].shear_stiffness; }},
        {"bolt[0].rupture_strain", 0.01, "", [](const Model& m) { return m.bolts[0].rupture_strain; }},
        {"bolt[0].end[2]", -3, "m", [](const Model& m) { return m.bolts[0].end.z(); }},
        {"bolt_pattern[0].spacing[0]", 0.5, "m",
         [](const Model& m) { return 4.0 / double(m.bolts.size() - 1); }},
        {"bolt_pattern[0].length", 3.5, "m", [](const Model& m) { return 1 - m.bolts.back().end.z(); }},
        {"bolt_pattern[0].yield_force", 2e4, "N", [](const Model& m) { return m.bolts.back().yield_force; }},
        {"water[0].surface[1][1]", 0.5, "m", [](const Model& m) { return m.phreatic->line[1].z; }},
        {"water[0].factor", 0.5, "", [](const Model& m) { return m.phreatic->factor; }},
        {"water[0].drains_at_aperture", 0.002, "m",
         [](const Model& m) { return m.phreatic->drains_at_aperture; }},
        {"ground_motion.scale", 3, "",
         [](const Model& m) { return m.ground_motion.acceleration[1].x() / 2; }},
        {"ground_motion.acceleration[1][1]", 5, "m/s^2",
         [](const Model& m) { return m.ground_motion.acceleration[1].x(); }},
        {"joint.rough.jrc", 4, "", [](const Model& m) { return jointOf(m, "rough").jrc; }},
        {"joint.rough.jcs", 4e7, "Pa", [](const Model& m) { return jointOf(m, "rough").jcs; }},
        {"joint.fitted.a", 1.1, "Pa^(1-b)", [](const Model& m) { return jointOf(m, "fitted").a; }},
        {"joint.fitted.b", 0.7, "", [](const Model& m) { return jointOf(m, "fitted").b; }},
        {"joint.fitted.strength_factor", 0.7, "",
         [](const Model& m) { return jointOf(m, "fitted").strength_factor; }},
        {"joint.measured.shear_strength[1][1]", 5e4, "Pa",
         [](const Model& m) { return jointOf(m, "measured").shear_strength[1].shear_strength; }},
    };
    return all;
}

}  // namespace

TEST_CASE(
    "sweeps: loads, bolts, earthquakes, water tables and laws of strength are variables, each with its "
    "unit") {
    const tools::testing::TemporaryFolder folder;
    folder.write("slope.toml", kSlope);
    for (const Quantity& quantity : quantities()) {
        const std::string field = quantity.field;
        CAPTURE(field);
        const double ends[2] = {0.999 * quantity.value, 1.001 * quantity.value};
        std::ostringstream text;
        text << std::setprecision(17)
             << "scenario = \"slope.toml\"\nanalysis = \"safety-factor\"\nsamples = 2\n"
             << "[[random]]\nfield = \"" << quantity.field
             << "\"\ndistribution = \"uniform\"\nmin = " << std::min(ends[0], ends[1])
             << "\nmax = " << std::max(ends[0], ends[1]) << "\n";
        const auto sweep = readSweep(folder.write("sweep.toml", text.str()));
        for (const Error& error : sweep.errors()) FAIL_CHECK(format(error));
        if (!sweep.ok()) continue;
        CHECK(sweep->columns[0].unit == quantity.unit);
        const SweepRun run = runOf(*sweep, 1);
        const auto sampled = scenarioOf(*sweep, run);
        REQUIRE(sampled.ok());
        const double drawn = std::get<double>(run.values[0]);
        CHECK(drawn == doctest::Approx(quantity.value).epsilon(0.0011));
        // Of a spacing the number of bolts follows, which is whole.
        const double precision = field.find("spacing") == std::string::npos ? 1e-9 : 0.4;
        CHECK(quantity.of(sampled->scenario.model) == doctest::Approx(drawn).epsilon(precision));
    }
}

}  // namespace talus::formats
