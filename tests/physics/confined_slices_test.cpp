// Slices on a dipping bed between fixed slices. Nothing presses their upright sides, so statics allows no
// friction there: an answer may count on some that locks, but its interval has to reach down to the factor of
// a single slice.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "support/models.h"
#include "talus/analysis.h"

using namespace talus;
using namespace talus::test;

namespace {

struct Slices {
    double dip_deg, spacing;  // of the bed, and the slices' width [deg, m]
    int count, blocks;        // slices, and blocks in each along the dip
    double bed_deg = 34, sides_deg = 38;

    Model model() const {
        constexpr double kLength = 12, kThickness = 4;
        Model made;
        made.joints = {joint(sides_deg, 2e10), joint(bed_deg, 2e10)};
        for (Joint& each : made.joints) each.shear_stiffness = 1e10;
        const double width = spacing * count;
        made.blocks = {box("bed", {-20, -5, -5}, {40, width + 5, 0}, 2650, Motion::fixed),
                       box("near", {-5, -5, 0}, {kLength + 5, 0, kThickness}, 2650, Motion::fixed),
                       box("far", {-5, width, 0}, {kLength + 5, width + 5, kThickness}, 2650, Motion::fixed)};
        made.blocks[0].face_joint.assign(6, 1);
        const double length = kLength / blocks;
        for (int s = 0; s < count; ++s)
            for (int k = 0; k < blocks; ++k) {
                const auto b = static_cast<std::int32_t>(made.blocks.size());
                addBox(made, "s" + std::to_string(s + 1) + "k" + std::to_string(k + 1),
                       {k * length, s * spacing, 0}, {length, spacing, kThickness}, 2650);
                made.pair_joints.push_back({0, b, 1});
            }
        const Eigen::Quaterniond dip = turnAbout(-Vec3::UnitY(), dip_deg);  // out of the slope, towards -x
        for (Block& block : made.blocks)
            for (Vec3& v : block.shape.vertices) v = dip * v;
        return made;
    }
    double factor() const { return std::tan(radians(bed_deg)) / std::tan(radians(dip_deg)); }
};

}  // namespace

TEST_SUITE("physics") {
    TEST_CASE("slices between fixed slices: the interval reaches down to the factor of a single slice") {
        for (const double dip : {30.0, 38.0, 45.0})
            for (const double spacing : {2.0, 6.0, 9.0})
                for (const int count : {1, 2, 4})
                    for (const int blocks : {1, 2}) {
                        if (blocks > 1 && (count == 2 || spacing == 6.0)) continue;
                        const Slices slices{dip, spacing, count, blocks};
                        CAPTURE(dip);
                        CAPTURE(spacing);
                        CAPTURE(count);
                        CAPTURE(blocks);
                        const SearchResult result = *safetyFactor(slices.model());
                        REQUIRE((result.status == SearchStatus::found));
                        REQUIRE(result.answer_interval.has_value());
                        CHECK(result.answer_interval->first <= slices.factor() * 1.005);
                        CHECK(result.answer_interval->first >= slices.factor() * 0.98);
                        CHECK(result.answer >= slices.factor() * 0.995);
                    }
    }
}
