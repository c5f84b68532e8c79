// The list of searches: what commands, sweeps and files rely on.

#include "talus/searches.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>

#include "support/models.h"

using namespace talus;
using namespace talus::test;

TEST_CASE("searches are found by their names, and no two share a name or a key") {
    std::set<std::string> names, keys;
    for (const LoadSearch& search : loadSearches()) {
        CHECK(loadSearch(search.name) == &search);
        names.insert(search.name);
        for (const char* key : {search.answer_key, search.load->key, search.theory_key}) keys.insert(key);
        CHECK(search.load->scale > 0);
        CHECK(search.lowest < search.highest);
    }
    CHECK(names.size() == loadSearches().size());
    CHECK(keys.size() == 3 * loadSearches().size());
    CHECK(loadSearch("run") == nullptr);
    CHECK(loadSearch("critical-angle")->keyInUnit("bracket") == "bracket_deg");
    CHECK(loadSearch("safety-factor")->keyInUnit("bracket") == "bracket");
}

TEST_CASE("quantities stand in the order of their enumeration, and no two share a name or a key") {
    std::set<std::string> names, keys;
    for (std::size_t k = 0; k < variedQuantities().size(); ++k) {
        const VariedQuantity& quantity = variedQuantities()[k];
        CHECK(static_cast<std::size_t>(quantity.varied) == k);
        CHECK(&quantityOf(quantity.varied) == &quantity);
        names.insert(quantity.name), keys.insert(quantity.key);
        // What can be put on a model can be written into a scenario, in one of two ways.
        CHECK((quantity.apply != nullptr) == (quantity.divides_strengths || !quantity.written.empty()));
    }
    CHECK(names.size() == variedQuantities().size());
    CHECK(keys.size() == variedQuantities().size());
}

TEST_CASE("a model under a load is the one that fails there") {
    Model model = floorModel(30);
    model.joints[0].cohesion = 200;
    putUnderLoad(model, Varied::tilt, radians(12));
    CHECK(model.gravity.tilt == radians(12));
    putUnderLoad(model, Varied::factor, 2);
    CHECK(std::tan(model.joints[0].friction) == doctest::Approx(std::tan(radians(30)) / 2));
    CHECK(std::tan(model.joints[0].residual_friction) == doctest::Approx(std::tan(radians(30)) / 2));
    CHECK(model.joints[0].cohesion == 100);
    CHECK(model.gravity.tilt == radians(12));
}

TEST_CASE("each search finds the load of a block on a plane, and its theory says the same") {
    Model model = floorModel(20);
    model.blocks.push_back(box("key", {0, 0, 0}, {1, 1, 0.2}));
    model.gravity.tilt = radians(12);
    model.analysis.start = radians(15);
    model.analysis.stop = radians(25);
    const double factor = std::tan(radians(20)) / std::tan(radians(12));
    const auto exactOf = [&](const LoadSearch& search) {
        switch (search.load->varied) {
            case Varied::tilt:
                return radians(20);
            case Varied::factor:
                return factor;
            case Varied::horizontal:
                break;
        }
        return std::tan(radians(20 - 12));
    };
    for (const LoadSearch& search : loadSearches()) {
        CAPTURE(search.name);
        const auto found = search.find(model, Control{}, {});
        REQUIRE(found.ok());
        CHECK(found->answer == doctest::Approx(exactOf(search)).epsilon(0.002));
        const auto theory = search.theory(model, nullptr);
        REQUIRE(theory.has_value());
        CHECK(theory->value == doctest::Approx(exactOf(search)).epsilon(1e-9));
    }
}
