// Fields that are given other values than the file has: talus::formats::readScenario with changes, `--set` in
// commands.

#include <doctest/doctest.h>

#include "support/files.h"
#include "support/properties.h"
#include "talus/formats/changes.h"

using namespace talus;
using namespace talus::formats;

namespace {

constexpr const char* kText =
    "[material.granite]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\n"
    "friction_deg = 30.0\n[[stack]]\ncolumns = 3\nrows = 2\nslices = 1\nblock = [0.2, 0.1, 0.1]\n[[water]]\n"
    "fissure = 1\ndepth = 0.1\n";

Result<Scenario> changed(const std::string& field, const std::string& value) {
    const test::TemporaryFile file("slope.toml", kText);
    return readScenario(file.path(), {{field, value}});
}

/// The first fault as people read it.
std::string fault(const std::string& field, const std::string& value) {
    const auto scenario = changed(field, value);
    REQUIRE_FALSE(scenario.ok());
    return format(scenario.errors().front());
}

}  // namespace

TEST_SUITE("scenario changes") {
    TEST_CASE("a changed field has its value, in the model and in the text that is kept") {
        const auto scenario = changed("joint.default.friction_deg", "25");
        REQUIRE(scenario.ok());
        CHECK(scenario->model.joints[0].friction == doctest::Approx(25.0 * 3.14159265358979 / 180));
        const auto again = parseScenario(scenario->text, "kept.toml");
        REQUIRE(again.ok());
        CHECK(again->model.joints[0].friction == scenario->model.joints[0].friction);
    }

    TEST_CASE("elements of arrays, fields and tables that the file leaves out, texts and booleans") {
        CHECK(changed("stack[0].columns", "5")->model.blocks.size() == 11);
        CHECK(changed("stack[0].block[2]", "0.2")->model.blocks.size() == 7);
        CHECK(changed("gravity.tilt_deg", "10")->model.gravity.tilt == doctest::Approx(0.174532925));
        CHECK(changed("contact.points", "corner")->model.points.kind == PointRule::Kind::corner);
        CHECK_FALSE(changed("analysis.time_scaling", "false")->model.analysis.time_scaling);
        CHECK(changed("material.\"granite\".density", "2500")->model.blocks[1].density == 2500);
    }

    TEST_CASE("arrays and tables as the file would have them, in the model and in the text that is kept") {
        const auto sized = changed("stack[0].block", "[0.4, 0.1, 0.2]");
        REQUIRE(sized.ok());
        CHECK(parseScenario(sized->text, "kept.toml")->model.blocks[1].shape.vertices ==
              sized->model.blocks[1].shape.vertices);
        CHECK(changed("run.watch", "[\"c1r2s1\", \"c2r1s1\"]")->model.run.watch.size() == 2);
        CHECK(changed("water", "[{ fissure = 2, depth = 0.05 }]")->model.waters.size() == 1);
        CHECK(fault("stack[0].block", "[0.4, 0.1]") ==
              "--set: error: stack[0].block: found an array of 2 values, allowed: an array of 3 numbers");
        CHECK(fault("stack[0].block", "[0.4, x]").starts_with("--set: error: stack[0].block: found "));
        CHECK(
            fault("stack[0].block", "[0.4, -1, 2]").starts_with("--set: error: stack[0].block[1]: found -1"));
    }

    TEST_CASE("a text in double quotes is read as the file's, escapes and all, alone as in an array") {
        const auto named = [](const std::string& value) {
            const auto scenario = changed("stack[0].name", value);
            REQUIRE(scenario.ok());
            return scenario->model.blocks[1].name;
        };
        CHECK(named("wall-").starts_with("wall-"));
        CHECK(named("\"wall-\"").starts_with("wall-"));
        CHECK(named("\"w\\u0061ll \\\"a\\\"-\"").starts_with("wall \"a\"-"));
        CHECK(named("w\\u0061ll-").starts_with("w\\u0061ll-"));
        CHECK(changed("run.watch", "[\"c1r\\u0032s1\"]")->model.run.watch[0] == "c1r2s1");
        for (const std::string open : {"\"wall", "\"wall\\q\"", "\"a\" \"b\"", "\""})
            CHECK(fault("stack[0].name", open).find("allowed: one array, table or text") !=
                  std::string::npos);
    }

    TEST_CASE("nothing behind a line break is dropped: it belongs to the value, or is a fault") {
        CHECK(changed("run.watch", "[\"c1r2s1\",\n \"c2r1s1\"]\n")->model.run.watch.size() == 2);
        for (const std::string more : {"\nwater = []", "\n[gravity]\ntilt_deg = 3", "\n3"}) {
            CAPTURE(more);
            CHECK(fault("run.watch", "[\"c1r2s1\"]" + more).starts_with("--set: error: run.watch: found "));
            CHECK(
                fault("stack[0].name", "\"wall\"" + more).starts_with("--set: error: stack[0].name: found "));
            CHECK(fault("joint.default.friction_deg", "25" + more)
                      .starts_with("--set: error: joint.default.friction_deg: found "));
        }
    }

    TEST_CASE("a joint or a material that the file does not have is named where it lacks what is required") {
        CHECK(fault("joint.defalt.friction_deg", "20") ==
              "--set: error: joint.defalt.friction_deg: found the unknown joint \"defalt\", did you mean "
              "\"default\"?");
        CHECK(fault("material.granit.density", "2500") ==
              "--set: error: material.granit.density: found the unknown material \"granit\", did you mean "
              "\"granite\"?");
    }

    TEST_CASE("a joint may be added whole, and faults elsewhere are said whatever was added") {
        const test::TemporaryFile file("slope.toml", kText);
        std::vector<FieldChange> wall{{"joint.wall.normal_stiffness", "1e9"},
                                      {"joint.wall.shear_stiffness", "1e9"},
                                      {"joint.wall.friction_deg", "20"},
                                      {"stack[0].joint", "wall"}};
        CHECK(readScenario(file.path(), wall).ok());
        wall.push_back({"stack[0].block", "[0.4, -1, 2]"});
        const auto wrong = readScenario(file.path(), wall);
        REQUIRE(wrong.errors().size() == 1);
        CHECK(format(wrong.errors()[0]).starts_with("--set: error: stack[0].block[1]: found -1"));
        wall[2].field = "joint.wal.friction_deg";
        std::string all;
        const auto both = readScenario(file.path(), wall);
        for (const Error& error : both.errors()) all += format(error) + "\n";
        CAPTURE(all);
        CHECK(all.find("found the unknown joint \"wal\"") != std::string::npos);
        CHECK(all.find("stack[0].block[1]: found -1") != std::string::npos);
    }

    TEST_CASE("any friction angle that is allowed arrives to the bit") {
        test::checkProperty("value of --set", 100, [] {
            const double value = *test::numberIn(0, 80);
            const auto scenario = changed("joint.default.friction_deg", std::to_string(value));
            RC_ASSERT(scenario.ok());
            const auto written = parseScenario(scenario->text, "written.toml");
            RC_ASSERT(written.ok());
            RC_ASSERT(written->model.joints[0].friction == scenario->model.joints[0].friction);
        });
    }

    TEST_CASE("faults name the option and the field, not a line of the file") {
        CHECK(fault("joint.default.friction_deg", "100")
                  .starts_with("--set: error: joint.default.friction_deg: found"));
        CHECK(fault("joint.default.friction_deg", "steep")
                  .starts_with("--set: error: joint.default.friction_deg: "));
        CHECK(fault("joint.default.frction_deg", "30").find("friction_deg") != std::string::npos);
        CHECK(fault("joint.default.frction_deg", "30")
                  .starts_with("--set: error: joint.default.frction_deg: found an unknown key "
                               "\"frction_deg\" (near \"friction_deg\", which has a value), allowed: "));
        CHECK(fault("joint.other.friction_deg", "30").starts_with("--set: error: joint.other"));
        CHECK(fault("water[4].depth", "1").starts_with("--set: error: water[4].depth: there is no"));
        CHECK(fault("water[", "1").starts_with("--set: error: water["));
        CHECK(fault("watr.depth", "1").starts_with("--set: error: watr"));
    }

    TEST_CASE("what the engine finds in a changed field is said of who changed it, in others of the file") {
        const auto scenario = changed("joint.default.friction_deg", "25");
        REQUIRE(scenario.ok());
        const auto told = placed(*scenario, {{"joint.default.friction_deg", "a"},
                                             {"joint.default.friction_deg[0]", "b"},
                                             {"joint.default.normal_stiffness", "c"}});
        CHECK(format(told[0]) == "--set: error: joint.default.friction_deg: a");
        CHECK(format(told[1]) == "--set: error: joint.default.friction_deg[0]: b");
        CHECK(told[2].file == scenario->path);
        CHECK(told[2].line == 4);
    }

    TEST_CASE("faults of other fields keep their line") {
        const test::TemporaryFile file("slope.toml", std::string(kText) + "depht = 3\n");
        const auto scenario = readScenario(file.path(), {{"gravity.tilt_deg", "3"}});
        REQUIRE_FALSE(scenario.ok());
        CHECK(scenario.errors().front().file == file.path());
        CHECK(scenario.errors().front().line == 15);
    }
}
