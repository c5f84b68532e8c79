// The prediction for a whole model, and models without one.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "models.h"
#include "talus/theory.h"

using namespace talus;
using namespace talus::theory;
using namespace talus::theory::testing;

namespace {

double predictedDegrees(const Model& model) {
    const auto prediction = predict(model);
    REQUIRE(prediction.has_value());
    return prediction->critical_tilt / kDegree;
}

Model paperSlope(double friction_deg) {
    StackOptions options;
    options.friction_deg = friction_deg;
    return stackModel(options);
}

}  // namespace

TEST_CASE("the paper's slope: every watered fissure at three friction angles") {
    const double expected[][3] = {{18.00, 19.50, 21.00}, {5.60, 7.25, 8.92},    {11.94, 13.53, 15.13},
                                  {14.00, 15.56, 17.13}, {15.01, 16.56, 18.12}, {15.62, 17.16, 18.70},
                                  {16.02, 17.55, 19.09}};
    const double friction[] = {18, 19.5, 21};
    for (int fissure = 0; fissure <= 6; ++fissure)
        for (int k = 0; k < 3; ++k) {
            CAPTURE(fissure);
            CAPTURE(friction[k]);
            Model model = paperSlope(friction[k]);
            if (fissure > 0) addFissureWater(model, fissure, 0.35);
            const auto prediction = predict(model);
            REQUIRE(prediction.has_value());
            CHECK(std::abs(prediction->critical_tilt / kDegree - expected[fissure][k]) < 0.0051);
            CHECK_FALSE(prediction->topples);
            CHECK_FALSE(prediction->formula.empty());
        }
}

TEST_CASE("a prediction names its formula and the blocks that move") {
    StackOptions options;
    Model model = stackModel(options);
    addFissureWater(model, 2, 0.35);
    const auto slides = predict(model);
    REQUIRE(slides.has_value());
    CHECK(slides->kind() == std::string("sliding on a plane"));
    REQUIRE(slides->blocks.size() == static_cast<std::size_t>(2 * model.stack->rows * model.stack->slices));
    CHECK(slides->blocks.front() == "c1r1s1");
    CHECK(std::is_sorted(slides->blocks.begin(), slides->blocks.end()));
    const auto topples = predict(paperSlope(30));
    REQUIRE(topples.has_value());
    CHECK(topples->kind() == std::string("overturning about the toe"));
    CHECK(topples->blocks.size() == static_cast<std::size_t>(model.stack->rows * model.stack->slices));
}

TEST_CASE("twelve columns: further watered fissures behind the first change nothing") {
    StackOptions options;
    options.heights.assign(12, 5);
    Model one = stackModel(options), four = stackModel(options);
    addFissureWater(one, 7, 0.35);
    for (const int fissure : {7, 8, 9, 10}) addFissureWater(four, fissure, 0.35);
    CHECK(std::abs(predictedDegrees(one) - 17.83) < 0.0051);
    CHECK(predictedDegrees(four) == doctest::Approx(predictedDegrees(one)).epsilon(1e-12));
}

TEST_CASE("a dry slope with rough joints overturns at the toe column") {
    const auto prediction = predict(paperSlope(30));
    REQUIRE(prediction.has_value());
    CHECK(prediction->topples);
    CHECK(prediction->critical_tilt == doctest::Approx(std::atan(0.2 / 0.5)).epsilon(1e-12));
}

TEST_CASE("the toe column overturned by the water behind it") {
    Model model = paperSlope(40);
    addFissureWater(model, 1, 0.35);
    const auto prediction = predict(model);
    REQUIRE(prediction.has_value());
    CHECK(prediction->topples);
    CHECK(prediction->critical_tilt ==
          doctest::Approx(criticalTiltToppling(0.2, 0.5, 2700, 0.35)).epsilon(1e-12));
}

TEST_CASE("a tall column behind a low one that would lean on it: nothing rather than a guess") {
    StackOptions options;
    options.friction_deg = 40;
    options.heights = {
        2, 5};  // above the toe's top the second column overturns at atan(2/3), leaning comes before
    CHECK_FALSE(predict(stackModel(options)).has_value());
    options.friction_deg = 15;  // slides before anything leans
    CHECK(predictedDegrees(stackModel(options)) == doctest::Approx(15).epsilon(1e-12));
}

TEST_CASE("stepped slope: water against the free part of a taller neighbour") {
    StackOptions options;
    options.heights = {2, 5, 5};
    Model model = stackModel(options);
    addFissureWater(model, 2, 0.35);
    // Above the floor both columns in front of fissure 2 slide; above the toe's top column 2 would slide
    // alone.
    const double weight = 2700 * (0.2 * 0.2 + 0.2 * 0.5);
    const double whole = std::atan(std::tan(19.5 * kDegree) - 1000 * 0.35 * 0.35 / (2 * weight));
    const double above = criticalTiltSliding({0.2, 0.3, 2700, 1000, 0.15, 19.5 * kDegree, 0, 9.81});
    REQUIRE(whole < above);
    CHECK(predictedDegrees(model) == doctest::Approx(whole / kDegree).epsilon(1e-10));

    Model perched = stackModel(options);  // water above the toe's top only
    addFissureWater(perched, 2, 0.2, 0.2);
    const double upper = criticalTiltSliding({0.2, 0.3, 2700, 1000, 0.2, 19.5 * kDegree, 0, 9.81});
    CHECK(predictedDegrees(perched) == doctest::Approx(upper / kDegree).epsilon(1e-10));
}

TEST_CASE("perched water acts above its base only") {
    Model model = paperSlope(19.5);
    addFissureWater(model, 2, 0.2, 0.3);
    // Above level 4 (0.3 m) two columns of 0.2 m height hold 0.2 m of water.
    const double expected = criticalTiltSliding({0.4, 0.2, 2700, 1000, 0.2, 19.5 * kDegree, 0, 9.81});
    CHECK(predictedDegrees(model) == doctest::Approx(expected / kDegree).epsilon(1e-10));
}

TEST_CASE("each bed level has its own joint") {
    Model model = paperSlope(19.5);
    model.joints.push_back(plainJoint(12));
    for (Block& block : model.blocks)
        if (block.name.find("r3") != std::string::npos) block.face_joint[faceOf(block, -Vec3::UnitZ())] = 1;
    CHECK(predictedDegrees(model) == doctest::Approx(12).epsilon(1e-12));
    model.blocks[1 + 2 * 3].face_joint[faceOf(model.blocks[1 + 2 * 3], -Vec3::UnitZ())] = 0;
    CHECK_FALSE(predict(model).has_value());  // one block of that bed differs
}

TEST_CASE("the joint of a pair replaces the rule") {
    StackOptions options;
    options.heights = {1};
    options.slices = 1;
    Model model = stackModel(options);
    model.joints.push_back(plainJoint(25));
    PairJoint pair;
    pair.block_a = 1;
    pair.block_b = 0;
    pair.joint = 1;
    model.pair_joints.push_back(pair);
    CHECK(predictedDegrees(model) == doctest::Approx(25).epsilon(1e-12));
}

TEST_CASE("a slope that water pushes uphill at the start has no critical tilt") {
    Model model = paperSlope(19.5);
    addFissureWater(model, 6, 0.5);  // the last column moves uphill below 6.2 deg
    CHECK_FALSE(predict(model).has_value());
    model.analysis.start = 6.3 * kDegree;
    CHECK(predict(model).has_value());
    model.analysis.start = 6.1 * kDegree;
    CHECK_FALSE(predict(model).has_value());
}

TEST_CASE("what the formulas do not cover") {
    SUBCASE("running bond") {
        Model model = paperSlope(19.5);
        model.stack->running = true;
        CHECK_FALSE(predict(model).has_value());
    }
    SUBCASE("fissures that hold together") {
        Model model = paperSlope(19.5);
        model.joints[0].tensile_strength = 1e5;
        CHECK_FALSE(predict(model).has_value());
    }
    SUBCASE("strength with a peak") {
        Model model = singleModel(1, 0.3, 20, 500);
        CHECK(predict(model).has_value());
        model.joints[0].residual_cohesion = 0;
        CHECK_FALSE(predict(model).has_value());
    }
    SUBCASE("a block the stack does not know") {
        Model model = paperSlope(19.5);
        model.blocks.push_back(boxBlock("extra", {-1, 0, 0}, {-0.5, 0.1, 0.1}, Motion::free));
        CHECK_FALSE(predict(model).has_value());
    }
}

TEST_CASE("a level over time counts with its value at the start") {
    Model constant = paperSlope(19.5), rising = paperSlope(19.5);
    addFissureWater(constant, 1, 0.1);
    addFissureWater(rising, 1, 0.1);
    rising.waters[0].level.push_back({1.0, 0.35});
    rising.waters[0].drains_at_aperture = 0.001;
    REQUIRE(predict(rising).has_value());
    CHECK(predict(rising)->critical_tilt == predict(constant)->critical_tilt);
}

TEST_CASE("single bodies with water behind them") {
    struct Row {
        double length, height, friction, depth, expected;
        bool topples;
    };
    for (const Row& row :
         {Row{1, 1, 40, 0, 40, false}, Row{1, 1, 40, 0.5, 38.38, false}, Row{1, 1, 40, 1, 33.04, false},
          Row{1, 2, 40, 0, 26.57, true}, Row{1, 2, 40, 1, 25.11, true}, Row{1, 2, 40, 2, 13.95, true},
          Row{0.5, 1, 30, 0, 26.57, true}, Row{0.5, 1, 30, 0.5, 25.11, true},
          Row{0.5, 1, 30, 1, 11.31, false}}) {
        CAPTURE(row.expected);
        Model model = singleModel(row.length, row.height, row.friction);
        if (row.depth > 0) addFaceWater(model, Vec3::UnitX(), row.depth);
        const auto prediction = predict(model);
        REQUIRE(prediction.has_value());
        CHECK(std::abs(prediction->critical_tilt / kDegree - row.expected) < 0.0051);
        CHECK(prediction->topples == row.topples);
    }
}

TEST_CASE("a single box: water in front holds it, uplift under it releases it") {
    Model held = singleModel(1, 0.5, 20), lifted = held;
    addFaceWater(held, -Vec3::UnitX(), 0.2);
    const double weight = 26000 * 0.5 * 0.5, thrust = 9810 * 0.5 * 0.02;
    CHECK(std::tan(predictedDegrees(held) * kDegree) ==
          doctest::Approx(std::tan(20 * kDegree) + thrust / weight).epsilon(1e-12));

    Water water;
    water.kind = Water::Level::head;
    water.head = {0.3, 0.1};
    water.pair = {1, 0};
    lifted.waters.push_back(water);
    const double uplift = 9810 * 0.5 * 0.2;
    CHECK(std::tan(predictedDegrees(lifted) * kDegree) ==
          doctest::Approx(std::tan(20 * kDegree) * (1 - uplift / weight)).epsilon(1e-12));
}

TEST_CASE("uplift adds to the overturning moment by its lever") {
    Model model = singleModel(0.5, 1, 50);
    Water water;
    water.kind = Water::Level::head;
    water.head = {0.4, 0.0};
    water.pair = {0, 1};
    model.waters.push_back(water);
    const double weight = 26000 * 0.5 * 0.5;
    const double uplift = 9810 * 0.5 * 0.5 * 0.2,
                 lever = 0.5 * 2 / 3;  // a triangle, its heavy end at the back
    const double expected = (weight * 0.25 - uplift * lever) / (weight * 0.5);
    CHECK(std::tan(predictedDegrees(model) * kDegree) == doctest::Approx(expected).epsilon(1e-12));
}

TEST_CASE("a cohesive box: exact while its base stays closed, silent when part of it would open") {
    const Model squat = singleModel(1, 0.3, 20, 500);
    const double expected = criticalTiltSliding({1, 0.3, 26000 / 9.81, 1000, 0, 20 * kDegree, 500, 9.81});
    CHECK(predictedDegrees(squat) == doctest::Approx(expected / kDegree).epsilon(1e-12));
    CHECK_FALSE(predict(singleModel(1, 0.9, 20, 500)).has_value());
}
