#include "cli/block_names.h"

#include <doctest/doctest.h>

using talus::tools::compactNames;

namespace {

std::vector<std::string> boxNames(const std::string& prefix, int columns, int rows, int slices) {
    std::vector<std::string> names;
    for (int c = 1; c <= columns; ++c)
        for (int r = 1; r <= rows; ++r)
            for (int s = 1; s <= slices; ++s)
                names.push_back(prefix + "c" + std::to_string(c) + "r" + std::to_string(r) + "s" +
                                std::to_string(s));
    return names;
}

}  // namespace

TEST_CASE("whole boxes of a stack become ranges") {
    CHECK(compactNames(boxNames("", 7, 5, 3)) == "c1-7 r1-5 s1-3");
    CHECK(compactNames(boxNames("left", 12, 11, 1)) == "leftc1-12 r1-11 s1");
    CHECK(compactNames({"c2r3s1"}) == "c2 r3 s1");
    CHECK(compactNames({}) == "");
}

TEST_CASE("names that form no box are listed in pieces, and other names as they are") {
    CHECK(compactNames({"c1r1s1", "c1r2s1", "c1r4s1", "c3r1s1"}) == "c1 r1-2 s1, c1 r4 s1, c3 r1 s1");
    CHECK(compactNames({"c1r1s1", "c1r1s2", "c1r2s1"}) == "c1 r1 s1-2, c1 r2 s1");
    CHECK(compactNames({"c1r1s1", "key", "c1rs2"}) == "c1 r1 s1, key, c1rs2");
}

TEST_CASE("stacks stand in the order of their names, which is a natural one") {
    CHECK(compactNames({"s2c1r1s1", "s2c2r1s1", "s10c1r1s1"}) == "s2c1-2 r1 s1, s10c1 r1 s1");
}

TEST_CASE("a long list is cut and its rest counted") {
    CHECK(compactNames({"a", "b", "c", "d"}, 2) == "a, b and 2 more blocks");
    CHECK(compactNames({"c1r1s1", "c1r3s1", "c1r3s2", "c1r5s1"}, 1) == "c1 r1 s1 and 3 more blocks");
}
