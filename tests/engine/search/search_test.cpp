// Secondary results of a search.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/models.h"
#include "talus/searches.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kFriction = 20, kTilt = 8;  // [deg]

Model slope() {
    Model model = floorModel(kFriction);
    addBox(model, "box", {0, 0, 0}, {1, 2, 0.3}, 2500);
    model.gravity.tilt = radians(kTilt);
    model.analysis.start = 0;
    return model;
}

}  // namespace

TEST_SUITE("search") {
    TEST_CASE("a result says how much fails, in which interval the answer lies and how the path went there") {
        for (const LoadSearch& search : loadSearches()) {
            CAPTURE(search.name);
            const SearchResult result = *search.find(slope(), {}, {});
            REQUIRE((result.status == SearchStatus::found));
            CHECK(result.answer == doctest::Approx((result.low + result.high) / 2).epsilon(1e-12));
            CHECK(result.failing_volume == doctest::Approx(0.6).epsilon(1e-12));
            CHECK(result.failing_mass == doctest::Approx(1500).epsilon(1e-12));
            REQUIRE(result.answer_interval.has_value());
            CHECK(result.answer_interval->first == result.answer);  // no joint could lock
            CHECK(result.answer_interval->second >= result.answer);
            REQUIRE(result.upper_bound.value.has_value());
            CHECK(*result.upper_bound.value == doctest::Approx(result.answer).epsilon(1e-3));
            CHECK(!result.answer_interval_reasons.first.empty());
            CHECK(!result.answer_interval_reasons.second.empty());
            CHECK(result.failure_displacement == slope().analysis.failure_displacement);
            CHECK(result.answers_by_displacement.empty());
            REQUIRE(result.path.size() > 2);
            CHECK(result.path.size() == result.probes.size());
            CHECK(result.path.back().displacement >= result.failure_displacement * 0.3);
        }
    }

    TEST_CASE("a stop that a block slides against: a failure or none, by the displacement that counts") {
        constexpr double kGap = 1e-3, kSize = 0.3;
        Model model = slope();
        model.blocks.push_back(box("stop", {-0.5, 0, 0}, {-kGap, 2, kSize}, 2700, Motion::fixed));
        model.analysis.stop = radians(35);
        for (const double counts : {3e-4, 1e-3, 2e-2}) {
            CAPTURE(counts);
            model.analysis.failure_displacement = counts;
            const SearchResult result = *criticalAngle(model);
            const bool fails = counts * kSize < kGap;
            CHECK((result.status == (fails ? SearchStatus::found : SearchStatus::stable_to_stop)));
            if (fails) CHECK(degrees(result.answer) == doctest::Approx(kFriction).epsilon(1e-3));
        }
    }

    TEST_CASE("an upper bound and an interval are left out where they are not wanted") {
        const SearchResult result =
            *criticalAngle(slope(), {.interval = false, .upper_bound = Beside::never});
        CHECK((result.status == SearchStatus::found));
        CHECK_FALSE(result.upper_bound.value.has_value());
        CHECK(result.upper_bound.reason.find("not computed") != std::string::npos);
        REQUIRE(result.answer_interval.has_value());
        CHECK(result.answer_interval->first == result.answer);
        CHECK(result.answer_interval->second == result.answer);
    }

    TEST_CASE("the same bits with and without threads") {
        const SearchResult one = *criticalAngle(stackModel(3, 4, 1, 30), {.threads = 1});
        const SearchResult two = *criticalAngle(stackModel(3, 4, 1, 30), {.threads = 2});
        CHECK(one.answer == two.answer);
        CHECK(one.state_hash == two.state_hash);
        CHECK(one.factors == two.factors);
    }

    TEST_CASE("blocks in another order give the same answer") {
        for (const LoadSearch& search : loadSearches()) {
            CAPTURE(search.name);
            Model model = stackModel(3, 4, 1, 30);
            model.gravity.tilt = radians(5);
            model.analysis.start = 0;
            const SearchResult first = *search.find(model, {}, {});
            std::reverse(model.blocks.begin() + 1, model.blocks.end());
            const SearchResult second = *search.find(model, {}, {});
            const double width = first.high - first.low;
            CHECK(std::abs(first.answer - second.answer) <= 2 * width);
            CHECK(first.moving_blocks == second.moving_blocks);
        }
    }
}
