// PLY and glTF of a run, read back by hand: the blocks' volumes, places and turns.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include "support/models.h"
#include "support/snapshots.h"
#include "talus/formats/export.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;
using nlohmann::json;

namespace {

struct Run {
    formats::Scenario scenario = *formats::parseScenario(runScenarioText("0.02"), "test.toml");
    Recorded recorded = record(scenario.model);
    formats::SnapshotHeader header = formats::headerOf(scenario, recorded.geometry, "", 10);
};

const Run& aRun() {
    static const Run run;
    return run;
}

template <class Number>
Number take(const char*& at) {
    Number value;
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
    return value;
}

/// A .glb file taken apart.
struct Glb {
    json document;
    std::string binary;

    explicit Glb(const std::string& file) {
        const char* at = file.data();
        CHECK(take<std::uint32_t>(at) == 0x46546C67);
        CHECK(take<std::uint32_t>(at) == 2);
        CHECK(take<std::uint32_t>(at) == file.size());
        const auto length = take<std::uint32_t>(at);
        CHECK(length % 4 == 0);
        CHECK(take<std::uint32_t>(at) == 0x4E4F534A);
        document = json::parse(at, at + length);
        at += length;
        const auto bytes = take<std::uint32_t>(at);
        CHECK(take<std::uint32_t>(at) == 0x004E4942);
        binary.assign(at, bytes);
        CHECK(at + bytes == file.data() + file.size());
        CHECK(document["buffers"][0]["byteLength"] == bytes);
    }

    template <class Number>
    std::vector<Number> values(std::size_t accessor, std::size_t parts) const {
        const json& a = document["accessors"][accessor];
        const json& view = document["bufferViews"][a["bufferView"].get<std::size_t>()];
        std::vector<Number> all(a["count"].get<std::size_t>() * parts);
        REQUIRE(view["byteLength"].get<std::size_t>() == all.size() * sizeof(Number));
        std::memcpy(all.data(), binary.data() + view["byteOffset"].get<std::size_t>(),
                    all.size() * sizeof(Number));
        return all;
    }
};

Vec3 vectorOf(const json& list) {
    return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

double volumeOf(const Glb& glb, std::size_t mesh) {
    const json& primitive = glb.document["meshes"][mesh]["primitives"][0];
    const auto places = glb.values<float>(primitive["attributes"]["POSITION"].get<std::size_t>(), 3);
    const auto corners = glb.values<std::uint32_t>(primitive["indices"].get<std::size_t>(), 1);
    const auto at = [&](std::size_t k) {
        return Vec3(places[3 * corners[k]], places[3 * corners[k] + 1], places[3 * corners[k] + 2]);
    };
    double volume = 0;
    for (std::size_t k = 0; k < corners.size(); k += 3) volume += at(k).dot(at(k + 1).cross(at(k + 2))) / 6;
    return volume;
}

}  // namespace

TEST_CASE("glTF: a node a block, with its mesh, its place and its turn at every frame") {
    const Run& run = aRun();
    const Glb glb(formats::gltfBlocks(run.header, run.recorded.lights));
    const json& nodes = glb.document["nodes"];
    REQUIRE(nodes.size() == run.header.names.size() + 2);
    const Vec3 origin = vectorOf(nodes[1]["translation"]);
    for (std::size_t b = 0; b < run.header.names.size(); ++b) {
        const json& node = nodes[b + 2];
        CHECK(node["name"] == run.header.names[b]);
        const double volume = volumeOf(glb, node["mesh"].get<std::size_t>());
        CHECK(volume == doctest::Approx(run.header.geometry.mass[b] / 2700).epsilon(1e-5));
        const Vec3 centroid(run.header.geometry.centroid.x[b], run.header.geometry.centroid.y[b],
                            run.header.geometry.centroid.z[b]);
        const VectorList<float>& moved = run.recorded.lights.front().displacement;
        CHECK((origin + vectorOf(node["translation"]) - centroid - Vec3(moved.x[b], moved.y[b], moved.z[b]))
                  .norm() < 1e-12);
    }
    // z up becomes y up.
    const json& q = nodes[0]["rotation"];
    const Vec3 up =
        Eigen::Quaterniond(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>()) *
        Vec3::UnitZ();
    CHECK((up - Vec3::UnitY()).norm() < 1e-12);
}

TEST_CASE("glTF: the animation is the run") {
    const Run& run = aRun();
    const Glb glb(formats::gltfBlocks(run.header, run.recorded.lights));
    const json& animation = glb.document["animations"][0];
    REQUIRE_FALSE(animation["channels"].empty());
    const LightFrame& last = run.recorded.lights.back();
    std::size_t turned = 0;
    for (const json& channel : animation["channels"]) {
        const std::size_t block = channel["target"]["node"].get<std::size_t>() - 2;
        CHECK(run.header.motions[block] == Motion::free);
        const json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
        const auto times = glb.values<float>(sampler["input"].get<std::size_t>(), 1);
        REQUIRE(times.size() == run.recorded.lights.size());
        CHECK(times.back() == doctest::Approx(last.time));
        const auto output = sampler["output"].get<std::size_t>();
        if (channel["target"]["path"] == "translation") {
            const auto places = glb.values<float>(output, 3);
            const double moved = places[places.size() - 3] - places[0];
            CHECK(moved == doctest::Approx(last.displacement.x[block] -
                                           run.recorded.lights.front().displacement.x[block])
                               .epsilon(1e-3));
            continue;
        }
        const auto turns = glb.values<float>(output, 4);
        const double angle = 2 * std::acos(std::min(1.0, std::abs(static_cast<double>(turns.back()))));
        const Vec3 rotation(last.rotation.x[block], last.rotation.y[block], last.rotation.z[block]);
        CHECK(std::abs(angle - rotation.norm()) < 1e-3);
        turned += rotation.norm() > 1e-3;
    }
    CHECK(turned > 0);
}

TEST_CASE("glTF: one frame stands still; survey coordinates keep their places") {
    Run run = aRun();
    const Vec3 far(4e5, 5e6, 1e3);
    for (std::size_t v = 0; v < run.header.geometry.vertex.x.size(); ++v)
        run.header.geometry.vertex.x[v] += far.x(), run.header.geometry.vertex.y[v] += far.y(),
            run.header.geometry.vertex.z[v] += far.z();
    for (std::size_t b = 0; b < run.header.names.size(); ++b)
        run.header.geometry.centroid.x[b] += far.x(), run.header.geometry.centroid.y[b] += far.y(),
            run.header.geometry.centroid.z[b] += far.z();
    const Glb glb(formats::gltfBlocks(run.header, {run.recorded.lights.back()}));
    CHECK_FALSE(glb.document.contains("animations"));
    CHECK(volumeOf(glb, 1) == doctest::Approx(run.header.geometry.mass[1] / 2700).epsilon(1e-4));
}

TEST_CASE("PLY: vertices and faces are those of the frame, each face with its block and colour") {
    const Run& run = aRun();
    const LightFrame& frame = run.recorded.lights.back();
    const std::string ply = formats::plyBlocks(run.header, frame);
    const std::size_t body = ply.find("end_header\n") + 11;
    const std::vector<Vec3> vertices = formats::placedVertices(run.header, frame);
    const std::size_t faces = run.header.geometry.face_vertex_begin.size() - 1;
    CHECK(ply.find("element vertex " + std::to_string(vertices.size()) + "\n") != std::string::npos);
    CHECK(ply.find("element face " + std::to_string(faces) + "\n") != std::string::npos);
    const char* at = ply.data() + body;
    for (const Vec3& vertex : vertices)
        for (const double part : {vertex.x(), vertex.y(), vertex.z()}) CHECK(take<double>(at) == part);
    const std::vector<FailureMode> roles = formats::failureRoles(run.header, frame);
    std::size_t b = 0;
    for (std::size_t f = 0; f < faces; ++f) {
        while (static_cast<std::size_t>(run.header.geometry.face_begin[b + 1]) <= f) ++b;
        const auto corners = take<std::uint8_t>(at);
        const auto first = run.header.geometry.face_vertex_begin[f];
        REQUIRE(corners == run.header.geometry.face_vertex_begin[f + 1] - first);
        for (std::int32_t k = 0; k < corners; ++k)
            CHECK(take<std::int32_t>(at) ==
                  run.header.geometry.face_vertex[static_cast<std::size_t>(first + k)]);
        CHECK(take<std::int32_t>(at) == static_cast<std::int32_t>(b));
        CHECK(take<std::uint8_t>(at) == static_cast<std::uint8_t>(roles[b]));
        at += 3;
    }
    CHECK(at == ply.data() + ply.size());
}

TEST_CASE("a body of two parts is drawn by its surface: no face that lies inside, in any format") {
    formats::Scenario scenario = *formats::parseScenario(runScenarioText("0.002"), "test.toml");
    Block& block = scenario.model.blocks.back();
    block.shape = *joinParts({*makeBox({2, 0, 5}, {3, 1, 6}), *makeBox({3, 0, 5}, {4, 1, 6})});
    block.face_joint.assign(block.shape.faces.size(), 0);
    scenario.model.waters.clear();
    const Recorded recorded = record(scenario.model);
    const formats::SnapshotHeader header = formats::headerOf(scenario, recorded.geometry, "", 10);
    const LightFrame& frame = recorded.lights.back();
    const std::size_t faces = header.geometry.face_vertex_begin.size() - 1, surface = faces - 2;
    std::size_t triangles = 0;  // of the fans of all but the two inner squares
    for (std::size_t f = 0; f < faces; ++f)
        triangles += static_cast<std::size_t>(header.geometry.face_vertex_begin[f + 1] -
                                              header.geometry.face_vertex_begin[f] - 2);
    triangles -= 2 * 2;

    const std::string ply = formats::plyBlocks(header, frame);
    CHECK(ply.find("element face " + std::to_string(surface) + "\n") != std::string::npos);
    const std::string stl = formats::stlBlocks(header, frame);
    CHECK(stl.size() == 84 + 50 * triangles);
    const Glb glb(formats::gltfBlocks(header, {frame}));
    const json& body = glb.document["meshes"].back()["primitives"][0];
    CHECK(glb.document["accessors"][body["indices"].get<std::size_t>()]["count"] == 10 * 6);
}
