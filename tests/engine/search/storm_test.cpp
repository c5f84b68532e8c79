// The factor of safety over a rain: limit equilibrium of a block in front of a crack that fills.

#include "talus/storm.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "support/closed_fissure.h"
#include "support/relative.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kRain = 60 / 3.6e6;  // [m/s]: 60 mm/h

/// A block that slides once the crack behind it is full enough: without a leak the level rises by
/// i C / b.
struct StormSlope {
    ClosedFissure fissure{};
    double catchment = 0.03;  ///< [m]
    double until = 3600;      ///< of the rain [s]

    StormSlope() {
        fissure.tilt_deg = 14;
        fissure.filled = 0.05;
    }

    Model model() const {
        Model made = fissure.model(1e10);
        made.waters[0].rain = {{0, kRain}, {until, kRain}, {until + 1, 0}, {2 * until, 0}};
        made.waters[0].catchment = catchment;
        made.waters[0].overflow = 0.45;
        return made;
    }
    double levelAfter(double time) const {
        const double rise = kRain * catchment / fissure.opening * std::min(time, until + 0.5);
        return std::min(0.45, fissure.filled + rise);
    }
    double factorAt(double level) const {
        const double weight = fissure.mass() * fissure.g, beta = fissure.tilt();
        const double thrust =
            0.5 * fissure.water_density * fissure.g * std::cos(beta) * level * level * fissure.width;
        return weight * std::cos(beta) * std::tan(radians(fissure.friction_deg)) /
               (weight * std::sin(beta) + thrust);
    }
};

StormResult computed(const Model& model, const StormSettings& settings, const Control& control = {}) {
    const auto result = storm(model, settings, control);
    for (const Error& error : result.errors()) FAIL_CHECK(error.field << ": " << error.message);
    REQUIRE(result.ok());
    return *result;
}

}  // namespace

TEST_SUITE("engine") {
    TEST_CASE("storm: levels and factors are those of the closed form, and it fails when that says so") {
        const StormSlope slope;
        const StormResult result = computed(slope.model(), {.step = 50});
        REQUIRE(result.points.size() == 146);  // 3601 s, a time of the table, among them
        CHECK(result.waters == std::vector<std::string>{"water[0]"});
        for (const StormPoint& point : result.points) {
            CAPTURE(point.time);
            CHECK(point.levels[0] == near(slope.levelAfter(point.time), 1e-9));
            REQUIRE((point.status == SearchStatus::found));
            const double exact = slope.factorAt(point.levels[0]);
            CHECK(point.factor == doctest::Approx(exact).epsilon(0.002));
            CHECK((point.mode == FailureMode::sliding));
            CHECK(std::isnan(point.low) == point.interpolated);
            CHECK(std::isnan(point.high) == point.interpolated);
        }
        CHECK(result.searches < 20);  // of 33 levels
        REQUIRE(result.least);
        CHECK_FALSE(result.points[*result.least].interpolated);
        REQUIRE(result.failure_time);
        double low = 0, high = slope.until;
        for (int k = 0; k < 60; ++k)
            (slope.factorAt(slope.levelAfter(0.5 * (low + high))) > 1 ? low : high) = 0.5 * (low + high);
        MESSAGE("fails after " << *result.failure_time << " s, exact " << low << " s, searches "
                               << result.searches);
        CHECK(*result.failure_time == doctest::Approx(low).epsilon(0.05));
        CHECK(result.moving_blocks == std::vector<std::string>{"slide"});
        REQUIRE(result.at_end.size() == 1);
        CHECK(result.at_end[0].run_over > 0);
    }

    TEST_CASE("storm: a factor is that of the search with this level held, to the bit") {
        const StormSlope slope;
        const Model model = slope.model();
        const StormResult result = computed(model, {.step = 1800, .duration = 3600});
        REQUIRE(result.points.size() == 3);
        for (const StormPoint& point : result.points) {
            CHECK_FALSE(point.interpolated);
            Model held = model;
            held.waters[0].closed = false;
            held.waters[0].level = {{0, point.levels[0]}};
            Control control;
            control.interval = false;
            const auto found = safetyFactor(held, control);
            REQUIRE(found.ok());
            CHECK(found->answer == point.factor);
            CHECK(found->low == point.low);
            CHECK(found->high == point.high);
        }
        Control two;
        two.threads = 2;
        const StormResult again = computed(model, {.step = 1800, .duration = 3600}, two);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(again.points[k].factor == result.points[k].factor);
            CHECK(again.points[k].levels == result.points[k].levels);
        }
    }

    TEST_CASE("storm: a level over time is doubted once, by its whole table") {
        Model model = StormSlope{}.fissure.model(1e10);
        Water& water = model.waters[0];
        water.closed = false;
        const auto toldOf = [&](const char* what) {
            const StormResult result = computed(model, {.step = 1800});
            return std::count_if(result.warnings.begin(), result.warnings.end(), [&](const auto& warning) {
                return warning.find(what) != std::string::npos;
            });
        };
        water.level = {{0, 0.05}, {1800, 2.0}, {3600, 1.0}};
        CHECK(toldOf("found a depth of 2 m at 1800 s, so that the water stands") == 1);
        CHECK(toldOf("above the joint's upper end") == 1);
        // What is dry at the least factor is wet at another time.
        water.kind = Water::Level::elevation;
        water.base = 0.3;
        model.joints[0].strength_over_time = {{0, 1}, {1800, 0.5}, {3600, 0.4}};
        water.level = {{0, 0.5}, {1800, 0.2}, {3600, 0.2}};
        CHECK(toldOf("it wets no free block") == 0);
        water.level = {{0, 0.25}, {1800, 0.2}, {3600, 0.2}};
        CHECK(toldOf("it wets no free block") == 1);
    }

    TEST_CASE("storm: equal levels are searched for once, and a table of levels is followed as it is") {
        const StormSlope slope;
        Model model = slope.model();
        Water& water = model.waters[0];
        water.closed = false;
        water.level = {{0, 0.1}, {100, 0.1}, {200, 0.2}, {300, 0.1}, {400, 0.1}};
        const StormResult result = computed(model, {.step = 100});
        REQUIRE(result.points.size() == 5);
        CHECK(result.searches == 2);
        for (std::size_t k = 0; k < 5; ++k) CHECK(result.points[k].levels[0] == water.level[k].value);
        CHECK(result.points[1].factor == result.points[4].factor);
        CHECK(result.points[2].factor < result.points[0].factor);
        CHECK(*result.least == 2);
        CHECK(result.at_end.empty());
        CHECK_FALSE(result.failure_time);
    }

    TEST_CASE("storm: times of tables lie between those of the step, each once") {
        const StormSlope slope;
        Model model = slope.model();
        Water& water = model.waters[0];
        water.closed = false;
        water.level = {{0, 0.1}, {90, 0.2}, {100, 0.1}, {200, 0.1}, {270, 0.1}};
        const StormResult result = computed(model, {.step = 100, .duration = 250});
        std::vector<double> times;
        for (const StormPoint& point : result.points) times.push_back(point.time);
        CHECK(times == std::vector<double>{0, 90, 100, 200, 250});
        CHECK(*result.least == 1);
        CHECK(result.points[1].levels[0] == 0.2);

        water.level.clear();
        for (std::size_t k = 0; k <= 2 * kMostStormPoints; ++k)
            water.level.push_back({static_cast<double>(k), 0.1});
        const auto refused = storm(model, {.step = 600.5});
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.errors()[0].field == "duration");
        CHECK(refused.errors()[0].message.find("with those of the tables, allowed: 40001") !=
              std::string::npos);
    }

    TEST_CASE("storm: elevations that one has found can be given to another, as a table") {
        const StormSlope slope;
        Model model = slope.model();
        Water& water = model.waters[0];
        water.kind = Water::Level::elevation;
        water.overflow = kInfinity;
        const StormResult first = computed(model, {.step = 900, .duration = 1800});
        REQUIRE(first.points.size() == 3);
        CHECK(first.points[2].levels[0] > first.points[0].levels[0]);
        water.closed = false;
        water.level.clear();
        for (const StormPoint& point : first.points) water.level.push_back({point.time, point.levels[0]});
        const StormResult second = computed(model, {.step = 900});
        REQUIRE(second.points.size() == 3);
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(second.points[k].levels == first.points[k].levels);
            CHECK(second.points[k].factor == first.points[k].factor);
        }
    }

    TEST_CASE("storm: a slope that fails before the rain, and one without an end or without water") {
        StormSlope slope;
        slope.fissure.tilt_deg = 20;
        const StormResult result = computed(slope.model(), {.step = 3600, .duration = 3600});
        REQUIRE(result.failure_time);
        CHECK(*result.failure_time == 0);

        Model steady = slope.model();
        steady.waters[0].rain = {{0, kRain}};
        CHECK_FALSE(stormDuration(steady));
        const auto endless = storm(steady, {});
        REQUIRE_FALSE(endless.ok());
        CHECK(endless.errors()[0].field == "duration");
        const auto too_fine = storm(slope.model(), {.step = 1e-3});
        REQUIRE_FALSE(too_fine.ok());
        CHECK(too_fine.errors()[0].field == "step");
        const double nan = std::nan("");
        for (const double bad : {0.0, -300.0, kInfinity, nan}) {
            CAPTURE(bad);
            const auto no_step = storm(slope.model(), {.step = bad});
            REQUIRE_FALSE(no_step.ok());
            CHECK(no_step.errors()[0].field == "step");
            CHECK(no_step.errors()[0].message.find("allowed: more than 0 s") != std::string::npos);
            const auto no_duration = storm(slope.model(), {.step = 300, .duration = bad});
            REQUIRE_FALSE(no_duration.ok());
            CHECK(no_duration.errors()[0].field == "duration");
        }
        steady.waters[0].closed = false;
        const auto held = storm(steady, {.duration = 10});
        REQUIRE_FALSE(held.ok());
        CHECK(held.errors()[0].message.starts_with("found no water whose level changes"));
        Model open = slope.model();
        open.waters[0].walls.pop_back();
        const auto unbounded = storm(open, {});
        REQUIRE_FALSE(unbounded.ok());
        CHECK(unbounded.errors()[0].field == "water[0].volume");
    }

    TEST_CASE("storm: one that is asked to stop returns what it has found") {
        const StormSlope slope;
        std::atomic<bool> stop{false};
        Control control;
        control.stop = &stop;
        int told = 0;
        control.progress = [&](const Progress& progress) {
            CHECK(progress.fraction >= 0);
            CHECK(progress.fraction <= 1);
            if (progress.detail.starts_with("level") && ++told > 30) stop = true;
        };
        const auto result = storm(slope.model(), {.step = 300}, control);
        REQUIRE(result.ok());
        CHECK(result->interrupted);
        CHECK(result->searches < 8);
        stop = true;
        const auto at_once = storm(slope.model(), {.step = 300}, control);
        REQUIRE(at_once.ok());
        CHECK(at_once->interrupted);
    }
}
