#include "measure/natural_order.h"

#include <doctest/doctest.h>

#include <random>

using namespace talus;

TEST_CASE("names are in the order in which people count") {
    std::vector<std::string> names{"c10r1s1", "c2r10s1", "key", "c2r9s1", "b", "c1r1s1", "b12", "b2"};
    sortNaturally(names);
    CHECK(names ==
          std::vector<std::string>{"b", "b2", "b12", "c1r1s1", "c2r9s1", "c2r10s1", "c10r1s1", "key"});
    CHECK(isNaturallyBefore("b99999999999999999999", "b100000000000000000000"));  // beyond 64 bits
    CHECK(isNaturallyBefore("c2", "c2a"));
    CHECK(isNaturallyBefore("c2a", "c10"));
}

TEST_CASE("the order of names is total: it depends on no order before") {
    // Leading zeros and digits beside letters are what could leave two names without an order.
    const std::vector<std::string> names{"",     "0",    "00",  "1",   "01",   "001",       "1a",    "01a",
                                         "a",    "a0",   "a00", "a0b", "a00b", "a1b2",      "a01b2", "a1b02",
                                         "a1b3", "a10b", "a9b", "a-1", "a.1",  "a\xc3\xa4", "b"};
    for (const std::string& a : names)
        for (const std::string& b : names) {
            CAPTURE(a);
            CAPTURE(b);
            CHECK((isNaturallyBefore(a, b) + isNaturallyBefore(b, a)) == (a == b ? 0 : 1));
            for (const std::string& c : names)
                if (isNaturallyBefore(a, b) && isNaturallyBefore(b, c)) CHECK(isNaturallyBefore(a, c));
        }
    std::vector<std::string> sorted = names;
    sortNaturally(sorted);
    std::mt19937 random(7);
    for (int k = 0; k < 20; ++k) {
        std::vector<std::string> shuffled = names;
        std::shuffle(shuffled.begin(), shuffled.end(), random);
        sortNaturally(shuffled);
        CHECK(shuffled == sorted);
    }
}
