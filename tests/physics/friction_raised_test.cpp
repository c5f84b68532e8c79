// More friction never gives less safety: stacks whose friction is raised step by step.

#include <doctest/doctest.h>

#include <cmath>

#include "support/models.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

struct Shape {
    int columns, rows, slices;
    Vec3 block;
    double stiffness;
};

const Shape kShapes[] = {{3, 3, 2, {0.169, 0.241, 0.212}, 3.01425e11},
                         {3, 3, 1, {0.169, 0.241, 0.212}, 3.01425e11},
                         {2, 5, 1, {0.2, 0.1, 0.1}, 1e11},
                         {4, 4, 1, {0.25, 0.2, 0.2}, 1e10},
                         {1, 6, 2, {0.2, 0.2, 0.15}, 3e11}};

Model modelOf(const Shape& shape, double friction_deg) {
    Model model =
        stackModel(shape.columns, shape.rows, shape.slices, friction_deg, shape.block, shape.stiffness);
    model.joints[0].shear_stiffness = 0.5 * shape.stiffness;
    return model;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE(
        "friction raised: stacks slide at it, then topple where one column does, and never sooner again") {
        for (const Shape& shape : kShapes) {
            const double topples = degrees(std::atan(shape.block.x() / (shape.rows * shape.block.z())));
            double before = 0;
            for (const double friction : {5.0, 10.0, 14.0, 17.0, 22.0, 30.0, 36.6, 40.0, 44.0, 50.0}) {
                CAPTURE(shape.columns);
                CAPTURE(shape.rows);
                CAPTURE(shape.slices);
                CAPTURE(friction);
                const SearchResult result = *criticalAngle(modelOf(shape, friction), {.interval = false});
                REQUIRE((result.status == SearchStatus::found));
                const double answer = degrees(result.answer);
                CHECK(answer >= before - 0.02);  // two tolerances
                if (friction < topples - 0.5)
                    CHECK(answer == doctest::Approx(friction).epsilon(0.003));
                else if (friction > topples + 0.5)
                    CHECK(answer >= topples * (1 - 0.003));
                if (friction > topples + 0.5 && friction < 45)
                    CHECK(answer == doctest::Approx(topples).epsilon(0.003));
                before = std::max(before, answer);
            }
        }
    }

    TEST_CASE("friction raised: the factor of safety and the earthquake that is withstood rise with it") {
        for (const Shape& shape : kShapes) {
            double factor_before = 0, push_before = 0;
            for (const double friction : {14.0, 22.0, 30.0, 36.6, 44.0}) {
                CAPTURE(shape.columns);
                CAPTURE(shape.rows);
                CAPTURE(friction);
                Model model = modelOf(shape, friction);
                model.gravity.tilt = radians(8);
                const SearchResult factor = *safetyFactor(model, {.interval = false});
                const SearchResult push = *criticalAcceleration(model, {.interval = false});
                REQUIRE((factor.status == SearchStatus::found));
                REQUIRE((push.status == SearchStatus::found));
                CHECK(factor.answer ==
                      doctest::Approx(std::tan(radians(friction)) / std::tan(radians(8))).epsilon(0.003));
                CHECK(factor.answer >= factor_before);
                CHECK(push.answer >= push_before - 2e-4);  // two tolerances
                factor_before = factor.answer, push_before = push.answer;
            }
        }
    }
}
