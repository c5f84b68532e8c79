#include "analysis/bracket.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using talus::analysis::Bracket;

namespace {

struct Outcome {
    Bracket bracket;
    int probes;
};

/// Searches a load whose failing probes show `force(cell)`; positive means failing.
Outcome probeUntilClosed(std::int64_t stop, std::int64_t step,
                         const std::function<double(std::int64_t)>& force) {
    Outcome outcome{Bracket(stop), 0};
    const auto probe = [&](std::int64_t cell) {
        ++outcome.probes;
        if (force(cell) > 0)
            outcome.bracket.fails(cell, force(cell));
        else
            outcome.bracket.stands(cell);
    };
    while (!outcome.bracket.high() && !outcome.bracket.stoodToTheEnd())
        probe(std::min(stop, outcome.bracket.low() + step));
    while (outcome.bracket.high() && !outcome.bracket.closed()) probe(outcome.bracket.next());
    return outcome;
}

}  // namespace

TEST_SUITE("analysis") {
    TEST_CASE("the last cell is found, whatever the forces look like") {
        for (std::int64_t critical = 0; critical < 4096; critical += 7) {
            const auto linear = [&](std::int64_t cell) { return static_cast<double>(cell - critical) - 0.5; };
            const auto cubic = [&](std::int64_t cell) { return std::pow(linear(cell), 3); };
            const auto flat = [&](std::int64_t cell) { return linear(cell) > 0 ? 1.0 : -1.0; };
            const auto noisy = [&](std::int64_t cell) {
                return linear(cell) > 0 ? 2.0 + std::sin(static_cast<double>(cell * cell)) : -1.0;
            };
            for (const auto& force :
                 {std::function<double(std::int64_t)>(linear), {cubic}, {flat}, {noisy}}) {
                const Outcome outcome = probeUntilClosed(4096, 512, force);
                REQUIRE(outcome.bracket.closed());
                CHECK(outcome.bracket.low() == critical);
                CHECK(*outcome.bracket.high() == critical + 1);
                CHECK(outcome.probes <= 8 + 2 * 9 + 4);
            }
        }
    }

    TEST_CASE("a force in proportion to the excess load needs few probes") {
        const Outcome outcome = probeUntilClosed(
            4096, 512, [](std::int64_t cell) { return 0.003 * (static_cast<double>(cell) - 1776.3); });
        CHECK(outcome.bracket.low() == 1776);
        CHECK(outcome.probes <= 4 + 4);
    }

    TEST_CASE("an assembly that stands to the end says so") {
        const Outcome outcome = probeUntilClosed(4096, 512, [](std::int64_t) { return -1.0; });
        CHECK(outcome.bracket.stoodToTheEnd());
        CHECK_FALSE(outcome.bracket.high());
    }

    TEST_CASE(
        "opened again it goes up twice as far each time, to the end, in however small steps it is gone "
        "there") {
        constexpr std::int64_t kStop = 4096;
        Bracket bracket(kStop);
        bracket.fails(512, 1.0);
        bracket.reopen();
        CHECK(bracket.low() == 512);
        std::int64_t ahead = 1;
        for (int k = 0; k < 200; ++k) {
            const std::int64_t low = bracket.low();
            CHECK(bracket.up(2 * kStop) == std::min(kStop, low + ahead));
            bracket.stands(low + 1);
            ahead = std::min(2 * ahead, kStop);
        }
    }
}
