// Answers hardly depend on the numbers that the searches are tuned by: each is halved and doubled.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "support/models.h"
#include "support/structures.h"
#include "support/verification.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::test;

namespace {

struct Known {
    const char* name;
    const char* search;
    Model model;
};

std::vector<Known> models() {
    std::vector<Known> all;
    Model block = floorModel(20, 1e10);
    addBox(block, "box", {0, 0, 0}, {1, 1, 0.3});
    all.push_back({"block", "critical-angle", block});
    block.gravity.tilt = radians(10);
    all.push_back({"block at its tilt", "safety-factor", block});
    all.push_back({"block that is pushed", "critical-acceleration", block});
    Model wet = stackModel(4, 5, 1, 19.5);
    wet.waters = {fissureAt(wet, 0.4, 0.35)};
    all.push_back({"wet stack", "critical-angle", wet});
    all.push_back({"toppling column", "critical-angle", stackModel(1, 5, 1, 30)});
    all.push_back({"columns side by side", "critical-angle", stackModel(4, 5, 1, 30, {0.1, 0.1, 0.1})});
    Model brittle = floorModel(30, 1e10);
    brittle.joints[0].cohesion = 800;
    addBox(brittle, "body", {0, 0, 0}, {1, 1, 0.2}, 2000);
    all.push_back({"brittle cohesion", "critical-angle", brittle});
    all.push_back({"arch", "critical-angle", archModel(15, 10, 1.5, 40, 1e12)});
    all.push_back({"bilinear slab", "safety-factor", verification("bilinear-slab")});
    all.push_back({"Goodman and Bray", "safety-factor", verification("goodman-bray-slice-38.15")});
    return all;
}

}  // namespace

TEST_SUITE("slow: physics") {
    TEST_CASE(
        "halving and doubling each rule of the searches moves the answers of ten models by less than 1 %") {
        const Control alone{.interval = false, .upper_bound = Beside::never};
        for (const Known& known : models()) {
            CAPTURE(known.name);
            const LoadSearch& search = *loadSearch(known.search);
            const SearchResult usual = *search.find(known.model, alone, {});
            REQUIRE((usual.status == SearchStatus::found));
            double most = 0;
            std::string by;
            for (const SearchRule& rule : searchRules())
                for (const double times : {0.5, 2.0}) {
                    CAPTURE(rule.name);
                    CAPTURE(times);
                    SearchRules rules;
                    rules.*rule.value *= times;
                    const SearchResult result = *search.find(known.model, alone, rules);
                    CHECK((result.status == SearchStatus::found));
                    const double moved = std::abs(result.answer / usual.answer - 1);
                    CHECK(moved < 0.01);
                    if (moved > most) most = moved, by = rule.name;
                }
            MESSAGE(std::string(known.name)
                    << ": " << usual.answer << ", moved by at most " << 100 * most << " %, by " << by);
        }
    }
}
