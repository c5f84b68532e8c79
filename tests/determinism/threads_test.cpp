// Same binary, same input, same bits: for any number of threads.

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include "build/build.h"
#include "contacts/update.h"
#include "measure/measure.h"
#include "step/step.h"
#include "step/time_step.h"
#include "support/models.h"
#include "talus/analysis.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

/// A slope that fails: 600 blocks and some 2,000 interfaces, so that every stage's range is cut.
Model slidingSlope() {
    Model model = stackModel(10, 6, 10, 15);
    model.gravity.tilt = radians(20);
    model.damping.contact = 1e-6;
    model.waters = {fissureAt(model, 1.0, 0.4)};
    return model;
}

/// 300 steps, `together` of them at once, with a search in the middle.
std::uint64_t hashAfter(const Model& model, int threads, bool parallel, int together) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
        State state = *buildState(model, parallel);
        const std::vector<double> bounds = frequencyBounds(state, parallel);
        const double dt =
            0.5 * stableTimeStep(*std::max_element(bounds.begin(), bounds.end()), state.damping.contact);
        updateForces(state, parallel);
        for (int k = 0; k < 300; k += together) {
            if (k == 150) findInterfaces(state, false, parallel);
            advance(state, {dt, parallel}, together);
        }
        return stateHash(state);
    });
}

}  // namespace

TEST_SUITE("determinism") {
    TEST_CASE("state hash is equal for 1, 2, 3, 5 and 8 threads and for the serial path") {
        const Model model = slidingSlope();
        const std::uint64_t serial = hashAfter(model, 1, false, 1);
        for (const int threads : {1, 2, 3, 5, 8}) {
            CAPTURE(threads);
            CHECK(hashAfter(model, threads, true, 10) == serial);
        }
    }

    TEST_CASE("a closed volume of water: the same bits for 1 and 2 threads") {
        Model model = slidingSlope();
        model.waters[0].closed = true;
        model.waters[0].opening = 0.002;
        model.waters[0].inflow = {{0.0, 0.01}};
        model.run.start = RunSettings::Start::unstressed;
        model.run.duration = 5e-4;
        const auto one = run(model, {.threads = 1}, RunOutput{}),
                   two = run(model, {.threads = 2}, RunOutput{});
        REQUIRE(one.ok());
        REQUIRE(two.ok());
        CHECK(one->state_hash == two->state_hash);
        REQUIRE(one->waters.size() == 1);
        CHECK(one->waters[0].level == two->waters[0].level);
        CHECK(one->waters[0].volume == two->waters[0].volume);
        CHECK(one->waters[0].level != 0.4);
    }

    TEST_CASE("a copied state continues to the same bits") {
        Model model = slidingSlope();
        State state = *buildState(model, false);
        const double dt = 2e-6;
        updateForces(state, false);
        for (int k = 0; k < 100; ++k) advance(state, {dt, false});
        State copy = state;
        for (int k = 0; k < 100; ++k) advance(state, {dt, false});
        for (int k = 0; k < 100; ++k) advance(copy, {dt, false});
        CHECK(stateHash(copy) == stateHash(state));
    }

    TEST_CASE("analyses end in the same state with any number of threads, and again") {
        Model model = stackModel(3, 4, 1, 19.5);
        model.waters = {fissureAt(model, 0.2, 0.25)};
        const SearchResult first = *criticalAngle(model, {.threads = 1});
        for (const int threads : {1, 2, 3, 5, 8}) {
            const SearchResult again = *criticalAngle(model, {.threads = threads});
            CHECK(again.state_hash == first.state_hash);
            CHECK(again.answer == first.answer);
            CHECK(again.steps == first.steps);
        }
        model.run.duration = 0.01;
        const std::uint64_t hash = run(model, {.threads = 1}, {})->state_hash;
        CHECK(run(model, {.threads = 8}, {})->state_hash == hash);
    }
}
