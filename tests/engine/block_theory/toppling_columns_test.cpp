// Columns that lean on each other: against the recurrence of Goodman and Bray, published factors of safety,
// one column by hand; and which slopes are a row of columns.

#include "block_theory/toppling_columns.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "block_theory/column_row.h"
#include "build/build.h"
#include "state/caller.h"
#include "support/models.h"

using namespace talus;
using talus::keyblocks::columnRow;
using talus::keyblocks::ColumnRow;
using talus::keyblocks::leaningAt;
using talus::keyblocks::LeaningColumn;
using talus::keyblocks::SideFace;
using namespace talus::test;

namespace {

constexpr double kWidth = 10, kStep = 1, kThick = 1;  // of a column, of the base, of the slice [m]
constexpr int kColumns = 16, kCrest = 10;
constexpr double kDip = 30;  // of the base [deg]

/// Goodman and Bray's slope: height of column n, the toe being 1 [m].
double heightOf(int n) { return n <= kCrest ? 4.0 * n : 40.0 - 6.0 * (n - kCrest); }

/// Columns on steps, each beside its step's own fixed block.
Model columnsModel(double friction_deg, int columns = kColumns) {
    Model model;
    model.joints = {joint(friction_deg)};
    for (int n = 1; n <= columns; ++n) {
        const double x = kWidth * (n - 1), z = kStep * (n - 1);
        const std::string number = std::to_string(n);
        addBox(model, "n" + number, {x, 0, z}, {kWidth, kThick, heightOf(n)}, 2548.42);
        model.blocks.push_back(
            box("base" + number, {x, 0, -10}, {x + kWidth, kThick, z}, 2548.42, Motion::fixed));
    }
    model.gravity.tilt = radians(kDip);
    return model;
}

std::optional<ColumnRow> rowOf(const Model& model) {
    auto state = buildState(keptByCaller(model), false, {});
    REQUIRE(state);
    return columnRow(*state);
}

/// The factor at which the toe column is at its limit.
double factorOf(std::span<const LeaningColumn> columns) {
    double low = 0.6, high = 3;
    while (high - low > 1e-10 * high) {
        const double middle = std::sqrt(low * high);
        (leaningAt(columns, middle)->excess > 0 ? high : low) = middle;
    }
    return low;
}

double factorOf(const Model& model) {
    const auto row = rowOf(model);
    REQUIRE(row.has_value());
    return factorOf(row->columns);
}

/// The push that the toe column lacks, by the recurrence as published: rectangular columns, one angle of
/// friction (Goodman and Bray 1976, equations 8 to 12), [N per m].
double publishedExcess(int columns, double tan_friction) {
    const double a = radians(kDip);
    double push = 0;
    for (int n = columns; n >= 1; --n) {
        const double y = heightOf(n), weight = 25e3 * kWidth * y;
        // Where the forces act above the base: at the upper end of either side's contact.
        const double above = n == columns ? 0 : std::min(y, heightOf(n + 1) + kStep),
                     below = n == 1 ? 1 : std::min(y, heightOf(n - 1) - kStep);
        const double topple = (push * (above - kWidth * tan_friction) +
                               0.5 * weight * (y * std::sin(a) - kWidth * std::cos(a))) /
                              below;
        const double slide =
            push - weight * (std::cos(a) * tan_friction - std::sin(a)) / (1 - tan_friction * tan_friction);
        if (n == 1) return std::max(topple, slide);
        push = std::max({topple, slide, 0.0});
    }
    return 0;
}

}  // namespace

TEST_SUITE("block_theory") {
    TEST_CASE("toppling columns: published factors of safety of 16 blocks") {
        CHECK(factorOf(columnsModel(38.15)) == doctest::Approx(1).epsilon(1e-4));
        CHECK(factorOf(columnsModel(38.6598)) == doctest::Approx(1.0185).epsilon(1e-4));
    }

    TEST_CASE("toppling columns: the published recurrence, for any number of columns and any friction") {
        for (const int columns : {2, 3, 5, 8, 10, 12, 16}) {
            for (const double friction : {31.0, 33.0, 36.0, 39.0, 43.0}) {
                CAPTURE(columns);
                CAPTURE(friction);
                const auto row = rowOf(columnsModel(friction, columns));
                REQUIRE(row.has_value());
                const double excess = leaningAt(row->columns, 1)->excess;
                const double published = publishedExcess(columns, std::tan(radians(friction)));
                if (std::abs(published) > 1) CHECK((excess > 0) == (published > 0));
            }
        }
    }

    TEST_CASE("toppling columns: which of them move") {
        const auto row = rowOf(columnsModel(38.15));
        REQUIRE(row.has_value());
        const auto leaning = leaningAt(row->columns, 1);
        CHECK(leaning->moving == 13);  // blocks 16 to 14 are stable
        CHECK(leaning->topples);
        const auto low = leaningAt(std::span(row->columns).first(1), 1);
        CHECK(low->moving == 1);
        CHECK_FALSE(low->topples);
    }

    TEST_CASE("toppling columns: two of them on a smooth step, by hand") {
        // The upper column, tall, topples; the lower one slides.
        LeaningColumn lower;
        lower.pivot = {0, 0};
        lower.base_normal = {0, 1};
        lower.downhill = {-1, 0};
        lower.base_length = 2;
        LeaningColumn upper = lower;
        lower.tan_friction = upper.tan_friction = 0.5;
        lower.force = {-0.2, -2};
        lower.moment = -3;
        lower.arm = 1;
        upper.pivot = {2, 0};
        upper.force = {-0.2, -1};
        upper.moment = 0.6;
        upper.arm = 1;
        upper.front = SideFace{.top = {2, 2}, .bottom = {2, 0}, .normal = {-1, 0}, .along = {0, 1}};
        const LeaningColumn both[] = {lower, upper};
        // It pushes with 0.6 / 2 = 0.3: 0.2 + 0.3 - 0.5 * 2 = -0.5 of a weight of sqrt(0.2^2 + 2^2).
        CHECK(leaningAt(both, 1)->excess == doctest::Approx(-0.5 / std::hypot(0.2, 2)));
        CHECK(leaningAt(both, 2)->excess == doctest::Approx(0.0).epsilon(1e-12));
        CHECK(leaningAt(both, 1)->moving == 2);
    }

    TEST_CASE("toppling columns: one that only slides pushes as low as it can, and no base pulls") {
        LeaningColumn lower;
        lower.pivot = {0, 0};
        lower.base_normal = {0, 1};
        lower.downhill = {-1, 0};
        lower.base_length = lower.arm = 1;
        lower.tan_friction = 0.5;
        lower.force = {-0.2, -2};
        lower.moment = -0.9;
        LeaningColumn upper = lower;
        upper.pivot = {1, 0};
        upper.tan_friction = 0.3;
        upper.force = {-0.8, -1};
        upper.moment = -0.5;
        upper.front = SideFace{.top = {1, 2}, .bottom = {1, 0}, .normal = {-1, 0}, .along = {0, 1}};
        // It pushes with 0.8 - 0.3 = 0.5 at the foot; at the top that would topple the lower column.
        const LeaningColumn low[] = {lower, upper};
        CHECK(leaningAt(low, 1)->excess == doctest::Approx((0.2 + 0.5 - 0.5 * 2) / std::hypot(0.2, 2)));
        CHECK_FALSE(leaningAt(low, 1)->topples);
        // With a moment of 0.2 it would topple unless the push acts 0.4 above its foot.
        upper.moment = 0.2;
        const LeaningColumn higher[] = {lower, upper};
        lower.moment = -0.1;
        const LeaningColumn weak[] = {lower, upper};
        CHECK(leaningAt(higher, 1)->excess < 0);
        CHECK(leaningAt(weak, 1)->excess == doctest::Approx((-0.1 + 0.5 * 0.4) / std::hypot(0.2, 2)));
        // The base would have to press 1.5 from the pivot, and is 1 long.
        upper.moment = -1.5;
        const LeaningColumn beyond[] = {lower, upper};
        CHECK_FALSE(leaningAt(beyond, 1).has_value());
    }

    TEST_CASE("toppling columns: strength is that of the time, as joints over time say") {
        Model model = columnsModel(38.6598);
        const double factor = factorOf(model);
        Joint& joint = model.joints[0];
        joint.friction = joint.residual_friction = std::atan(0.5 * std::tan(radians(38.6598)));
        joint.strength_over_time = {{0, 2}};
        CHECK(factorOf(model) == doctest::Approx(factor).epsilon(1e-9));
    }

    TEST_CASE("toppling columns: nothing depends on where the slope looks, on size, or on order") {
        const double expected = factorOf(columnsModel(38.6598));
        const Vec3 down(-std::sin(radians(kDip)), 0, -std::cos(radians(kDip)));
        for (const double angle : {25.0, 90.0, 140.0, 180.0}) {
            const Eigen::Quaterniond turn = turnAbout({1, 2, 3}, angle);
            Model turned = columnsModel(38.6598);
            for (Block& block : turned.blocks)
                for (Vec3& v : block.shape.vertices) v = turn * v;
            turned.gravity.tilt = 0;
            turned.gravity.direction = turn * down;
            CHECK(factorOf(turned) == doctest::Approx(expected).epsilon(1e-6));
        }
        Model shuffled = columnsModel(38.6598);
        std::shuffle(shuffled.blocks.begin(), shuffled.blocks.end(), std::mt19937(7));
        CHECK(factorOf(shuffled) == doctest::Approx(expected).epsilon(1e-9));
        Model small = columnsModel(38.6598);
        for (Block& block : small.blocks)
            for (Vec3& v : block.shape.vertices) v *= 0.01;
        CHECK(factorOf(small) == doctest::Approx(expected).epsilon(1e-9));
    }

    TEST_CASE("toppling columns: slopes that are no row of columns") {
        Model cohesive = columnsModel(38.15);
        cohesive.joints[0].cohesion = cohesive.joints[0].residual_cohesion = 1000;
        CHECK_FALSE(rowOf(cohesive).has_value());

        Model held = columnsModel(38.15);
        held.blocks.push_back(box("buttress", {-10, 0, 0}, {0, kThick, 4}, 2700, Motion::fixed));
        CHECK_FALSE(rowOf(held).has_value());

        Model loaded = columnsModel(38.15);
        addBox(loaded, "on top", {1, 0, heightOf(1)}, {2, kThick, 1});
        CHECK_FALSE(rowOf(loaded).has_value());

        Model narrow = columnsModel(38.15);
        narrow.blocks[0].shape = *makeBox({0, 0, 0}, {kWidth, 0.5 * kThick, heightOf(1)});
        CHECK_FALSE(rowOf(narrow).has_value());

        Model across = columnsModel(38.15);
        across.blocks.push_back(box("beside", {20, kThick, 3}, {30, 2, 9}, 2700, Motion::fixed));
        CHECK_FALSE(rowOf(across).has_value());

        CHECK_FALSE(rowOf(columnsModel(38.15, 1)).has_value());

        const double top = kStep * (kColumns - 1) + heightOf(kColumns), end = kWidth * kColumns;
        Model roofed = columnsModel(38.15);
        roofed.blocks.push_back(
            box("roof", {end - kWidth, 0, top}, {end, kThick, top + 1}, 2700, Motion::fixed));
        CHECK_FALSE(rowOf(roofed).has_value());
        Model walled = columnsModel(38.15);
        walled.blocks.push_back(box("wall", {end, 0, 0}, {end + 1, kThick, top}, 2700, Motion::fixed));
        CHECK(rowOf(walled).has_value());

        // Bolts without pretension carry nothing yet.
        Model bolted = columnsModel(38.15);
        Bolt bolt;
        bolt.name = "A1";
        bolt.head = {-0.0, 0.5, 2};
        bolt.end = {5, 0.5, -5};
        bolt.area = 8e-4;
        bolt.modulus = 2e11;
        bolted.bolts = {bolt};
        CHECK_FALSE(rowOf(bolted).has_value());
    }
}
