// Readers that are not ours, @mcap/core and FlatBuffers reflection by the embedded schema, find the same
// values. Needs node and npm, and the packages of node/package.json, which are installed beside the test
// program once.

#include <doctest/doctest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/files.h"
#include "support/skip.h"
#include "support/snapshots.h"

using namespace talus;
using namespace talus::formats;
using namespace talus::test;
using nlohmann::json;

namespace {

bool succeeds(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

/// The folder with the script and its packages; empty when they cannot be had.
std::string nodeFolder() {
    const std::filesystem::path source = std::string(TALUS_SOURCE_DIR) + "/tests/formats/snapshot/node";
    const std::filesystem::path folder =
        std::filesystem::path(TALUS_PROGRAM).parent_path().parent_path() / "tests/snapshot-node";
    if (!succeeds("node --version") || !succeeds("npm --version")) return "";
    std::filesystem::create_directories(folder);
    for (const char* name : {"package.json", "package-lock.json", "read.mjs"})
        std::filesystem::copy_file(source / name, folder / name,
                                   std::filesystem::copy_options::overwrite_existing);
    const std::string quoted = "'" + folder.string() + "'";
    if (!std::filesystem::exists(folder / "node_modules/@mcap/core") &&
        !succeeds("cd " + quoted + " && npm ci --ignore-scripts"))
        return "";
    return folder.string();
}

std::vector<json> readWithNode(const std::string& node, const std::string& path,
                               const std::string& from = "") {
    const std::string out = path + ".jsonl";
    const std::string command = "node '" + node + "/read.mjs' '" + path + "' " + from + " > '" + out + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    std::istringstream text(contentOf(out));
    std::vector<json> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
    return lines;
}

/// "blocks.position.x" in a message; absent where the vector is empty.
json at(const json& values, const std::string& path) {
    const json* now = &values;
    std::istringstream parts(path);
    for (std::string part; std::getline(parts, part, '.');) {
        if (!now->is_object() || !now->contains(part)) return nullptr;
        now = &now->at(part);
    }
    return *now;
}

double numberOf(const json& value) {
    if (value.is_number()) return value.get<double>();
    return value == "NaN"      ? std::nan("")
           : value.is_string() ? std::strtod(value.get<std::string>().c_str(), nullptr)
                               : -1;
}

template <class Number>
bool same(const json& found, const std::vector<Number>& expected) {
    if (found.is_null()) return expected.empty();
    if (found.size() != expected.size()) return false;
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const double a = numberOf(found[k]), b = static_cast<double>(expected[k]);
        if (a != b && !(std::isnan(a) && std::isnan(b))) return false;
    }
    return true;
}

bool same(const json& found, double expected) { return numberOf(found) == expected; }
bool sameHash(const json& found, std::uint64_t expected) { return found == std::to_string(expected); }

#define SAME(values, frame, path) CHECK_MESSAGE(same(at(values, #path), (frame).path), #path)
#define SAME_VECTOR(values, frame, path) \
    SAME(values, frame, path.x);         \
    SAME(values, frame, path.y);         \
    SAME(values, frame, path.z)

void checkLight(const json& v, const LightFrame& f) {
    SAME(v, f, time);
    CHECK(sameHash(v.at("state_hash"), f.state_hash));
    CHECK(v.at("step") == std::to_string(f.step));
    SAME(v, f, tilt);
    SAME(v, f, time_step);
    SAME(v, f, out_of_balance);
    CHECK(same(at(v, "energies.kinetic"), f.kinetic_energy));
    CHECK(same(at(v, "energies.elastic"), f.elastic_energy));
    CHECK(same(at(v, "energies.gravity"), f.gravity_energy));
    SAME_VECTOR(v, f, displacement);
    SAME_VECTOR(v, f, rotation);
    SAME_VECTOR(v, f, velocity);
    SAME(v, f, water.level);
    SAME(v, f, water.table);
    SAME(v, f, water.drained);
}

void checkFull(const json& v, const FullFrame& f) {
    SAME(v, f, time);
    CHECK(sameHash(v.at("state_hash"), f.state_hash));
    SAME_VECTOR(v, f, blocks.position);
    SAME(v, f, blocks.orientation.w);
    SAME_VECTOR(v, f, blocks.orientation);
    SAME_VECTOR(v, f, blocks.velocity);
    SAME_VECTOR(v, f, blocks.angular_momentum);
    SAME_VECTOR(v, f, blocks.force);
    SAME_VECTOR(v, f, blocks.torque);
    SAME(v, f, blocks.inverse_mass);
    SAME_VECTOR(v, f, blocks.inverse_inertia);
    SAME(v, f, interfaces.block_a);
    SAME(v, f, interfaces.block_b);
    SAME(v, f, interfaces.face_a);
    SAME(v, f, interfaces.face_b);
    SAME(v, f, interfaces.joint);
    SAME(v, f, interfaces.area);
    SAME_VECTOR(v, f, interfaces.origin_a);
    SAME_VECTOR(v, f, interfaces.e1_a);
    SAME_VECTOR(v, f, interfaces.e2_b);
    SAME_VECTOR(v, f, interfaces.reference_gap);
    SAME(v, f, interfaces.point_begin);
    SAME(v, f, interfaces.patch_begin);
    SAME(v, f, interfaces.patch_xi);
    SAME(v, f, interfaces.patch_eta);
    SAME_VECTOR(v, f, interfaces.force);
    SAME_VECTOR(v, f, interfaces.moment_a);
    SAME_VECTOR(v, f, interfaces.moment_b);
    SAME(v, f, points.xi);
    SAME(v, f, points.eta);
    SAME(v, f, points.area);
    SAME(v, f, points.offset_1);
    SAME(v, f, points.offset_2);
    SAME(v, f, points.bond);
    SAME(v, f, points.dilation);
    SAME(v, f, points.normal);
    SAME(v, f, points.shear_1);
    SAME(v, f, points.shear_2);
    SAME(v, f, points.water);
    SAME(v, f, points.state);
    SAME(v, f, points.mobilised);
    SAME_VECTOR(v, f, wet.force);
    SAME(v, f, wet.vertex_x);
    SAME(v, f, waters.p0);
    SAME(v, f, waters.tilt);
    CHECK(same(at(v, "laws.tan_friction"), f.laws.of(&Joint::friction)));
    CHECK(same(at(v, "search.position.x"), f.search_position.x));
    CHECK(same(at(v, "search.margin"), f.search_margin));
    CHECK(same(at(v, "progress.next_frame"), f.progress.next_frame));
    CHECK(same(at(v, "loads.contact_damping"), f.loads.contact_damping));
}

}  // namespace

TEST_CASE("@mcap/core reads a snapshot file by its index, and every value is equal") {
    const std::string node = nodeFolder();
    if (node.empty())
        return test::skip("node, npm or the packages of tests/formats/snapshot/node are not to be had here");
    const TemporaryFolder folder;
    const Scenario scenario = *parseScenario(runScenarioText("0.03"), "run.toml");
    const Recorded run = record(scenario.model, 5);
    REQUIRE(writeFile(folder / "a.mcap", scenario, run).empty());
    const std::vector<json> lines = readWithNode(node, folder / "a.mcap");
    const json& summary = lines.at(0);
    CHECK(summary.at("profile") == "talus");
    CHECK(summary.at("messages") == std::to_string(1 + run.lights.size() + run.fulls.size()));
    CHECK(summary.at("metadata")[0].at("name") == "talus.end");

    std::size_t light = 0, full = 0;
    for (std::size_t k = 1; k < lines.size(); ++k) {
        const json& values = lines[k].at("values");
        if (lines[k].at("topic") == "header") {
            CHECK(values.at("scenario_text") == scenario.text);
            CHECK(same(at(values, "geometry.vertex.x"), run.geometry.vertex.x));
            CHECK(same(at(values, "geometry.face_vertex"), run.geometry.face_vertex));
            CHECK(at(values, "geometry.name")[0] == "floor");
            CHECK(same(at(values, "waters")[1].at("head"), std::vector<double>{0.1, 0.02}));
        } else if (lines[k].at("topic") == "frame") {
            REQUIRE(light < run.lights.size());
            checkLight(values, run.lights[light++]);
        } else {
            REQUIRE(full < run.fulls.size());
            checkFull(values, run.fulls[full++]);
        }
    }
    CHECK(light == run.lights.size());
    CHECK(full == run.fulls.size());

    // Seek by time: only what comes at or after 25 ms.
    const std::vector<json> later = readWithNode(node, folder / "a.mcap", "25000000");
    std::size_t expected = 0;
    for (const LightFrame& frame : run.lights) expected += frame.time >= 0.025 - 1e-9;
    std::size_t found = 0;
    for (std::size_t k = 1; k < later.size(); ++k) {
        CHECK(std::stoull(later[k].at("time").get<std::string>()) >= 25000000);
        found += later[k].at("topic") == "frame";
    }
    CHECK(found == expected);
}
