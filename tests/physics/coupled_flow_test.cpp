// Flow whose apertures follow the joints, against closed formulas and the flow of rigid joints.

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "support/flows.h"
#include "support/models.h"
#include "support/slower.h"
#include "talus/analysis.h"
#include "talus/limit_analysis.h"
#include "talus/simulation.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kUnitWeight = 9810, kRock = 2700 * 9.81;  // [N/m^3]
constexpr double kAperture = 1e-4;                         // [m]
constexpr double kLength = 4;                              // of the joint [m]

SteadyFlow coupledSolved(const Model& model) {
    auto flow = coupledFlow(model);
    for (const Error& error : flow.errors()) FAIL_CHECK(error.field, ": ", error.message);
    REQUIRE(flow.ok());
    return *flow;
}

/// A block of 4 m x 1 m x 1 m on a joint of this stiffness. The head falls from the +x end to the -x end,
/// where the pressure is zero.
Model blockOnJoint(double stiffness, double tilt, double pressure_head, double friction = 30) {
    Model model = floorModel(friction, stiffness);
    addBox(model, "box", {0, 0, 0}, {kLength, 1, 1});
    model.gravity.tilt = tilt;
    model.flow = flowAlongX(kAperture, 0, kLength * std::sin(tilt) + pressure_head);
    model.flow->refinements = 4;
    model.flow->coupled = true;
    return model;
}

/// The same in closed form. The block is rigid and the joint's stiffness uniform, so the opening is linear
/// along the joint: b(x) = b0 + (b1 - b0) x / L. Then b^3 dh/dx = const has h(x) = h0 + (h1 - h0) (1 / b0^2 -
/// 1 / b(x)^2) / (1 / b0^2 - 1 / b1^2). Its pressure takes U_0 and U_1 off the reactions of the ends, by the
/// lever rule. Where reactions fall by D_0 and D_1, a uniform stiffness k opens the ends by (4 D_0 - 2 D_1) /
/// k A and (4 D_1 - 2 D_0) / k A. Repeated until the apertures no longer change.
struct Wedge {
    double stiffness, tilt, pressure_head;
    std::array<double, 2> aperture{kAperture, kAperture}, uplift{};

    double pressureAt(double x) const {
        const double b = aperture[0] + (aperture[1] - aperture[0]) * x / kLength;
        const auto inverse = [](double width) { return 1 / (width * width); };
        const double fall = inverse(aperture[0]) - inverse(aperture[1]);
        const double share = std::abs(aperture[1] / aperture[0] - 1) < 1e-9
                                 ? x / kLength
                                 : (inverse(aperture[0]) - inverse(b)) / fall;
        const double top = kLength * std::sin(tilt) + pressure_head;
        return kUnitWeight * (share * top - x * std::sin(tilt));
    }
    void findUplift() {
        constexpr int kParts = 2000;
        uplift = {};
        for (int k = 0; k < kParts; ++k) {
            const double x = (k + 0.5) * kLength / kParts,
                         push = std::max(0.0, pressureAt(x)) * kLength / kParts;
            uplift[0] += push * (1 - x / kLength);
            uplift[1] += push * x / kLength;
        }
    }
    void solve() {
        const double weight = kRock * kLength, level = weight / 2, mean = weight * std::cos(tilt) / 2;
        const double tips = weight * std::sin(tilt) * 0.5 / kLength;  // towards the lower end
        for (int pass = 0; pass < 200; ++pass) {
            findUplift();
            const double less_0 = level - (mean + tips - uplift[0]),
                         less_1 = level - (mean - tips - uplift[1]);
            aperture[0] = kAperture + (4 * less_0 - 2 * less_1) / (stiffness * kLength);
            aperture[1] = kAperture + (4 * less_1 - 2 * less_0) / (stiffness * kLength);
        }
    }
    double factor(double friction) const {
        const double weight = kRock * kLength;
        return (weight * std::cos(tilt) - uplift[0] - uplift[1]) * std::tan(radians(friction)) /
               (weight * std::sin(tilt));
    }
};

double factorOf(const Model& model) {
    const auto result = safetyFactor(model);
    for (const Error& error : result.errors()) FAIL_CHECK(error.field, ": ", error.message);
    REQUIRE(result.ok());
    const bool is_found = result->status == SearchStatus::found;
    REQUIRE(is_found);
    if (model.flow->coupled) {
        REQUIRE(result->flow_coupling);
        CHECK(result->flow_coupling->converged);
        CHECK(result->flow_coupling->last_change <= model.flow->coupling_tolerance);
    }
    return result->answer;
}

/// A dam of 30 blocks, 5 m high, with soft joints, and water of 1.8 m and 0.3 m on its two sides.
Model softDam() {
    Model model = gridDam(6, 5, 1, {1, 1, 1}, 1.8, 0.3);
    for (Joint& joint : model.joints) joint.normal_stiffness = joint.shear_stiffness = 1e9;
    model.flow->coupled = true;
    return model;
}

}  // namespace

TEST_CASE("coupled flow: under a block that turns, the heads of a wedge-shaped joint") {
    Model model = blockOnJoint(1e8, 0, 1.8);
    model.flow->coupling_tolerance = 1e-6;
    Wedge wedge{1e8, 0, 1.8};
    wedge.solve();
    REQUIRE(wedge.aperture[1] > 1.3 * wedge.aperture[0]);
    double last = kInfinity;
    for (const int refinements : {2, 3, 4}) {
        CAPTURE(refinements);
        model.flow->refinements = refinements;
        const SteadyFlow found = coupledSolved(model);
        REQUIRE(found.coupling);
        CHECK(found.coupling->converged);
        double error = 0;
        for (std::size_t n = 0; n < found.nodes.size(); ++n)
            error =
                std::max(error, std::abs(kUnitWeight * found.head[n] - wedge.pressureAt(found.nodes[n].x())));
        CHECK(error < 0.6 * last);
        last = error;
    }
    CHECK(last < 0.02 * kUnitWeight * 1.8);
}

TEST_CASE(
    "coupled flow: under many plates aperture follows the pressure, and b^4 is linear along the joint") {
    // q = T(b) dh/dx with b = b0 + rho g h / k: the integral of b^3 dh is k / (4 rho g) b^4. The plates are
    // thin, so that the water between them hardly turns them.
    constexpr double kStiffness = 1.5e8, kHead = 1.5;
    const auto apertureAt = [&](double h) { return kAperture + kUnitWeight * h / kStiffness; };
    const double high = std::pow(apertureAt(kHead), 4), low = std::pow(apertureAt(0), 4);
    double last = kInfinity;
    for (const int plates : {2, 4, 8}) {
        CAPTURE(plates);
        Model model = floorModel(30, kStiffness);
        const double width = kLength / plates;
        model.joints.push_back(joint(0.1, kStiffness));
        for (int k = 0; k < plates; ++k) {
            addBox(model, "plate" + std::to_string(k), {k * width, 0, 0}, {width, 1, 0.005}, 540e3);
            for (const double side : {-1.0, 1.0})  // plates lift one by one
                model.blocks.back().face_joint[static_cast<std::size_t>(
                    faceTowards(model, model.blocks.size() - 1, side * Vec3::UnitX()))] = 1;
        }
        for (const double x : {-1.0, kLength})
            model.blocks.push_back(
                box("wall" + std::to_string(x), {x, 0, 0}, {x + 1, 1, 1}, 2700, Motion::fixed));
        model.flow = flowAlongX(kAperture, kHead, 0);
        for (std::size_t end = 0; end < 2; ++end) {
            FlowBoundary& boundary = model.flow->boundaries[end];
            const double x = end == 0 ? 0 : kLength;
            boundary.face.reset();
            boundary.box_min = Vec3(x - 1e-3, -1, -1e-3);
            boundary.box_max = Vec3(x + 1e-3, 2, 1);
        }
        model.flow->coupled = true;
        model.flow->coupling_tolerance = 1e-6;
        const SteadyFlow found = coupledSolved(model);
        CHECK(found.coupling->converged);
        double error = 0;
        for (std::size_t n = 0; n < found.nodes.size(); ++n) {
            if (found.nodes[n].z() > 1e-6) continue;
            const double fourth = std::lerp(high, low, found.nodes[n].x() / kLength);
            const double head = (std::pow(fourth, 0.25) - kAperture) * kStiffness / kUnitWeight;
            error = std::max(error, std::abs(found.head[n] - head));
        }
        CHECK(error < 0.6 * last);
        last = error;
    }
    CHECK(last < 0.01 * kHead);
}

TEST_CASE("coupled flow: stiff joints have the answer of flow that is not coupled") {
    Model model = blockOnJoint(1e13, radians(20), 1.5);
    const double coupled = factorOf(model);
    model.flow->coupled = false;
    CHECK(coupled == doctest::Approx(factorOf(model)).epsilon(1e-3));
}

TEST_CASE("coupled flow: opening at the upper end raises the pressure and lowers the factor of safety") {
    const double tilt = radians(20);
    Model model = blockOnJoint(4e8, tilt, 1.0);
    const double coupled = factorOf(model);
    Wedge wedge{4e8, tilt, 1.0};
    wedge.solve();
    CHECK(coupled == doctest::Approx(wedge.factor(30)).epsilon(5e-3));
    model.flow->coupled = false;
    const double plain = factorOf(model);
    CHECK(coupled < plain - 0.15);
}

TEST_CASE("coupled flow: at the critical angle the factor of safety is 1") {
    Model model = blockOnJoint(4e8, radians(20), 1.5, 35);
    model.flow->refinements = 2;
    const auto angle = criticalAngle(model);
    REQUIRE(angle.ok());
    const bool is_found = angle->status == SearchStatus::found;
    REQUIRE(is_found);
    CHECK(angle->flow_coupling->converged);
    REQUIRE(angle->answer > radians(21));
    model.gravity.tilt = angle->answer;
    CHECK(factorOf(model) == doctest::Approx(1).epsilon(3e-3));
}

TEST_CASE("coupled flow: a history begins with the pressure of its equilibrium, as a search does") {
    Model model = blockOnJoint(4e8, radians(10), 1.2, 40);
    model.flow->refinements = 2;
    const SteadyFlow found = coupledSolved(model);
    CHECK(found.coupling->converged);
    model.run.duration = 1e-3;
    model.run.frame_interval = 1e-3;
    std::optional<FullFrame> last;
    RunOutput output;
    output.full = [&](FullFrame&& frame) { last = std::move(frame); };
    const auto result = run(model, {}, output);
    REQUIRE(result.ok());
    const bool begins_at_rest = result->start == InitialState::equilibrium;
    CHECK(begins_at_rest);
    REQUIRE(last);
    REQUIRE(last->memory.size() == 1);
    CHECK(last->memory[0].name == "flow.push");
    double uplift = 0;
    for (std::size_t t = 0; t < found.triangles.size(); ++t) {
        double mean = 0;
        for (const std::int32_t n : found.triangles[t])
            mean += found.pressure[static_cast<std::size_t>(n)] / 3;
        const Vec3 &a = found.nodes[static_cast<std::size_t>(found.triangles[t][0])],
                   &b = found.nodes[static_cast<std::size_t>(found.triangles[t][1])],
                   &c = found.nodes[static_cast<std::size_t>(found.triangles[t][2])];
        uplift += mean * 0.5 * (b - a).cross(c - a).norm();
    }
    const std::vector<double>& push = last->memory[0].values;
    const double pushed = Vec3(push[6], push[7], push[8]).norm();  // of the box, the second block
    CHECK(pushed == doctest::Approx(uplift).epsilon(2e-3));
}

TEST_CASE("coupled flow: analyses without an equilibrium say that apertures are as stated") {
    Model model = blockOnJoint(4e8, radians(10), 1.2, 40);
    model.run.duration = 1e-3;
    model.run.start = RunSettings::Start::unstressed;
    const auto history = run(model, {}, {});
    REQUIRE(history.ok());
    CHECK(says(history->warnings, "flow.coupled: the history does not begin in equilibrium"));
    const auto limit = limitAnalysis(model, Varied::factor);
    REQUIRE(limit.ok());
    CHECK(says(limit->warnings, "flow.coupled: joints do not open here"));
}

TEST_CASE("coupled flow: a history without an equilibrium to begin with is refused") {
    Model model = blockOnJoint(4e8, radians(20), 1.2, 15);
    const auto failing = run(model, {}, {});
    REQUIRE_FALSE(failing.ok());
    CHECK(failing.errors().front().field == "flow.coupled");
    CHECK(failing.errors().front().message.starts_with("found no equilibrium that the history begins with"));
    CHECK_FALSE(Simulation::begin(std::make_shared<const Model>(model)).ok());
    model = blockOnJoint(4e8, radians(10), 1.2, 40);
    addBox(model, "above", {0, 0, 3}, {0.2, 0.2, 0.2});
    const auto loose = run(model, {}, {});
    REQUIRE_FALSE(loose.ok());
    CHECK(loose.errors().front().field == "flow.coupled");
    CHECK(loose.errors().front().message.find("\"above\" touches no other block") != std::string::npos);
}

TEST_CASE("coupled flow: warnings name a mesh too coarse for the opening of a joint, and a capped aperture") {
    Model model = blockOnJoint(4e8, radians(20), 1.0);
    model.flow->refinements = 0;
    const auto coarse = safetyFactor(model, {.interval = false});
    REQUIRE(coarse.ok());
    CHECK(says(coarse->warnings, "flow.refinements: found 0, at which apertures"));
    CHECK(says(coupledSolved(model).warnings, "flow.refinements: found 0"));
    model.flow->refinements = kTriesFew ? 2 : 4;
    const auto fine = safetyFactor(model, {.interval = false});
    REQUIRE(fine.ok());
    CHECK_FALSE(says(fine->warnings, "flow.refinements"));
    CHECK_FALSE(says(fine->warnings, "flow.aperture"));
    model = blockOnJoint(4e8, radians(20), 1.0);
    model.flow->aperture = 1e-6;
    model.flow->coupling_passes = 300;
    CHECK(says(coupledSolved(model).warnings, "times their stated aperture in the last equilibrium"));
}

TEST_CASE("coupled flow: a search refines the mesh as far as joints taper, unless that is given") {
    for (const double stiffness : kTriesFew ? std::vector{4e8, 4e9} : std::vector{5e7, 1.5e8, 4e8, 4e9}) {
        CAPTURE(stiffness);
        Model model = blockOnJoint(stiffness, radians(20), 1.0);
        model.flow->coupling_passes = 300;
        model.flow->refinements = 0;
        const double coarse = factorOf(model);
        model.flow->refines = true;
        const auto found = safetyFactor(model, {.interval = false});
        REQUIRE(found.ok());
        CHECK_FALSE(says(found->warnings, "flow.refinements"));
        REQUIRE(found->flow_coupling);
        const int refinements = found->flow_coupling->refinements;
        CHECK((refinements == 0) == (stiffness > 1e9));
        model.flow->refines = false;
        model.flow->refinements = refinements;
        CHECK(found->answer == factorOf(model));
        model.flow->refinements = kTriesFew ? 3 : 5;
        const double exact = factorOf(model);
        CHECK(found->answer == doctest::Approx(exact).epsilon(0.01));
        if (refinements > 0) CHECK(std::abs(found->answer - exact) < 0.2 * std::abs(coarse - exact));
    }
}

TEST_CASE(
    "coupled flow: the flow of an equilibrium refines its mesh, too, and is compared with a coarser one") {
    Model model = blockOnJoint(4e8, radians(20), 1.0);
    model.flow->refinements = 0;
    model.flow->refines = true;
    const SteadyFlow found = coupledSolved(model);
    REQUIRE(found.coupling->refinements > 0);
    CHECK_FALSE(says(found.warnings, "flow.refinements"));
    const auto change = meshChange(model, found);
    REQUIRE(change.ok());
    CHECK(change->refinements == found.coupling->refinements - 1);
    CHECK(4 * change->triangles == found.triangles.size());
}

TEST_CASE(
    "coupled flow: where a search on the finer mesh is interrupted, the answer of the coarser one counts") {
    Model model = blockOnJoint(4e8, radians(20), 1.0);
    model.flow->refinements = 0;
    model.flow->refines = true;
    std::atomic<bool> stop = false;
    Control control{.interval = false};
    control.stop = &stop;
    control.progress = [&](const Progress& now) {
        if (now.detail.find("finer mesh") != std::string::npos) stop = true;
    };
    const auto found = safetyFactor(model, control);
    REQUIRE(found.ok());
    model.flow->refines = false;
    CHECK(found->answer == factorOf(model));
    CHECK(found->flow_coupling->refinements == 0);
    CHECK(says(found->warnings, "there is no answer (interrupted); this one is with 0"));
    CHECK(says(found->warnings, "flow.refinements: found 0, at which apertures"));
}

TEST_CASE("coupled flow: a joint that drains as it is tilted slides at its angle of friction") {
    Model model = blockOnJoint(4e8, 0, 1.2);
    model.flow->refinements = 2;
    model.flow->free_surface = true;
    model.flow->boundaries[0].kind = FlowBoundary::Kind::outlet;
    const auto angle = criticalAngle(model, {.interval = false});
    REQUIRE(angle.ok());
    CHECK(angle->answer == doctest::Approx(radians(30)).epsilon(1e-3));
    CHECK(angle->flow_coupling->converged);
}

TEST_CASE("coupled flow: what does not converge within its passes says so") {
    Model model = blockOnJoint(2e8, radians(10), 1.5, 40);
    model.flow->refinements = 2;
    model.flow->coupling_passes = 1;
    const auto result = safetyFactor(model);
    REQUIRE(result.ok());
    REQUIRE(result->flow_coupling);
    CHECK_FALSE(result->flow_coupling->converged);
    CHECK(result->flow_coupling->largest_change > model.flow->coupling_tolerance);
    CHECK(says(result->warnings, "flow.coupling_passes: after 1 passes"));
    const SteadyFlow found = coupledSolved(model);
    CHECK_FALSE(found.coupling->converged);
    CHECK(says(found.warnings, "flow.coupling_passes"));
}

TEST_CASE("coupled flow: a dam of many blocks, with any number of threads") {
    Model model = softDam();
    const auto first = safetyFactor(model, {.threads = 1, .interval = false});
    REQUIRE(first.ok());
    const bool is_found = first->status == SearchStatus::found;
    REQUIRE(is_found);
    CHECK(first->flow_coupling->converged);
    CHECK(first->flow_coupling->passes > 0);
    for (const int threads : {2, 3}) {
        if (kTriesFew && threads > 2) continue;
        const auto again = safetyFactor(model, {.threads = threads, .interval = false});
        REQUIRE(again.ok());
        CHECK(again->state_hash == first->state_hash);
        CHECK(again->answer == first->answer);
        CHECK(again->flow_coupling->last_change == first->flow_coupling->last_change);
    }
    model.flow->refinements = 1;
    CHECK(first->answer == doctest::Approx(factorOf(model)).epsilon(4e-3));  // the mesh hardly decides it
}

TEST_CASE("coupled flow: a dam that is tilted drains where it rises above the lower head, and slides") {
    Model model = gridDam(6, 5, 1, {1, 1, 1}, 1, 0.3);
    for (Joint& joint : model.joints) {
        joint.normal_stiffness = joint.shear_stiffness = 1e10;
        joint.friction = joint.residual_friction = radians(8);
    }
    model.flow->coupled = true;
    const auto angle = criticalAngle(model, {.interval = false});
    REQUIRE(angle.ok());
    CHECK(angle->flow_coupling->converged);
    REQUIRE(angle->answer > radians(5));
    model.gravity.tilt = angle->answer;
    model.flow->boundaries[1].kind = FlowBoundary::Kind::outlet;  // such a low head would be refused now
    CHECK(factorOf(model) == doctest::Approx(1).epsilon(2e-3));
}

TEST_CASE("coupled flow: a block that falls at the start is removed and named, as by a search") {
    const Model sound = blockOnJoint(1e9, radians(10), 1);
    Model model = sound;
    // Beside the box, on nothing: it touches the box's +y face alone.
    const Block hangs = box("loose", {1, 1, 0.4}, {1.6, 1.6, 1}, 2700, Motion::free);
    model.blocks.insert(model.blocks.begin() + 1, hangs);
    const SteadyFlow with = coupledSolved(model), without = coupledSolved(sound);
    CHECK(with.fallen_at_start == std::vector<std::string>{"loose"});
    CHECK(without.fallen_at_start.empty());
    const std::string said =
        "1 block falls at the start whatever the strength (for example loose): the answer does not include "
        "them";
    CHECK(std::count(with.warnings.begin(), with.warnings.end(), said) == 1);
    CHECK(with.head == without.head);
    CHECK(with.aperture == without.aperture);
    CHECK(std::count(with.block_a.begin(), with.block_a.end(), 1) == 0);
    CHECK(std::count(with.block_b.begin(), with.block_b.end(), 1) == 0);
    const auto searched = safetyFactor(model);
    REQUIRE(searched.ok());
    CHECK(searched->fallen_at_start == with.fallen_at_start);
    const auto change = meshChange(model, with);
    REQUIRE(change.ok());
    CHECK(change->total == meshChange(sound, without)->total);
}

TEST_CASE("coupled flow: a small block that slides at the scenario's tilt is named") {
    Model model = blockOnJoint(1e9, radians(10), 1);
    model.joints.push_back(joint(5));
    addBox(model, "small", {1, 0.3, 1}, {0.4, 0.4, 0.3});
    model.blocks.back().face_joint.assign(6, 1);
    REQUIRE_FALSE(coupledFlow(model).ok());  // the slope is not stable under its own loads
    model.analysis.least_mass_share = 0.05;
    const SteadyFlow flow = coupledSolved(model);
    CHECK(flow.fallen_at_start.empty());
    CHECK(std::count_if(flow.warnings.begin(), flow.warnings.end(), [](const std::string& warning) {
              return warning.starts_with("1 block fails on the way to the equilibrium (for example small)");
          }) == 1);
}

TEST_CASE("coupled flow: without an equilibrium it is refused, and so is other water in its joint") {
    const auto refused = coupledFlow(blockOnJoint(1e9, radians(40), 1, 20));
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.errors().front().field == "flow.coupled");
    CHECK(refused.errors().front().message.starts_with("found no equilibrium while the "));
    Model model = blockOnJoint(1e9, 0, 1);
    Water water;
    water.kind = Water::Level::head;
    water.head = {1, 0};
    water.pair = {1, 0};
    water.field = "water[0]";
    model.waters.push_back(water);
    const auto beside = safetyFactor(model);
    REQUIRE_FALSE(beside.ok());
    CHECK(beside.errors().front().field == "water[0]");
}
