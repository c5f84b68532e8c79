// A file written by the first version stays readable, with the values that were in it. golden/snapshot-1.fbs
// is that version's schema; CTest's formats/schema-evolution holds today's against it. Neither is ever
// changed: a later version adds its own beside them.

#include <doctest/doctest.h>

#include "talus/formats/snapshot.h"

using namespace talus;
using namespace talus::formats;

TEST_CASE("the file of the first version is read with its values") {
    auto reader =
        SnapshotReader::open(std::string(TALUS_SOURCE_DIR) + "/tests/formats/snapshot/golden/run-1.mcap");
    REQUIRE(reader.ok());
    CHECK(reader->verify().empty());
    const SnapshotHeader& header = reader->header();
    CHECK(header.format == 1);
    CHECK(header.names == std::vector<std::string>{"floor", "key"});
    CHECK(header.motions == std::vector<Motion>{Motion::fixed, Motion::free});
    CHECK(header.geometry.mass[1] == doctest::Approx(1300));
    CHECK(header.joints[0].friction == doctest::Approx(20 * 0.017453292519943295));
    REQUIRE(header.waters.size() == 2);
    CHECK(header.waters[0].head == std::array<double, 2>{0.1, 0.02});
    CHECK(header.waters[1].level[0].value == 0.3);
    CHECK(header.scenario_text.starts_with("[gravity]\ntilt_deg = 25.0\n"));

    REQUIRE(reader->frames().size() == 6);
    REQUIRE(reader->fulls() == 2);
    const LightFrame last = *reader->frame(5);
    CHECK(last.state_hash == 0x6837d15f4db6ef82);
    CHECK(last.step == 5);
    CHECK(last.time == doctest::Approx(0.01));
    CHECK(last.kinetic_energy == doctest::Approx(0.127511674));
    CHECK(last.velocity.x[1] == doctest::Approx(-0.0138198165));
    CHECK(last.displacement.x[1] == doctest::Approx(-0.000171439242));
    const FullFrame full = *reader->full(1);
    CHECK(full.state_hash == last.state_hash);
    CHECK(full.interfaces.size() == 1);
    CHECK(full.points.size() == 9);
    CHECK(full.progress.time_step == doctest::Approx(0.002));
    CHECK(full.laws.of(&Joint::dilation)[0] == doctest::Approx(0.017455064928217585));
    CHECK(full.loads.tilt == doctest::Approx(25 * 0.017453292519943295));
    REQUIRE(reader->end().has_value());
    CHECK(reader->end()->ended == "finished");
    CHECK(reader->end()->state_hash == last.state_hash);
}
