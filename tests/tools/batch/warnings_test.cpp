#include "batch/warnings.h"

#include <doctest/doctest.h>

namespace talus::tools::batch {

TEST_CASE("warnings without numbers keep the digits of names") {
    CHECK(withoutNumbers("water[0].depth: found water up to -3.5e-15 m") ==
          "water[0].depth: found water up to # m");
    CHECK(withoutNumbers("joint.J1.cohesion: 40000 is more than cohesion, 2.5e+04: stronger") ==
          "joint.J1.cohesion: # is more than cohesion, #: stronger");
    CHECK(withoutNumbers("block \"c3 r12\" moved by 0.3 m3") == "block \"c# r#\" moved by # m3");
    CHECK(withoutNumbers("0.5. 7e x") == "#. #e x");
    CHECK(withoutNumbers("").empty());
}

TEST_CASE("each distinct warning is counted once a run") {
    WarningCount count;
    count.add(2, "a: 1 m | b | a: 2 m");
    count.add(5, "");
    count.add(7, "b");
    count.add(9, "b | water[1]: c");
    const auto groups = count.groups();
    REQUIRE(groups.size() == 3);
    CHECK(warningLine(groups[0], 9) == "3 of 9 runs: b");
    CHECK(warningLine(groups[1], 9) == "1 of 9 runs, with the numbers of run 2: a: 1 m");
    CHECK(warningLine(groups[2], 1) == "1 of 1 run: water[1]: c");
    CHECK(groups[2].first == 9);
    CHECK(moreWarnings(groups).empty());
}

TEST_CASE("many kinds of warnings are counted, not all shown") {
    WarningCount count;
    std::string cell;
    for (char c = 'a'; c <= 'z'; ++c) cell += std::string(cell.empty() ? "" : kBetweenWarnings) + c;
    count.add(0, cell);
    CHECK(moreWarnings(count.groups()) == "and 6 more in the column warnings of results.csv");
    const std::string lines = warningLines(count.groups(), 1);
    CHECK(lines.find("warning: 1 of 1 run: t\nwarning: and 6 more") != std::string::npos);
}

}  // namespace talus::tools::batch
