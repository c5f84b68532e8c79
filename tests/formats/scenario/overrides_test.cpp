// Values put into a model are the same as values put into the file: every field, and every joint that follows
// another.

#include "talus/formats/overrides.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "formats/scenario/scenario_texts.h"
#include "scenario/read_document.h"
#include "toml/document.h"
#include "toml/field_path.h"

namespace talus::formats {

namespace {

void checkSame(const Joint& a, const Joint& b) {
    CAPTURE(a.name);
    CHECK(a.name == b.name);
    CHECK((a.law == b.law));
    CHECK(a.shear_strength == b.shear_strength);
    for (const JointProperty& property : kJointProperties) {
        CAPTURE(property.key);
        CHECK(a.*property.value == b.*property.value);
    }
}

/// All that an override may touch, to the bit.
void checkSame(const Model& a, const Model& b) {
    REQUIRE(a.joints.size() == b.joints.size());
    for (std::size_t j = 0; j < a.joints.size(); ++j) checkSame(a.joints[j], b.joints[j]);
    REQUIRE(a.pair_joints.size() == b.pair_joints.size());
    for (std::size_t p = 0; p < a.pair_joints.size(); ++p) {
        const PairJoint &x = a.pair_joints[p], &y = b.pair_joints[p];
        CHECK(std::tie(x.block_a, x.block_b, x.joint, x.must_touch, x.field) ==
              std::tie(y.block_a, y.block_b, y.joint, y.must_touch, y.field));
    }
    REQUIRE(a.blocks.size() == b.blocks.size());
    for (std::size_t k = 0; k < a.blocks.size(); ++k) {
        CHECK(a.blocks[k].density == b.blocks[k].density);
        CHECK(a.blocks[k].face_joint == b.blocks[k].face_joint);
    }
    REQUIRE(a.waters.size() == b.waters.size());
    for (std::size_t w = 0; w < a.waters.size(); ++w) {
        REQUIRE(a.waters[w].level.size() == b.waters[w].level.size());
        for (std::size_t k = 0; k < a.waters[w].level.size(); ++k)
            CHECK(a.waters[w].level[k].value == b.waters[w].level[k].value);
        CHECK(a.waters[w].head == b.waters[w].head);
        CHECK(a.waters[w].density == b.waters[w].density);
        CHECK(a.waters[w].drains_at_aperture == b.waters[w].drains_at_aperture);
        CHECK(a.waters[w].opening == b.waters[w].opening);
        CHECK(a.waters[w].overflow == b.waters[w].overflow);
        REQUIRE(a.waters[w].inflow.size() == b.waters[w].inflow.size());
        for (std::size_t k = 0; k < a.waters[w].inflow.size(); ++k)
            CHECK(a.waters[w].inflow[k].value == b.waters[w].inflow[k].value);
        REQUIRE(a.waters[w].rain.size() == b.waters[w].rain.size());
        for (std::size_t k = 0; k < a.waters[w].rain.size(); ++k)
            CHECK(a.waters[w].rain[k].value == b.waters[w].rain[k].value);
        CHECK(a.waters[w].catchment == b.waters[w].catchment);
        CHECK(a.waters[w].leak_aperture == b.waters[w].leak_aperture);
        CHECK(a.waters[w].leak_length == b.waters[w].leak_length);
    }
    CHECK(a.gravity.tilt == b.gravity.tilt);
    CHECK(a.gravity.magnitude == b.gravity.magnitude);
    CHECK(a.analysis.start == b.analysis.start);
    CHECK(a.analysis.stop == b.analysis.stop);
    CHECK(a.damping.contact == b.damping.contact);
    CHECK(a.damping.local == b.damping.local);
}

/// The scenario with the value in its file.
Scenario rewritten(const std::string& text, const std::vector<std::pair<std::string, double>>& values) {
    auto document = toml::Document::parse(text, "written.toml");
    REQUIRE(document.ok());
    for (const auto& [field, value] : values) {
        const std::string& name = field;
        CAPTURE(name);
        REQUIRE_FALSE(document->set(*toml::parseField(field), value, true).has_value());
    }
    const auto scenario = scenario::readDocument(*document, "", "written.toml");
    for (const Error& error : scenario.errors()) FAIL_CHECK(format(error));
    REQUIRE(scenario.ok());
    return *scenario;
}

/// In any order: the reader goes by the file, overrides by the order in which they come.
std::string listOf(std::vector<std::string> warnings) {
    std::sort(warnings.begin(), warnings.end());
    std::string list;
    for (const std::string& warning : warnings) list += warning + "\n";
    return list;
}

void checkOverrides(const std::string& text, const std::vector<std::pair<std::string, double>>& values) {
    Scenario scenario = readGood(text);
    for (const auto& [field, value] : values) {
        const std::string& name = field;
        CAPTURE(name);
        CHECK(canOverride(scenario, field));
        CHECK(applyOverride(scenario, field, value));
    }
    const Scenario read = rewritten(text, values);
    checkSame(scenario.model, read.model);
    CHECK(listOf(scenario.warnings) == listOf(read.warnings));
}

/// In the middle of what the property may be: as it stands, times 1e9 for stiffnesses, or over 100 for
/// shares.
double allowedValue(const JointProperty& property, double value) {
    if (property.allowed.contains(value)) return value;
    return property.allowed.max == 1 ? 0.01 * value : 1e9 * value;
}

/// Joints that follow others in every way there is, and waters of every kind.
std::string slope() {
    return joint("weak", "friction_deg = 22\nresidual_friction_deg = 15\ncohesion = 7") +
           joint("default", "friction_deg = 30") + joint("bed", "friction_deg = 25") + material() +
           "[material.marl]\ndensity = 2300.0\n" +
           stack(
               "row_material = [\"granite\", \"marl\"]\nmaterial = \"marl\"\nbed_joint = \"bed\"\n"
               "bed_friction_deg = [20, 25]\n") +
           "[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoint = \"weak\"\ncohesion = 10\n"
           "[[interface]]\nbetween = [\"c2r1s1\", \"c3r1s1\"]\njoint = \"default\"\nfriction_deg = 12.5\n"
           "[[interface]]\nbetween = [\"c1r2s1\", \"c2r2s1\"]\njoint = \"default\"\n"
           "[[water]]\nfissure = 1\ndepth = 0.05\n"
           "[[water]]\nfissure = 2\nelevation = 0.04\ndensity = 1010\n"
           "[[water]]\nbetween = [\"c1r1s1\", \"floor\"]\nhead = [0.1, 0.02]\n"
           "[[water]]\nfissure = 3\nlevels = [[0, 0.01], [1, 0.02]]\n";
}

}  // namespace

TEST_CASE("warnings are those of the values put in, not of those of the file") {
    const std::string text = joint("default", "friction_deg = 30\ncohesion = 7\nresidual_cohesion = 5") +
                             material() + stack() + "[[water]]\nfissure = 1\ndepth = 0.05\n";
    REQUIRE(readGood(text).warnings.empty());
    const std::string cohesion = "joint.default.cohesion", density = "water[0].density";
    for (const auto& values : std::vector<std::vector<std::pair<std::string, double>>>{
             {{cohesion, 3}}, {{cohesion, 3}, {cohesion, 4}}, {{density, 1}}, {{density, 1}, {density, 2}}}) {
        Scenario scenario = readGood(text);
        for (const auto& [field, value] : values) CHECK(applyOverride(scenario, field, value));
        CHECK(scenario.warnings.size() == 1);
        checkOverrides(text, values);
    }
    checkOverrides(text, {{cohesion, 3}, {cohesion, 8}, {density, 1}, {density, 1020}});
}

TEST_CASE("each property of each joint, alone and after others") {
    for (const std::string name : {"weak", "default", "bed"})
        for (const JointProperty& property : kJointProperties) {
            if (name == "bed" && property.value == &Joint::friction) continue;
            if (!property.laws.has(StrengthLaw::coulomb)) continue;
            const std::string field = "joint." + name + "." + std::string(property.key);
            CAPTURE(field);
            checkOverrides(slope(), {{field, allowedValue(property, 17.3)}});
            checkOverrides(slope(),
                           {{"joint.default.friction_deg", 31.7}, {field, allowedValue(property, 0.7)}});
            checkOverrides(slope(), {{field, allowedValue(property, 11.1)},
                                     {"joint.default.residual_friction_deg", 9.9}});
        }
}

TEST_CASE("each number of each law, and of entries that follow the joint") {
    const std::string text =
        joint("default", "law = \"barton-bandis\"\njrc = 8\njcs = 5e7\nresidual_friction_deg = 28") +
        joint("table", "law = \"envelope\"\nshear_strength = [[0, 0], [1e5, 9e4], [1e6, 6e5]]") +
        joint("power", "law = \"power\"\na = 1.2\nb = 0.8") + material() + stack("bed_joint = \"power\"\n") +
        "[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoint = \"default\"\njrc = 3\n"
        "[[interface]]\nbetween = [\"c2r1s1\", \"c3r1s1\"]\njoint = \"table\"\nstrength_factor = 0.5\n";
    for (const Joint& of : readGood(text).model.joints)
        for (const JointProperty& property : kJointProperties) {
            const std::string field = "joint." + of.name + "." + std::string(property.key);
            CAPTURE(field);
            Scenario scenario = readGood(text);
            const bool is_named = of.name.find('@') == std::string::npos;
            CHECK(canOverride(scenario, field) == (is_named && property.laws.has(of.law)));
            if (canOverride(scenario, field)) checkOverrides(text, {{field, allowedValue(property, 0.7)}});
        }
}

TEST_CASE("materials, gravity, damping and water") {
    checkOverrides(slope(), {{"material.marl.density", 2345.6}, {"material.granite.density", 2700.1}});
    checkOverrides(slope(), {{"gravity.tilt_deg", 12.34}, {"gravity.magnitude", 9.80665}});
    checkOverrides(slope(), {{"gravity.tilt_deg", 50}});  // the search's end follows
    checkOverrides("[analysis]\nstop_deg = 40\n" + slope(), {{"gravity.tilt_deg", 39}});
    checkOverrides("[analysis]\nstart_deg = 3\n" + slope(), {{"gravity.tilt_deg", 50}});
    checkOverrides(slope(), {{"damping.contact", 1e-6}, {"damping.local", 0.3}});
    checkOverrides(slope(), {{"water[0].depth", 0.0123}, {"water[1].elevation", 0.031}});
    checkOverrides(slope(), {{"water[2].head[0]", 0.2}, {"water[2].head[1]", 0.0}});
    checkOverrides(slope() +
                       "[[water]]\nfissure = 3\nbase = 0.05\ndepth = 0.01\nvolume = \"closed\"\n"
                       "opening = 0.002\ninflow = 1e-3\noverflow = 0.02\nrain = 10\ncatchment = 5\n"
                       "leak_aperture = 1e-4\nleak_length = 3\n",
                   {{"water[4].opening", 0.003},
                    {"water[4].inflow", 2e-3},
                    {"water[4].overflow", 0.03},
                    {"water[4].rain", 25},
                    {"water[4].catchment", 7},
                    {"water[4].leak_aperture", 2e-4},
                    {"water[4].leak_length", 4}});
    checkOverrides(slope(), {{"water[1].density", 1030}, {"water[3].drains_at_aperture", 0.001}});
}

TEST_CASE("what a model does not hold as it is needs the reader, and so does what is not allowed") {
    Scenario scenario = readGood("[analysis]\nstop_deg = 40\n" + slope());
    const Model before = scenario.model;
    for (const char* field :
         {"stack[0].columns", "run.duration_s", "joint.none.cohesion", "joint.default.fricton_deg",
          "joint.bed.friction_deg", "water[3].depth", "water[0].elevation", "water[9].depth",
          "water[2].head[2]", "water[0].base", "material.sand.density", "gravity.tilt", "water[0", "",
          "joint.default@20deg.cohesion", "analysis.stop_deg", "water[0].opening", "water[0].inflow",
          "water[0].overflow"}) {
        CAPTURE(field);
        CHECK_FALSE(canOverride(scenario, field));
        CHECK_FALSE(applyOverride(scenario, field, 1));
    }
    CHECK_FALSE(applyOverride(scenario, "joint.default.friction_deg", 90));
    CHECK_FALSE(applyOverride(scenario, "joint.default.cohesion", -1));
    CHECK_FALSE(applyOverride(scenario, "joint.default.cohesion", kInfinity));
    CHECK_FALSE(applyOverride(scenario, "water[0].depth", -0.1));
    CHECK_FALSE(applyOverride(scenario, "gravity.tilt_deg", 40));  // where the search is to stop
    CHECK_FALSE(overridePairs(scenario, {{1, 5, 1, *jointProperty("cohesion"), -1}}));
    checkSame(scenario.model, before);
}

TEST_CASE("pairs get joints of their own as from [[interface]] tables") {
    Scenario scenario = readGood(slope());
    const auto blockOf = [&](const std::string& name) {
        for (std::size_t b = 0; b < scenario.model.blocks.size(); ++b)
            if (scenario.model.blocks[b].name == name) return static_cast<std::int32_t>(b);
        return -1;
    };
    const std::size_t friction = *jointProperty("friction_deg"), cohesion = *jointProperty("cohesion");
    // Two properties of a new pair, one of an entry that had none of its own, and one more new pair.
    REQUIRE(overridePairs(scenario, {{blockOf("c1r1s2"), blockOf("c2r1s2"), 1, friction, 21.3},
                                     {blockOf("c1r1s2"), blockOf("c2r1s2"), 1, cohesion, 33},
                                     {blockOf("c1r2s1"), blockOf("c2r2s1"), 1, friction, 19.1},
                                     {blockOf("c2r2s1"), blockOf("c3r2s1"), 0, friction, 5}}));
    const Scenario read = readGood([&] {
        std::string text = slope();
        const std::string plain = "between = [\"c1r2s1\", \"c2r2s1\"]\njoint = \"default\"\n";
        text.insert(text.find(plain) + plain.size(), "friction_deg = 19.1\n");
        return text;
    }() + "[[interface]]\nbetween = [\"c1r1s2\", \"c2r1s2\"]\njoint = \"default\"\nfriction_deg = "
          "21.3\ncohesion = "
          "33\n"
          "[[interface]]\nbetween = [\"c2r2s1\", \"c3r2s1\"]\njoint = \"weak\"\nfriction_deg = 5\n");
    checkSame(scenario.model, read.model);
    // A joint that others were made from still leads them.
    REQUIRE(applyOverride(scenario, "joint.default.tensile_strength", 4));
    for (const Joint& own : scenario.model.joints)
        if (own.name.starts_with("default")) CHECK(own.tensile_strength == 4);
}

}  // namespace talus::formats
