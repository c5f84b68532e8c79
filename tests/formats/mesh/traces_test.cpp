// Traces of a drawing: which plane each has, and what is wrong with those that have none.

#include "mesh/traces.h"

#include <doctest/doctest.h>

#include <cmath>

#include "talus/formats/scenario.h"
#include "talus/rock_mass.h"

namespace talus::formats {

namespace {

constexpr double kDeg = 0.017453292519943295;

std::string pair(int code, const std::string& value) { return std::to_string(code) + "\n" + value + "\n"; }

std::string place(int code, const Vec3& p) {
    return pair(code, std::to_string(p.x())) + pair(code + 10, std::to_string(p.y())) +
           pair(code + 20, std::to_string(p.z()));
}

std::string polyline(const std::vector<Vec3>& points, const std::string& layer = "J1", int flags = 8) {
    std::string text = pair(0, "POLYLINE") + pair(8, layer) + pair(66, "1") + place(10, {0, 0, 0}) +
                       pair(70, std::to_string(flags));
    for (const Vec3& p : points) text += pair(0, "VERTEX") + pair(8, layer) + place(10, p) + pair(70, "32");
    return text + pair(0, "SEQEND") + pair(8, layer);
}

std::string lightweight(const std::vector<Vec3>& points, const std::string& more = "") {
    std::string text = pair(0, "LWPOLYLINE") + pair(8, "J1") + pair(90, std::to_string(points.size())) +
                       pair(70, "0") + pair(38, std::to_string(points.front().z())) + more;
    for (const Vec3& p : points) text += pair(10, std::to_string(p.x())) + pair(20, std::to_string(p.y()));
    return text;
}

std::string drawing(const std::string& entities, const std::string& unit = "6") {
    return pair(0, "SECTION") + pair(2, "HEADER") + pair(9, "$INSUNITS") + pair(70, unit) +
           pair(0, "ENDSEC") + pair(0, "SECTION") + pair(2, "ENTITIES") + entities + pair(0, "ENDSEC") +
           pair(0, "EOF");
}

Traces readGood(const std::string& entities, const TraceOptions& options = {}) {
    auto traces = parseTraces(drawing(entities), "a.dxf", options);
    for (const Error& error : traces.errors()) FAIL_CHECK(format(error));
    REQUIRE(traces.ok());
    return *std::move(traces);
}

std::string fault(const std::string& text, const TraceOptions& options = {}) {
    const auto traces = parseTraces(text, "a.dxf", options);
    REQUIRE_FALSE(traces.ok());
    return format(traces.errors()[0]);
}

/// A line that goes along a plane through the origin and leaves its chord by `relief` in the middle.
std::vector<Vec3> lineIn(const Vec3& normal, double length, double relief) {
    const Vec3 along = Vec3::UnitY().cross(normal).normalized(), across = normal.cross(along);
    return {-0.5 * length * along, relief * across, 0.1 * length * along + 0.5 * relief * across,
            0.5 * length * along};
}

}  // namespace

TEST_CASE("a trace with relief has the plane of its points; its ends are a diameter of the disc") {
    const Vec3 normal = upwardNormal(55 * kDeg, 210 * kDeg);
    const auto traces = readGood(polyline(lineIn(normal, 6, 1.5)));
    REQUIRE(traces.discs.size() == 1);
    CHECK(traces.notes.empty());
    // Coordinates are written with six decimals.
    CHECK(traces.discs[0].dip == doctest::Approx(55 * kDeg).epsilon(1e-5));
    CHECK(traces.discs[0].dip_direction == doctest::Approx(210 * kDeg).epsilon(1e-5));
    CHECK(traces.discs[0].radius == doctest::Approx(3).epsilon(1e-5));
    CHECK(traces.discs[0].centre.norm() < 1e-5);
}

TEST_CASE("the plane of a trace does not depend on how densely its pieces are digitised") {
    const std::vector<Vec3> corners{{0, 0, 0}, {3, 0, 1}, {5, 2, 1}};
    std::vector<Vec3> dense;
    for (int k = 0; k <= 100; ++k) dense.push_back(corners[0] + 0.01 * k * (corners[1] - corners[0]));
    dense.push_back(corners[2]);
    CHECK((planeOfTrace(corners).normal - planeOfTrace(dense).normal).norm() < 1e-12);
    CHECK(planeOfTrace(corners).off_plane < 1e-12);
}

TEST_CASE("a straight trace takes the plane through it that is nearest to the stated one") {
    const TraceOptions stated{{}, Orientation{60 * kDeg, 90 * kDeg}};
    // It rises towards the north by 45 degrees in the mean; the plane dips to the east.
    const Vec3 along = Vec3(0.1, 1, 1).normalized();
    const auto traces = readGood(polyline({{0, 0, 0}, 2 * along, 4 * along}), stated);
    REQUIRE(traces.discs.size() == 1);
    const Vec3 normal = upwardNormal(traces.discs[0].dip, traces.discs[0].dip_direction);
    CHECK(std::abs(normal.dot(along)) < 1e-6);
    // No plane through the line is nearer: the normal's part along the line is all that goes.
    const Vec3 wanted = upwardNormal(60 * kDeg, 90 * kDeg);
    CHECK(normal.dot(wanted) == doctest::Approx(std::sqrt(1 - std::pow(along.dot(wanted), 2))).epsilon(1e-6));
    CHECK(fault(drawing(polyline({{0, 0, 0}, {2, 0, 0}})), stated).find("lies across the plane") !=
          std::string::npos);
}

TEST_CASE("traces that define no plane are faults that name them, unless an orientation is stated") {
    const std::string straight = fault(drawing(polyline({{1, 2, 3}, {4, 2, 3.1}, {7, 2, 3}}, "bed")));
    CHECK(straight ==
          "a.dxf:16: error: found the POLYLINE on layer \"bed\" from (1, 2, 3) with a relief of 0.05 m over "
          "6 m, "
          "too straight to define a plane, allowed: a trace with a relief of at least 0.05 of its length in "
          "one "
          "plane, or dip_deg and dip_direction_deg of the set");
    const std::vector<Vec3> twisted{{0, 0, 0}, {2, 1, 0}, {4, 0, 1}, {6, 0, 0}, {8, 0, 0}};
    CHECK(fault(drawing(polyline(twisted))).find("m off their plane, allowed") != std::string::npos);
    CHECK(readGood(polyline(twisted), {{}, Orientation{30 * kDeg, 0}}).discs.size() == 1);
}

TEST_CASE("what is drawn in plan has the plane of the drawing, not of the joint: it takes the stated one") {
    const std::vector<Vec3> bent{{0, 0, 5}, {2, 1, 5}, {4, 0, 5}};
    const TraceOptions stated{{}, Orientation{70 * kDeg, 0}};
    for (const std::string& entity : {lightweight(bent), polyline(bent, "J1", 0)}) {
        CHECK(fault(drawing(entity)).find("whose points all lie in the plane it was drawn in") !=
              std::string::npos);
        const auto traces = readGood(entity, stated);
        REQUIRE(traces.discs.size() == 1);
        CHECK((traces.discs[0].centre - Vec3(2, 0, 5)).norm() < 1e-12);
        CHECK(traces.discs[0].dip == doctest::Approx(70 * kDeg));
    }
    // In space, all points at one height are a level plane.
    CHECK(readGood(polyline(bent)).discs[0].dip < 1e-9);
}

TEST_CASE("entities that are no traces are left out with a note that counts them, on the wanted layer") {
    const std::string good = polyline(lineIn(upwardNormal(1, 2), 6, 1.5));
    const auto entity = [](const std::string& type, const std::string& layer) {
        return pair(0, type) + pair(8, layer) + place(10, {1, 2, 3});
    };
    const std::string others = entity("SPLINE", "J1") + entity("ARC", "J1") + entity("SPLINE", "J1") +
                               entity("INSERT", "J2") + polyline({{1, 2, 3}}, "J1", 64);
    const auto one_layer = readGood(others + good, {"J1", {}});
    CHECK(one_layer.discs.size() == 1);
    REQUIRE(one_layer.notes.size() == 1);
    CHECK(one_layer.notes[0] ==
          "has 1 ARC, 1 POLYLINE mesh, 2 SPLINE on layer \"J1\", left out: traces are LINE, POLYLINE or "
          "LWPOLYLINE");
    const auto all = readGood(others + good);
    REQUIRE(all.notes.size() == 1);
    CHECK(all.notes[0].starts_with("has 1 ARC, 1 INSERT, 1 POLYLINE mesh, 2 SPLINE, left out"));
    CHECK(fault(drawing(entity("SPLINE", "J1"))).find("found no traces but 1 SPLINE, allowed") !=
          std::string::npos);
    CHECK(fault(drawing(entity("SPLINE", "J2") + good), {"J2", {}})
              .find("found no traces but 1 SPLINE on layer \"J2\", allowed: a layer that has some: \"J1\"") !=
          std::string::npos);
}

TEST_CASE("other layers and entities are passed over; arcs, closed lines and broken files are faults") {
    const std::string good = polyline(lineIn(upwardNormal(1, 2), 6, 1.5));
    const std::string others = pair(0, "CIRCLE") + pair(8, "J1") + pair(10, "1") + pair(40, "2") +
                               polyline({{0, 0, 0}, {1, 0, 0}}, "grid");
    CHECK(readGood(others + good, {"J1", {}}).discs.size() == 1);
    const auto has = [](const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    };
    CHECK(has(fault(drawing(good), {"J9", {}}), "allowed: a layer that has some: \"J1\""));
    CHECK(has(fault(drawing(pair(0, "CIRCLE") + pair(10, "1"))), "found no traces"));
    CHECK(has(fault(drawing(polyline({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}}, "J1", 9))), "which is closed"));
    CHECK(has(fault(drawing(polyline({{1, 0, 0}, {1, 0, 0}}))), "without two different ends"));
    CHECK(has(fault(drawing(lightweight({{0, 0, 1}, {1, 0, 1}}, pair(42, "0.5")))), "with arcs or a spline"));
    CHECK(has(fault(drawing(lightweight({{0, 0, 1}, {1, 0, 1}}, pair(230, "0.5")))), "in a tilted plane"));
    CHECK(has(fault(drawing(pair(0, "LINE") + pair(10, "1,5"))), "found \"1,5\" for group code 10 of LINE"));
    CHECK(has(fault(pair(0, "SECTION") + pair(2, "ENTITIES") + good), "without EOF"));
    CHECK(has(fault("0\nSECTION\nx\n"), "in place of a group code"));
    CHECK(has(fault("AutoCAD Binary DXF..."), "found a binary DXF file"));
    const auto millimetres = parseTraces(drawing(good, "4"), "a.dxf", {});
    REQUIRE(millimetres.ok());
    REQUIRE(millimetres->notes.size() == 1);
    CHECK(millimetres->notes[0] == "has a unit of 0.001 m by its header, and was read in metres");
}

}  // namespace talus::formats
