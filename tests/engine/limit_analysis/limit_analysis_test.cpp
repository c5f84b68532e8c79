// Limit analysis against closed forms: single bodies, columns, arches, brick walls, wedges, slopes with
// water.

#include "talus/limit_analysis.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cmath>

#include "support/models.h"
#include "talus/formats/scenario.h"

using namespace talus;
using namespace talus::test;

namespace {

LimitResult limitOf(const Model& model, Varied load) {
    const auto result = limitAnalysis(model, load);
    REQUIRE(result.ok());
    return *result;
}

/// Found, and both ends of the bracket within `tolerance` of a share of what is expected.
void checkLimit(const Model& model, Varied load, double expected, double tolerance = 1e-6) {
    const LimitResult result = limitOf(model, load);
    CHECK((result.status == SearchStatus::found));
    CHECK(result.lower <= result.upper);
    CHECK(result.lower == doctest::Approx(expected).epsilon(tolerance));
    CHECK(result.upper == doctest::Approx(expected).epsilon(tolerance));
    CHECK_FALSE(result.moving_blocks.empty());
}

constexpr double kFactorWidth = 1.5e-4;  // of the bracket of a factor, and half as much again

Model blockOnPlane(double friction_deg, const Vec3& size, double tilt_deg = 0) {
    Model model = floorModel(friction_deg);
    addBox(model, "block", {0, 0, 0}, size);
    model.gravity.tilt = radians(tilt_deg);
    model.analysis.stop = radians(80);
    return model;
}

double weightOf(const Vec3& size) { return 2700 * 9.81 * size.prod(); }

Model scenario(const std::string& name) {
    const auto read = formats::readScenario(TALUS_SOURCE_DIR "/bench/verification/" + name);
    REQUIRE(read.ok());
    return read->model;
}

void addHull(Model& model, const std::string& name, const std::vector<Vec3>& corners) {
    Block block;
    block.name = name;
    block.shape = *convexHull(corners);
    block.density = 2548.419979613;
    block.face_joint.assign(block.shape.faces.size(), 0);
    model.blocks.push_back(block);
}

/// A semicircular arch of voussoirs with straight faces, radius of the centre line 10 m, a slice 1 m thick.
Model arch(int voussoirs, double thickness, double friction_deg) {
    Model model;
    model.joints = {joint(friction_deg, 1e11)};
    model.blocks = {box("left", {-12, 0, -1}, {-8, 1, 0}, 2700, Motion::fixed),
                    box("right", {8, 0, -1}, {12, 1, 0}, 2700, Motion::fixed)};
    for (int k = 0; k < voussoirs; ++k) {
        std::vector<Vec3> corners;
        for (const int end : {k, k + 1})
            for (const double radius : {10 - thickness / 2, 10 + thickness / 2})
                for (const double y : {0.0, 1.0}) {
                    const double angle = M_PI * end / voussoirs;
                    corners.push_back({radius * std::cos(angle), y, radius * std::sin(angle)});
                }
        addHull(model, "v" + std::to_string(k + 1), corners);
    }
    return model;
}

/// Courses of bricks 0.4 x 0.175 on a fixed floor: odd ones whole bricks between two halves, even ones whole.
Model brickWall(int courses, int bricks, double tan_friction) {
    Model model = floorModel(degrees(std::atan(tan_friction)), 1e11);
    const auto lay = [&](int course, double from, double to) {
        addBox(model, "b" + std::to_string(model.blocks.size()), {from, 0, 0.175 * course},
               {to - from, 1, 0.175});
    };
    for (int course = 0; course < courses; ++course) {
        const bool halves = course % 2 == 0;
        if (halves) lay(course, 0, 0.2);
        for (int k = 0; k < bricks - halves; ++k)
            lay(course, 0.4 * k + 0.2 * halves, 0.4 * (k + 1) + 0.2 * halves);
        if (halves) lay(course, 0.4 * bricks - 0.2, 0.4 * bricks);
    }
    return model;
}

/// Normal of a plane's upper side from dip and dip direction [deg].
Vec3 upward(double dip, double direction) {
    const double d = radians(dip), a = radians(direction);
    return {std::sin(d) * std::sin(a), std::sin(d) * std::cos(a), std::cos(d)};
}

/// How freely a wedge on the planes 40/130 and 60/220 can move this way, if joints open by tan(phi) of their
/// slide: down, and out of both cones. Concave in the direction, so its maximum is found by looking ever
/// closer.
double freedom(const Vec3& v, double tan_friction) {
    double least = -v.z();
    for (const Vec3& n : {upward(40, 130), upward(60, 220)}) {
        const double opening = v.dot(n);
        least = std::min(least, opening - tan_friction * (v - opening * n).norm());
    }
    return least;
}

double greatestFreedom(double tan_friction) {
    double dip = 0, trend = 180, best = -1;
    for (double width = 90; width > 1e-7; width *= 0.5) {
        const double dip_0 = dip, trend_0 = trend;
        for (int i = -20; i <= 20; ++i)
            for (int j = -20; j <= 20; ++j) {
                const double d = radians(dip_0 + width * i / 20), a = radians(trend_0 + width * j / 20);
                const double here = freedom(
                    {std::cos(d) * std::sin(a), std::cos(d) * std::cos(a), -std::sin(d)}, tan_friction);
                if (here <= best) continue;
                best = here;
                dip = dip_0 + width * i / 20;
                trend = trend_0 + width * j / 20;
            }
    }
    return best;
}

/// The strength reduction at which the wedge first can move.
double wedgeFactor(double friction_deg) {
    double stands = 0.5, falls = 2;
    while (falls - stands > 1e-6) {
        const double factor = 0.5 * (stands + falls);
        (greatestFreedom(std::tan(radians(friction_deg)) / factor) > 0 ? falls : stands) = factor;
    }
    return falls;
}

}  // namespace

TEST_SUITE("limit analysis") {
    TEST_CASE("a block slides at its friction angle, and opens by it") {
        const Model model = blockOnPlane(27, {1, 1, 0.5});
        checkLimit(model, Varied::tilt, radians(27));
        const LimitResult result = limitOf(model, Varied::tilt);
        CHECK(result.plane_section);
        REQUIRE(result.mechanism.size() == 1);
        const Vec3 velocity = result.mechanism[0].velocity;
        CHECK(velocity.x() < 0);
        CHECK(velocity.z() / -velocity.x() == doctest::Approx(std::tan(radians(27))));
        CHECK(result.mechanism[0].spin.norm() < 1e-9);
        CHECK(result.moving_blocks == std::vector<std::string>{"block"});
    }

    TEST_CASE("a slender block overturns, whatever its friction") {
        checkLimit(blockOnPlane(40, {0.4, 1, 1}), Varied::tilt, std::atan(0.4));
        checkLimit(blockOnPlane(40, {0.4, 1, 1}), Varied::horizontal, 0.4);
        const LimitResult result = limitOf(blockOnPlane(40, {0.4, 1, 1}), Varied::tilt);
        REQUIRE(result.mechanism.size() == 1);
        CHECK(result.mechanism[0].spin.y() < 0);  // over its edge at the smaller x
    }

    TEST_CASE("factor of safety of a block on a plane, with friction and with cohesion") {
        const Vec3 size(1, 1, 0.3);
        for (const double weak : {0.02, 0.3, 1.0, 3.0, 10.0}) {
            CAPTURE(weak);
            const LimitResult result = limitOf(blockOnPlane(weak, size, 20), Varied::factor);
            REQUIRE((result.status == SearchStatus::found));
            const double expected = std::tan(radians(weak)) / std::tan(radians(20));
            CHECK(result.lower / expected == doctest::Approx(1).epsilon(kFactorWidth));
            CHECK(result.upper / expected == doctest::Approx(1).epsilon(kFactorWidth));
        }
        CHECK((limitOf(blockOnPlane(0, size, 20), Varied::factor).status == SearchStatus::unstable_at_start));
        Model model = blockOnPlane(30, size, 20);
        const double friction = std::tan(radians(30)) / std::tan(radians(20));
        checkLimit(model, Varied::factor, friction, kFactorWidth);
        model.joints[0].cohesion = 3000;
        const double held = 3000 / (weightOf(size) * std::sin(radians(20)));
        checkLimit(model, Varied::factor, friction + held, kFactorWidth);
    }

    TEST_CASE("a horizontal load is normal to gravity") {
        const Vec3 size(1, 1, 0.2);
        checkLimit(blockOnPlane(30, size, 10), Varied::horizontal, std::tan(radians(20)));
    }

    TEST_CASE("tension holds a block from overturning, its points adding up to the patch's modulus") {
        const Vec3 size(0.4, 1, 1);
        Model model = blockOnPlane(60, size);
        model.joints[0].cohesion = 1e6;
        model.joints[0].tensile_strength = 5000;
        // Moment about the edge: k W h / 2 = W b / 2 + sigma_t b d b / 2.
        checkLimit(model, Varied::horizontal, 0.4 * (1 + 5000 * 0.4 / weightOf(size)));
    }

    TEST_CASE("a joint that gets stronger as it slips has the strength it may get to") {
        Model model = blockOnPlane(25, {1, 1, 0.2}, 30);
        model.joints[0].residual_friction = radians(35);
        checkLimit(model, Varied::factor, std::tan(radians(35)) / std::tan(radians(30)), kFactorWidth);
        model = blockOnPlane(25, {1, 1, 0.2});
        model.joints[0].residual_cohesion = 500;
        const double weight = weightOf({1, 1, 0.2});
        const auto excess = [&](double tilt) {
            return weight * (std::sin(tilt) - std::cos(tilt) * std::tan(radians(25))) - 500;
        };
        const LimitResult tilt = limitOf(model, Varied::tilt);
        CHECK(std::abs(excess(tilt.upper)) < 1e-3 * weight);
    }

    TEST_CASE("the tilt with cohesion is iterated for") {
        const Vec3 size(1, 1, 0.3);
        Model model = blockOnPlane(20, size);
        model.joints[0].cohesion = 1000;
        // sin(b) = cos(b) tan(phi) + C A / W, so sin(b - phi) = C A cos(phi) / W.
        const double phi = radians(20);
        checkLimit(model, Varied::tilt, phi + std::asin(1000 * std::cos(phi) / weightOf(size)));
    }

    TEST_CASE("a column of many blocks overturns as one") {
        for (const int rows : {10, 20, 40})
            checkLimit(stackModel(1, rows, 1, 35), Varied::tilt, std::atan(0.2 / (0.1 * rows)));
    }

    TEST_CASE("columns that lean on each other: an upper bound, not the answer") {
        const LimitResult result = limitOf(stackModel(3, 20, 1, 35), Varied::tilt);
        CHECK((result.status == SearchStatus::found));
        CHECK(result.lower > 1.2 * std::atan(0.2 / 2.0));
    }

    TEST_CASE(
        "slices side by side are one section; without their symmetry the same limit is found in space") {
        const LimitResult section = limitOf(stackModel(3, 4, 3, 19.5), Varied::tilt);
        CHECK(section.plane_section);
        CHECK(section.blocks == 36);
        CHECK(section.mechanism.size() == 36);
        CHECK(section.contact_points == 2 * (3 * 4 + 2 * 4));
        CHECK(degrees(section.upper) == doctest::Approx(19.5).epsilon(1e-6));
        CHECK(section.moving_blocks.size() >= 12);

        // A heavier block on top of one slice.
        Model model = stackModel(2, 3, 2, 19.5);
        model.blocks.back().density *= 2;
        const LimitResult space = limitOf(model, Varied::tilt);
        CHECK_FALSE(space.plane_section);
        CHECK(degrees(space.lower) == doctest::Approx(19.5).epsilon(1e-5));
        CHECK(degrees(space.upper) == doctest::Approx(19.5).epsilon(1e-4));
    }

    TEST_CASE("slices that water drives apart are not a section, and fall at the start") {
        Model model = stackModel(1, 1, 2, 19.5);
        model.waters = {waterOn(model, 1, Vec3::UnitY(), 0.1), waterOn(model, 2, -Vec3::UnitY(), 0.1)};
        for (Joint& joint : model.joints) joint.friction = joint.residual_friction = 0.001;
        const LimitResult result = limitOf(model, Varied::tilt);
        CHECK_FALSE(result.plane_section);
        CHECK((result.status == SearchStatus::unstable_at_start));
    }

    TEST_CASE("friction in a direction that no first pyramid has: its cone is found from both sides") {
        // On a plane turned about x the tilt about y slides the block along neither tangent.
        Model model = blockOnPlane(25, {1, 1, 0.3});
        for (Block& block : model.blocks)
            for (Vec3& v : block.shape.vertices) v = turnAbout(Vec3::UnitX(), 15) * v;
        CHECK_FALSE(limitOf(model, Varied::tilt).plane_section);
        checkLimit(model, Varied::tilt, std::acos(std::cos(radians(25)) / std::cos(radians(15))), 1e-4);
        checkLimit(model, Varied::factor, std::tan(radians(25)) / std::tan(radians(15)), 3e-4);
    }

    TEST_CASE("a wedge on two planes: no direction in which it could open both while it falls") {
        const Model model = scenario("wedge-phi-35.toml");
        const LimitResult result = limitOf(model, Varied::factor);
        REQUIRE((result.status == SearchStatus::found));
        MESSAGE("wedge: " << result.lower << " to " << result.upper);
        const double expected = wedgeFactor(35);
        CHECK(result.lower == doctest::Approx(expected).epsilon(3e-4));
        CHECK(result.upper == doctest::Approx(expected).epsilon(3e-4));
        CHECK(result.upper >= 1.064);  // limit equilibrium, without shear across the line of intersection
        CHECK(result.moving_blocks == std::vector<std::string>{"wedge"});
    }

    TEST_CASE("a fissure full of water pushes a block off") {
        // tan(b) = tan(phi) - rho_w w^2 / (2 rho b h)
        Model model = blockOnPlane(40, {1, 1, 1});
        model.waters = {waterOn(model, 1, Vec3::UnitX(), 1.0)};
        const double sliding = std::atan(std::tan(radians(40)) - 1000.0 / (2 * 2700));
        checkLimit(model, Varied::tilt, sliding, 1e-6);
    }

    TEST_CASE("a side load has one limit, large or small, wherever the tilt begins") {
        // As above; where it overturns first: tan(b) = b/h - rho_w w^3 / (3 rho b h^2)
        for (const double width : {0.4, 1.0})
            for (const double depth : {0.02, 0.1, 0.5, 1.0})
                for (const double start : {-10.0, -4.0, -1.0, -0.1, 0.0, 5.0}) {
                    Model model = blockOnPlane(33, {width, 1, 1});
                    model.waters = {waterOn(model, 1, Vec3::UnitX(), depth)};
                    model.analysis.start = radians(start);
                    const double slides = std::tan(radians(33)) - 1000 * depth * depth / (2 * 2700 * width);
                    const double overturns = width - 1000 * std::pow(depth, 3) / (3 * 2700 * width);
                    CAPTURE(width);
                    CAPTURE(depth);
                    CAPTURE(start);
                    checkLimit(model, Varied::tilt, std::atan(std::min(slides, overturns)), 1e-6);
                }
    }

    TEST_CASE("an arch of 27 voussoirs, by its thickness over its radius") {
        const double expected[][2] = {{0.11, 0.70}, {0.12, 2.77}, {0.15, 8.27}};
        for (const auto& [thickness, angle] : expected) {
            const LimitResult result = limitOf(arch(27, 10 * thickness, 35), Varied::tilt);
            MESSAGE("thickness " << thickness << ": " << degrees(result.lower) << " deg, expected " << angle);
            CHECK((result.status == SearchStatus::found));
            CHECK(std::abs(degrees(result.upper) - angle) < 0.006);
            CHECK(std::abs(degrees(result.lower) - angle) < 0.006);
        }
        CHECK((limitOf(arch(27, 1.067 * 1.002, 35), Varied::tilt).status == SearchStatus::found));
        CHECK((limitOf(arch(27, 1.067 * 0.998, 35), Varied::tilt).status == SearchStatus::unstable_at_start));
    }

    TEST_CASE("brick walls under a horizontal load (M. C. Ferris and F. Tin-Loi, 2001)") {
        CHECK(limitOf(brickWall(6, 5, 0.65), Varied::horizontal).upper ==
              doctest::Approx(0.6429).epsilon(1e-4));
        CHECK(limitOf(brickWall(10, 5, 0.65), Varied::horizontal).upper ==
              doctest::Approx(0.5800).epsilon(1e-4));
    }

    TEST_CASE("plane failure with a tension crack (Hoek and Bray)") {
        const double expected[] = {1.544, 1.464, 1.363, 1.247, 1.119};
        for (int depth = 0; depth <= 4; ++depth) {
            const std::string name = "hoek-bray-crack-" + std::to_string(depth) + "m.toml";
            CHECK(limitOf(scenario(name), Varied::factor).upper ==
                  doctest::Approx(expected[depth]).epsilon(1e-3));
        }
    }

    TEST_CASE("what ends without a limit says so") {
        Model steep = blockOnPlane(30, {1, 1, 0.3}, 35);
        const LimitResult falls = limitOf(steep, Varied::tilt);
        CHECK((falls.status == SearchStatus::unstable_at_start));
        CHECK(falls.lower == -kInfinity);
        CHECK(falls.upper == doctest::Approx(radians(35)));
        CHECK(falls.moving_blocks == std::vector<std::string>{"block"});
        CHECK((limitOf(steep, Varied::horizontal).status == SearchStatus::unstable_at_start));

        Model flat = blockOnPlane(30, {1, 1, 0.3});
        const LimitResult stands = limitOf(flat, Varied::factor);
        CHECK((stands.status == SearchStatus::stable_to_stop));
        CHECK(stands.upper == kInfinity);
        flat.analysis.stop = radians(29);
        CHECK((limitOf(flat, Varied::tilt).status == SearchStatus::stable_to_stop));
    }

    TEST_CASE("too many contact points are refused") {
        const Model model = stackModel(2, 3, 1, 30);
        const std::size_t points = limitOf(model, Varied::tilt).contact_points;
        CHECK(points == 2 * (2 * 3 + 3));  // two in the section of each interface
        const auto refused = limitAnalysis(model, Varied::tilt, {}, {.max_contact_points = points - 1});
        REQUIRE_FALSE(refused.ok());
        CHECK(refused.errors()[0].message.find("18 contact points") != std::string::npos);
    }

    TEST_CASE("blocks that are left out neither fall nor hold") {
        Model model = blockOnPlane(27, {1, 1, 0.5});
        addBox(model, "loose", {3, 0, 0}, {0.1, 1, 2});
        CHECK(limitOf(model, Varied::tilt).upper == doctest::Approx(std::atan(0.05)));
        const auto result = limitAnalysis(model, Varied::tilt, {}, {.left_out = {"loose"}});
        REQUIRE(result.ok());
        CHECK(result->upper == doctest::Approx(radians(27)));
        CHECK(result->blocks == 1);
        CHECK(result->mechanism.size() == 1);
    }

    TEST_CASE("the upper bound: the upper end, or why there is none") {
        const Model model = blockOnPlane(27, {1, 1, 0.5}, 20);
        const auto factor = limitCeiling(model, Varied::factor, false);
        REQUIRE(factor.ok());
        REQUIRE(factor->value.has_value());
        const double limit = std::tan(radians(27)) / std::tan(radians(20));
        CHECK(*factor->value == doctest::Approx(limit).epsilon(kFactorWidth));
        CHECK_FALSE(isAbove(1.004 * limit, *factor, Varied::factor));
        CHECK(isAbove(1.006 * limit, *factor, Varied::factor));

        Model large = stackModel(6, 10, 2, 19.5);
        large.blocks.back().density *= 2;  // not a section
        const auto none = limitCeiling(large, Varied::tilt, false);
        REQUIRE(none.ok());
        CHECK_FALSE(none->value.has_value());
        CHECK(none->reason.find("contact points") != std::string::npos);
        CHECK_FALSE(isAbove(10, *none, Varied::tilt));

        const auto level = limitCeiling(blockOnPlane(27, {1, 1, 0.5}), Varied::factor, false);
        REQUIRE(level.ok());
        CHECK_FALSE(level->value.has_value());
        CHECK(level->reason.find("stable up to the largest load tried") != std::string::npos);
    }

    TEST_CASE("limit analysis can be interrupted") {
        const std::atomic<bool> stop{true};
        const auto result = limitAnalysis(stackModel(3, 10, 1, 30), Varied::tilt, {.stop = &stop});
        REQUIRE(result.ok());
        CHECK((result->status == SearchStatus::interrupted));
    }

    TEST_CASE("an interrupted limit analysis keeps its bounds so far") {
        for (const Varied load : {Varied::tilt, Varied::factor, Varied::horizontal}) {
            const Model model = stackModel(3, 10, 1, 30);
            const auto whole = limitAnalysis(model, load);
            REQUIRE(whole.ok());
            for (int reports = 1; reports < 40; ++reports) {
                std::atomic<bool> stop{false};
                int seen = 0;
                Control control{.stop = &stop};
                control.progress = [&](const Progress& progress) {
                    if (progress.stage == "limit analysis" && ++seen == reports) stop = true;
                };
                const auto part = limitAnalysis(model, load, control);
                REQUIRE(part.ok());
                if ((part->status != SearchStatus::interrupted)) break;
                CHECK(part->lower <= whole->upper * (1 + 1e-6));
                CHECK(part->upper >= whole->lower * (1 - 1e-6));
                const bool knows = std::isfinite(part->lower) || std::isfinite(part->upper);
                CHECK((knows || (load == Varied::factor && reports == 1)));
            }
        }
    }
}
