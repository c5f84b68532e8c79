#include "limit_analysis/linear_program.h"

#include <doctest/doctest.h>

using namespace talus::limit;

TEST_SUITE("limit_analysis") {
    TEST_CASE("a programme with numbers beyond the solver's reach fails, and does not end the process") {
        for (const double bound : {1e3, 1e30, 1e150, 1e300}) {
            CAPTURE(bound);
            LinearProgram program({bound}, {bound}, nullptr);
            Columns columns;
            columns.begin = {0, 1};
            columns.lower = {0};
            columns.upper = {1e4};
            columns.cost = {1};
            columns.row = {0};
            columns.value = {1};
            program.append(columns);
            const Outcome outcome = program.solvePrimal();
            CHECK((outcome == (bound < 1e4 ? Outcome::optimal : Outcome::failed)));
        }
    }
}
