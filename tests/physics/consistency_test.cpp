// The program's answers about a model hold together: the three searches below and above the critical angle,
// upper bounds, closed formulas. `talus-consistency` draws as many models as are wanted.

#include "support/consistency.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/drawn_models.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

TEST_SUITE("slow: physics") {
    TEST_CASE("models of eight kinds, drawn at random: answers do not contradict each other") {
        constexpr unsigned kDraws = 4, kFirst = 1001;
        int different = 0;
        for (const ModelKind kind : kModelKinds)
            for (unsigned seed = kFirst; seed < kFirst + kDraws; ++seed) {
                const auto scenario = formats::parseScenario(drawnScenario(kind, seed), "drawn.toml");
                REQUIRE(scenario.ok());
                const Consistency found = checkConsistency(scenario->model, false);
                different += !found.contradictions.empty() || !found.undecided.empty();
                for (const std::vector<std::string>* list : {&found.contradictions, &found.undecided})
                    for (const std::string& said : *list)
                        MESSAGE(std::string(nameOf(kind))
                                << " " << seed << ": " << said << " (" << found.answers << ")");
            }
        CHECK(different == 0);
    }
}
