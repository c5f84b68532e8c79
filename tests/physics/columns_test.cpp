// Columns of different heights side by side: what the three searches say of them agrees, and lies where
// toppling of each by itself puts it.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/models.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

struct Column {
    double width, height;
    int pieces = 1;
};

struct Row {
    std::vector<Column> columns;
    double friction;  // [deg]
    double stiffness = 1e11;

    Model model() const {
        Model made = floorModel(friction, stiffness);
        made.joints[0].shear_stiffness = 0.5 * stiffness;
        double x = 0;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const double piece = columns[c].height / columns[c].pieces;
            for (int k = 0; k < columns[c].pieces; ++k)
                addBox(made, "c" + std::to_string(c + 1) + "r" + std::to_string(k + 1), {x, 0, k * piece},
                       {columns[c].width, 0.5, piece}, 2000);
            x += columns[c].width;
        }
        made.analysis.start = 0;
        made.analysis.stop = radians(60);
        return made;
    }

    /// The tilt at which a column fails by itself.
    double alone(std::size_t c) const {
        return std::min(radians(friction), std::atan(columns[c].width / columns[c].height));
    }
    /// Each stands by itself up to here, and so do all.
    double least() const {
        double least = kInfinity;
        for (std::size_t c = 0; c < columns.size(); ++c) least = std::min(least, alone(c));
        return least;
    }
};

/// \param first_is_least  the first column, which leans on nothing, fails before the others would
Row drawn(unsigned seed, bool first_is_least) {
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random() >> 11) / 9007199254740992.0;
    };
    Row row{.columns = {}, .friction = between(25, 45)};
    for (int c = 2 + static_cast<int>(random() % 4); c > 0; --c)
        row.columns.push_back({between(0.15, 0.3), between(0.5, 2)});
    if (first_is_least) {
        row.columns.front().width = 0.1;
        row.columns.front().height = between(1.5, 2);
    }
    return row;
}

/// Found, in degrees where it is a tilt.
SearchResult found(Result<SearchResult> result) {
    REQUIRE(result.ok());
    REQUIRE((result->status == SearchStatus::found));
    return std::move(*result);
}

/// The three searches contradict each other nowhere: the factor is one at the critical tilt, and k is the
/// tangent of it.
void checkAgreement(const Row& row, double angle) {
    const SearchResult push = found(criticalAcceleration(row.model(), {.interval = false}));
    CHECK(push.answer == doctest::Approx(std::tan(angle)).epsilon(0.01));
    for (const double beyond : {-0.01, 0.01}) {
        CAPTURE(beyond);
        Model model = row.model();
        model.gravity.tilt = angle * (1 + beyond);
        const SearchResult factor = *safetyFactor(model, {.interval = false});
        const bool stands = factor.status == SearchStatus::stable_to_stop ||
                            (factor.status == SearchStatus::found && factor.answer >= 1);
        CHECK(stands == (beyond < 0));
    }
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("columns of different heights: the first one topples by itself if it is the first to") {
        std::vector<Row> rows{{{{0.1, 1.93}, {0.293, 1.852}, {0.261, 1.12}, {0.268, 1.177}, {0.286, 1.438}},
                               27.331,
                               1.12129e11}};
        for (unsigned seed = 1; seed <= 6; ++seed) rows.push_back(drawn(seed, true));
        for (std::size_t k = 0; k < rows.size(); ++k) {
            CAPTURE(k);
            const Row& row = rows[k];
            const SearchResult angle = found(criticalAngle(row.model(), {.interval = false}));
            CHECK(degrees(angle.answer) == doctest::Approx(degrees(row.alone(0))).epsilon(0.005));
            CHECK((angle.mode == FailureMode::toppling));
            CHECK(angle.moving_blocks.front() == "c1r1");
            checkAgreement(row, angle.answer);
            // What topples needs no reduction of friction: below, the factor is one of sliding.
            Model model = row.model();
            model.gravity.tilt = 0.8 * row.alone(0);
            const SearchResult factor = found(safetyFactor(model, {.interval = false}));
            const double slides = std::tan(radians(row.friction)) / std::tan(model.gravity.tilt);
            CHECK(factor.answer == doctest::Approx(slides).epsilon(0.005));
        }
    }

    TEST_CASE(
        "columns of different heights are stable up to the limit of each, and not beyond that of the first") {
        for (unsigned seed = 11; seed <= 20; ++seed) {
            CAPTURE(seed);
            const Row row = drawn(seed, false);
            const SearchResult angle = found(criticalAngle(row.model()));
            MESSAGE(row.columns.size() << " columns: " << degrees(angle.answer) << ", each by itself "
                                       << degrees(row.least()) << ", the first " << degrees(row.alone(0)));
            CHECK(angle.answer >= row.least() * (1 - 0.005));
            REQUIRE(angle.answer_interval.has_value());
            CHECK(angle.answer_interval->first <= row.alone(0) * (1 + 0.002));
            checkAgreement(row, angle.answer);
        }
    }
}
