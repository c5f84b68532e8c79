// The paper's columns in front of a fissure with a closed volume of water: as one block does
// (closed_water_test.cpp).

#include <doctest/doctest.h>

#include "support/closed_fissure.h"
#include "support/relative.h"
#include "support/verification.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

TEST_SUITE("slow: physics") {
    TEST_CASE(
        "closed volume: three columns stop where the fallen level holds them, and undamped at twice that") {
        ClosedFissure fissure;
        fissure.tilt_deg = 16.562588;
        for (const bool slow : {true, false}) {
            const Model model = verification(slow ? "closed-fissure-slow" : "closed-fissure-free");
            const auto result = run(model, {}, RunOutput{});
            for (const Error& error : result.errors()) FAIL_CHECK(error.message);
            REQUIRE(result.ok());
            const double way = result->watch.at(0).displacement.norm();
            const double exact = slow ? fissure.slowStop() : fissure.freeStop();
            MESSAGE("slid " << way << ", exact " << exact << ", level " << result->waters.at(0).level);
            CHECK(way == near(exact, slow ? 0.01 : 0.02));
            // The columns behind the fissure stand.
            for (std::size_t b = 0; b < model.blocks.size(); ++b)
                if (model.blocks[b].name.starts_with("c5"))
                    CHECK(result->displacements[b].norm() < 0.01 * exact);
        }
    }
}
