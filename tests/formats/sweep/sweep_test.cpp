// Sweep files: what they say, what is wrong with them, and the scenarios their runs are.

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "formats/scenario/scenario_texts.h"
#include "formats/sweep/sweep_file.h"
#include "support/files.h"
#include "talus/formats/sweep.h"
#include "toml/document.h"
#include "toml/write_document.h"

namespace talus::formats {

namespace {

using test::TemporaryFolder;
constexpr double kDeg = 3.14159265358979323846 / 180;

const std::string kHead = "scenario = \"slope.toml\"\nanalysis = \"critical-angle\"\n";  // 2 lines

double realAt(const SweepRun& run, std::size_t column) { return std::get<double>(run.values[column]); }

std::string random(const std::string& field, const std::string& more) {
    return "[[random]]\nfield = \"" + field + "\"\n" + more + "\n";
}

const std::string kUniform = "distribution = \"uniform\"\nmin = 18\nmax = 21";

Scenario scenarioAt(const Sweep& sweep, std::uint64_t index) {
    auto sampled = scenarioOf(sweep, runOf(sweep, index));
    for (const Error& error : sampled.errors()) FAIL_CHECK(format(error));
    REQUIRE(sampled.ok());
    return sampled->scenario;
}

}  // namespace

TEST_CASE("grids multiply, the last one fastest, and their values reach the model") {
    const SweepFile file(kHead +
                         "[[grid]]\nfield = \"gravity.tilt_deg\"\nvalues = [1, 2.5]\n"
                         "[[grid]]\nfield = \"stack[0].columns\"\nfrom = 2\nto = 6\nstep = 2\n");
    const Sweep sweep = file.read();
    REQUIRE(sweep.runs() == 6);
    const std::vector<std::size_t> blocks = {9, 17, 25};  // columns x 2 x 2, and the floor
    for (std::uint64_t run = 0; run < 6; ++run) {
        const Model model = scenarioAt(sweep, run).model;
        CHECK(model.gravity.tilt == doctest::Approx((run < 3 ? 1 : 2.5) * kDeg));
        CHECK(model.blocks.size() == blocks[run % 3]);
    }
    CHECK(sweep.columns[0].unit == "deg");
}

TEST_CASE("a span with a count ends on both ends") {
    const SweepFile file(kHead + "[[grid]]\nfield = \"water[0].depth\"\nfrom = 0.01\nto = 0.09\ncount = 5\n");
    const Sweep sweep = file.read();
    REQUIRE(sweep.runs() == 5);
    CHECK(realAt(runOf(sweep, 0), 0) == 0.01);
    CHECK(realAt(runOf(sweep, 2), 0) == doctest::Approx(0.05));
    CHECK(realAt(runOf(sweep, 4), 0) == 0.09);
    CHECK(scenarioAt(sweep, 4).model.waters[0].level[0].value == 0.09);
}

TEST_CASE("integers are whole in the scenario, from the least to the greatest") {
    const SweepFile file(kHead + "samples = 200\n" +
                         random("stack[0].columns", "distribution = \"integer\"\nmin = 2\nmax = 4"));
    const Sweep sweep = file.read();
    std::map<std::int64_t, int> counts;
    for (std::uint64_t run = 0; run < 200; ++run)
        ++counts[std::get<std::int64_t>(runOf(sweep, run).values[0])];
    REQUIRE(counts.size() == 3);
    for (const auto& [columns, count] : counts) {
        CHECK(columns >= 2);
        CHECK(columns <= 4);
        CHECK(std::abs(count - 200.0 / 3) < 3 * std::sqrt(200 * 2.0 / 9));
    }
    const std::int64_t columns = std::get<std::int64_t>(runOf(sweep, 5).values[0]);
    CHECK(scenarioAt(sweep, 5).model.blocks.size() == static_cast<std::size_t>(columns) * 4 + 1);
}

TEST_CASE("a table of cases comes from a CSV file, with names, quotes and comments") {
    SweepFile file(kHead + "[table]\nfile = \"cases.csv\"\n");
    file.folder.write("cases.csv",
                      "# two cases\nname; gravity.tilt_deg; stack[0].columns; contact.points\n"
                      "\"one; dry\";1.5;2;corner\n\n  two ;2.5; 3 ;quarter\r\n");
    const Sweep sweep = file.read();
    REQUIRE(sweep.runs() == 2);
    CHECK(sweep.case_names == std::vector<std::string>{"one; dry", "two"});
    CHECK(scenarioAt(sweep, 0).model.points.kind == PointRule::Kind::corner);
    CHECK(scenarioAt(sweep, 1).model.blocks.size() == 13);
}

TEST_CASE("a sample is the same whatever else varies, and each case meets the same samples") {
    const SweepFile one(kHead + "samples = 50\nseed = 3\n" + random("joint.default.friction_deg", kUniform));
    const SweepFile two(
        kHead + "samples = 90\nseed = 3\n[[grid]]\nfield = \"water[0].depth\"\nvalues = [0.01, 0.02]\n" +
        random("joint.default.cohesion", kUniform) + random("joint.default.friction_deg", kUniform));
    const Sweep a = one.read(), b = two.read();
    std::set<double> drawn;
    for (std::uint64_t sample = 0; sample < 50; ++sample) {
        const double value = realAt(runOf(a, sample), 0);
        CHECK(value >= 18);
        CHECK(value <= 21);
        CHECK(realAt(runOf(b, 2 * sample), 2) == value);
        CHECK(realAt(runOf(b, 2 * sample + 1), 2) == value);
        CHECK(realAt(runOf(b, 2 * sample), 1) != value);
        drawn.insert(value);
    }
    CHECK(drawn.size() == 50);
    CHECK(scenarioAt(a, 7).model.joints[0].friction == doctest::Approx(realAt(runOf(a, 7), 0) * kDeg));
}

TEST_CASE("samples are fixed for all time: seed 1") {
    // Computed once; a change means that every batch ever recorded can no longer be repeated.
    const SweepFile file(
        kHead + "samples = 3\n" + random("joint.default.friction_deg", kUniform) +
        random("joint.default.cohesion", "distribution = \"lognormal\"\nmean = 500\nsd = 200") +
        random("material.granite.density",
               "distribution = \"beta\"\nalpha = 2\nbeta = 3\nmin = 2600\nmax = 2800"));
    const Sweep sweep = file.read();
    CHECK(realAt(runOf(sweep, 0), 0) == 19.977069385356945);
    CHECK(realAt(runOf(sweep, 2), 0) == 20.27980646733677);
    CHECK(realAt(runOf(sweep, 0), 1) == 293.74921048678556);
    CHECK(realAt(runOf(sweep, 1), 2) == 2663.9590308055763);
}

TEST_CASE("draws per joint are independent, one for all joints is not") {
    const std::string scenario = properties() + joint("weak") + stack("bed_joint = \"weak\"\n");
    const SweepFile each(
        kHead + "samples = 4\n" + random("joint.*.friction_deg", "per = \"joint\"\n" + kUniform), scenario);
    const Sweep sweep = each.read();
    REQUIRE(sweep.columns.size() == 2);
    CHECK(sweep.columns[1].name == "joint.weak.friction_deg");
    CHECK(realAt(runOf(sweep, 0), 0) != realAt(runOf(sweep, 0), 1));
    const SweepFile all(kHead + "samples = 4\n" + random("joint.*.friction_deg", kUniform), scenario);
    const Model model = scenarioAt(all.read(), 2).model;
    CHECK(model.joints[0].friction == model.joints[1].friction);
}

TEST_CASE("draws per interface: each pair its own, the same pair the same in a larger slope") {
    const std::string draws = random("joint.default.friction_deg", "per = \"interface\"\n" + kUniform);
    const SweepFile file(kHead + "samples = 3\n[[grid]]\nfield = \"stack[0].columns\"\nvalues = [2, 3]\n" +
                         draws);
    const Sweep sweep = file.read();
    const auto small = scenarioOf(sweep, runOf(sweep, 0)), large = scenarioOf(sweep, runOf(sweep, 1));
    REQUIRE(small.ok());
    REQUIRE(large.ok());
    // Columns x 2 x 2 blocks: between columns 4, beds 4 a column, between slices 2 a column.
    CHECK(small->drawn.at(0).interfaces == 4 + 8 + 4);
    CHECK(large->drawn.at(0).interfaces == 8 + 12 + 6);
    CHECK(small->drawn[0].min >= 18);
    CHECK(small->drawn[0].max <= 21);
    std::map<std::pair<std::string, std::string>, double> friction;
    const auto strengthOf = [](const Model& model, const PairJoint& pair) {
        return model.joints[static_cast<std::size_t>(pair.joint)].friction / kDeg;
    };
    const auto names = [](const Model& model, const PairJoint& pair) {
        return std::pair(model.blocks[static_cast<std::size_t>(pair.block_a)].name,
                         model.blocks[static_cast<std::size_t>(pair.block_b)].name);
    };
    double sum = 0;
    std::set<double> distinct;
    for (const PairJoint& pair : small->scenario.model.pair_joints) {
        friction[names(small->scenario.model, pair)] = strengthOf(small->scenario.model, pair);
        sum += strengthOf(small->scenario.model, pair);
        distinct.insert(strengthOf(small->scenario.model, pair));
    }
    CHECK(distinct.size() == 16);
    CHECK(sum / 16 == doctest::Approx(small->drawn[0].mean));
    int shared = 0;
    for (const PairJoint& pair : large->scenario.model.pair_joints)
        if (const auto same = friction.find(names(large->scenario.model, pair)); same != friction.end()) {
            CHECK(same->second == strengthOf(large->scenario.model, pair));
            ++shared;
        }
    CHECK(shared == 16);
}

TEST_CASE("a sample written back reads as the same model, ties between joints included") {
    const std::string scenario =
        "# weak comes first and wins ties\n" + joint("weak", "friction_deg = 30") + joint() + material() +
        "[joint.\"odd \\\"name\"]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 12\n" +
        stack("heights = [1, 2, 2]\nbed_friction_deg = [20, 21.5]\n") +
        "[[water]]\nfissure = 1\nlevels = [[0, 0.01], [1, 0.02]]\n" +
        "[[block]]\nname = \"far\"\nbox = { min = [0, 3, 0], max = [1, 4, 1] }\njoint = "
        "\"weak\"\nvelocity = [0, 0, 1]\n"
        "[[interface]]\nbetween = [\"c1r1s1\", \"c2r1s1\"]\njoint = \"weak\"\ncohesion = 10\n";
    const SweepFile file(kHead + "samples = 2\n" +
                             random("joint.default.friction_deg", "per = \"interface\"\n" + kUniform) +
                             "[[grid]]\nfield = \"gravity.tilt_deg\"\nvalues = [0.1]\n",
                         scenario);
    const Sweep sweep = file.read();
    const Model model = scenarioAt(sweep, 1).model;
    const auto written = scenarioTextOf(sweep, runOf(sweep, 1));
    REQUIRE(written.ok());
    const Model again = readGood(*written).model;
    REQUIRE(again.joints.size() == model.joints.size());
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
        CHECK(again.joints[j].name == model.joints[j].name);
        CHECK(again.joints[j].friction == model.joints[j].friction);
        CHECK(again.joints[j].cohesion == model.joints[j].cohesion);
        CHECK(again.joints[j].residual_friction == model.joints[j].residual_friction);
    }
    REQUIRE(again.pair_joints.size() == model.pair_joints.size());
    for (std::size_t p = 0; p < model.pair_joints.size(); ++p) {
        CHECK(again.pair_joints[p].block_a == model.pair_joints[p].block_a);
        CHECK(again.pair_joints[p].joint == model.pair_joints[p].joint);
    }
    REQUIRE(again.blocks.size() == model.blocks.size());
    for (std::size_t b = 0; b < model.blocks.size(); ++b) {
        CHECK(again.blocks[b].name == model.blocks[b].name);
        CHECK(again.blocks[b].face_joint == model.blocks[b].face_joint);
        CHECK(again.blocks[b].shape.vertices == model.blocks[b].shape.vertices);
    }
    CHECK(again.gravity.tilt == model.gravity.tilt);
    CHECK(again.waters[0].level.size() == 2);
    // And written once more it is the same text.
    const auto document = toml::Document::parse(*written, "");
    REQUIRE(document.ok());
    CHECK(toml::writeDocument(*document) == *written);
}

TEST_CASE("the identity changes with what decides the runs, and with nothing else") {
    const std::string draws = random("joint.default.friction_deg", kUniform);
    const auto identity = [](const std::string& text, const std::string& scenario = slope()) {
        return identityOf(SweepFile(text, scenario).read());
    };
    const std::string base = identity(kHead + "samples = 3\n" + draws);
    CHECK(identity("# a remark\n" + kHead + "samples = 3\n" + draws + "[report]\ntilt_deg = [3]\n",
                   "# one\n" + slope()) == base);
    CHECK(identity(kHead + "samples = 4\n" + draws) == base);
    CHECK(identity(kHead + "samples = 3\nseed = 2\n" + draws) != base);
    CHECK(identity(kHead + "range = false\nsamples = 3\n" + draws) == base);
    CHECK(identity(kHead + "range = true\nsamples = 3\n" + draws) != base);
    CHECK(identity(kHead + "samples = 3\nsampling = \"latin-hypercube\"\n" + draws) != base);
    CHECK(identity(kHead + "samples = 3\n" +
                   random("joint.default.friction_deg",
                          "distribution = \"uniform\"\nmin = 18\nmax = 21.5")) != base);
    CHECK(identity(kHead + "samples = 3\n" + draws, slope() + "density = 1001\n") != base);
    CHECK(identity("scenario = \"slope.toml\"\nanalysis = \"safety-factor\"\nsamples = 3\n" + draws) != base);
}

TEST_CASE("every fault of a sweep names its place") {
    const auto fault = [](const std::string& text) { return SweepFile(text).fault(); };
    const std::string grid = kHead + "[[grid]]\nfield = \"water[0].depth\"\n";  // 4 lines
    CHECK(fault("analysis = \"critical-angle\"\n").find("scenario: missing") != std::string::npos);
    CHECK(fault("scenario = \"none.toml\"\nanalysis = \"run\"\n").find("none.toml:0:0 : cannot be opened") ==
          0);
    CHECK(fault("scenario = \"slope.toml\"\nanalysis = \"walk\"\n") ==
          "sweep.toml:2:12 analysis: found \"walk\", allowed: \"critical-angle\", \"safety-factor\", "
          "\"critical-acceleration\", \"run\"");
    CHECK(
        fault(grid + "values = [0.1, \"deep\"]\n")
            .find("sweep.toml:5:16 grid[0]: gives a scenario with water[0].depth: found a string \"deep\"") ==
        0);
    CHECK(fault(grid + "values = [0.1, -0.5]\n")
              .find("sweep.toml:5:16 grid[0]: gives a scenario with water[0].depth: found -0.5") == 0);
    CHECK(fault(grid + "values = []\n").find("sweep.toml:5:10 grid[0].values: found an empty list") == 0);
    CHECK(fault(grid + "from = 0.1\nto = 0.2\n").find("sweep.toml:3:1 grid[0].count: found neither") == 0);
    CHECK(fault(grid + "from = 0.1\nto = 0.2\nstep = -0.1\n")
              .find("sweep.toml:7:8 grid[0].step: found a step of -0.1") == 0);
    CHECK(fault(grid + "values = [0.01]\n[[grid]]\nfield = \"water[0].depth\"\nvalues = [0.02]\n")
              .find("sweep.toml:7:9 grid[1].field: found \"water[0].depth\" again") == 0);
    CHECK(
        fault(kHead + "[[grid]]\nfield = \"water[3].depth\"\nvalues = [0.02]\n")
            .find("sweep.toml:5:11 grid[0]: gives a scenario with water[3].depth: there is no element [3]") ==
        0);
    CHECK(fault(kHead + "[[grid]]\nfield = \"joint.default.fricton_deg\"\nvalues = [20]\n")
              .find("sweep.toml:5:11 grid[0]: gives a scenario with joint.default.fricton_deg: found an "
                    "unknown key") == 0);
    CHECK(fault(kHead + "[[grid]]\nfield = \"joint.defalt.friction_deg\"\nvalues = [20]\n") ==
          "sweep.toml:4:9 grid[0].field: found the unknown joint \"defalt\", did you mean \"default\"?");
    CHECK(fault(kHead + "samples = 2\n" + random("material.granit.density", kUniform)) ==
          "sweep.toml:5:9 random[0].field: found the unknown material \"granit\", did you mean \"granite\"?");
    CHECK(fault(kHead + "[[grid]]\nfield = \"water[0\"\nvalues = [20]\n")
              .find("sweep.toml:4:9 grid[0].field: found \"water[0\", allowed: the path") == 0);
    for (const std::string path : {"]", "a]", "water]", "water[0]]", "joint.default.friction_deg]", "a]b.c",
                                   "water[0]x", "a..b", "a.", ".a", "[0]", "water[-1].depth"}) {
        const std::string found = fault(kHead + "[[grid]]\nfield = \"" + path + "\"\nvalues = [20]\n");
        CHECK(found.find("sweep.toml:4:9 grid[0].field: found \"" + path + "\", allowed: the path") == 0);
    }
    CHECK(fault(kHead + random("joint.default.friction_deg", kUniform)).find("samples: missing") !=
          std::string::npos);
    CHECK(fault(kHead + "seed = 1\n" + grid.substr(kHead.size()) + "values = [0.02]\n")
              .find("sweep.toml:3:8 seed: found without [[random]]") == 0);
    const std::string some = kHead + "samples = 2\n";  // 3 lines
    CHECK(fault(some + random("joint.default.friction_deg", "distribution = \"uniform\"\nmin = 18\nmax = 17"))
              .find("sweep.toml:8:7 random[0].max: found 17, allowed: more than min, 18") == 0);
    CHECK(
        fault(some + random("joint.default.friction_deg", "distribution = \"uniform\"\nmin = 18\nmax = 95"))
            .find(
                "sweep.toml:5:9 random[0]: gives a scenario with joint.default.friction_deg: found 94.99") ==
        0);
    CHECK(fault(some + random("stack[0].columns", "distribution = \"integer\"\nmin = 2\nmax = 4.5"))
              .find("sweep.toml:8:7 random[0].max: found 4.5 in an integer distribution, allowed: a whole "
                    "number up to 1e+09") == 0);
    CHECK(fault(some + random("joint.default.friction_deg",
                              "distribution = \"normal\"\nmean = 18\nsd = 2\nmax = 20"))
              .find("sweep.toml:9:7 random[0].max: found in a normal distribution") == 0);
    CHECK(
        fault(some + random("water[0].depth", "per = \"interface\"\n" + kUniform))
            .find("sweep.toml:6:7 random[0].per: found draws per joint or interface of \"water[0].depth\"") ==
        0);
}

TEST_CASE("a faulty table of cases names its line and column") {
    SweepFile file(kHead + "[table]\nfile = \"cases.csv\"\n");
    file.folder.write("cases.csv", "gravity.tilt_deg,water[0].depth\n1,0.01\n2,\n");
    CHECK(file.fault() == "cases.csv:3:3 : found an empty cell, allowed: a value");
    file.folder.write("cases.csv", "gravity.tilt_deg,material.granit.density\n1,2600\n");
    CHECK(file.fault() ==
          "cases.csv:1:18 material.granit.density: found the unknown material \"granit\", did "
          "you mean \"granite\"?");
    file.folder.write("cases.csv", "gravity.tilt_deg,water[0].depth\n1,0.01\n2\n");
    CHECK(file.fault() == "cases.csv:3:1 : found 1 values, allowed: one per column, 2");
    file.folder.write("cases.csv", "gravity.tilt_deg,water[0].depth\n1,0.01\n2,-0.01\n");
    CHECK(file.fault().find(
              "cases.csv:3:3 water[0].depth: gives a scenario with water[0].depth: found -0.01") == 0);
    file.folder.write("cases.csv", "gravity.tilt_deg\n");
    CHECK(file.fault().find("cases.csv:0:0 : found no cases") == 0);
}

}  // namespace talus::formats
