// Joints whose strength falls with time, as ice in them warms: a block on a plane and one that hangs, in
// closed form; every analysis takes the strength of its time.

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/block_theory.h"
#include "talus/limit_analysis.h"
#include "talus/simulation.h"
#include "talus/storm.h"
#include "talus/theory.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kGravity = 9.81;

/// A block of 1 x 1 x 0.5 m on a plane, so flat that its joint is closed.
struct Thaw {
    double tilt_deg = 25, friction_deg = 40, cohesion = 0;
    std::vector<LevelPoint> table{{0, 1}, {1, 0.2}};

    Model model() const {
        Model made = floorModel(friction_deg);
        made.joints[0].cohesion = made.joints[0].residual_cohesion = cohesion;
        made.joints[0].strength_over_time = table;
        addBox(made, "block", {0, 0, 0}, {1, 1, 0.5});
        made.gravity.tilt = radians(tilt_deg);
        made.damping.contact = 1e-5;
        made.run.watch = {"block"};
        return made;
    }
    double mass() const { return 0.5 * 2700; }
    double weight() const { return mass() * kGravity; }
    /// Of safety, at a factor of strength: f (tan(phi) / tan(beta) + C A / (W sin(beta))).
    double factorAt(double strength) const {
        const double beta = radians(tilt_deg);
        return strength *
               (std::tan(radians(friction_deg)) / std::tan(beta) + cohesion / (weight() * std::sin(beta)));
    }
    /// At which the falling strength reaches the driving force [s], f = 1 - 0.8 t.
    double slidesAt() const { return (1 - 1 / factorAt(1)) / 0.8; }
    /// The acceleration grows by this much per second from then on: g cos(beta) tan(phi) 0.8 [m/s^3].
    double jerk() const {
        return 0.8 * kGravity * std::cos(radians(tilt_deg)) * std::tan(radians(friction_deg));
    }
};

RunResult history(const Model& model, std::vector<HistoryRecord>& records) {
    const auto result = run(model, {}, [&](const HistoryRecord& record) { records.push_back(record); });
    REQUIRE(result.ok());
    return *result;
}

double factorOf(const Model& model) {
    const auto found = safetyFactor(model);
    REQUIRE(found.ok());
    REQUIRE((found->status == SearchStatus::found));
    return found->answer;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE(
        "strength over time: a block slides from when friction is spent, and friction takes the energy") {
        const Thaw thaw;
        Model model = thaw.model();
        model.run.duration = 0.85;
        model.run.frame_interval = 0.05;
        std::vector<HistoryRecord> records;
        history(model, records);
        const double begin = thaw.slidesAt();
        for (const HistoryRecord& record : records) {
            CAPTURE(record.time);
            const double since = std::max(0.0, record.time - begin);
            const BlockReport& block = record.watch.at(0);
            // x = j t^3 / 6. The strength changes every ten steps, so sliding begins up to half a millisecond
            // off; elastic shear of the joint is 1e-6 m.
            const double way = thaw.jerk() * std::pow(since, 3) / 6;
            const double late = 5e-4 * thaw.jerk() * since * since / 2;
            CHECK(std::abs(block.displacement.norm() - way) < 2e-6 + 1e-3 * way + late);
            // Work of friction, f W cos(beta) tan(phi) v: what kinetic and potential energy lack.
            double friction = 0;
            constexpr int kParts = 1000;
            for (int k = 0; k < kParts; ++k) {
                const double t = since * (k + 0.5) / kParts, strength = 1 - 0.8 * (begin + t);
                friction +=
                    strength * thaw.mass() * thaw.jerk() / 0.8 * 0.5 * thaw.jerk() * t * t * since / kParts;
            }
            const double lost = -(record.kinetic_energy + record.elastic_energy + record.gravity_energy -
                                  records.front().elastic_energy);
            CHECK(std::abs(lost - friction) < 0.5 + 0.01 * friction);
        }
        CHECK(begin == doctest::Approx(0.5554).epsilon(1e-3));
        CHECK(records.back().watch.at(0).displacement.norm() > 0.02);
    }

    TEST_CASE("strength over time: a block that hangs falls when its tensile strength is its weight") {
        Model model;
        model.joints = {joint(40)};
        model.joints[0].cohesion = model.joints[0].residual_cohesion = 1e6;
        model.joints[0].tensile_strength = 2 * 2700 * kGravity;
        model.joints[0].strength_over_time = {{0, 1}, {1, 0.2}};
        model.blocks = {box("roof", {-1, -1, 1}, {2, 2, 2}, 2700, Motion::fixed)};
        addBox(model, "block", {0, 0, 0}, {1, 1, 1});
        model.damping.contact = 1e-5;
        model.run.watch = {"block"};
        model.run.duration = 0.8;
        model.run.frame_interval = 0.1;
        std::vector<HistoryRecord> records;
        history(model, records);
        const double begin = 0.5 / 0.8;
        for (const HistoryRecord& record : records) {
            CAPTURE(record.time);
            const double since = std::max(0.0, record.time - begin);
            const double fallen = 0.5 * kGravity * since * since;
            // Contact points break one after the other: the rest spring back with up to g sqrt(m / k).
            const double spring = kGravity * std::sqrt(2700 / 1e10) * since;
            CHECK(std::abs(record.watch.at(0).displacement.norm() - fallen) < 2e-5 + 2 * spring);
        }
    }

    TEST_CASE("strength over time: a table of ones changes no bit of a history") {
        Thaw thaw;
        thaw.friction_deg = 22;
        thaw.table.clear();
        Model plain = thaw.model();
        plain.run.duration = 0.05;
        Model ones = plain;
        ones.joints[0].strength_over_time = {{0, 1}, {1, 1}};
        std::vector<HistoryRecord> records;
        CHECK(history(plain, records).state_hash == history(ones, records).state_hash);
        Model falls = plain;
        falls.joints[0].strength_over_time = {{0, 1}, {1, 0.9}};
        CHECK(history(plain, records).state_hash != history(falls, records).state_hash);
    }

    TEST_CASE("strength over time: each analysis takes the factor at time 0, and says so") {
        for (const double strength : {1.0, 0.7, 0.45})
            for (const double cohesion : {0.0, 5e3}) {
                CAPTURE(strength);
                CAPTURE(cohesion);
                Thaw thaw;
                thaw.cohesion = cohesion;
                thaw.table = {{0, strength}, {100, 0.1}};
                const Model model = thaw.model();
                const double exact = thaw.factorAt(strength);
                const auto found = safetyFactor(model);
                REQUIRE(found.ok());
                CHECK(found->answer == doctest::Approx(exact).epsilon(0.002));
                REQUIRE(found->limit_equilibrium);
                CHECK(found->limit_equilibrium->value == doctest::Approx(exact).epsilon(1e-9));
                REQUIRE(found->warnings.size() >= 1);
                CHECK(found->warnings[0].find(
                          "joint.default.strength_over_time: this answer is for time 0") == 0);
                const auto limit = limitAnalysis(model, Varied::factor);
                REQUIRE(limit.ok());
                CHECK(limit->upper == doctest::Approx(exact).epsilon(1e-3));
                CHECK(limit->warnings.size() == 1);
                const auto keys = keyBlocks(model);
                REQUIRE(keys.ok());
                CHECK(keys->blocks.at(0).sliding.factor == doctest::Approx(exact).epsilon(1e-9));
                CHECK(keys->warnings.size() == 1);
                if (cohesion > 0) continue;
                const double tilt = std::atan(strength * std::tan(radians(40)));
                const auto theory = theory::predict(model);
                REQUIRE(theory);
                CHECK(theory->critical_tilt == doctest::Approx(tilt).epsilon(1e-12));
                const auto angle = criticalAngle(model);
                REQUIRE(angle.ok());
                if (tilt > radians(25))
                    CHECK(angle->answer == doctest::Approx(tilt).epsilon(1e-3));
                else
                    CHECK((angle->status == SearchStatus::unstable_at_start));
            }
    }

    TEST_CASE("strength over time: storm follows it, F(t) = f(t) F(0), and interpolates over it") {
        Thaw thaw;
        thaw.cohesion = 2e3;
        thaw.table = {{0, 1}, {1000, 0.4}, {2000, 0.9}};
        const Model model = thaw.model();
        CHECK(stormDuration(model) == 2000);
        const auto result = storm(model, {.step = 50});
        REQUIRE(result.ok());
        CHECK(result->waters.empty());
        CHECK(result->joints == std::vector<std::string>{"default"});
        REQUIRE(result->points.size() == 41);
        for (const StormPoint& point : result->points) {
            CAPTURE(point.time);
            REQUIRE((point.status == SearchStatus::found));
            CHECK(point.levels.empty());
            REQUIRE(point.strengths.size() == 1);
            CHECK(point.strengths[0] == strengthFactor(model.joints[0], point.time));
            CHECK(point.factor == doctest::Approx(thaw.factorAt(point.strengths[0])).epsilon(0.003));
        }
        CHECK(result->searches <= 14);
        REQUIRE(result->least);
        CHECK(*result->least == 20);
        REQUIRE(result->failure_time);
        const double exact = (1 - 1 / thaw.factorAt(1)) / 0.6 * 1000;
        CHECK(*result->failure_time == doctest::Approx(exact).epsilon(0.01));
        CHECK(result->points[20].factor == factorOf([&] {
                  Model held = model;
                  held.joints[0].strength_over_time = {{0, result->points[20].strengths[0]}};
                  return held;
              }()));
        CHECK(result->warnings.empty());  // each time has its own strength
    }

    TEST_CASE("strength over time: a storm finds the least factor at an entry between two steps") {
        Thaw thaw;
        thaw.table = {{0, 1}, {900, 0.3}, {1800, 1}, {7200, 0.9}};
        const auto result = storm(thaw.model(), {.step = 600});
        REQUIRE(result.ok());
        CHECK(result->points.size() == 14);
        REQUIRE(result->least);
        const StormPoint& least = result->points[*result->least];
        CHECK(least.time == 900);
        CHECK(least.factor == doctest::Approx(thaw.factorAt(0.3)).epsilon(0.002));
        REQUIRE(result->failure_time);
        CHECK(*result->failure_time == doctest::Approx(900 / 0.7 * (1 - 1 / thaw.factorAt(1))).epsilon(0.01));
    }

    TEST_CASE(
        "strength over time: two joints that change each have a column in a storm, equal ones share it") {
        Thaw thaw;
        thaw.table = {{0, 1}, {100, 0.5}};
        Model model = thaw.model();
        model.joints.push_back(model.joints[0]);
        model.joints.back().name = "second";
        model.joints.push_back(model.joints[0]);
        model.joints.back().name = "third";
        model.joints.back().strength_over_time = {{0, 0.8}, {100, 0.9}};
        const auto result = storm(model, {.step = 50});
        REQUIRE(result.ok());
        CHECK(result->joints == std::vector<std::string>{"default, second", "third"});
        REQUIRE(result->points.size() == 3);
        CHECK(result->points[1].strengths == std::vector<double>{0.75, 0.5 * (0.8 + 0.9)});
        CHECK(result->searches == 3);
        for (const StormPoint& point : result->points)
            CHECK(point.factor == doctest::Approx(thaw.factorAt(point.strengths[0])).epsilon(0.002));
    }

    TEST_CASE("strength over time: dilation beyond the least friction is refused") {
        Thaw thaw;
        Model model = thaw.model();
        model.joints[0].dilation = radians(12);
        const auto refused = safetyFactor(model);
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.errors()[0].field == "joint.default.dilation_deg");
        CHECK(refused.errors()[0].message.starts_with(
            "found 12 with a friction angle of 9.5266 at 1 s with 0.2 times the strength: "));
        model.joints[0].strength_over_time = {{0, 1}, {1, 0.5}};
        CHECK(safetyFactor(model).ok());
    }
}
