// talus batch --map: probabilities over the face against an integral by hand, and conservation of volume.

#include <doctest/doctest.h>

#include <Eigen/LU>
#include <cmath>

#include "batch/map_files.h"
#include "batch/map_picture.h"
#include "batch/summary.h"
#include "cli/text.h"
#include "talus/rock_mass.h"
#include "tools/batch_folder.h"

namespace talus::tools::testing {

using namespace talus::tools::batch;

namespace {

const std::string kStrength =
    "[material.rock]\ndensity = 2600.0\n[joint.default]\nnormal_stiffness = 1e10\nshear_stiffness = 1e10\n"
    "friction_deg = 43.0\n";
const std::string kFixed =
    "fixed = [{ boundary = \"-z\" }, { boundary = \"+x\" }, { boundary = \"-y\" }, { boundary = \"+y\" }]\n";

/// Two planes through (1.5, 0, 3) on a face that looks to -x cut one wedge out of it.
const std::string kWedge =
    kStrength +
    "[rock_mass]\nregion = { profile = [[-3, -1], [12, -1], [12, 10], [5, 10], [0, 0], [-3, 0]], y = [-10, "
    "10] }\n" +
    kFixed +
    "[[single_joint]]\nname = \"A\"\npoint = [1.5, 0.0, 3.0]\ndip_deg = 55.0\ndip_direction_deg = 310.0\n"
    "[[single_joint]]\nname = \"B\"\npoint = [1.5, 0.0, 3.0]\ndip_deg = 55.0\ndip_direction_deg = 230.0\n";

std::string randomDips(int samples) {
    std::string text = "samples = " + std::to_string(samples) + "\nseed = 11\n";
    for (const char* joint : {"0", "1"})
        text += "[[random]]\nfield = \"single_joint[" + std::string(joint) +
                "].dip_deg\"\ndistribution = \"uniform\"\nmin = 50.0\nmax = 60.0\n";
    return text;
}

/// Of a wedge without cohesion: W + N_A n_A + N_B n_B = T s, F = (N_A + N_B) tan(phi) / T (Hoek and Bray).
double wedgeFactor(double dip_a, double dip_b) {
    const Vec3 a = upwardNormal(dip_a * kDegree, 310 * kDegree),
               b = upwardNormal(dip_b * kDegree, 230 * kDegree);
    Vec3 line = a.cross(b).normalized();
    if (line.z() > 0) line = -line;
    Mat3 system;
    system << a, b, -line;
    const Vec3 forces = system.inverse() * Vec3::UnitZ();
    REQUIRE(forces.x() > 0);
    REQUIRE(forces.y() > 0);
    return (forces.x() + forces.y()) * std::tan(43 * kDegree) / forces.z();
}

double wedgeProbability() {
    constexpr int kCells = 200;
    int fails = 0;
    for (int i = 0; i < kCells; ++i)
        for (int j = 0; j < kCells; ++j)
            fails += wedgeFactor(50 + 10 * (i + 0.5) / kCells, 50 + 10 * (j + 0.5) / kCells) < 1;
    return static_cast<double>(fails) / (kCells * kCells);
}

FailureMap mapOf(const BatchFolder& folder, int threads, double cell) {
    const auto sweep = formats::readSweep(folder.path);
    REQUIRE(sweep.ok());
    const StoredBatch stored = readStored(folder.out());
    const std::atomic<bool> stop{false};
    auto map = failureMap(*sweep, stored, faceOf(*sweep, stored.info, cell), threads, stop);
    REQUIRE(map.has_value());
    return *std::move(map);
}

std::size_t cellAt(const FailureMap& map, const Vec3& place) {
    std::size_t nearest = 0;
    for (std::size_t c = 0; c < map.face.cells.size(); ++c)
        if ((map.face.cells[c].centre - place).norm() < (map.face.cells[nearest].centre - place).norm())
            nearest = c;
    return nearest;
}

double integral(const FailureMap& map) {
    double sum = 0;
    for (std::size_t c = 0; c < map.face.cells.size(); ++c)
        sum += map.volume_per_area[c] * map.face.cells[c].area;
    return sum;
}

}  // namespace

TEST_CASE("a wedge with two random dips: the probability of an integral by hand, and its volume") {
    const BatchFolder folder(randomDips(120), "safety-factor", kWedge);
    REQUIRE(folder.run().exit_code == 0);
    const FailureMap map = mapOf(folder, 2, 0.5);
    CHECK(map.runs == 120);
    const double exact = wedgeProbability();
    CHECK(exact > 0.2);
    CHECK(exact < 0.8);
    const Interval interval = shareInterval(map.failed, map.runs, 0.999);
    MESSAGE("probability " << exact << ", of the samples " << map.failed << " of " << map.runs);
    CHECK(interval.low <= exact);
    CHECK(exact <= interval.high);
    // In the middle of every wedge; on the face below all wedges; beside all of them.
    CHECK(map.hits[cellAt(map, {4, 0, 8})] == map.failed);
    CHECK(map.hits[cellAt(map, {0.5, 0, 1})] == 0);
    CHECK(map.hits[cellAt(map, {4, 9, 8})] == 0);
    // On the level ground behind: only flat wedges reach so far, so some of the failures.
    CHECK(map.hits[cellAt(map, {7.6, 0, 10})] < map.failed);
    CHECK(map.interval(cellAt(map, {4, 0, 8})).low < exact);
    // Its cells hold the mean of what the rows say.
    double volume = 0;
    for (const Observation& seen : summarise(readStored(folder.out())).observations) {
        if (!(seen.answer <= 1)) continue;
        const StoredBatch stored = readStored(folder.out());
        volume += std::stod(stored.row(seen.run)[*stored.info.find("failing_volume_m3")]);
    }
    CHECK(map.volume == doctest::Approx(volume / 120).epsilon(1e-9));
    CHECK(map.hidden_volume == 0);
    CHECK(integral(map) == doctest::Approx(map.volume).epsilon(1e-12));
}

TEST_CASE("a block that slides in every sample: 1 on its free faces, 0 elsewhere") {
    // A plane of 40 degrees daylights at (2, y, 4) and leaves the region through its sides.
    const std::string scenario =
        kStrength +
        "[rock_mass]\nregion = { profile = [[-2, -1], [12, -1], [12, 10], [5, 10], [0, 0], [-2, 0]], y = [0, "
        "4] }\nfixed = [{ boundary = \"-z\" }]\n"
        "[[single_joint]]\npoint = [2.0, 0.0, 4.0]\ndip_deg = 40.0\ndip_direction_deg = 270.0\n";
    const BatchFolder folder(
        "samples = 5\n[[random]]\nfield = \"joint.default.friction_deg\"\ndistribution = \"uniform\"\nmin = "
        "5.0\nmax = 15.0\n",
        "safety-factor", scenario);
    REQUIRE(folder.run().exit_code == 0);
    const FailureMap map = mapOf(folder, 1, 0.25);
    CHECK(map.failed == 5);
    CHECK(map.runs == 5);
    for (std::size_t c = 0; c < map.face.cells.size(); ++c) {
        const Vec3& centre = map.face.cells[c].centre;
        const double plane = 4 + std::tan(40 * kDegree) * (centre.x() - 2);
        CHECK(map.probability(c) == (centre.z() > plane ? 1 : 0));
        if (centre.z() < plane) CHECK(map.volume_per_area[c] == 0);
    }
    // The block is (2, 4), (5, 10) and where the plane meets z = 10.
    const double back = 2 + 6 / std::tan(40 * kDegree);
    CHECK(map.volume == doctest::Approx(4 * 0.5 * (back - 5) * 6).epsilon(1e-9));
    CHECK(integral(map) == doctest::Approx(map.volume).epsilon(1e-12));
}

TEST_CASE("two independent blocks: with groups each has its own probability") {
    // Strips of rock, the first with a plane of 40 degrees and the third with one of 50 degrees.
    const auto strip = [](double from, double to, double dip) {
        const std::string top = std::to_string(4 + 8 * std::tan(dip * kDegree)), low = std::to_string(from),
                          high = std::to_string(to);
        return "[[single_joint]]\npolygon = [[2, " + low + ", 4], [2, " + high + ", 4], [10, " + high + ", " +
               top + "], [10, " + low + ", " + top + "]]\n";
    };
    std::string scenario =
        kStrength +
        "[rock_mass]\nregion = { profile = [[-0.5, -1], [14, -1], [14, 10], [5, 10], [0, 0], [-0.5, "
        "0]], y = [0, 8] }\nfixed = [{ boundary = \"-z\" }]\n";
    for (const char* y : {"3.0", "5.0"})
        scenario += "[[single_joint]]\npoint = [0.0, " + std::string(y) +
                    ", 0.0]\ndip_deg = 90.0\ndip_direction_deg = 0.0\n";
    scenario += strip(0, 3, 40) + strip(5, 8, 50);
    const std::string sweep =
        "samples = 25\n[[random]]\nfield = \"joint.default.friction_deg\"\ndistribution = \"uniform\"\nmin = "
        "30.0\nmax = 60.0\n";
    for (const bool follows : {false, true}) {
        CAPTURE(follows);
        const BatchFolder folder((follows ? "groups = 2\n" : "") + sweep, "safety-factor", scenario);
        REQUIRE(folder.run().exit_code == 0);
        std::uint64_t flat = 0, steep = 0;
        const StoredBatch stored = readStored(folder.out());
        for (std::uint64_t run = 0; run < 25; ++run) {
            const double friction =
                std::stod(stored.row(run)[*stored.info.find("joint.default.friction_deg")]);
            flat += friction < 40;
            steep += friction < 50;
        }
        REQUIRE(flat > 0);
        REQUIRE(steep > flat);
        const FailureMap map = mapOf(folder, 2, 0.5);
        CHECK(map.failed == steep);
        CHECK(map.hits[cellAt(map, {4, 6.5, 8})] == steep);
        CHECK(map.hits[cellAt(map, {4, 1.5, 8})] == (follows ? flat : 0));
        CHECK(map.hits[cellAt(map, {4, 4, 8})] == 0);
        // Triangles (2, 4), (5, 10), (2 + 6 / tan(dip), 10), 3 m wide.
        const auto volume = [](double dip) { return 3 * 0.5 * 6 * (6 / std::tan(dip * kDegree) - 3); };
        const double expected = (static_cast<double>(steep) * volume(50) +
                                 (follows ? static_cast<double>(flat) * volume(40) : 0)) /
                                25;
        CHECK(map.volume == doctest::Approx(expected).epsilon(1e-5));  // corners have six decimals
        CHECK(integral(map) == doctest::Approx(map.volume).epsilon(1e-12));
    }
}

TEST_CASE("the same map for any number of threads, and of a batch that went on") {
    const std::string sweep = randomDips(24);
    const BatchFolder whole(sweep, "safety-factor", kWedge);
    const std::string vtp = whole.folder / "map.vtp", ply = whole.folder / "map.ply",
                      page = whole.folder / "map.html";
    const Outcome first = whole.run({"--threads", "1", "--map", vtp, "--map", ply, "--map", page});
    REQUIRE(first.exit_code == 0);
    CHECK(first.json()["map"]["runs"] == 24);
    CHECK(first.json()["map"]["files"].size() == 3);
    CHECK(contentOf(page).find("samples fail: factor of safety below 1") != std::string::npos);
    CHECK(contentOf(page).find("<svg id=\"map-probability\"") != std::string::npos);
    CHECK(contentOf(ply).starts_with("ply\n"));

    const BatchFolder resumed(randomDips(9), "safety-factor", kWedge);
    REQUIRE(resumed.run().exit_code == 0);
    resumed.folder.write("sweep.toml", "scenario = \"block.toml\"\nanalysis = \"safety-factor\"\n" + sweep);
    const std::string again = resumed.folder / "map.vtp", other = resumed.folder / "map.ply";
    REQUIRE(resumed.run({"--threads", "3", "--map", again, "--map", other}).exit_code == 0);
    CHECK(contentOf(again) == contentOf(vtp));
    CHECK(contentOf(other) == contentOf(ply));
    // Nothing is left to compute: the map comes from the folder.
    const std::string later = resumed.folder / "later.vtp";
    const Outcome rest = resumed.run({"--map", later});
    CHECK(rest.json()["computed"] == 0);
    CHECK(contentOf(later) == contentOf(vtp));
}

TEST_CASE("the map on the slope: one page with the blocks of the scenario and the values of the map") {
    const BatchFolder wedge(randomDips(24), "safety-factor", kWedge);
    const std::string page = wedge.folder / "slope.html";
    const Outcome outcome = wedge.run({"--map-3d", page, "--map-cell", "1"});
    CAPTURE(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.json()["map"]["files"] == nlohmann::json::array({page}));
    const std::string text = contentOf(page), open = "<script id=\"failure-map\" type=\"application/json\">";
    CHECK(text.find("<title>Talus replay</title>") != std::string::npos);
    const std::size_t begin = text.find(open);
    REQUIRE(begin != std::string::npos);
    const std::string data =
        text.substr(begin + open.size(), text.find('<', begin + 1) - begin - open.size());
    const auto json = nlohmann::json::parse(data);
    const FailureMap map = mapOf(wedge, 1, 1);
    const auto& cells = json["cells"];
    REQUIRE(cells["hits"].size() == map.face.cells.size());
    for (std::size_t c = 0; c < map.face.cells.size(); ++c) {
        CHECK(cells["hits"][c] == map.hits[c]);
        CHECK(cells["volume"][c] == map.volume_per_area[c]);
        CHECK(cells["low"][c] == map.interval(c).low);
        CHECK(cells["high"][c] == map.interval(c).high);
        CHECK(cells["centre"][3 * c + 1] == map.face.cells[c].centre.y());
    }
    CHECK(json["runs"] == 24);
    CHECK(json["pieceBegin"].size() == json["pieceCell"].size() + 1);
    CHECK(json["pieceBegin"].back() == json["corner"].size() / 3);
    CHECK(json["scales"]["probability"]["most"] == scaleEnd(map, MapQuantity::probability));
}

TEST_CASE("maps that cannot be made are refused before anything is computed") {
    const auto refused = [](const BatchFolder& folder, std::vector<std::string> more,
                            const std::string& words) {
        const Outcome outcome = folder.run(std::move(more));
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 2);
        CHECK(outcome.err.find(words) != std::string::npos);
        CHECK(contentOf(folder.out() + "/results.csv").empty());
    };
    const BatchFolder wedge(randomDips(4), "safety-factor", kWedge);
    refused(wedge, {"--map", "map.txt"}, "allowed: a name that ends in .html, .vtp or .ply");
    refused(wedge, {"--map", wedge.out() + "/../out/report.html"}, "is the batch's own report");
    refused(wedge, {"--map", wedge.folder / "map.vtp", "--shard", "1/2"}, "found together with --shard");
    refused(wedge, {"--map", wedge.folder / "map.vtp", "--map-cell", "0.001"}, "more than 1000000 cells");
    refused(wedge, {"--map", wedge.folder / "map.html", "--map-cell", "0.1"}, "allowed in a page: at most");
    const std::string slope = wedge.folder / "slope.html";
    refused(wedge, {"--map-3d", "slope.vtp"}, "--map-3d: found");
    refused(wedge, {"--map-3d", slope, "--shard", "1/2"}, "--map-3d: found together with --shard");
    refused(wedge, {"--map-3d", slope, "--map-cell", "0.1"}, "--map-3d: found a face of");
    refused(wedge, {"--map-3d", slope, "--map", slope}, "is a file of --map, too");
    refused(wedge, {"--map-3d", wedge.out() + "/report.html"}, "is the batch's own report");
    const BatchFolder stack(draws(3), "safety-factor", blockScenario(11, 12));
    refused(stack, {"--map", stack.folder / "map.vtp"}, "a scenario without [rock_mass]");
    const BatchFolder grid(randomDips(2) + kGrid, "safety-factor", kWedge);
    refused(grid, {"--map", grid.folder / "map.vtp"}, "found a sweep of 2 cases");
    const BatchFolder angle(randomDips(2), "critical-angle", kWedge);
    refused(angle, {"--map", angle.folder / "map.vtp"}, "[report] with tilt_deg");
    const BatchFolder moved(
        "samples = 2\n[[random]]\nfield = \"rock_mass.region.y[1]\"\ndistribution = "
        "\"uniform\"\nmin = 10\nmax = 11\n",
        "safety-factor", kWedge);
    refused(moved, {"--map", moved.folder / "map.vtp"}, "a sweep that varies rock_mass.region.y[1]");
}

}  // namespace talus::tools::testing
