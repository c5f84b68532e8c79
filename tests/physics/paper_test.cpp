// The paper's slope: every row of the verification table, from the scenarios a user would run.

#include <doctest/doctest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "support/models.h"
#include "support/slower.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

Model paperModel(const std::string& name, double friction_deg) {
    auto scenario = formats::readScenario(std::string(TALUS_SOURCE_DIR) + "/bench/paper/" + name + ".toml");
    REQUIRE(scenario.ok());
    for (Joint& joint : scenario->model.joints)
        joint.friction = joint.residual_friction = radians(friction_deg);
    return scenario->model;
}

void checkRow(const Model& model, double expected_deg, int columns_that_go) {
    const auto result = criticalAngle(model);
    REQUIRE(result.ok());
    REQUIRE((result->status == SearchStatus::found));
    MESSAGE("critical angle " << degrees(result->answer) << ", exact " << expected_deg);
    CHECK(std::abs(degrees(result->answer) - expected_deg) < 0.02 + 0.005);
    CHECK((result->mode == FailureMode::sliding));
    std::set<std::string> columns;
    for (const std::string& block : result->moving_blocks) columns.insert(block.substr(0, block.find('r')));
    CHECK(static_cast<int>(columns.size()) == columns_that_go);
}

/// One slice of the slope: the same limit, a third of the work.
Model oneSlice(int fissure, double friction_deg) {
    Model model = stackModel(7, 5, 1, friction_deg);
    model.analysis.start = 0;
    if (fissure > 0) model.waters = {fissureAt(model, 0.2 * fissure, 0.35)};
    return model;
}

constexpr double kExact[3][7] = {{18.00, 5.60, 11.94, 14.00, 15.01, 15.62, 16.02},
                                 {19.50, 7.25, 13.53, 15.56, 16.56, 17.16, 17.55},
                                 {21.00, 8.92, 15.13, 17.13, 18.12, 18.70, 19.09}};
constexpr double kFriction[3] = {18.0, 19.5, 21.0};

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("one slice, phi 19.5: dry and fissures 1, 3, 6") {
        for (const int fissure : {0, 1, 3, 6}) {
            CAPTURE(fissure);
            checkRow(oneSlice(fissure, 19.5), kExact[1][fissure], fissure == 0 ? 7 : fissure);
        }
    }

    TEST_CASE(
        "what holds a dry slope of low rows is its friction: it stands below that angle, and fails above") {
        struct Shape {
            int columns, rows, slices;
        };
        for (const Shape& shape : {Shape{7, 5, 2}, Shape{7, 5, 3}, Shape{8, 4, 3}, Shape{5, 4, 3}})
            for (const double friction : {18.0, 17.3, 19.5, 20.3, 21.0}) {
                if (kTriesFew && (shape.slices > 2 || friction != 18.0)) continue;
                CAPTURE(shape.columns);
                CAPTURE(shape.slices);
                CAPTURE(friction);
                Model model = stackModel(shape.columns, shape.rows, shape.slices, friction);
                model.analysis.start = 0;
                const SearchResult result = *criticalAngle(model);
                REQUIRE((result.status == SearchStatus::found));
                CHECK(degrees(result.low) <= friction);
                CHECK(degrees(result.high) >= friction);
                CHECK((result.mode == FailureMode::sliding));
            }
    }

    TEST_CASE("corner points agree with vertex points") {
        for (const int fissure : {0, 2}) {
            Model model = oneSlice(fissure, 19.5);
            model.points.kind = PointRule::Kind::corner;
            checkRow(model, kExact[1][fissure], fissure == 0 ? 7 : fissure);
        }
    }

    TEST_CASE("quarter points: the pivot half way in topples the dry slope at atan(0.05/0.25)") {
        Model model = oneSlice(0, 19.5);
        model.points.kind = PointRule::Kind::quarter;
        const SearchResult result = *criticalAngle(model);
        CHECK(degrees(result.answer) == doctest::Approx(11.31).epsilon(0.002));
        CHECK((result.mode == FailureMode::toppling));
    }
}

TEST_SUITE("slow: physics") {
    TEST_CASE("Table 1: seven cases, three friction angles") {
        for (int row = 0; row < 3; ++row)
            for (int fissure = 0; fissure <= 6; ++fissure) {
                const std::string name = fissure == 0 ? "dry" : "fissure-" + std::to_string(fissure);
                CAPTURE(name);
                CAPTURE(kFriction[row]);
                checkRow(paperModel(name, kFriction[row]), kExact[row][fissure], fissure == 0 ? 7 : fissure);
            }
    }

    TEST_CASE("section 5: twelve columns") {
        checkRow(paperModel("section5-fissure-7", 19.5), 17.83, 7);
        checkRow(paperModel("section5-fissures-7-10", 19.5), 17.83, 7);
    }

    TEST_CASE("deep water: fails on a level base, and pushes the last column uphill") {
        Model model = oneSlice(1, 19.5);
        model.waters[0].level[0].value = 0.5;
        CHECK((criticalAngle(model)->status == SearchStatus::unstable_at_start));
        Model back = oneSlice(6, 19.5);
        back.waters[0].level[0].value = 0.5;
        const SearchResult uphill = *criticalAngle(back);
        CHECK((uphill.status == SearchStatus::unstable_at_start));
        for (const std::string& block : uphill.moving_blocks) CHECK(block.substr(0, 2) == "c7");
        back.analysis.start = radians(7);
        CHECK(criticalAngle(back)->low >= radians(7));
    }
}
