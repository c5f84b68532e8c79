// --keep-mechanism of limit-analysis: blocks move as the result says, in a file for replay, inspect and
// export.

#include <doctest/doctest.h>

#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;
using formats::SnapshotReader;
using nlohmann::json;

namespace {

const std::string kVerification = TALUS_SOURCE_DIR "/bench/verification/";

Vec3 at(const auto& list, std::size_t k) { return Vec3(list.x[k], list.y[k], list.z[k]); }
Vec3 vectorOf(const json& list) { return Vec3(list[0], list[1], list[2]); }

/// Each free block's way and turn in each frame are its velocity and spin times one number that grows with
/// time.
void checkMotion(SnapshotReader& reader, const json& result) {
    const formats::SnapshotHeader& header = reader.header();
    const double way = result.at("kept_mechanism").at("farthest_way_m");
    CHECK(result.at("kept_mechanism").at("farthest_displacement_m") == way);
    const std::size_t last = reader.frames().size() - 1;
    for (const std::size_t k : {std::size_t{0}, last / 2, last}) {
        const LightFrame frame = *reader.frame(k);
        const double share = static_cast<double>(k) / static_cast<double>(last);
        std::size_t next = 0;
        for (std::size_t b = 0; b < header.names.size(); ++b) {
            Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();
            if (header.motions[b] == Motion::free) {
                const json& block = result.at("mechanism")[next++];
                REQUIRE(block.at("block") == header.names[b]);
                velocity = vectorOf(block.at("velocity_m_s")), spin = vectorOf(block.at("spin_rad_s"));
            }
            CHECK((at(frame.displacement, b) - share * way * velocity).norm() < 1e-6 * way);
            CHECK((at(frame.rotation, b) - share * way * spin).norm() < 1e-6 * way * (1 + spin.norm()));
        }
        CHECK(next == result.at("mechanism").size());
    }
}

}  // namespace

TEST_CASE("a mechanism is kept as the motion that the result names: sliding, hinges, falling at once") {
    const TemporaryFolder folder;
    struct Case {
        std::string scenario, load;
        const char* mode;
    };
    for (const Case& one : {Case{folder.write("slides.toml", blockScenario(0, 20)), "tilt", "sliding"},
                            {folder.write("steep.toml", blockScenario(25, 20)), "factor", "sliding"},
                            {kVerification + "column-10.toml", "tilt", "toppling"},
                            {kVerification + "arch-27-1.5m.toml", "horizontal", "toppling"}}) {
        const std::string &scenario = one.scenario, &load = one.load, mode = one.mode;
        CAPTURE(scenario);
        const std::string file = folder / "mechanism.mcap";
        const Outcome outcome = runTalus({"limit-analysis", scenario, "--for", load, "--keep-mechanism", file,
                                          "--force", "--json", "--quiet", "--threads", "1"});
        REQUIRE(outcome.exit_code == 0);
        const json result = outcome.json();
        const json& kept = result.at("kept_mechanism");
        CHECK(kept.at("file") == file);
        CHECK(kept.at("mode") == mode);
        auto reader = SnapshotReader::open(file);
        REQUIRE(reader.ok());
        CHECK(reader->verify().empty());
        REQUIRE(reader->end().has_value());
        CHECK(reader->end()->ended == "finished");
        CHECK(reader->frames().size() == kept.at("frames"));
        CHECK(reader->header().failure->analysis == "limit-analysis --for " + load);
        checkMotion(*reader, result);

        CHECK(runTalus({"inspect", file, "--json"}).json().at("failure").at("mode") == mode);
        CHECK(runTalus({"replay", file, "-o", folder / "page.html", "--quiet", "--force"}).exit_code == 0);
        CHECK(runTalus({"export", file, "--vtk", folder / ("vtk-" + load + mode), "--quiet"}).exit_code == 0);
    }
}

TEST_CASE("a mechanism that is not there is not kept, and what is no run is not computed again") {
    const TemporaryFolder folder;
    const std::string stands = folder.write("stands.toml", blockScenario(0, 20));
    const std::string file = folder / "mechanism.mcap";
    const Outcome nothing = runTalus(
        {"limit-analysis", stands, "--for", "factor", "--keep-mechanism", file, "--json", "--quiet"});
    CHECK(nothing.exit_code == 0);
    CHECK(nothing.json().at("kept_mechanism").at("file").is_null());
    CHECK(nothing.json().at("kept_mechanism").at("reason") == "nothing fails");
    CHECK(runTalus({"limit-analysis", stands, "--for", "tilt", "--keep-mechanism", "m.csv"}).exit_code == 2);

    const std::vector<std::string> keep{"limit-analysis",   stands, "--for",  "tilt",
                                        "--keep-mechanism", file,   "--quiet"};
    REQUIRE(runTalus(keep).exit_code == 0);
    const Outcome again = runTalus(keep);
    CHECK(again.exit_code == 2);
    CHECK(again.err.find("--force replaces it") != std::string::npos);
    const Outcome verified = runTalus({"replay", file, "--verify", "--quiet"});
    CHECK(verified.exit_code == 2);
    CHECK(verified.err.find("mechanism of a limit analysis") != std::string::npos);
    CHECK(runTalus({"run", "--resume", file, "--quiet"}).exit_code == 2);
}
