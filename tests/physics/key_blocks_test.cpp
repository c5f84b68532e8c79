// Block theory on models: closed forms, and invariance under rotation, scale and order.

#include "talus/block_theory.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/key_blocks.h"
#include "support/models.h"
#include "support/rock_slopes.h"
#include "verification/rows.h"

using namespace talus;
using namespace talus::test;

namespace {

using Names = std::vector<std::string>;

const KeyBlock& blockNamed(const KeyBlockResult& result, const std::string& name) {
    const auto at = std::find_if(result.blocks.begin(), result.blocks.end(),
                                 [&](const KeyBlock& block) { return block.name == name; });
    REQUIRE(at != result.blocks.end());
    return *at;
}

formats::Scenario parsed(const std::string& text) {
    auto scenario = formats::parseScenario(text, TALUS_SOURCE_DIR "/bench/verification/row.toml");
    for (const Error& error : scenario.errors()) FAIL_CHECK(formats::format(error));
    REQUIRE(scenario.ok());
    return std::move(*scenario);
}

/// A box of 2 x 1 x 1 m on the floor, under a gravity that is tilted.
Model boxOnFloor(double friction_deg, double tilt_deg) {
    Model model = floorModel(friction_deg);
    model.gravity.tilt = radians(tilt_deg);
    addBox(model, "box", {0, 0, 0}, {2, 1, 1});
    return model;
}
constexpr double kBoxWeight = 2 * 2700 * 9.81;

/// Slices between two fixed ones, on a bed that dips towards -x; some blocks in each, one behind the other.
Model confinedSlices(double dip_deg, double bed_deg, double sides_deg, int slices, int blocks) {
    Model model;
    model.joints = {joint(sides_deg, 2e10), joint(bed_deg, 2e10)};
    model.joints[1].name = "bedding";
    const double width = 9, length = 12.0 / blocks;
    model.blocks = {box("bed", {-20, -5, -5}, {40, slices * width + 5, 0}, 2650, Motion::fixed),
                    box("near", {-5, -5, 0}, {17, 0, 4}, 2650, Motion::fixed),
                    box("far", {-5, slices * width, 0}, {17, slices * width + 5, 4}, 2650, Motion::fixed)};
    for (int s = 0; s < slices; ++s)
        for (int k = 0; k < blocks; ++k) {
            model.pair_joints.push_back({0, static_cast<std::int32_t>(model.blocks.size()), 1});
            addBox(model, "s" + std::to_string(s + 1) + "k" + std::to_string(k + 1),
                   {k * length, s * width, 0}, {length, width, 4}, 2650);
        }
    const Eigen::Quaterniond dip = turnAbout(-Vec3::UnitY(), dip_deg);
    for (Block& block : model.blocks)
        for (Vec3& v : block.shape.vertices) v = dip * v;
    return model;
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("key blocks: planes, wedges, water, earthquakes and an anchor of the verification manual") {
        int rows = 0;
        for (const tools::VerificationRow& row : tools::verificationRows()) {
            const bool is_plane_or_wedge =
                row.section == "Wedges and plane failure" || row.section == "Laws of strength" ||
                (row.section == "Earthquakes" && row.quantity == "safety_factor") ||
                row.scenario.find("hoek-bray-crack-2m-anchored") != std::string::npos ||
                row.scenario.find("verification/plane-phi") != std::string::npos;
            if (!is_plane_or_wedge || row.quantity != "safety_factor") continue;
            CAPTURE(row.name);
            const KeyBlockResult result = found(parsed(tools::scenarioText(row)).model);
            REQUIRE(!result.groups.empty());
            CHECK(result.groups.front().sliding.factor == doctest::Approx(row.reference).epsilon(1e-3));
            const bool is_wedge = row.scenario.find("wedge") != std::string::npos;
            CHECK((result.groups.front().sliding.mode ==
                   (is_wedge ? SlidingMode::wedge : SlidingMode::slides)));
            ++rows;
        }
        CHECK(rows >= 20);
    }

    TEST_CASE("key blocks: slices between fixed slices slide at tan(phi) over tan(dip) of their bed") {
        for (const double dip : {30.0, 38.0, 45.0})
            for (const int blocks : {1, 3}) {
                CAPTURE(dip);
                CAPTURE(blocks);
                const KeyBlockResult result = found(confinedSlices(dip, 34, 38, 3, blocks));
                const double factor = std::tan(radians(34)) / std::tan(radians(dip));
                REQUIRE(!result.groups.empty());
                for (const MovingGroup& group : result.groups) {
                    CHECK(group.sliding.factor == doctest::Approx(factor).epsilon(1e-9));
                    CHECK(group.sliding.joints == Names{"bedding"});
                }
                // All three together first; then what lies before another block, without the one behind it.
                CHECK(result.groups.front().blocks.size() == static_cast<std::size_t>(3 * blocks));
                if (blocks == 1) continue;
                CHECK((blockNamed(result, "s2k1").sliding.mode == SlidingMode::slides));
                CHECK((blockNamed(result, "s2k2").sliding.mode == SlidingMode::none));
            }
        const auto least = leastGroup(confinedSlices(38, 34, 38, 3, 1));
        REQUIRE((least.ok() && least->has_value()));
        CHECK((*least)->value == doctest::Approx(0.8633).epsilon(1e-4));
        CHECK((*least)->kind == std::string("sliding on one plane"));
        CHECK((*least)->blocks == Names{"s1k1", "s2k1", "s3k1"});
    }

    TEST_CASE("key blocks: a block under a roof falls, and takes along what hangs below it") {
        Model model;
        model.joints = {joint(40)};
        model.blocks = {box("roof", {-5, -5, 2}, {5, 5, 3}, 2700, Motion::fixed)};
        addBox(model, "upper", {0, 0, 1}, {1, 1, 1});
        addBox(model, "lower", {0, 0, 0}, {1, 1, 1});
        const KeyBlockResult result = found(model);
        CHECK((blockNamed(result, "lower").sliding.mode == SlidingMode::falls));
        CHECK(blockNamed(result, "lower").sliding.factor == 0);
        // The one above it stands on it, as long as it is held still, and can be drawn out.
        CHECK((blockNamed(result, "upper").sliding.mode == SlidingMode::none));
        CHECK(blockNamed(result, "upper").removable);
        CHECK(std::abs(blockNamed(result, "upper").free_direction.z()) < 1e-9);
        CHECK(result.groups.front().blocks == Names{"lower", "upper"});
        CHECK(result.groups.front().sliding.factor == 0);
        CHECK((result.groups.front().sliding.direction + Vec3::UnitZ()).norm() < 1e-9);
        CHECK((*leastGroup(model))->kind == std::string("falling"));
    }

    TEST_CASE("key blocks: uplift takes from the normal force, water behind drives") {
        const double tilt = radians(20), tan_phi = std::tan(radians(30)), unit = 9810;
        Model lifted = boxOnFloor(30, 20);
        Water uplift;
        uplift.kind = Water::Level::head;
        uplift.head = {1.5, 0.5};
        uplift.pair = {1, 0};
        uplift.field = "water[0]";
        lifted.waters = {uplift};
        const double lift = unit * std::cos(tilt) * 1.0 * 2;  // mean head 1 m on 2 m2
        CHECK(
            found(lifted).groups.front().sliding.factor ==
            doctest::Approx((kBoxWeight * std::cos(tilt) - lift) * tan_phi / (kBoxWeight * std::sin(tilt))));
        Model pushed = boxOnFloor(30, 20);
        pushed.waters = {waterOn(pushed, 1, Vec3::UnitX(), 0.8)};
        const double thrust = 0.5 * unit * std::cos(tilt) * 0.8 * 0.8;
        CHECK(
            found(pushed).groups.front().sliding.factor ==
            doctest::Approx(kBoxWeight * std::cos(tilt) * tan_phi / (kBoxWeight * std::sin(tilt) + thrust)));
        // On level ground the water alone drives.
        pushed.gravity.tilt = 0;
        CHECK(found(pushed).groups.front().sliding.factor ==
              doctest::Approx(kBoxWeight * tan_phi / (0.5 * unit * 0.64)));
        // More water than weight: it floats.
        lifted.waters[0].head = {12, 12};
        CHECK((found(lifted).groups.front().sliding.mode == SlidingMode::falls));
        CHECK(found(lifted).groups.front().sliding.direction.z() > 0);
    }

    TEST_CASE("key blocks: a bolt counts with its pretension, and what it could do beyond is warned of") {
        const double tilt = radians(35), tan_phi = std::tan(radians(30)), pull = 2e4;
        Model model = boxOnFloor(30, 35);
        Bolt bolt;
        bolt.name = "A";
        bolt.head = {1, 0.5, 0.75};
        bolt.end = {2, 0.5, -0.25};  // 45 degrees into the floor, uphill
        bolt.area = 1e-3;
        bolt.modulus = 2e11;
        bolt.yield_force = pull;
        bolt.pretension = pull;
        bolt.field = "bolt[0]";
        model.bolts = {bolt};
        const double part = pull / std::sqrt(2.0);
        const KeyBlockResult held = found(model);
        CHECK(held.groups.front().sliding.factor ==
              doctest::Approx((kBoxWeight * std::cos(tilt) + part) * tan_phi /
                              (kBoxWeight * std::sin(tilt) - part))
                  .epsilon(1e-6));
        CHECK(held.warnings.empty());
        model.bolts[0].pretension = 0;
        const KeyBlockResult slack = found(model);
        CHECK(slack.groups.front().sliding.factor == doctest::Approx(tan_phi / std::tan(tilt)));
        REQUIRE(slack.warnings.size() == 1);
        CHECK(slack.warnings[0].find("\"A\"") != std::string::npos);
    }

    TEST_CASE("key blocks: a load, and an earthquake") {
        const double tan_phi = std::tan(radians(30));
        Model model = boxOnFloor(30, 0);
        CHECK(found(model).groups.empty());
        CHECK(!leastGroup(model)->has_value());
        CHECK(blockNamed(found(model), "box").removable);
        CHECK(blockNamed(found(model), "box").free_direction.z() == doctest::Approx(1));
        model.seismic.horizontal = 0.2;
        CHECK(found(model).groups.front().sliding.factor == doctest::Approx(tan_phi / 0.2));
        CHECK(found(model).groups.front().sliding.direction.x() == doctest::Approx(-1));
        AppliedLoad load;
        load.block = 1;
        load.force = {0, 5000, -3000};
        load.field = "load[0]";
        model.loads = {load};
        CHECK(found(model).groups.front().sliding.factor ==
              doctest::Approx((kBoxWeight + 3000) * tan_phi / std::hypot(0.2 * kBoxWeight, 5000)));
    }

    TEST_CASE("key blocks: in a stack with cohesion all blocks above a weak bed fail together") {
        Model model = stackModel(1, 5, 1, 30, {1, 1, 1});
        model.gravity.tilt = radians(25);
        Joint weak = joint(15);
        weak.name = "weak";
        weak.cohesion = weak.residual_cohesion = 4000;
        model.joints.push_back(weak);
        model.pair_joints = {{2, 3, 1}};  // between the second and the third row
        const double weight = 2700 * 9.81, c = std::cos(radians(25)), s = std::sin(radians(25));
        const MovingGroup least = found(model).groups.front();
        CHECK(least.blocks == Names{"c1r3s1", "c1r4s1", "c1r5s1"});
        CHECK(least.sliding.factor ==
              doctest::Approx((3 * weight * c * std::tan(radians(15)) + 4000) / (3 * weight * s)));
        CHECK(least.sliding.joints == Names{"weak"});
        CHECK(least.volume == doctest::Approx(3));
        CHECK(least.mass == doctest::Approx(8100));
        // By itself the third block has the whole cohesion for itself, and slides out between its neighbours.
        CHECK(blockNamed(found(model), "c1r3s1").sliding.factor ==
              doctest::Approx((weight * c * std::tan(radians(15)) + 4000) / (weight * s)));
    }

    TEST_CASE("key blocks: a row does not slide from under others as if they had no weight") {
        // Water behind two columns of four rows: its thrust is on the lowest row alone, the weight of all
        // holds.
        Model model = stackModel(3, 4, 1, 25, {1, 1, 1});
        model.gravity.tilt = radians(10);
        model.waters = {fissureAt(model, 2, 1.0)};
        const double weight = 2700 * 9.81, thrust = 0.5 * 9810 * std::cos(radians(10));
        const auto factor = [&](double blocks) {
            return blocks * weight * std::cos(radians(10)) * std::tan(radians(25)) /
                   (blocks * weight * std::sin(radians(10)) + thrust);
        };
        const KeyBlockResult result = found(model);
        CHECK((blockNamed(result, "c1r1s1").sliding.mode == SlidingMode::slides));
        REQUIRE(!result.groups.empty());
        CHECK(result.groups.front().blocks.size() == 8);
        CHECK(result.groups.front().sliding.factor == doctest::Approx(factor(8)).epsilon(1e-6));
        for (const MovingGroup& group : result.groups)
            if (group.carries.empty()) CHECK(group.sliding.factor > factor(8) * (1 - 1e-6));
    }

    TEST_CASE("key blocks: carried blocks that cannot move along are named") {
        // A block on an incline carries one that a fixed wall holds back.
        Model model = floorModel(30);
        model.gravity.tilt = radians(20);
        addBox(model, "low", {0, 0, 0}, {2, 1, 1});
        addBox(model, "high", {0, 0, 1}, {2, 1, 1});
        model.blocks.push_back(box("wall", {-1, -1, 1}, {0, 2, 3}, 2700, Motion::fixed));
        const KeyBlockResult result = found(model);
        REQUIRE(!result.groups.empty());
        CHECK(result.groups.front().blocks == Names{"low"});
        CHECK(result.groups.front().carries == Names{"high"});
        CHECK(!leastGroup(model)->has_value());
    }

    TEST_CASE("key blocks: two halves of a wedge are weaker together than each against the other") {
        // The wedge of 40/130 and 60/220, cut along its line of intersection by an upright plane.
        const Vec3 a(std::sin(radians(40)) * std::sin(radians(130)),
                     std::sin(radians(40)) * std::cos(radians(130)), std::cos(radians(40)));
        const Vec3 b(std::sin(radians(60)) * std::sin(radians(220)),
                     std::sin(radians(60)) * std::cos(radians(220)), std::cos(radians(60)));
        const Vec3 line = a.cross(b);
        const double strike = degrees(std::atan2(line.x(), line.y()));
        auto rows = tools::verificationRows();
        const auto row = std::find_if(rows.begin(), rows.end(), [](const auto& each) {
            return each.scenario == "verification/wedge-phi-35" && each.quantity == "safety_factor";
        });
        REQUIRE(row != rows.end());
        const std::string text = tools::scenarioText(*row) +
                                 "\n[[single_joint]]\nname = \"cut\"\npoint = [5.0, 0.0, 3.0]\ndip_deg = 90\n"
                                 "dip_direction_deg = " +
                                 std::to_string(std::fmod(strike + 90 + 360, 360)) + "\n";
        const KeyBlockResult result = found(parsed(text).model);
        CHECK(result.groups.front().blocks.size() == 2);
        CHECK(result.groups.front().sliding.factor == doctest::Approx(row->reference).epsilon(1e-3));
        for (const KeyBlock& block : result.blocks) CHECK(block.sliding.factor > 1.05 * row->reference);
    }
}

namespace {

/// A slope whose joints dip out of it, towards -x and towards -y.
RockSlope jointedSlope() {
    return {.height = 10,
            .crest = 5,
            .back = 14,
            .width = 8,
            .normal_stiffness = 1e10,
            .shear_stiffness = 1e9,
            .friction_deg = 33,
            .sets = {{38, 265, 2.3}, {68, 95, 3.1}, {80, 5, 2.9}}};
}

/// Factors and blocks of the groups; of equal factors (to 1e-7) any order.
std::vector<std::pair<double, Names>> listOf(const KeyBlockResult& result) {
    std::vector<std::pair<double, Names>> list;
    for (const MovingGroup& group : result.groups) {
        list.emplace_back(std::round(group.sliding.factor * 1e7) / 1e7, group.blocks);
        std::sort(list.back().second.begin(), list.back().second.end());
    }
    std::sort(list.begin(), list.end());
    return list;
}

void checkSame(const KeyBlockResult& one, const KeyBlockResult& other) {
    CHECK(listOf(one).size() > 3);
    CHECK(listOf(one) == listOf(other));
    REQUIRE(one.blocks.size() == other.blocks.size());
    for (const KeyBlock& block : one.blocks) {
        const KeyBlock& twin = blockNamed(other, block.name);
        CAPTURE(block.name);
        CHECK(block.removable == twin.removable);
        CHECK((block.sliding.mode == twin.sliding.mode));
        CHECK(block.sliding.joints == twin.sliding.joints);
        if (std::isfinite(block.sliding.factor))
            CHECK(block.sliding.factor == doctest::Approx(twin.sliding.factor).epsilon(1e-7));
    }
}

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("key blocks: a turn about the vertical, a scale, an order or threads change nothing") {
        const Model model = scenarioOf(jointedSlope()).model;
        constexpr std::size_t kAll = 100'000;  // groups
        const KeyBlockResult as_it_is = found(model, kAll);
        CHECK(as_it_is.blocks.size() > 20);
        CHECK(as_it_is.groups.front().sliding.factor < 1);

        Model turned = model, scaled = model, shuffled = model;
        const Eigen::Quaterniond turn = turnAbout(Vec3::UnitZ(), 77);
        for (Block& block : turned.blocks)
            for (Vec3& v : block.shape.vertices) v = turn * v;
        for (Block& block : scaled.blocks)
            for (Vec3& v : block.shape.vertices) v *= 3;
        std::vector<std::size_t> order(model.blocks.size());
        for (std::size_t b = 0; b < order.size(); ++b) order[b] = b;
        std::shuffle(order.begin(), order.end(), std::mt19937(7));
        for (std::size_t b = 0; b < order.size(); ++b) shuffled.blocks[b] = model.blocks[order[b]];
        REQUIRE(model.pair_joints.empty());

        checkSame(as_it_is, found(turned, kAll));
        checkSame(as_it_is, found(scaled, kAll));
        checkSame(as_it_is, found(shuffled, kAll));
        const Vec3& s = as_it_is.groups.front().sliding.direction;
        CHECK((found(turned).groups.front().sliding.direction - turn * s).norm() < 1e-6);

        const auto parallel = keyBlocks(model, {.threads = 2}, {.most_groups = kAll});
        REQUIRE(parallel.ok());
        REQUIRE(parallel->groups.size() == as_it_is.groups.size());
        for (std::size_t k = 0; k < as_it_is.groups.size(); ++k) {
            CHECK(parallel->groups[k].blocks == as_it_is.groups[k].blocks);
            CHECK(parallel->groups[k].sliding.factor == as_it_is.groups[k].sliding.factor);
        }
    }

    TEST_CASE("key blocks: groups are ascending, different, and as many as are wanted") {
        const Model model = scenarioOf(jointedSlope()).model;
        const KeyBlockResult all = found(model, 1000), few = found(model, 3);
        REQUIRE(few.groups.size() == 3);
        for (std::size_t k = 0; k < 3; ++k) CHECK(few.groups[k].blocks == all.groups[k].blocks);
        std::vector<Names> names;
        for (std::size_t k = 0; k < all.groups.size(); ++k) {
            if (k > 0) CHECK(all.groups[k].sliding.factor >= all.groups[k - 1].sliding.factor - 1e-9);
            names.push_back(all.groups[k].blocks);
        }
        std::sort(names.begin(), names.end());
        CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
    }

    TEST_CASE("key blocks: a model without fixed blocks is refused, and an interruption ends early") {
        Model loose;
        loose.joints = {joint(30)};
        addBox(loose, "a", {0, 0, 0}, {1, 1, 1});
        loose.blocks[0].field = "block[0]";
        CHECK(!keyBlocks(loose).ok());
        const std::atomic<bool> stop{true};
        const auto stopped = keyBlocks(boxOnFloor(30, 20), {.stop = &stop});
        REQUIRE(stopped.ok());
        CHECK(stopped->interrupted);
        CHECK(!leastGroup(boxOnFloor(30, 20), {.stop = &stop}).ok());
    }
}
