// Masonry and columns as they may be drawn, not as they were chosen: every one is decided, and limit analysis
// agrees. Arches hinge, so their tilt is limit analysis's but for what joints of 1e12 Pa/m give; walls and
// columns lean on each other with joints that do not open as they slide, so theirs lies below it.

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "support/models.h"
#include "talus/analysis.h"
#include "talus/limit_analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

constexpr double kStiffness = 1e11, kDepth = 0.4;
constexpr unsigned kDraws = 12;

struct Draw {
    std::mt19937_64 random;

    explicit Draw(unsigned seed) : random(seed) {}
    double between(double low, double high) {
        return low + (high - low) * std::uniform_real_distribution<double>(0, 1)(random);
    }
    int one(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); }
};

Model onFloor(double friction_deg) {
    Model model = floorModel(friction_deg, kStiffness);
    model.analysis.start = 0;
    model.analysis.stop = radians(45);
    return model;
}

/// Rows of blocks of any length, each row set back at its ends.
Model wall(Draw draw) {
    Model model = onFloor(draw.between(25, 50));
    const double length = draw.between(1, 3);
    double z = 0;
    for (int row = draw.one(2, 6), k = 0; k < row; ++k) {
        const double height = draw.between(0.2, 0.5), end = length - (k > 0 ? draw.between(0, 0.3) : 0);
        double x = k > 0 ? draw.between(0, 0.3) : 0;
        while (x < end) {
            const double rest = end - x, wanted = draw.between(0.25, 1.2);
            const double width = rest - wanted < 0.25 ? rest : wanted;
            addBox(model, "b" + std::to_string(model.blocks.size()), {x, 0, z}, {width, kDepth, height});
            x += width;
        }
        z += height;
    }
    return model;
}

/// Columns side by side, of blocks or of one piece.
Model columns(Draw draw) {
    Model model = onFloor(draw.between(20, 50));
    double x = 0;
    for (int column = draw.one(1, 5); column > 0; --column) {
        const double width = draw.between(0.15, 0.5), height = draw.between(0.4, 1.6);
        const int pieces = draw.one(1, 4);
        for (int k = 0; k < pieces; ++k)
            addBox(model, "b" + std::to_string(model.blocks.size()), {x, 0, height * k / pieces},
                   {width, kDepth, height / pieces});
        x += width;
    }
    return model;
}

void addVoussoir(Model& model, const std::vector<Eigen::Vector2d>& section, Motion motion) {
    std::vector<Vec3> corners;
    for (const double y : {0.0, kDepth})
        for (const Eigen::Vector2d& c : section) corners.emplace_back(c.x(), y, c.y());
    Block block = box("b" + std::to_string(model.blocks.size()), {0, 0, 0}, {1, 1, 1}, 2500, motion);
    block.shape = *convexHull(corners);
    block.face_joint.assign(block.shape.faces.size(), 0);
    model.blocks.push_back(std::move(block));
}

/// Part of a ring on two abutments.
Model arch(Draw draw) {
    Model model = onFloor(draw.between(35, 50));
    model.joints = {joint(degrees(model.joints[0].friction), 1e12)};
    model.blocks.clear();
    const int count = 2 * draw.one(3, 10) + 1;
    const double radius = draw.between(2, 10), half = radians(draw.between(60, 90));
    const double thickness = draw.between(0.11, 0.25) * radius;
    const auto at = [&](double angle, double r) {
        return Eigen::Vector2d(r * std::sin(angle), r * std::cos(angle));
    };
    const double inner = radius - 0.5 * thickness, outer = radius + 0.5 * thickness;
    for (int k = 0; k < count; ++k) {
        const double from = -half + 2 * half * k / count, to = -half + 2 * half * (k + 1) / count;
        addVoussoir(model, {at(from, inner), at(from, outer), at(to, inner), at(to, outer)}, Motion::free);
    }
    for (const double side : {-1.0, 1.0}) {
        const Eigen::Vector2d down(0.5 * side * std::cos(half), -0.5 * std::sin(half));
        addVoussoir(model,
                    {at(side * half, inner), at(side * half, outer), at(side * half, inner) + down,
                     at(side * half, outer) + down},
                    Motion::fixed);
    }
    return model;
}

/// Decided, and not above limit analysis. \param least  share of that which it reaches at least, but for
/// `give` [deg]
/// \return whether it is above, of which the commands say that it is undecided
bool check(const Model& model, double least, double give) {
    const auto search = criticalAngle(model);
    const auto bound = limitAnalysis(model, Varied::tilt);
    REQUIRE(search.ok());
    REQUIRE(bound.ok());
    const SearchResult& found = *search;
    const LimitResult& limit = *bound;
    const double angle = degrees(found.answer), ceiling = degrees(limit.upper);
    MESSAGE(model.blocks.size() << " blocks, friction " << degrees(model.joints[0].friction) << ": "
                                << std::string(toString(found.status)) << " " << angle << ", limit analysis "
                                << std::string(toString(limit.status)) << " " << ceiling);
    const bool is_found = found.status == SearchStatus::found;
    CHECK((is_found || found.status == SearchStatus::stable_to_stop ||
           found.status == SearchStatus::unstable_at_start));
    if (found.status != SearchStatus::found) {
        CHECK((found.status == limit.status || limit.status == SearchStatus::found));
        CHECK((limit.status == found.status || ceiling < give));  // one that hardly stands
        return false;
    }
    CHECK(!found.moving_blocks.empty());
    if (limit.status == SearchStatus::found) CHECK(angle >= least * degrees(limit.lower) - give);
    return isAbove(found.low, {limit.upper, ""}, Varied::tilt);
}

}  // namespace

TEST_SUITE("slow: physics") {
    TEST_CASE("arches at random tilt to limit analysis's angle") {
        for (unsigned seed = 1; seed <= kDraws; ++seed) {
            CAPTURE(seed);
            CHECK_FALSE(check(arch(Draw(seed)), 1.0, 0.03));
        }
    }

    TEST_CASE("walls and columns at random are decided, below limit analysis's angle") {
        for (unsigned seed = 1; seed <= kDraws; ++seed) {
            CAPTURE(seed);
            CHECK_FALSE(check(wall(Draw(seed)), 0.0, 0.0));
            CHECK_FALSE(check(columns(Draw(seed)), 0.0, 0.0));
        }
    }

    // Nothing leans on the first column, so it goes where it would alone. Friction between columns that turn
    // together would hold them degrees beyond (engine/src/equilibrium/first_order_gaps.h), the more the
    // rougher they are.
    TEST_CASE("stacks of equal columns topple where one column does, whatever their friction") {
        struct Shape {
            int columns, rows;
            double width;
        };
        for (const Shape shape : {Shape{2, 5, 0.2},
                                  {3, 5, 0.2},
                                  {7, 5, 0.2},
                                  {2, 8, 0.3},
                                  {5, 8, 0.3},
                                  {3, 10, 0.3},
                                  {4, 4, 0.15},
                                  {9, 6, 0.2},
                                  {12, 3, 0.1},
                                  {3, 15, 0.2}})
            for (const double friction : {25.0, 30.0, 35.0, 40.0, 45.0}) {
                CAPTURE(shape.columns);
                CAPTURE(shape.rows);
                CAPTURE(friction);
                const double exact = degrees(std::atan(shape.width / (0.1 * shape.rows)));
                if (exact > friction - 1) continue;  // it slides
                Model model =
                    stackModel(shape.columns, shape.rows, 1, friction, {shape.width, 0.1, 0.1}, 1e12);
                const SearchResult found = *criticalAngle(model);
                CHECK((found.status == SearchStatus::found));
                CHECK(degrees(found.answer) == doctest::Approx(exact).epsilon(0.002));
                CHECK((found.mode == FailureMode::toppling));
            }
    }

    // Weight applied at once finds the jam of such columns sooner than a growing tilt: a few are stable, for
    // some hundredths of a degree.
    TEST_CASE("stacks of equal columns begun beyond the tilt at which one topples are unstable") {
        int stacks = 0, stood = 0;
        for (const auto& [columns, rows, width] :
             {std::tuple{2, 5, 0.2}, {3, 5, 0.2}, {7, 5, 0.2}, {5, 8, 0.3}, {3, 10, 0.3}, {12, 3, 0.1}})
            for (const double friction : {30.0, 40.0})
                for (const double beyond : {0.3, 1.0, 3.0}) {
                    Model model = stackModel(columns, rows, 1, friction, {width, 0.1, 0.1}, 3.375e11);
                    model.analysis.start = std::atan(width / (0.1 * rows)) + radians(beyond);
                    model.analysis.stop = radians(45);
                    const SearchResult found = *criticalAngle(model);
                    ++stacks;
                    if (found.status != SearchStatus::unstable_at_start) {
                        ++stood;
                        MESSAGE(columns << " columns of " << rows << ", friction " << friction << ", "
                                        << beyond
                                        << " degrees beyond: " << std::string(toString(found.status)) << " "
                                        << degrees(found.answer));
                    }
                }
        CHECK(stacks == 36);
        CHECK(stood <= 4);
    }

    // Joints of 1e12 Pa/m give a little, and a column of 40 blocks leans by more than one block's hundredth
    // before it goes.
    TEST_CASE("columns of many blocks topple at the angle of one piece") {
        for (const int count : {10, 20, 40}) {
            CAPTURE(count);
            Model model = onFloor(38);
            model.joints = {joint(38, 1e12)};
            for (int k = 0; k < count; ++k)
                addBox(model, "b" + std::to_string(k), {0, 0, 0.1 * k}, {0.2, kDepth, 0.1});
            const SearchResult found = *criticalAngle(model);
            const double exact = degrees(std::atan(2.0 / count));
            MESSAGE(count << " blocks: " << degrees(found.answer) << ", one piece " << exact);
            CHECK((found.status == SearchStatus::found));
            CHECK(degrees(found.answer) <= exact + 0.01);
            CHECK(degrees(found.answer) >= 0.99 * exact);
        }
    }

    // One column is no lean: it slides as a whole or on one of its beds, or topples about its lower edge.
    TEST_CASE("columns of one piece at random slide or topple at their closed angle") {
        for (unsigned seed = 1; seed <= kDraws; ++seed) {
            CAPTURE(seed);
            Draw draw(seed);
            const double friction = draw.between(15, 40), width = draw.between(0.2, 0.6),
                         height = draw.between(0.3, 1.5);
            Model model = onFloor(friction);
            addBox(model, "column", {0, 0, 0}, {width, kDepth, height});
            const SearchResult found = *criticalAngle(model);
            const double exact = std::min(friction, degrees(std::atan(width / height)));
            CHECK((found.status == SearchStatus::found));
            CHECK(degrees(found.answer) == doctest::Approx(exact).epsilon(0.001));
        }
    }
}
