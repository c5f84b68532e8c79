// [[fracture_set]]: what it draws, what it reads, and what is refused, where.

#include <algorithm>

#include "faults.h"
#include "support/files.h"
#include "talus/formats/fractures.h"
#include "talus/rock_mass.h"

namespace talus::formats {

namespace {

/// Keys of the set from line 10.
std::string rock(const std::string& keys, const std::string& more = "") {
    return properties() +
           "[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [8, 8, 8] } }\n[[fracture_set]]\n" + keys +
           more;
}

const std::string kF1 =
    "name = \"F1\"\ndip_deg = 35\ndip_direction_deg = 200\nfisher = 25\nradius_law = \"power\"\n"
    "radius_exponent = 2.5\nradius_min = 1\nradius_max = 4\np32 = 0.3\n";

}  // namespace

TEST_CASE("fracture sets: drawn to their P32, listed as joints of the rock mass, cut with their strength") {
    const Scenario scenario = readGood(rock(kF1, joint("F1", "friction_deg = 20")));
    const auto joints = rockJoints(scenario);
    REQUIRE(joints.ok());
    std::vector<Fracture> discs;
    for (const RockJoint& each : *joints) {
        CHECK(each.set == "F1");
        discs.push_back(*each.disc);
        CHECK((each.normal - upwardNormal(each.disc->dip, each.disc->dip_direction)).norm() < 1e-14);
    }
    const TriangleSurface region = *boxSurface(Vec3::Zero(), Vec3::Constant(8));
    CHECK(fractureIntensity(discs, region) == doctest::Approx(0.3).epsilon(0.02));
    CHECK(scenario.model.blocks.size() > 3);
    bool cut = false;
    for (const Block& block : scenario.model.blocks)
        cut = cut || std::count(block.face_joint.begin(), block.face_joint.end(), 1) > 0;
    CHECK(cut);
    CHECK(scenario.warnings.size() <= 2);  // one line for all discs, not one each
}

TEST_CASE("fracture sets: written to CSV and read again they are the same discs and cut the same blocks") {
    const test::TemporaryFolder folder;
    const Scenario drawn = readGood(rock(kF1));
    std::vector<std::pair<std::string, Fracture>> discs;
    for (const RockJoint& each : *rockJoints(drawn)) discs.emplace_back(each.set, *each.disc);
    const std::string file = folder.write("f.csv", "# by hand\n" + fracturesCsv(discs));
    const auto read = readFractures(file);
    REQUIRE(read.ok());
    REQUIRE(read->size() == discs.size());
    for (std::size_t k = 0; k < discs.size(); ++k) {
        CHECK((*read)[k].centre == discs[k].second.centre);
        CHECK((*read)[k].radius == discs[k].second.radius);
        CHECK(std::abs((*read)[k].dip - discs[k].second.dip) < 1e-15);
        CHECK(std::abs((*read)[k].dip_direction - discs[k].second.dip_direction) < 2e-15);
    }
    const Scenario again = readGood(rock("file = \"" + file + "\"\n"));
    REQUIRE(again.model.blocks.size() == drawn.model.blocks.size());
    for (std::size_t b = 0; b < drawn.model.blocks.size(); ++b)
        CHECK(massProperties(again.model.blocks[b].shape).volume ==
              doctest::Approx(massProperties(drawn.model.blocks[b].shape).volume).epsilon(1e-9));
    const std::string plain = folder.write("p.csv", "radius,dip,dip_direction,z,y,x,who\n2,30,90,4,4,4,me\n");
    CHECK((*readFractures(plain))[0].centre == Vec3(4, 4, 4));
}

TEST_CASE("fracture sets: faults are reported with their places") {
    const test::TemporaryFolder folder;
    const auto fault = [](const std::string& keys, int line, const std::string& field,
                          const std::string& fragment) {
        checkFault({rock(keys), line, "fracture_set[0]" + field, fragment});
    };
    const std::string plane = "dip_deg = 35\ndip_direction_deg = 200\n";
    fault(plane + "radius = 1\n", 9, ".p32", "missing; one of these is required: p32, count");
    fault(plane + "radius = 1\np32 = 0\n", 13, ".p32", "found 0, allowed: greater than 0");
    fault(plane + "count = 3\n", 9, ".radius", "missing");
    fault(plane + "radius = 1\ncount = 3\nradius_exponent = 2\n", 14, ".radius_exponent",
          "only with radius_law = \"power\"");
    fault(plane + "radius_law = \"power\"\nradius_exponent = 2\nradius_min = 3\nradius_max = 2\ncount = 3\n",
          14, ".radius_min", "found 3 to 2, allowed: the smaller one first");
    fault("file = \"none.csv\"\n", 10, ".file", "none.csv: error: cannot be opened");
    fault("file = \"" + folder.write("one.csv", "x,y,z,dip,dip_direction,radius\n1,2,3,4,5,6\n") +
              "\"\nradius = 2\n",
          11, ".radius", "together with file");
    const auto bad = [&](const std::string& text, const std::string& fragment) {
        const auto errors = readBad(rock("file = \"" + folder.write("bad.csv", text) + "\"\n"));
        CHECK(errors[0].field == "fracture_set[0].file");
        CHECK_MESSAGE(errors[0].message.find(fragment) != std::string::npos, errors[0].message);
    };
    bad("x_m,y_m,z_m,dip_deg,radius_m\n", "bad.csv:1: error: found columns \"x_m,y_m,z_m,dip_deg,radius_m\"");
    bad("x,y,z,dip,dip_direction,radius\n1,2,3,4,5\n", "bad.csv:2: error: found 5 values, allowed: 6");
    bad("x,y,z,dip,dip_direction,radius\n1,2,3,94,5,6\n",
        "found dip \"94\", allowed: a number of at least 0 and at most 90");
    bad("x,y,z,dip,dip_direction,radius\n1,2,3,4,5,0\n",
        "found radius \"0\", allowed: a number greater than 0");
    checkFault({"[[fracture_set]]\n" + properties() + stack(), 1, "fracture_set", "without [rock_mass]"});
}

}  // namespace talus::formats
