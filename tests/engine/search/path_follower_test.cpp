#include "search/path_follower.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "search/unloaded_joints.h"
#include "support/paths.h"
#include "support/structures.h"

using namespace talus;
using namespace talus::test;
using namespace talus::search;

namespace {

Follow upTo(double target, std::vector<double> displacements = {3e-4}) {
    return {.target = target, .displacements = std::move(displacements)};
}

Model boxes(const std::vector<double>& frictions) {
    Model model = floorModel(40);
    for (std::size_t k = 0; k < frictions.size(); ++k) {
        const auto n = static_cast<std::int32_t>(k) + 1;
        model.joints.push_back(joint(frictions[k]));
        addBox(model, "b" + std::to_string(n), {2.0 * static_cast<double>(k), 0, 0}, {1, 1, 0.3});
        model.pair_joints.push_back({0, n, n});
    }
    return model;
}

}  // namespace

TEST_SUITE("search") {
    TEST_CASE(
        "the path of a block ends where it slides: a bracket as narrow as is wanted, around the angle") {
        for (const double tolerance_deg : {0.1, 0.01, 0.001})
            for (const double friction : {12.0, 20.0, 33.0}) {
                CAPTURE(tolerance_deg);
                CAPTURE(friction);
                Model model = boxes({friction});
                model.analysis.tolerance = radians(tolerance_deg);
                LoadedPath loaded(model);
                const Followed followed = followPath(loaded.path, loaded.axis, upTo(radians(60)));
                REQUIRE((followed.result == PathResult::failed));
                // Equilibrium is known to a hundredth of the load that is wanted.
                CHECK(followed.bracket.stands <= radians(friction + 0.01 * tolerance_deg));
                CHECK(followed.bracket.stands > radians(friction - tolerance_deg));
                CHECK(followed.bracket.fails >= radians(friction) * (1 - 1e-6));
                CHECK(followed.bracket.fails - followed.bracket.stands <= radians(tolerance_deg));
                REQUIRE(followed.stood.has_value());
                CHECK(followed.stood->load == followed.bracket.stands);
                REQUIRE(followed.failing.has_value());
            }
    }

    TEST_CASE("a peak is found within the tolerance, however coarse or fine the steps are") {
        const double exact = 8.269;  // limit analysis: the arch hinges
        double finest = 0;
        for (const double tolerance_deg : {0.001, 0.01, 0.1}) {
            CAPTURE(tolerance_deg);
            Model model = archModel(27, 10, 1.5, 35, 1e12);
            model.analysis.tolerance = radians(tolerance_deg);
            LoadedPath loaded(model);
            const Followed followed = followPath(loaded.path, loaded.axis, upTo(radians(60)));
            REQUIRE((followed.result == PathResult::failed));
            const double found = degrees(0.5 * (followed.bracket.stands + followed.bracket.fails));
            MESSAGE(tolerance_deg << " deg wide: " << found);
            if (finest == 0) finest = found;
            CHECK(std::abs(found - finest) <= tolerance_deg);
            CHECK(found < exact + 0.01 + tolerance_deg);
            CHECK(found > exact - 0.05 - tolerance_deg);
        }
    }

    TEST_CASE("columns overturn at atan(0.2 / h), less what the give of their joints takes") {
        struct Column {
            int rows;
            double exact;
        };
        for (const Column& column : {Column{10, 11.310}, {20, 5.711}, {40, 2.862}}) {
            const int rows = column.rows;
            const double exact = column.exact;
            CAPTURE(rows);
            LoadedPath loaded(stackModel(1, rows, 1, 30));
            const Followed followed = followPath(loaded.path, loaded.axis, upTo(radians(60)));
            REQUIRE((followed.result == PathResult::failed));
            const auto [stands, fails] = followed.bracket;
            MESSAGE(rows << " blocks: " << degrees(stands) << " to " << degrees(fails));
            CHECK(degrees(fails) > exact - 0.04);
            CHECK(degrees(stands) < exact + 0.001);
        }
    }

    TEST_CASE("tilted arches fail by hinges where limit analysis says") {
        struct Arch {
            int voussoirs;
            double thickness;
            double friction;
            double exact;
        };
        for (const Arch& arch : {Arch{11, 1.5, 40.0, 9.165},
                                 {15, 1.5, 40.0, 8.557},
                                 {21, 1.5, 40.0, 8.436},
                                 {27, 1.5, 35.0, 8.27}}) {
            const int voussoirs = arch.voussoirs;
            const double exact = arch.exact;
            CAPTURE(voussoirs);
            LoadedPath loaded(archModel(voussoirs, 10, arch.thickness, arch.friction, 1e12));
            const Followed followed = followPath(loaded.path, loaded.axis, upTo(radians(60)));
            REQUIRE((followed.result == PathResult::failed));
            const auto [stands, fails] = followed.bracket;
            MESSAGE(voussoirs << " voussoirs: " << degrees(stands) << " to " << degrees(fails));
            CHECK(degrees(fails) > exact - 0.05);
            CHECK(degrees(stands) < exact + 0.001);
        }
    }

    TEST_CASE("a target below the failure is reached, in equilibrium and at its own load") {
        LoadedPath loaded(boxes({20}));
        const Followed followed = followPath(loaded.path, loaded.axis, upTo(radians(19)));
        CHECK((followed.result == PathResult::reached));
        CHECK(loaded.path.load() == radians(19));
        CHECK(loaded.path.isBalanced());
        CHECK(followed.bracket.stands == radians(19));
        CHECK(std::isinf(followed.bracket.fails));
        CHECK_FALSE(followed.failing.has_value());
    }

    TEST_CASE("the curve of load against displacement begins at the start, and never goes back in the load") {
        LoadedPath loaded(boxes({20}));
        const Followed followed = followPath(loaded.path, loaded.axis, upTo(radians(60)));
        REQUIRE(followed.points.size() > 3);
        CHECK(followed.points.size() == followed.probes.size());
        CHECK(followed.points.front().load == 0);
        CHECK(followed.points.front().displacement == 0);
        for (std::size_t k = 1; k < followed.points.size(); ++k) {
            CHECK(followed.points[k].load >= followed.points[k - 1].load - 0.5 * loaded.axis.loading.cell);
            CHECK(followed.points[k].displacement >= followed.points[k - 1].displacement * (1 - 1e-9));
        }
        CHECK((followed.probes.back().verdict == Verdict::failing));
        std::int64_t factors = 0;
        for (const Probe& probe : followed.probes) factors += probe.factors;
        CHECK(factors > 0);
        CHECK(factors <= loaded.path.work().factors);
    }

    // A block slides onto a stop: a failure by displacements below the gap, none by larger ones.
    TEST_CASE(
        "each displacement has the load at which blocks part by that before equilibrium is found again") {
        constexpr double kSize = 0.3;
        for (const double gap : {0.5e-3, 2e-3}) {
            CAPTURE(gap);
            Model model = boxes({20});
            model.blocks.push_back(box("stop", {-0.3, 0, 0}, {-gap, 1, kSize}, 2700, Motion::fixed));
            const std::vector<double> displacements{1e-4, 3e-4, 1e-3, 3e-3, 1e-2};
            LoadedPath loaded(model);
            Follow follow = upTo(radians(30), displacements);
            follow.counts = 1;
            const Followed followed = followPath(loaded.path, loaded.axis, follow);
            REQUIRE((followed.result == PathResult::failed));
            for (std::size_t k = 0; k < displacements.size(); ++k) {
                CAPTURE(displacements[k]);
                const auto& bracket = followed.by_displacement[k];
                if (displacements[k] * kSize < gap) {
                    REQUIRE(bracket.has_value());
                    CHECK(degrees(bracket->stands) == doctest::Approx(20).epsilon(1e-3));
                } else {
                    CHECK((!bracket || degrees(bracket->stands) > 21));
                }
            }
        }
    }

    TEST_CASE("where the caller removes failed blocks, the path continues with the others") {
        LoadedPath loaded(boxes({25, 20, 30}));
        std::vector<double> failed;
        Follow follow = upTo(radians(60));
        const std::size_t order[] = {2, 1};
        follow.mends = [&](const Followed& found) {
            failed.push_back(degrees(found.bracket.stands));
            if (failed.size() > 2) return false;
            loaded.path.goBack(*found.stood);
            loaded.path.takeOut({order[failed.size() - 1]});
            return true;
        };
        const Followed followed = followPath(loaded.path, loaded.axis, follow);
        CHECK((followed.result == PathResult::failed));
        REQUIRE(failed.size() == 3);
        CHECK(failed[0] == doctest::Approx(20).epsilon(1e-3));
        CHECK(failed[1] == doctest::Approx(25).epsilon(1e-3));
        CHECK(failed[2] == doctest::Approx(30).epsilon(1e-3));
        CHECK(degrees(followed.bracket.stands) == doctest::Approx(30).epsilon(1e-3));
    }

    TEST_CASE("an interrupted path says so, with its results so far") {
        const Model model = boxes({20});
        std::atomic<bool> stop{false};
        const LoadAxis weight = weightAxis(1e-4), tilt = tiltAxis(model, {});
        equilibrium::EquilibriumPath path(unloaded(model), {}, false, &stop);
        path.vary(weight.loading, 0);
        REQUIRE((equilibrium::release(path, 1, path.parting(), 0.1) == equilibrium::Released::rests));
        path.vary(tilt.loading, 0);
        Follow follow = upTo(radians(60));
        follow.report = [&](double load, const char*) { stop = stop || load > radians(5); };
        const Followed followed = followPath(path, tilt, follow);
        CHECK((followed.result == PathResult::interrupted));
        CHECK(followed.bracket.stands > 0);
        CHECK(followed.bracket.stands < radians(20.01));
        CHECK(std::isinf(followed.bracket.fails));
    }
}
