// The program's answers about a model hold together: the three searches below and above the critical angle, upper
// bounds, closed formulas. `talus-consistency` draws as many models as are wanted.

#include "support/consistency.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/drawn_models.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

TEST_SUITE("slow: physics") {
    TEST_CASE("models of eight kinds, drawn at random: no answer contradicts another, none is undecided") {
        constexpr unsigned kDraws = 4, kFirst = 1001;
        for (const ModelKind kind : kModelKinds)
            for (unsigned seed = kFirst; seed < kFirst + kDraws; ++seed) {
                const auto scenario = formats::parseScenario(drawnScenario(kind, seed), "drawn.toml");
                REQUIRE(scenario.ok());
                const Consistency found = checkConsistency(scenario->model, false);
                CAPTURE(nameOf(kind));
                CAPTURE(seed);
                CAPTURE(found.answers);
                for (const std::vector<std::string>* list : {&found.contradictions, &found.undecided})
                    for (const std::string& said : *list) FAIL_CHECK(said);
            }
    }
}
