// [[bolt]], [[bolt_pattern]], [ground_motion] and the surface of [[water]] as scenarios say them, and what is
// refused.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "faults.h"
#include "support/files.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::formats;

namespace {

const std::string kBlocks =
    "[material.rock]\ndensity = 2700.0\n"
    "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 30.0\n"
    "[[block]]\nname = \"base\"\nfixed = true\nbox = { min = [0, 0, 0], max = [9, 4, 4] }\n"
    "[[block]]\nname = \"top\"\nbox = { min = [0, 0, 4], max = [4, 4, 8] }\n";

const std::string kBar = "area = 8e-4\nmodulus = 2e11\nyield_force = 4e5\n";
const std::string kGrout = "kind = \"grouted\"\nbond_stiffness = 1e8\nbond_strength = 2e5\n";

std::string bolt(const std::string& more) {
    return "[[bolt]]\nname = \"A1\"\nhead = [2.0, 2.0, 8.0]\nend = [2.0, 2.0, 1.0]\n" + more;
}

std::string pattern(const std::string& more) {
    return "[[bolt_pattern]]\nname = \"P\"\nface = \"-x\"\nspacing = [2.0, 2.0]\nlength = 5.0\nplunge_deg = "
           "45.0\n"
           "trend_deg = 90.0\n" +
           kBar + kGrout + more;
}

std::string refused(const std::string& section) { return refusalOf(kBlocks + section); }

bool starts(const std::string& text, const std::string& with) {
    CAPTURE(text);
    CHECK(text.starts_with(with));
    return text.starts_with(with);
}

/// A ground motion from a file that is there as long as this.
struct RecordFile {
    test::TemporaryFolder folder;
    std::string with(const std::string& csv, const std::string& more = "") const {
        return "[ground_motion]\nfile = \"" + folder.write("record.csv", csv) + "\"\n" + more;
    }
};

}  // namespace

TEST_SUITE("scenario") {
    TEST_CASE("a bolt is read in SI units") {
        const auto scenario = parseScenario(
            kBlocks + bolt(kBar + kGrout +
                           "pretension = 1e5\nrupture_strain = 0.05\nshear_stiffness = 1e7\nplate = true\n"),
            "slope.toml");
        REQUIRE(scenario.ok());
        const Bolt& read = scenario->model.bolts.at(0);
        CHECK(read.name == "A1");
        CHECK(read.grouted);
        CHECK(read.plate);
        CHECK(read.head == Vec3(2, 2, 8));
        CHECK(read.bond_strength == 2e5);
        CHECK(read.pretension == 1e5);
        CHECK(read.rupture_strain == 0.05);
        CHECK(read.shear_stiffness == 1e7);
    }

    TEST_CASE("bolts that cannot be are refused at their place") {
        const std::string anchored = "kind = \"anchored\"\n";
        starts(refused(bolt("area = -1.0\nmodulus = 2e11\nyield_force = 4e5\n" + anchored)),
               "bolt[0].area: found -1");
        starts(refused(bolt("area = 1.0\nmodulus = 2e11\n" + anchored)), "bolt[0].yield_force: missing");
        starts(refused(bolt(kBar + "kind = \"glued\"\n")), "bolt[0].kind: found \"glued\"");
        starts(refused(bolt(kBar + "kind = \"grouted\"\n")), "bolt[0].bond_stiffness: missing");
        starts(refused(bolt(kBar + anchored + "bond_strength = 1e5\n")),
               "bolt[0].bond_strength: found bond_strength with");
        starts(refused(bolt(kBar + anchored + "pretension = 5e5\n")),
               "bolt[0].pretension: found more than yield_force");
        starts(refused(bolt(kBar + anchored) + bolt(kBar + anchored)),
               "bolt[1].name: found \"A1\" a second time");
        starts(refused("[[bolt]]\nhead = [1.0, 1.0, 1.0]\nend = [1.0, 1.0, 1.0]\n" + kBar + anchored),
               "bolt[0].end: found the same point as head");
        starts(refused(pattern("box = { min = [-1, 0, 9], max = [1, 4, 12] }\n")),
               "bolt_pattern[0].box: found no free face");
    }

    TEST_CASE("a pattern becomes bolts on the free face in its direction") {
        const auto scenario =
            parseScenario(kBlocks + pattern("box = { min = [-1, 0, 4], max = [1, 4, 8] }\n"), "slope.toml");
        REQUIRE(scenario.ok());
        REQUIRE(scenario->model.bolts.size() == 4);
        CHECK(scenario->model.bolt_patterns.size() == 1);  // kept, so that others can be placed instead
        CHECK(scenario->model.bolts[3].name == "P-4");
        CHECK(scenario->model.bolts[0].head.x() == 0);
        CHECK(scenario->model.bolts[0].head.z() == doctest::Approx(5));
    }

    TEST_CASE("a record of accelerations, scaled; the run lasts as long as it when nothing else is said") {
        const RecordFile file;
        const auto scenario = parseScenario(
            kBlocks + file.with("# a comment\ntime_s, az_m_s2, ax_m_s2\n0, 1, 2\n0.5, 3, 4\n2.5,5,6\n",
                                "scale = 2.0\n"),
            "slope.toml");
        REQUIRE(scenario.ok());
        const GroundMotion& motion = scenario->model.ground_motion;
        CHECK(motion.time == std::vector<double>{0, 0.5, 2.5});
        CHECK(motion.acceleration[1] == Vec3(8, 0, 6));
        CHECK(scenario->model.run.duration == 2.5);
    }

    TEST_CASE("a record may stand in the scenario itself") {
        const std::string section = "[ground_motion]\nscale = 0.5\nacceleration = ";
        const auto scenario =
            parseScenario(kBlocks + section + "[[0.0, 4.0, 0.0, 1.0], [0.5, 2.0, 0.0, 0.0]]\n", "slope.toml");
        REQUIRE(scenario.ok());
        const GroundMotion& motion = scenario->model.ground_motion;
        CHECK(motion.time == std::vector<double>{0, 0.5});
        CHECK(motion.acceleration[0] == Vec3(2, 0, 0.5));
        CHECK(scenario->model.run.duration == 0.5);
        starts(refused(section + "[[0.0, 4.0, 0.0, 1.0], [0.5, 2.0, 0.0, 0.0], [0.5, 1.0, 0.0, 0.0]]\n"),
               "ground_motion.acceleration[2]: found the time 0.5 s after 0.5 s");
        starts(refused(section + "[[-1.0, 4.0, 0.0, 1.0], [0.5, 2.0, 0.0, 0.0]]\n"),
               "ground_motion.acceleration[0]: found the time -1 s, allowed: at least 0");
        starts(refused(section + "[[0.0, 4.0], [0.5, 2.0]]\n"), "ground_motion.acceleration[0]: ");
        starts(refused(section + "[[0.0, 4.0, 0.0, 0.0]]\n"),
               "ground_motion.acceleration: found fewer than two");
        starts(refused(section + "[[0.0, 4.0, 0.0, 0.0], [0.5, 2.0, 0.0, 0.0]]\nfile = \"r.csv\"\n"),
               "ground_motion.acceleration: found file, acceleration together");
    }

    TEST_CASE("velocities become accelerations that are constant between them") {
        const RecordFile file;
        const auto scenario =
            parseScenario(kBlocks + file.with("time_s,vx_m_s\n0,0\n0.5,1\n2.5,0\n"), "slope.toml");
        REQUIRE(scenario.ok());
        CHECK(scenario->model.ground_motion.time == std::vector<double>{0, 0.5, 0.5, 2.5});
        CHECK(scenario->model.ground_motion.acceleration[1] == Vec3(2, 0, 0));
        CHECK(scenario->model.ground_motion.acceleration[2] == Vec3(-0.5, 0, 0));
    }

    TEST_CASE("baseline: the velocity ends where it began, and with a line it has no trend") {
        const RecordFile file;
        const std::string csv = "time_s,ax_m_s2\n0,1\n1,3\n2,4\n4,0\n";
        for (const std::string baseline : {"mean", "line"}) {
            const auto scenario =
                parseScenario(kBlocks + file.with(csv, "baseline = \"" + baseline + "\"\n"), "slope.toml");
            REQUIRE(scenario.ok());
            const GroundMotion& motion = scenario->model.ground_motion;
            double velocity = 0, moment = 0;
            for (std::size_t k = 0; k + 1 < motion.time.size(); ++k) {
                const double from = motion.time[k], to = motion.time[k + 1];
                const double a = motion.acceleration[k].x(), b = motion.acceleration[k + 1].x();
                velocity += 0.5 * (to - from) * (a + b);
                moment += (to - from) / 6 * (a * (2 * from + to) + b * (from + 2 * to));
            }
            CHECK(std::abs(velocity) < 1e-12);
            CHECK((std::abs(moment) < 1e-12) == (baseline == "line"));
        }
    }

    TEST_CASE("records that are none are refused with their line") {
        const RecordFile file;
        const auto message = [&](const std::string& csv) { return refused(file.with(csv)); };
        const auto says = [&](const std::string& csv, const std::string& what) {
            const std::string text = message(csv);
            CAPTURE(text);
            CHECK(text.starts_with("ground_motion.file: "));
            CHECK(text.find(what) != std::string::npos);
        };
        says("time_s,ax\n0,0\n1,0\n", "line 1: found column \"ax\"");
        says("time_s,ax_m_s2,vx_m_s\n0,0,0\n", "line 1: found columns");
        says("ax_m_s2\n0\n", "line 1: found columns");
        says("time_s,ax_m_s2\n0,0\n1,\n2,0\n", "line 3: found a gap");
        says("time_s,ax_m_s2\n0,0\n1\n", "line 3: found 1 values");
        says("time_s,ax_m_s2\n0,0\n1,0\n0.5,0\n", "line 4: found the time 0.5 s after 1 s");
        says("time_s,ax_m_s2\n0,0\n1,fast\n", "line 3: found \"fast\"");
        says("time_s,ax_m_s2\n0,0\n1,inf\n", "line 3: found \"inf\"");
        says("time_s,ax_m_s2\n0,0\n", "found 1 rows");
        starts(refused("[ground_motion]\nfile = \"absent.csv\"\n"), "ground_motion.file: absent.csv: ");
    }

    TEST_CASE(
        "a phreatic surface is read, also beside other water; one that folds back, or a second, is refused") {
        const auto scenario = parseScenario(
            kBlocks +
                "[[water]]\nsurface = [[0.0, 1.0], [4.0, 2.0]]\nfactor = 0.8\ndrains_at_aperture = 0.002\n",
            "slope.toml");
        REQUIRE(scenario.ok());
        REQUIRE(scenario->model.phreatic.has_value());
        CHECK(scenario->model.phreatic->line[1].z == 2.0);
        CHECK(scenario->model.phreatic->factor == 0.8);
        CHECK(scenario->model.phreatic->drains_at_aperture == 0.002);
        starts(refused("[[water]]\nsurface = [[0.0, 1.0], [4.0, 2.0], [3.0, 3.0]]\n"),
               "water[0].surface[2]: found x = 3 after 4, a line that folds back");
        starts(refused("[[water]]\nsurface = [[0.0, 1.0]]\n"),
               "water[0].surface: found fewer than two points");
        starts(refused("[[water]]\nsurface = [[0.0, 1.0], [1.0, 1.0]]\ndepth = 1.0\n"),
               "water[0].depth: found depth together with a surface");
        starts(refused("[[water]]\nbetween = [\"top\", \"base\"]\ndepth = 1.0\nfactor = 0.5\n"),
               "water[0].factor: ");
        const std::string one = "[[water]]\nsurface = [[0.0, 1.0], [1.0, 1.0]]\n";
        const auto beside = parseScenario(
            kBlocks + one + "[[water]]\nbetween = [\"top\", \"base\"]\nhead = [1.0, 0.0]\n", "slope.toml");
        REQUIRE(beside.ok());
        CHECK(beside->model.phreatic.has_value());
        CHECK(beside->model.waters.size() == 1);
        starts(refused(one + one), "water[1]: found a second surface");
    }

    TEST_CASE(
        "joints of a rock mass run dry at a millimetre in `run` unless an entry says otherwise; others never "
        "do") {
        const std::string rock =
            "[material.rock]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = "
            "1e9\n"
            "friction_deg = 30.0\n[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [4, 4, 4] } }\n"
            "fixed = [{ boundary = \"-z\" }]\n[[single_joint]]\nname = \"bed\"\npoint = [0.0, 0.0, 2.0]\n"
            "dip_deg = 10\ndip_direction_deg = 270\n";
        const auto apertures = [](const std::string& text) {
            const auto scenario = parseScenario(text, "slope.toml");
            for (const Error& error : scenario.errors()) FAIL_CHECK(format(error));
            REQUIRE(scenario.ok());
            const Model& model = scenario->model;
            return model.phreatic ? model.phreatic->drains_at_aperture
                                  : model.waters.at(0).drains_at_aperture;
        };
        const std::string in_joint = "[[water]]\njoint = \"bed\"\nelevation = 3.0\n";
        const std::string table = "[[water]]\nsurface = [[0.0, 3.0], [4.0, 3.0]]\n";
        CHECK(apertures(rock + in_joint) == 1e-3);
        CHECK(apertures(rock + table) == 1e-3);
        CHECK(apertures(rock + "[[water]]\njoint = \"bed\"\nhead = [2.0, 0.0]\n") == 1e-3);
        CHECK(apertures(rock + in_joint + "drains_at_aperture = 0.02\n") == 0.02);
        CHECK(apertures(kBlocks + table) == kInfinity);
        CHECK(apertures(kBlocks + "[[water]]\nbetween = [\"top\", \"base\"]\nhead = [1.0, 0.0]\n") ==
              kInfinity);
    }
}
