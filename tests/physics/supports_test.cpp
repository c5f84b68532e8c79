// Bolts, ground motion and water tables against balances and motions with an exact answer.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/models.h"
#include "support/snapshots.h"
#include "support/verification.h"
#include "talus/analysis.h"
#include "talus/limit_analysis.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

SearchResult factorOf(const Model& model) {
    const auto found = safetyFactor(model);
    REQUIRE(found.ok());
    REQUIRE((found->status == SearchStatus::found));
    return *found;
}

/// A flat block of 1 x 1 x 0.2 m on a plane tilted by 30 degrees with 25 degrees of friction, tied to the
/// plane by a bolt up the slope, which pulls along it from the block's middle.
Model tied(double pretension, double yield) {
    Model model = floorModel(25, 1e10);
    model.gravity.tilt = radians(30);
    addBox(model, "key", {0, 0, 0}, {1, 1, 0.2});
    model.blocks.push_back(box("anchor block", {3, 0, 0.0}, {4, 1, 0.2}, 2700, Motion::fixed));
    Bolt bolt;
    bolt.name = "tie";
    bolt.head = {0.5, 0.5, 0.1};
    bolt.end = {3.5, 0.5, 0.1};
    bolt.area = 1e-4;
    bolt.modulus = 2e11;
    bolt.pretension = pretension;
    bolt.yield_force = yield;
    bolt.field = "bolt[0]";
    model.bolts = {bolt};
    return model;
}

constexpr double kWeight = 2700 * 0.2 * 9.81;

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE(
        "a block tied up its slope: F = W cos tan(phi) / (W sin - T), the bolt pretensioned or pulled to its "
        "yield") {
        const double b = radians(30), force = 800;
        const double exact = kWeight * std::cos(b) * std::tan(radians(25)) / (kWeight * std::sin(b) - force);
        for (const double pretension : {0.0, 400.0, force}) {
            CAPTURE(pretension);
            const Model model = tied(pretension, force);
            const SearchResult found = factorOf(model);
            MESSAGE("factor of safety ", found.answer, ", exact ", exact);
            CHECK(found.answer == doctest::Approx(exact).epsilon(0.002));
            REQUIRE(found.supports.at(0).reports.size() == 1);
            CHECK(found.supports.at(0).reports[0].name == "tie");
            CHECK(found.supports.at(0).reports[0].force == doctest::Approx(force).epsilon(1e-6));
            CHECK(found.supports.at(0).reports[0].utilisation == doctest::Approx(1.0));
            CHECK(!found.supports.at(0).reports[0].broken);
            const auto ceiling = limitAnalysis(model, Varied::factor);
            REQUIRE(ceiling.ok());
            CHECK(ceiling->upper == doctest::Approx(exact).epsilon(2e-4));
        }
    }

    // A bolt that stands across the slide turns with it and holds a little more: rests go on for ever, each a
    // little farther.
    TEST_CASE("a slab on a plane with a bolt at any angle: F = (W cos + N) tan(phi) / (W sin - T)") {
        const double b = std::atan(0.6), weight = 2500 * 4 * 9.81;
        for (const double angle : {22.0, 37.0, 49.0, 62.0, 81.0})
            for (const double force : {1e4, 4e4})
                for (const double pretension : {0.0, 0.5, 1.0}) {
                    CAPTURE(angle);
                    CAPTURE(force);
                    CAPTURE(pretension);
                    Model model = floorModel(25, 1e10);
                    model.blocks[0] = box("plane", {-5, -5, -3}, {5, 5, 0}, 2500, Motion::fixed);
                    model.gravity.tilt = b;
                    addBox(model, "slab", {0, 0, 0}, {2, 2, 1}, 2500);
                    Bolt bolt;
                    bolt.name = "tie";
                    bolt.head = {0.6, 1, 0.5};
                    bolt.end = bolt.head + 2.0 * Vec3(std::cos(radians(angle)), 0, -std::sin(radians(angle)));
                    bolt.area = 5e-4;
                    bolt.modulus = 2e11;
                    bolt.yield_force = force;
                    bolt.pretension = pretension * force;
                    bolt.field = "bolt[0]";
                    model.bolts = {bolt};
                    const double along = force * std::cos(radians(angle)),
                                 into = force * std::sin(radians(angle));
                    const double exact = (weight * std::cos(b) + into) * std::tan(radians(25)) /
                                         (weight * std::sin(b) - along);
                    CHECK(factorOf(model).answer == doctest::Approx(exact).epsilon(4e-3));
                }
    }

    TEST_CASE("a bolt holds what it can before it breaks, and then nothing") {
        Model model = tied(0, 800);
        model.bolts[0].rupture_strain = 1e-5;  // at 200 N
        const double b = radians(30);
        const double exact = kWeight * std::cos(b) * std::tan(radians(25)) / (kWeight * std::sin(b) - 200);
        const SearchResult found = factorOf(model);
        MESSAGE("factor of safety ", found.answer, ", exact ", exact);
        CHECK(found.answer == doctest::Approx(exact).epsilon(0.002));
        CHECK(found.supports.at(0).reports[0].broken);
        CHECK(found.supports.at(0).reports[0].force == 0);
    }

    TEST_CASE("the Hoek-Bray slope with 2 m of water and an anchor of 200 kN/m at 15 degrees: 1.848") {
        const Model model = verification("hoek-bray-crack-2m-anchored");
        const SearchResult found = factorOf(model);
        MESSAGE("factor of safety ", found.answer, ", published 1.848");
        CHECK(found.answer == doctest::Approx(1.848).epsilon(0.01));
        const auto ceiling = limitAnalysis(model, Varied::factor);
        REQUIRE(ceiling.ok());
        MESSAGE("ceiling ", ceiling->upper);
        CHECK(ceiling->upper > found.low);
    }

    TEST_CASE("Goodman and Bray's slope held by a force on its toe block: 1.2308 and 1.0000, within 1 %") {
        for (const auto& [name, factor] : {std::pair{"goodman-bray-slice-38.6598-held", 1.2308},
                                           {"goodman-bray-slice-33.0239-held", 1.0}}) {
            const SearchResult found = factorOf(verification(name));
            MESSAGE(name, ": factor of safety ", found.answer, ", published ", factor);
            CHECK(found.answer == doctest::Approx(factor).epsilon(0.01));
            CHECK((found.mode == FailureMode::toppling));
        }
    }

    TEST_CASE(
        "water that falls to nothing where its joint daylights: Hoek and Bray's 1.363, by the joint's "
        "heads") {
        const SearchResult by_pair = factorOf(verification("hoek-bray-crack-2m"));
        const SearchResult by_joint = factorOf(verification("hoek-bray-crack-2m-daylight"));
        MESSAGE("factor of safety ", by_joint.answer, ", exact 1.3636");
        CHECK(by_joint.answer == doctest::Approx(1.3636).epsilon(0.001));
        CHECK(by_joint.answer == doctest::Approx(by_pair.answer).epsilon(1e-3));
        // With the whole head at the toe as well, uplift is twice that: half of the difference is the drop's.
        Model full = verification("hoek-bray-crack-2m-daylight");
        full.waters[1].head = {2.0, 2.0};
        const double dip = radians(35), area = 7.652010281 / std::sin(dip), unit = 9810, weight = 1241.7e3;
        const double thrust = 0.5 * unit * 4, uplift = 2 * unit * area;
        const double exact = (25e3 * area + (weight * std::cos(dip) - uplift - thrust * std::sin(dip)) *
                                                std::tan(radians(37))) /
                             (weight * std::sin(dip) + thrust * std::cos(dip));
        CHECK(factorOf(full).answer == doctest::Approx(exact).epsilon(0.001));
    }

    TEST_CASE("a slope 60 m high with a crack of 14 m and 5 m of water in it: 1.0935") {
        const SearchResult found = factorOf(verification("hoek-bray-60m"));
        MESSAGE("factor of safety ", found.answer);
        CHECK(found.answer == doctest::Approx(1.0935).epsilon(0.001));
    }

    TEST_CASE(
        "pull on a grouted cable: shear lag's stiffness, then what yields; with a short bond what its grout "
        "holds") {
        for (const bool is_short : {false, true}) {
            const Model model = verification(is_short ? "pull-out-cable-short" : "pull-out-cable");
            const double lambda = std::sqrt(112e6 / (181e-6 * 98.6e9)), bond = is_short ? 2.0 : 17.7;
            const double stiffness = std::sqrt(112e6 * 181e-6 * 98.6e9) * std::tanh(lambda * bond);
            std::vector<HistoryRecord> records;
            const auto result =
                run(model, {}, [&](const HistoryRecord& record) { records.push_back(record); });
            REQUIRE(result.ok());
            double most = 0;
            for (const HistoryRecord& record : records)
                most = std::max(most, record.supports.at(0).reports[0].force);
            const HistoryRecord &half = records[8], &third = records[4];  // at 0.4 and 0.2 s
            const double pull = half.supports.at(0).reports[0].force - third.supports.at(0).reports[0].force;
            const double way = half.watch[0].displacement.z() - third.watch[0].displacement.z();
            MESSAGE("initial stiffness ", pull / way / 1e6, " MN/m, shear lag ", stiffness / 1e6, "; holds ",
                    most / 1e3, " kN");
            CHECK(pull == doctest::Approx(0.2 * 490e3).epsilon(1e-3));
            CHECK(pull / way == doctest::Approx(stiffness).epsilon(0.01));
            CHECK(most == doctest::Approx(is_short ? 0.35e6 : 0.5e6).epsilon(1e-9));
            const std::vector<SupportSign> signs{{"yielded", "yielded", !is_short},
                                                 {"slipped", "slipped in its grout", is_short}};
            CHECK(result->supports.at(0).reports[0].signs == signs);
        }
    }

    TEST_CASE("Newmark's block: a pulse a for t slips it by (a - mu g) t^2 a / (2 mu g)") {
        const auto result = run(verification("newmark-block"), {}, [](const HistoryRecord&) {});
        REQUIRE(result.ok());
        const double mu_g = 0.2 * 9.81, exact = (4 - mu_g) * 0.25 * 4 / (2 * mu_g);
        const Vec3 slip = result->displacements[1];
        MESSAGE("slip ", -slip.x(), " m, exact ", exact);
        CHECK(-slip.x() == doctest::Approx(exact).epsilon(0.005));
        CHECK(result->watch[0].velocity.norm() < 1e-6);
        CHECK(result->displacements[0] == Vec3::Zero());
    }

    TEST_CASE("a water table through a slope: a block below it is held by its buoyant weight") {
        // Level ground of a reservoir: the factor of a submerged block is that of a dry one.
        Model model = floorModel(35, 1e10);
        model.gravity.tilt = 0;
        model.seismic.horizontal = 0.2;
        addBox(model, "key", {0, 0, 0}, {1, 1, 0.4});
        model.phreatic = PhreaticSurface{.line = {{-9, 3}, {19, 3}}, .field = "water[0]"};
        const double weight = 2700 * 0.4 * 9.81, buoyancy = 1000 * 0.4 * 9.81;
        const double exact = (weight - buoyancy) * std::tan(radians(35)) / (0.2 * weight);
        const SearchResult found = factorOf(model);
        MESSAGE("factor of safety under water ", found.answer, ", exact ", exact);
        CHECK(found.answer == doctest::Approx(exact).epsilon(0.002));
    }
}

TEST_SUITE("slow: physics") {
    TEST_CASE("Housner's block: quarter period and the loss at the impact") {
        std::vector<HistoryRecord> records;
        const auto result = run(verification("housner-block"), {},
                                [&](const HistoryRecord& record) { records.push_back(record); });
        REQUIRE(result.ok());
        // The centroid is lowest at the impact. Its fall's energy is that of the rotation there; what is left
        // in the next swing is that times the square of the velocity's ratio.
        std::size_t lowest = 0;
        for (std::size_t k = 0; k < records.size(); ++k)
            if (records[k].watch[0].position.z() < records[lowest].watch[0].position.z()) lowest = k;
        const double fall = 2700 * 0.8 * 9.81 * (records.front().watch[0].position.z() - 1.0);
        const HistoryRecord& after = records.back();
        const double ratio = std::sqrt((after.kinetic_energy + after.gravity_energy + fall) / fall);
        MESSAGE("quarter period ", records[lowest].time, " s, reference 0.4909; velocity times ", ratio,
                ", reference 0.9423");
        CHECK(records[lowest].time == doctest::Approx(0.4909).epsilon(0.01));
        CHECK(ratio == doctest::Approx(0.9423).epsilon(0.01));
    }
}
