// How far discharge and heads move with the two numbers that smear the free surface (flow::FreeSurface).

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "flow/solve.h"
#include "support/flow_network.h"

using namespace talus;
using namespace talus::test;

namespace {

double inflowOf(const flow::Heads& heads) {
    double sum = 0;
    for (const double inflow : heads.inflow) sum += std::max(0.0, inflow);
    return sum;
}

/// Largest difference of head at nodes under pressure.
double difference(const flow::Heads& some, const flow::Heads& others, const FlowNetwork& dam) {
    double most = 0;
    for (std::size_t n = 0; n < some.head.size(); ++n)
        if (some.head[n] > dam.conditions.elevation[n])
            most = std::max(most, std::abs(some.head[n] - others.head[n]));
    return most;
}

/// A dam of square blocks, 9 m long and 7 m high, with 6 m and 1.2 m of water.
FlowNetwork damOf(double block) {
    const int columns = static_cast<int>(9 / block), rows = static_cast<int>(7 / block);
    return FlowNetwork(gridDam(columns, rows, 1, {block, 1, block}, 6, 1.2));
}

/// With other numbers against the usual ones.
struct Moved {
    double inflow = 0;  ///< share
    double head = 0;    ///< over the height of a patch
    double ramp = 0;    ///< ratio
};

Moved movedBy(const FlowNetwork& dam, const flow::FreeSurface& surface) {
    const auto solved = [&](const flow::FreeSurface& with) {
        flow::Heads heads = flow::solveHeads(dam.network, dam.conditions, dam.transmissivity, true, with);
        CHECK(heads.found);
        return heads;
    };
    const flow::Heads usual = solved({}), other = solved(surface);
    return {inflowOf(other) / inflowOf(usual) - 1, difference(usual, other, dam) / dam.network.height,
            other.ramp / usual.ramp};
}

}  // namespace

TEST_CASE("free surface: half or twice the transmissivity of dry joints moves next to nothing") {
    for (const double block : {0.5, 1.0}) {
        const FlowNetwork dam = damOf(block);
        for (const double factor : {0.5, 2.0}) {
            const Moved moved = movedBy(dam, {.dry_share = factor * flow::FreeSurface{}.dry_share});
            CHECK(std::abs(moved.inflow) < 5e-6);
            CHECK(moved.head < 3e-5);
            CHECK(moved.ramp == 1);
        }
    }
}

TEST_CASE("free surface: a ramp half or twice as wide moves the discharge by 0.3 percent at most") {
    for (const double block : {0.5, 1.0}) {
        const FlowNetwork dam = damOf(block);
        for (const double factor : {0.5, 2.0}) {
            const Moved moved = movedBy(dam, {.ramp = factor * flow::FreeSurface{}.ramp});
            CHECK(moved.ramp == factor);
            CHECK((moved.inflow > 0) == (factor > 1));  // a wider ramp carries more
            CHECK(std::abs(moved.inflow) < 3e-3);
            CHECK(moved.head < 0.01);
        }
    }
}
