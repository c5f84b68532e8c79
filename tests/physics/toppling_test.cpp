// What topples, leans or arches is decided, and where it should be.

#include <doctest/doctest.h>

#include <string>

#include "support/models.h"
#include "support/structures.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

/// Found, with its bracket in degrees.
SearchResult tilted(const Model& model, const std::string& name) {
    const SearchResult result = *criticalAngle(model);
    MESSAGE(name << ": " << degrees(result.low) << " to " << degrees(result.high) << ", " << result.steps
                 << " steps, " << result.factors << " factorisations");
    REQUIRE((result.status == SearchStatus::found));
    return result;
}

}  // namespace

TEST_SUITE("slow: physics") {
    TEST_CASE("columns overturn at atan(0.2 / h), less what their joints give") {
        for (const auto& [rows, exact] : {std::pair{10, 11.310}, {20, 5.711}}) {
            const Model model = stackModel(1, rows, 1, 35, {0.2, 1.0, 0.1}, 1e12);
            const double found = degrees(tilted(model, std::to_string(rows) + " blocks").answer);
            CHECK(found < exact + 0.02);
            CHECK(found > exact - 0.02);
        }
    }

    TEST_CASE("arches stand that were called unstable at the start, and fail by hinges when tilted") {
        const double found = degrees(tilted(archModel(27, 10, 1.5, 35, 1e12), "1.5 m").answer);
        CHECK(found < 8.27 + 0.01);
        CHECK(found > 8.27 - 0.05);
        CHECK((criticalAngle(archModel(27, 10, 1.0, 35, 1e12))->status == SearchStatus::unstable_at_start));
    }
}
