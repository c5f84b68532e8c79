// Closed volumes of water: how far a slope slides until the level has fallen far enough, where that is used
// up without damping, the energy of the water, and levels that rise by what flows in.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/closed_fissure.h"
#include "support/relative.h"
#include "support/slower.h"
#include "talus/analysis.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

struct Slide {
    RunResult result;
    double way = 0;    ///< of the first watched block [m]
    double level = 0;  ///< at the end [m]
};

Slide slideOf(Model model, const char* block = "slide") {
    model.run.watch = {block};
    const auto result = run(model, {}, RunOutput{});
    for (const Error& error : result.errors()) FAIL_CHECK(error.message);
    REQUIRE(result.ok());
    REQUIRE(result->waters.size() == 1);
    return {*result, result->watch[0].displacement.norm(), result->waters[0].level};
}

/// A dashpot takes out what rattles as the block is released; what slides does not feel it.
Model withoutRattling(const ClosedFissure& fissure) {
    Model model = fissure.model();
    model.damping.contact = 3e-5;
    return model;
}

/// Slowly: with the critical drag of the water's spring, for twelve of its times.
Model slowly(const ClosedFissure& fissure) {
    Model model = withoutRattling(fissure);
    model.damping.mass = fissure.criticalDrag();
    model.run.duration = model.run.frame_interval = 24 / model.damping.mass;
    return model;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("closed volume: moved slowly, a slide stops where the fallen level holds it") {
        for (const double opening : {0.002, 0.005}) {
            if (kTriesFew && opening > 0.002) continue;
            ClosedFissure fissure;
            fissure.opening = opening;
            const Slide slide = slideOf(slowly(fissure));
            MESSAGE("opening " << opening << ": slid " << slide.way << ", exact " << fissure.slowStop()
                               << ", level " << slide.level);
            CHECK(slide.way == near(fissure.slowStop(), 1e-3));
            // Without what the tilt of the table adds: V / (b + d) = H, tan(beta) = tan(phi) - ...
            const double h = std::sqrt(2 * 2.7 * 0.6 * 0.5 *
                                       (std::tan(radians(19.5)) - std::tan(radians(fissure.tilt_deg))));
            CHECK(h == near(0.3031, 1e-3));
            CHECK(slide.level == near(h, 1e-3));
            CHECK(slide.way == near(opening * (0.35 / h - 1), 2e-2));
            CHECK(slide.result.waters[0].volume ==
                  near(fissure.volume(), 1e-3));  // joints give by 1e-6 m before the start
        }
    }

    TEST_CASE("closed volume: without damping the block moves until the work is used up") {
        for (const double opening : {0.002, 0.005}) {
            if (kTriesFew && opening > 0.002) continue;
            ClosedFissure fissure;
            fissure.opening = opening;
            Model model = withoutRattling(fissure);
            model.run.duration = 0.5;
            model.run.frame_interval = 0.5;
            const Slide slide = slideOf(model);
            MESSAGE("opening " << opening << ": slid " << slide.way << ", exact " << fissure.freeStop()
                               << ", level " << slide.level);
            CHECK(slide.way == near(fissure.freeStop(), 2e-3));
            // In closed form without the tilt of the table: (b + d) / b = (H0 / H)^2.
            CHECK(slide.way == near(opening * 0.333, 1.5e-2));
            CHECK(slide.level == near(0.2625, 3e-3));
        }
    }

    TEST_CASE("closed volume: without friction the block has the energy that the water loses") {
        for (const double tilt_deg : {0.0, 10.0}) {
            ClosedFissure fissure;
            fissure.friction_deg = 0;
            fissure.tilt_deg = tilt_deg;
            Model model = fissure.model(1e10);
            model.run.duration = 0.1;
            model.run.frame_interval = 0.005;
            double worst = 0, farthest = 0, first = 0, kinetic = 0;
            model.run.watch = {"slide"};
            const auto result = run(model, {}, [&](const HistoryRecord& record) {
                const double d = -record.watch[0].displacement.x();
                const double beta = fissure.tilt();
                // Of the water, heights along gravity above the fissure: a strip b wide at x = 0, and the
                // room from x = 0 to -d below the table at z = H - x tan(beta).
                const double h = record.waters[0].level, t = std::tan(beta);
                const double b = fissure.opening, w = fissure.width;
                const auto potential = [&](double x) {  // of a strip at x: integral of z cos + x sin over z
                    const double top = h - x * t;
                    return 0.5 * top * top * std::cos(beta) + top * x * std::sin(beta);
                };
                double sum = 0;
                constexpr int kParts = 200;
                for (int k = 0; k < kParts; ++k) sum += potential(-d * (k + 0.5) / kParts) * d / kParts;
                const double water = 1000 * fissure.g * w * (sum + b * potential(0));
                const double total =
                    record.kinetic_energy + record.elastic_energy + record.gravity_energy + water;
                if (record.step == 0) first = total;
                worst = std::max(worst, std::abs(total - first));
                kinetic = record.kinetic_energy;
                farthest = std::max(farthest, d);
            });
            REQUIRE(result.ok());
            MESSAGE("tilt " << tilt_deg << ": moved " << farthest << " m, energy off by " << worst << " J of "
                            << kinetic << " J");
            CHECK(farthest > 1e-3);
            CHECK(worst < 3e-4 * kinetic);
        }
    }

    TEST_CASE("closed volume: an inflow fills a fissure along the exact curve, and runs over") {
        ClosedFissure fissure;
        fissure.tilt_deg = 5;  // stands
        fissure.filled = 0;
        Model model = fissure.model(1e11);
        model.blocks[1].motion = Motion::fixed;  // a fissure of rigid walls
        model.gravity.tilt = radians(5);
        model.waters[0].inflow = {{0.0, 0.0}, {0.02, 0.01}, {0.05, 0.01}};  // m3/s per m
        model.waters[0].overflow = 0.2;
        model.run.duration = 0.08;
        model.run.frame_interval = 0.004;
        model.run.time_step = 1e-5;
        const auto result = run(model, {}, [&](const HistoryRecord& record) {
            const double t = record.time;
            const double in = t < 0.02 ? 0.5 * 0.01 * t * t / 0.02 : 0.5 * 0.01 * 0.02 + 0.01 * (t - 0.02);
            CAPTURE(t);
            REQUIRE(record.waters.size() == 1);
            const WaterReport& water = record.waters[0];
            if (t == 0) {
                CHECK(water.level == 0);
                CHECK(water.volume == 0);
                return;
            }
            CHECK(water.level == near(std::min(0.2, in / fissure.opening), 1e-9));
            CHECK(water.volume + water.run_over == near(in * fissure.width, 1e-11));
            if (in / fissure.opening < 0.2) CHECK(water.run_over <= 1e-18);
        });
        for (const Error& error : result.errors()) FAIL_CHECK(error.message);
        REQUIRE(result.ok());
        CHECK(result->waters[0].level == near(0.2, 1e-12));
        CHECK(result->waters[0].run_over > 0);
    }

    TEST_CASE("closed volume: a supply keeps the slide going that a bag alone stops") {
        ClosedFissure fissure;
        const double stop = fissure.slowStop();
        Model model = slowly(fissure);
        model.waters[0].inflow = {{0.0, 0.002}};
        model.waters[0].overflow = 0.35;
        const Slide slide = slideOf(model);
        CHECK(slide.way > 3 * stop);
    }

    TEST_CASE("closed volume: searches hold the level as filled, and say so") {
        ClosedFissure fissure;
        Model closed = fissure.model();
        closed.analysis.start = 0;
        Model held = closed;
        held.waters[0].closed = false;
        for (const bool tilted : {true, false}) {
            const auto search = [&](const Model& model) {
                return tilted ? criticalAngle(model) : safetyFactor(model);
            };
            const auto a = search(closed), b = search(held);
            REQUIRE(a.ok());
            REQUIRE(b.ok());
            CHECK(a->answer == b->answer);
            CHECK(std::count_if(a->warnings.begin(), a->warnings.end(), [](const std::string& warning) {
                      return warning.find("closed volume") != std::string::npos;
                  }) == 1);
            CHECK(std::none_of(b->warnings.begin(), b->warnings.end(), [](const std::string& warning) {
                return warning.find("closed volume") != std::string::npos;
            }));
        }
    }

    TEST_CASE("closed volume: the failure that a search found is played on with a level that falls") {
        ClosedFissure fissure;
        Model model = fissure.model();
        model.analysis.start = 0;
        Control control;
        control.keep_failing_state = true;
        const auto search = criticalAngle(model, control);
        REQUIRE(search.ok());
        REQUIRE(search->failing != nullptr);
        model.gravity.tilt = search->failing->load;
        model.damping.contact = search->failing->contact_damping;
        model.run.duration = 1;
        model.run.frame_interval = 0.05;
        std::vector<double> levels;
        RunOutput output;
        output.light = [&](LightFrame&& frame) { levels.push_back(frame.water.level[0]); };
        const auto result = runFailing(model, {}, output, *search->failing, 0.05);
        REQUIRE(result.ok());
        REQUIRE(levels.size() > 2);
        CHECK(levels.front() == near(0.35, 1e-9));
        CHECK(levels.back() < 0.999 * levels.front());
    }
}
