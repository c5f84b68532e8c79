#include "equilibrium/path_newton.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/paths.h"

using namespace talus;
using namespace talus::test;
using namespace talus::equilibrium;

namespace {

constexpr double kStiffness = 1e9, kHeight = 0.05;

/// A flat slab on a floor.
Model slab(double friction_deg) {
    Model model = floorModel(friction_deg, kStiffness);
    addBox(model, "slab", {0, 0, 0}, {1, 1, kHeight});
    return model;
}

/// The equations about the end of a path under its weight.
struct AtRest {
    LoadedPath loaded;
    PathWork work{};
    State state;
    FirstOrderGaps gaps;
    PathEquations equations;

    explicit AtRest(const Model& model)
        : loaded(model),
          state(loaded.path.exactState()),
          gaps(state),
          equations(state, gaps, loaded.rules, nullptr, work) {
        equations.setLoading(loaded.axis.loading, 0);
        equations.take();
    }
};

/// (|x| / d)^2 + (s / l)^2
double arcOf(const PathEquations& equations, const Arc& arc, const PathStep& step) {
    const double by_load = step.value / arc.load;
    return equations.dot(step.x, step.x) / (arc.displacement * arc.displacement) + by_load * by_load;
}

double residualOf(PathEquations& equations, const Arc& arc, const PathStep& step) {
    Vec6s force;
    equations.residual(arc, step, equations.moved(step.x), false, force);
    return equations.inaccuracy(force);
}

}  // namespace

TEST_SUITE("equilibrium") {
    TEST_CASE("newton: an elastic step ends on the arc, balanced, after few iterations") {
        for (const double displacement : {1e-7, 1e-6, kInfinity})
            for (const double load : {1e-4, 1e-2}) {
                CAPTURE(displacement);
                CAPTURE(load);
                AtRest at(slab(30));
                const Arc arc{.unknown = Unknown::load, .displacement = displacement, .load = load};
                PathStep step = solveStep(at.equations, arc, tangentStep(at.equations, arc, {}));
                REQUIRE(step);
                CHECK(step.iterations <= 4);
                CHECK(step.value > 0);
                CHECK(std::abs(arcOf(at.equations, arc, step) - 1) < 0.2);
                CHECK(residualOf(at.equations, arc, step) < 1);
                // What the joint gives along it: rho g h sin(beta) / k, and hardly more by its turn.
                const double expected = 2700 * 9.81 * kHeight * std::sin(step.value) / kStiffness;
                CHECK(-step.x[0].x() == doctest::Approx(expected).epsilon(0.02));
            }
    }

    TEST_CASE("newton: a tangent step lies on the arc, and a secant step continues in its direction") {
        AtRest at(slab(30));
        const Arc arc{.unknown = Unknown::load, .displacement = 1e-6, .load = 1e-2};
        const PathStep tangent = tangentStep(at.equations, arc, {});
        CHECK(arcOf(at.equations, arc, tangent) == doctest::Approx(1));
        const Arc longer{.unknown = Unknown::load, .displacement = 3e-6, .load = 3e-2};
        const PathStep secant = secantStep(at.equations, longer, tangent);
        CHECK(arcOf(at.equations, longer, secant) == doctest::Approx(1));
        CHECK(secant.value == doctest::Approx(3 * tangent.value));
        CHECK((secant.x[0] - 3 * tangent.x[0]).norm() < 1e-12);
        // A tangent has no sign of its own: it goes on the way the last step went.
        PathStep down = tangent;
        down.value *= -1;
        for (Vec6& x : down.x) x *= -1;
        CHECK(tangentStep(at.equations, arc, down).value == doctest::Approx(-tangent.value));
    }

    TEST_CASE(
        "newton: beyond the friction angle there is no rest, and a drag that lets the slab go any way") {
        for (const double beyond : {0.1, 1.0, 10.0}) {
            CAPTURE(beyond);
            AtRest at(slab(20));
            at.equations.setLoad(radians(20 + beyond));
            const Arc rest{.unknown = Unknown::none, .displacement = kInfinity};
            // The drag that keeps the matrix regular holds it only far beyond any step that counts.
            const PathStep away = solveStep(at.equations, rest, {.x = Vec6s(1, Vec6::Zero())});
            CHECK((!away || at.equations.norm(away.x) > 0.1));
            const double driving = std::sin(radians(20 + beyond)) -
                                   std::cos(radians(20 + beyond)) * std::tan(radians(20));  // over the weight
            for (const double far : {1e-4, 1e-3}) {
                CAPTURE(far);
                const Arc arc{.unknown = Unknown::drag, .displacement = far};
                const PathStep slide = solveStep(at.equations, arc, tangentStep(at.equations, arc, {}));
                REQUIRE(slide);
                CHECK(at.equations.norm(slide.x) == doctest::Approx(far).epsilon(0.11));
                const Balance& balance = at.equations.balance();
                const double drag = slide.value * balance.drag[0] * -slide.x[0].x();
                CHECK(drag == doctest::Approx(driving * balance.weight[0]).epsilon(0.02));
            }
        }
    }

    TEST_CASE("newton: in pseudo-time a slab slides in proportion to the force that is left over") {
        for (const double beyond : {0.1, 1.0, 10.0})
            for (const double far : {1e-4, 1e-3}) {  // [m]
                CAPTURE(beyond);
                CAPTURE(far);
                AtRest at(slab(20));
                at.equations.setLoad(radians(20 + beyond));
                const Balance& balance = at.equations.balance();
                const double left_over =
                    balance.weight[0] *
                    (std::sin(radians(20 + beyond)) - std::cos(radians(20 + beyond)) * std::tan(radians(20)));
                const Arc arc{.unknown = Unknown::none,
                              .displacement = kInfinity,
                              .drag = left_over / (balance.drag[0] * far)};
                const PathStep slide = solveStep(at.equations, arc, {.x = Vec6s(1, Vec6::Zero())});
                REQUIRE(slide);
                CHECK(-slide.x[0].x() == doctest::Approx(far).epsilon(0.02));
            }
    }

    TEST_CASE("newton: equilibrium below the friction angle has the shear of the slope") {
        AtRest at(slab(20));
        at.equations.setLoad(radians(15));
        const Arc arc{.unknown = Unknown::none, .displacement = kInfinity};
        const PathStep step = solveStep(at.equations, arc, {.x = Vec6s(1, Vec6::Zero())});
        REQUIRE(step);
        const double expected = 2700 * 9.81 * kHeight * std::sin(radians(15)) / kStiffness;
        CHECK(-step.x[0].x() == doctest::Approx(expected).epsilon(0.02));
        CHECK(step.value == 0);
    }
}
