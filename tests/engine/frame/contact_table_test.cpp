// Contact points in the model frame: gap and force belong together, forces balance the weight, and far
// origins are told.

#include <doctest/doctest.h>

#include "support/models.h"
#include "support/snapshots.h"
#include "talus/contact_table.h"

using namespace talus;
using namespace talus::test;

namespace {

FullFrame atRest(Model model) {
    model.run.duration = 1e-5;
    const Recorded all = record(model, 1);
    REQUIRE(all.result.ok());
    return all.fulls.front();
}

}  // namespace

TEST_CASE("contact table: the gap is the force over stiffness and area, forces carry the weight") {
    Model model = floorModel(30, 1e9);
    addBox(model, "lower", {0, 0, 0}, {1, 1, 0.5});
    addBox(model, "upper", {0.2, 0, 0.5}, {0.7, 1, 0.5});
    const FullFrame frame = atRest(model);
    const ContactTable table = contactTable(frame);
    REQUIRE(table.size() > 0);
    double on_floor = 0;
    for (std::size_t k = 0; k < table.size(); ++k) {
        CHECK(table.normal_force[k] == doctest::Approx(-1e9 * table.gap[k] * table.area[k]).epsilon(1e-6));
        CHECK(table.force.z[k] == doctest::Approx(table.normal_force[k]));
        CHECK((table.state[k] == PointState::sticking));
        if (table.block_a[k] != 0) continue;
        on_floor += table.normal_force[k];
        CHECK(table.position.z[k] == doctest::Approx(0));
        CHECK(table.normal.z[k] == doctest::Approx(1));
    }
    CHECK(on_floor == doctest::Approx(2700 * 9.81 * (0.5 + 0.35)).epsilon(1e-8));
}

TEST_CASE("contact table: places are those of the model far from its origin, too") {
    Model model = floorModel(30, 1e9);
    addBox(model, "key", {0, 0, 0}, {1, 1, 0.5});
    const Vec3 far(4e5, 5e6, 1e3);
    for (Block& block : model.blocks)
        for (Vec3& v : block.shape.vertices) v += far;
    const ContactTable table = contactTable(atRest(model));
    REQUIRE(table.size() > 0);
    for (std::size_t k = 0; k < table.size(); ++k) {
        CHECK(std::abs(table.position.x[k] - far.x() - 0.5) < 0.5 + 1e-6);
        CHECK(std::abs(table.position.z[k] - far.z()) < 1e-6);
    }
}

TEST_CASE("contact table: places kept for vertices that touch nothing are left out") {
    Model model = floorModel(30, 1e9);
    addTurnedCube(model, "cube", turnAbout({1, 0, 0}, 20), 0, 0, 1e-4);
    model.run.start = RunSettings::Start::unstressed;
    const FullFrame frame = atRest(model);
    std::size_t idle = 0;
    for (std::size_t i = 0; i < frame.interfaces.size(); ++i) idle += frame.interfaces.isIdle(i);
    REQUIRE(idle > 0);
    for (const std::int32_t interface : contactTable(frame).interface)
        CHECK_FALSE(frame.interfaces.isIdle(static_cast<std::size_t>(interface)));
}
