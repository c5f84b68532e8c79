#include "limit_analysis/linear_program.h"

#include <doctest/doctest.h>

#include <limits>

using namespace talus::limit;

TEST_SUITE("limit_analysis") {
    TEST_CASE("a programme with numbers beyond the solver's reach fails, and does not end the process") {
        for (const double bound : {1e3, 1e30, 1e150, 1e300}) {
            CAPTURE(bound);
            LinearProgram program({bound}, {bound}, nullptr);
            Columns columns;
            columns.entry(0, 1);
            columns.close(0, 1e4, 1);
            program.append(columns);
            const Outcome outcome = program.solvePrimal();
            CHECK((outcome == (bound < 1e4 ? Outcome::optimal : Outcome::failed)));
        }
    }

    TEST_CASE("rows need have no lower or no upper bound") {
        constexpr double kNone = std::numeric_limits<double>::infinity();
        LinearProgram program({-kNone, 2}, {7, kNone}, nullptr);
        Columns columns;
        columns.entry(0, 1);
        columns.entry(1, 1);
        columns.close(0, 1e4, -1);
        program.append(columns);
        REQUIRE((program.solvePrimal() == Outcome::optimal));
        CHECK(program.value(0) == doctest::Approx(7));
    }
}
