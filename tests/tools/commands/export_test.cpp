// talus export: the files hold the values of the run, read back by hand and, where it is installed, by VTK.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "support/models.h"
#include "support/skip.h"
#include "support/snapshots.h"
#include "talus/formats/export.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;
using nlohmann::json;

namespace {

struct File {
    TemporaryFolder folder;
    std::string path = folder / "run.mcap";

    File() {
        const std::string scenario = folder.write("run.toml", test::runScenarioText("0.02"));
        REQUIRE(runTalus({"run", scenario, "-o", path, "--full-every", "5", "--quiet"}).exit_code == 0);
    }
};

const File& file() {
    static const File made;
    return made;
}

/// Values of a named array of a .vtp file with appended raw data.
template <class Number>
std::vector<Number> arrayOf(const std::string& vtp, const std::string& name) {
    const std::size_t element = vtp.find("Name=\"" + name + "\"");
    REQUIRE(element != std::string::npos);
    const std::size_t offset = std::stoul(vtp.substr(vtp.find("offset=\"", element) + 8));
    const std::size_t data = vtp.find("<AppendedData encoding=\"raw\">\n_") + 31 + offset;
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, vtp.data() + data, sizeof bytes);
    std::vector<Number> values(bytes / sizeof(Number));
    std::memcpy(values.data(), vtp.data() + data + sizeof bytes, bytes);
    return values;
}

/// Volume inside triangles, by the divergence theorem.
double volumeOfStl(const std::string& stl) {
    std::uint32_t count = 0;
    std::memcpy(&count, stl.data() + 80, sizeof count);
    REQUIRE(stl.size() == 84 + std::size_t{50} * count);
    double volume = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
        float v[12];
        std::memcpy(v, stl.data() + 84 + std::size_t{50} * k, sizeof v);
        const Vec3 a(v[3], v[4], v[5]), b(v[6], v[7], v[8]), c(v[9], v[10], v[11]);
        volume += a.dot(b.cross(c)) / 6;
        CHECK((b - a).cross(c - a).normalized().dot(Vec3(v[0], v[1], v[2])) > 0.999);
    }
    return volume;
}

}  // namespace

TEST_CASE("export --vtk: blocks where they are, contact points with their forces") {
    const TemporaryFolder folder;
    const Outcome outcome = runTalus({"export", file().path, "--vtk", folder / "out", "--json", "--quiet"});
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json().at("vtk").at("block_files") == 21);
    CHECK(outcome.json().at("vtk").at("contact_files") == 5);

    auto opened = formats::SnapshotReader::open(file().path);
    REQUIRE(opened.ok());
    formats::SnapshotReader& reader = *opened;
    const LightFrame light = *reader.frame(20);
    const FullFrame full = *reader.full(4);
    const std::string blocks = contentOf(folder / "out/blocks_000020.vtp");
    const auto displacement = arrayOf<float>(blocks, "displacement");
    const auto id = arrayOf<std::int32_t>(blocks, "block_id");
    REQUIRE(id.size() == 7 * 6);
    for (std::size_t f = 0; f < id.size(); ++f)
        CHECK(displacement[3 * f] == light.displacement.x[static_cast<std::size_t>(id[f])]);
    // A corner is where the exact pose has it.
    const auto points = arrayOf<double>(blocks, "Points");
    const auto& g = reader.header().geometry;
    for (std::size_t b = 0; b < 7; ++b) {
        Vec3 mean = Vec3::Zero();
        for (auto v = static_cast<std::size_t>(g.vertex_begin[b]);
             v < static_cast<std::size_t>(g.vertex_begin[b + 1]); ++v)
            mean += Vec3(points[3 * v], points[3 * v + 1], points[3 * v + 2]) / 8;
        CHECK(mean.x() == doctest::Approx(full.blocks.position.x[b]).epsilon(1e-6));
        CHECK(mean.z() == doctest::Approx(full.blocks.position.z[b]).epsilon(1e-6));
    }
    const std::string contacts = contentOf(folder / "out/contacts_000020.vtp");
    CHECK(arrayOf<double>(contacts, "normal_force") == full.points.normal);
    const auto force = arrayOf<double>(contacts, "force");
    const auto shear = arrayOf<double>(contacts, "shear_force");
    for (std::size_t p = 0; p < full.points.size(); ++p) {
        const Vec3 f(force[3 * p], force[3 * p + 1], force[3 * p + 2]);
        const Vec3 s(shear[3 * p], shear[3 * p + 1], shear[3 * p + 2]);
        CHECK(s.norm() == doctest::Approx(std::hypot(full.points.shear_1[p], full.points.shear_2[p])));
        CHECK((f - s).norm() == doctest::Approx(std::abs(full.points.normal[p])));
    }
    const std::string series = contentOf(folder / "out/contacts.pvd");
    CHECK(series.find("contacts_000000.vtp") != std::string::npos);
    CHECK(series.find("contacts_000001.vtp") == std::string::npos);
    CHECK(runTalus({"export", file().path, "--vtk", folder / "few", "--every", "9", "--json"})
              .json()
              .at("vtk")
              .at("block_files") == 4);  // 0, 9, 18 and the last
}

TEST_CASE("export --stl: closed surfaces of the blocks' volume") {
    const TemporaryFolder folder;
    REQUIRE(runTalus({"export", file().path, "--stl", "last", "-o", folder / "a.stl"}).exit_code == 0);
    auto opened = formats::SnapshotReader::open(file().path);
    REQUIRE(opened.ok());
    formats::SnapshotReader& reader = *opened;
    double volume = 0;
    for (const double mass : reader.header().geometry.mass) volume += mass / 2700;
    CHECK(volumeOfStl(contentOf(folder / "a.stl")) == doctest::Approx(volume).epsilon(1e-5));
}

TEST_CASE("export --csv: a row for each frame and block") {
    const TemporaryFolder folder;
    REQUIRE(runTalus({"export", file().path, "--csv", folder / "a.csv", "--every", "10"}).exit_code == 0);
    const std::string csv = contentOf(folder / "a.csv");
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 1 + 3 * 7);
    CHECK(csv.starts_with("frame,time_s,block,x_m"));
    CHECK(csv.find("\n20,") != std::string::npos);
    CHECK(csv.find(",c2r3s1,") != std::string::npos);
    CHECK(runTalus({"export", file().path}).exit_code == 2);
    CHECK(runTalus({"export", file().path, "--csv", folder / "no/such/a.csv"}).exit_code == 4);
}

TEST_CASE("failure roles: a block that slides, one that topples, one that stays") {
    Model model = test::floorModel(20);
    test::addBox(model, "slides", {0, 0, 0}, {1, 1, 0.5});
    test::addBox(model, "topples", {3, 0, 0}, {0.2, 1, 1});
    test::addBox(model, "stays", {6, 0, 0}, {1, 1, 1});
    formats::Scenario scenario;
    scenario.model = model;
    model.run.duration = 1e-6;
    const test::Recorded run = test::record(model);
    const formats::SnapshotHeader header = formats::headerOf(scenario, run.geometry, "", 1);
    LightFrame frame = run.lights.front();
    frame.displacement.x = {0, -0.2F, -0.05F, 0};
    frame.rotation.y = {0, 0.001F, -0.1F, 0};
    CHECK(formats::failureRoles(header, frame) ==
          std::vector<FailureMode>{FailureMode::none, FailureMode::sliding, FailureMode::toppling,
                                   FailureMode::none});
}

TEST_CASE("VTK reads the export") {
    if (std::system("/usr/bin/python3 -c 'import vtk' >/dev/null 2>&1") != 0)
        return test::skip("Debian's python3-vtk9 is not installed");
    const TemporaryFolder folder;
    REQUIRE(runTalus({"export", file().path, "--vtk", folder / "out", "--quiet"}).exit_code == 0);
    const std::string command = std::string("/usr/bin/python3 '") + TALUS_SOURCE_DIR +
                                "/tests/formats/export/read_vtk.py' '" + (folder / "out") + "' > '" +
                                (folder / "found.json") + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    const json found = json::parse(contentOf(folder / "found.json"));
    auto opened = formats::SnapshotReader::open(file().path);
    REQUIRE(opened.ok());
    formats::SnapshotReader& reader = *opened;
    REQUIRE(found.at("blocks").size() == reader.frames().size());
    REQUIRE(found.at("contacts").size() == reader.fulls());
    double volume = 0;
    for (const double mass : reader.header().geometry.mass) volume += mass / 2700;
    for (std::size_t k = 0; k < reader.frames().size(); ++k) {
        const json& blocks = found.at("blocks")[k];
        CHECK(blocks.at("polys") == 42);
        CHECK(blocks.at("time").get<double>() == reader.frames()[k].time);
        CHECK(blocks.at("volume").get<double>() == doctest::Approx(volume).epsilon(1e-3));
        CHECK(blocks.at("arrays").at("cell.velocity").size() == 42);
    }
    const json& contacts = found.at("contacts").back();
    const FullFrame full = *reader.full(reader.fulls() - 1);
    REQUIRE(contacts.at("verts") == full.points.size());
    for (std::size_t p = 0; p < full.points.size(); ++p)
        CHECK(contacts.at("arrays").at("point.normal_force")[p][0].get<double>() == full.points.normal[p]);
}

TEST_CASE("Ctrl-C ends an export of large frames at once, and ParaView's lists name what is there") {
    const TemporaryFolder folder;
    const std::string path =
        folder.write("large.toml",
                     "[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\nfriction_deg = 35\n"
                     "[material.rock]\ndensity = 2600.0\n[run]\nduration_s = 1e-4\nstart = \"unstressed\"\n"
                     "[[stack]]\nrows = 30\nslices = 30\nblock = [0.2, 0.1, 0.1]\ncolumns = " +
                         std::to_string(static_cast<int>(40 / kSlower)) + "\n");
    const std::string run = folder / "run.mcap";
    REQUIRE(runTalus({"run", path, "-o", run}).exit_code == 0);
    int interrupted = 0;
    for (const double begun : {0.15, 0.4, 0.7}) {
        CAPTURE(begun);
        const std::string out = folder / ("vtk" + std::to_string(begun));
        Program program({"export", run, "--vtk", out});
        REQUIRE(waitFor([&] { return program.endsWithin(0) || program.hasBegun(begun); }));
        program.signal(SIGINT);
        CHECK(program.endsWithin(kSlower * 0.5));
        const Outcome outcome = program.outcome();
        if (outcome.exit_code == 0) break;  // it was done already
        ++interrupted;
        CHECK(outcome.exit_code == 130);
        CHECK(outcome.err.find("interrupted") != std::string::npos);
        std::size_t listed = 0, there = 0;
        for (const char* list : {"blocks.pvd", "contacts.pvd"}) {
            const std::string text = contentOf(out + "/" + list);
            for (std::size_t at = 0; (at = text.find("file=\"", at)) != std::string::npos; ++at) ++listed;
        }
        if (std::filesystem::exists(out))
            for (const auto& file : std::filesystem::directory_iterator(out))
                there += file.path().extension() == ".vtp" ? 1 : 0;
        CHECK(listed == there);
    }
    CHECK(interrupted > 0);
}
