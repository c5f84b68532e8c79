// What is changed in a model, and what the answers of a sliding block do then.

#include "slope_report/sensitivity.h"

#include <doctest/doctest.h>

#include <cmath>

#include "cli/text.h"
#include "support/models.h"

using namespace talus;
using namespace talus::tools;
using test::addBox;
using test::floorModel;

namespace {

Model jointed() {
    Model model = floorModel(30);
    model.joints.resize(2);
    model.joints[0].cohesion = 1e4;
    model.joints[1] = model.joints[0];
    model.joints[1].law = StrengthLaw::power;
    model.joints[1].a = 2, model.joints[1].b = 0.9;
    model.seismic.horizontal = 0.1;
    return model;
}

/// A block on a level floor, tilted: it slides at tan(friction) / tan(tilt).
formats::Scenario block() {
    formats::Scenario scenario;
    scenario.path = "block.toml";
    scenario.model = floorModel(40);
    scenario.model.gravity.tilt = radians(20);
    addBox(scenario.model, "box", {0, 0, 0}, {2, 1, 1});
    return scenario;
}

}  // namespace

TEST_CASE("sensitivity: friction without cohesion, stiffness, and the coefficient about its own value") {
    const Model model = jointed();
    const auto list = changedQuantities(model, Varied::factor, 0.1);
    REQUIRE(list.size() == 3);
    Model less = model, more = model;
    list[0].less(less), list[0].more(more);
    CHECK(std::tan(less.joints[0].friction) == doctest::Approx(0.9 * std::tan(model.joints[0].friction)));
    CHECK(std::tan(more.joints[0].friction) == doctest::Approx(1.1 * std::tan(model.joints[0].friction)));
    CHECK(more.joints[0].cohesion == 1e4);
    CHECK(more.joints[1].strength_factor == doctest::Approx(1.1));
    CHECK(more.joints[1].a == 2);
    list[1].less(less), list[1].more(more);
    CHECK(less.seismic.horizontal == doctest::Approx(0.05));
    CHECK(more.seismic.horizontal == doctest::Approx(0.15));
    CHECK(list[1].less_text == "k = 0.050");
    list[2].more(more);
    CHECK(more.joints[0].normal_stiffness == doctest::Approx(1.1 * model.joints[0].normal_stiffness));
    CHECK(more.joints[0].shear_stiffness == doctest::Approx(1.1 * model.joints[0].shear_stiffness));
    CHECK(changedQuantities(model, Varied::horizontal, 0.1).size() == 2);
}

TEST_CASE("sensitivity: of a sliding block the answers are those of statics") {
    const formats::Scenario scenario = block();
    const LoadSearch& search = *loadSearch("safety-factor");
    const auto list = sensitivities(scenario, search, 0.1, {});
    REQUIRE(list);
    REQUIRE(list->size() == 3);
    const double tan_phi = std::tan(radians(40)), tilt = radians(20);
    const auto factor = [&](double k) {
        return tan_phi * (std::cos(tilt) - k * std::sin(tilt)) / (std::sin(tilt) + k * std::cos(tilt));
    };
    CHECK((*list)[0].less.answer == doctest::Approx(0.9 * factor(0)).epsilon(2e-3));
    CHECK((*list)[0].more.answer == doctest::Approx(1.1 * factor(0)).epsilon(2e-3));
    CHECK((*list)[1].less.answer == doctest::Approx(factor(-0.05)).epsilon(2e-3));
    CHECK((*list)[1].more.answer == doctest::Approx(factor(0.05)).epsilon(2e-3));
    CHECK((*list)[2].less.answer == doctest::Approx(factor(0)).epsilon(2e-3));
    CHECK((*list)[2].more.answer == doctest::Approx(factor(0)).epsilon(2e-3));
    for (const Sensitivity& one : *list) CHECK(one.less.volume == doctest::Approx(2));

    const auto plot = sensitivityPlot(*list, search, factor(0), scenario.path);
    REQUIRE(plot);
    CHECK(plot->x.categories == std::vector<std::string>{"friction", "horizontal k", "stiffness"});
    CHECK(sensitivityCsv(*list, search, "").starts_with("quantity,change,status,safety_factor,"));

    std::atomic<bool> stop{true};
    Control stopped;
    stopped.stop = &stop;
    CHECK(!sensitivities(scenario, search, 0.1, stopped));
}
