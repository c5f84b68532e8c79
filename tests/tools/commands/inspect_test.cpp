// talus inspect: every view, for people and programs, against the run itself.

#include <doctest/doctest.h>

#include <cmath>
#include <utility>

#include "support/containers.h"
#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus::tools::testing;
using nlohmann::json;

namespace {

struct File {
    TemporaryFolder folder;
    std::string path = folder / "run.mcap";
    json result;

    File() {
        const std::string scenario = folder.write("run.toml", talus::test::runScenarioText("0.02"));
        result = runTalus({"run", scenario, "-o", path, "--full-every", "5", "--json", "--quiet"}).json();
    }
    json inspect(std::vector<std::string> more) const {
        more.insert(more.begin(), {"inspect", path});
        more.push_back("--json");
        const Outcome outcome = runTalus(more);
        REQUIRE(outcome.exit_code == 0);
        return outcome.json();
    }
};

const File& file() {
    static const File made;
    return made;
}

double number(const json& value) { return value.get<double>(); }

}  // namespace

TEST_CASE("inspect: the summary is that of the run, with the state hash of every frame") {
    const json summary = file().inspect({});
    CHECK(summary.at("ended") == "finished");
    CHECK(summary.at("state_hash") == file().result.at("state_hash"));
    CHECK(summary.at("steps") == file().result.at("steps"));
    CHECK(summary.at("blocks") == 7);
    CHECK(summary.at("fixed_blocks") == 1);
    CHECK(summary.at("contact_points") == file().result.at("contact_points"));
    CHECK(summary.at("frames") == 21);
    CHECK(summary.at("full_states") == 5);
    const json& course = summary.at("course");
    REQUIRE(course.size() == 21);
    for (const json& frame : course) CHECK(frame.at("state_hash").get<std::string>().size() == 16);
    CHECK(course.back().at("state_hash") == summary.at("state_hash"));
    const Outcome text = runTalus({"inspect", file().path});
    CHECK(text.out.find("ended: finished") != std::string::npos);
    CHECK(text.out.find("... 9 more") != std::string::npos);
    const std::string csv = runTalus({"inspect", file().path, "--csv"}).out;
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 22);
}

TEST_CASE("inspect: a frame by number, as last and by time") {
    CHECK(file().inspect({"--frame", "last"}).at("frame") == 20);
    CHECK(file().inspect({"--frame", "7"}).at("frame") == 7);
    const json at = file().inspect({"--frame", "0.0105"});
    CHECK(at.at("frame") == 10);
    CHECK(number(at.at("time_s")) <= 0.0105);
    CHECK(at.at("waters").size() == 2);
    for (const char* wrong : {"21", "soon", "-1", "1e", "nan"}) {
        CAPTURE(wrong);
        CHECK(runTalus({"inspect", file().path, std::string("--frame=") + wrong}).exit_code == 2);
    }
}

TEST_CASE("inspect: a block agrees with what the run reports of it") {
    const json block = file().inspect({"--block", "c1r1s1"});
    const json& watched = file().result.at("watch").at("c1r1s1");
    for (int axis = 0; axis < 3; ++axis) {
        CHECK(number(block.at("position_m")[axis]) ==
              doctest::Approx(number(watched.at("position_m")[axis])).epsilon(1e-6));
        CHECK(number(block.at("velocity_m_s")[axis]) ==
              doctest::Approx(number(watched.at("velocity_m_s")[axis])).epsilon(1e-6));
    }
    bool floor = false;
    for (const json& neighbour : block.at("neighbours"))
        floor = floor || neighbour.at("neighbour") == "floor";
    CHECK(floor);
    CHECK(runTalus({"inspect", file().path, "--block", "nobody"}).exit_code == 2);
}

TEST_CASE("inspect: the contact points of an interface add up to its sums, from either side") {
    const json there = file().inspect({"--interface", "c2r1s1", "floor"});
    const json back = file().inspect({"--interface", "floor", "c2r1s1"});
    CHECK(there == back);
    const json& sums = there.at("interfaces")[0];
    double normal = 0, water = 0, area = 0;
    for (const json& point : there.at("points")) {
        normal += number(point.at("normal_n")), water += number(point.at("water_n")),
            area += number(point.at("area_m2"));
        CHECK(number(point.at("mobilised_friction")) >= 0);
        CHECK(number(point.at("mobilised_friction")) <= 1);
        CHECK((point.at("state") == "open" || point.at("state") == "sticking" ||
               point.at("state") == "slipping"));
    }
    CHECK(normal == doctest::Approx(number(sums.at("normal_n"))));
    CHECK(area == doctest::Approx(number(sums.at("area_m2"))));
    // Uplift between the heads 0.1 m and 0.02 m: their mean over the patch.
    CHECK(water == doctest::Approx(1000 * 9.81 * std::cos(25 * M_PI / 180) * 0.06 * area).epsilon(1e-5));
    CHECK(runTalus({"inspect", file().path, "--interface", "c1r1s1", "c2r3s1"}).exit_code == 2);
}

TEST_CASE("inspect: --top sorts, --verify holds, --diff finds the first difference") {
    const json top = file().inspect({"--top", "4"});
    REQUIRE(top.at("top").size() == 4);
    for (std::size_t k = 1; k < 4; ++k)
        CHECK(number(top.at("top")[k - 1].at("displacement_m")) >=
              number(top.at("top")[k].at("displacement_m")));
    CHECK(file().inspect({"--verify"}).at("sound") == true);
    CHECK(file().inspect({"--diff", file().path}).at("equal") == true);

    std::string other_text = talus::test::runScenarioText("0.02");
    other_text.replace(other_text.find("friction_deg = 15.0"), 19, "friction_deg = 14.9");
    const TemporaryFolder folder;
    const std::string other = folder / "other.mcap";
    REQUIRE(
        runTalus({"run", folder.write("other.toml", other_text), "-o", other, "--full-every", "5", "--quiet"})
            .exit_code == 0);
    const json difference = file().inspect({"--diff", other});
    CHECK(difference.at("equal") == false);
    CHECK(difference.at("same_scenario") == false);
    CHECK(difference.at("field") == "state_hash");  // less friction, other forces from the start
    CHECK(difference.at("frame") == 0);
}

TEST_CASE("inspect: a cut file is read as far as it goes, a damaged one is not sound") {
    const TemporaryFolder folder;
    std::string bytes = contentOf(file().path);
    const std::string cut = folder.write("cut.mcap", bytes.substr(0, bytes.size() / 2));
    const Outcome outcome = runTalus({"inspect", cut, "--json"});
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json().at("frames").get<int>() < 21);
    CHECK(outcome.json().at("faults").size() == 2);
    CHECK(outcome.err.find("not a whole record") != std::string::npos);
    CHECK(runTalus({"inspect", cut, "--verify"}).exit_code == 2);
    bytes[bytes.size() / 2] ^= 0x10;
    const std::string damaged = folder.write("damaged.mcap", bytes);
    CHECK(runTalus({"inspect", damaged, "--verify"}).exit_code == 2);
    // A page would hold the damage as it is.
    const Outcome page = runTalus({"replay", damaged, "-o", folder / "page.html"});
    CHECK(page.exit_code == 2);
    CHECK(page.err.find("is damaged; --from and --to leave it out") != std::string::npos);
    // A copy that goes on takes it along, and says so.
    CHECK(runTalus({"run", "--resume", damaged, "-o", folder / "copy.mcap"}).err.find("is damaged") !=
          std::string::npos);
    CHECK(runTalus({"inspect", folder / "absent.mcap"}).exit_code == 2);
    CHECK(runTalus({"inspect", file().path, "--top", "2", "--verify"}).exit_code == 2);
}

TEST_CASE("a file that has lost all its frames gives no empty answers") {
    // Every chunk but the first, which holds the header, is damaged.
    std::string bytes = contentOf(file().path);
    bool is_first = true;
    talus::test::eachRecord({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                            [&](std::size_t at, talus::mcap::Opcode opcode, talus::mcap::View content) {
                                if (opcode != talus::mcap::Opcode::chunk || std::exchange(is_first, false))
                                    return;
                                bytes[at + talus::mcap::kRecordHead + content.size - 1] ^= 0x10;
                            });
    const TemporaryFolder folder;
    // Without its end, as what is left is looked for then.
    const std::string lost = folder.write("lost.mcap", bytes.substr(0, bytes.size() - 8));
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"replay", lost},
                                               {"replay", lost, "--verify"},
                                               {"replay", lost, "-o", folder / "page.html"},
                                               {"export", lost, "--csv", folder / "rows.csv"},
                                               {"export", lost, "--gltf", folder / "blocks.glb"},
                                               {"export", lost, "--vtk", folder / "vtk"}}) {
        const Outcome outcome = runTalus(command);
        CAPTURE(command[0]);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find("holds no frames that can be read: the chunk at byte") != std::string::npos);
    }
    CHECK(runTalus({"inspect", lost}).exit_code == 0);
    CHECK(runTalus({"inspect", lost, "--verify"}).exit_code == 2);
}
