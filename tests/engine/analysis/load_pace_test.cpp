#include "analysis/load_pace.h"

#include <doctest/doctest.h>

#include <algorithm>

using talus::analysis::LoadPace;

TEST_SUITE("analysis") {
    TEST_CASE(
        "load pace: the axis's own step until something is learnt, then by how far blocks have parted") {
        LoadPace pace;
        CHECK(pace.next(64) == 64);
        for (const double leaving :
             {0.0625, 0.125, 0.25, 0.5, 1.0}) {  // a quarter of what leaves their place is wanted
            CAPTURE(leaving);
            pace.learn(32, leaving);
            CHECK(pace.next(64) == static_cast<int>(32 * 0.25 / leaving));
        }
        pace.learn(32, 0);
        CHECK(pace.next(64) == 4 * 32);  // at most four times the last
        CHECK(pace.next(16) == 4 * 16);  // and the axis's own
        pace.learn(1, 100);
        CHECK(pace.next(64) == 1);
    }

    TEST_CASE(
        "load pace: a step left open is halved, and what follows grows from there no more than twofold") {
        for (const int step : {2, 3, 10, 64, 256}) {
            CAPTURE(step);
            LoadPace pace;
            pace.learn(step, 0.25);
            pace.cutBack(step);
            CHECK(pace.next(256) == step / 2);
            std::int64_t last = step / 2;
            for (int k = 0; k < 80; ++k) {  // stands easily: would be four times as long each time
                pace.learn(last, 0);
                const std::int64_t next = pace.next(256);
                CHECK(next >= last);
                CHECK(next <= 1024);
                if (k == 0) CHECK(next == step / 2);
                if (k == 1) CHECK(next == std::min<std::int64_t>(2 * last, 1024));
                last = next;
            }
            CHECK(last == 1024);
        }
    }

    TEST_CASE("load pace: steps that stay open are halved down to one cell") {
        LoadPace pace;
        std::int64_t step = pace.next(100);
        while (step >= 2) {
            pace.cutBack(step);
            CHECK(pace.next(100) == step / 2);
            step = pace.next(100);
        }
        CHECK(step == 1);
    }
}
