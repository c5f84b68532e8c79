// Pictures of joints: where poles lie on the net, what the legend says, how many of each.

#include "report/joints_svg.h"

#include <doctest/doctest.h>

#include <numbers>

#include "talus/rock_mass.h"

namespace talus::tools {

namespace {

constexpr double kDeg = std::numbers::pi / 180;

std::vector<formats::RockJoint> planes() {
    std::vector<formats::RockJoint> joints;
    for (const auto& [set, dip, direction] : {std::tuple("A", 90.0, 90.0), std::tuple("A", 90.0, 90.0),
                                              std::tuple("B", 0.0, 0.0), std::tuple("C", 60.0, 0.0)})
        joints.push_back({set, upwardNormal(dip * kDeg, direction * kDeg), {}});
    return joints;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE(
    "stereonet: poles of the lower hemisphere, equal-area, each place of a set once, counted in the legend") {
    const std::string svg = stereonetSvg(planes(), "Joints of a & b");
    // The net's middle is at 284, 284, its radius 240. A vertical plane that dips east has its pole in the
    // west, a level one in the middle, and one that dips 60 to the north in the south at sqrt(2) sin 30 deg
    // of the radius.
    CHECK(has(svg, "cx=\"44.0\" cy=\"284.0\""));
    CHECK(has(svg, "cx=\"284.0\" cy=\"284.0\""));
    CHECK(has(svg, "cx=\"284.0\" cy=\"453.7\""));
    CHECK(count(svg, "class=\"pole set0\"") == 2);  // one on the net, one in the legend
    CHECK(has(svg, "A: 2 poles, mean 90/90"));
    CHECK(has(svg, "C: 1 pole, 60/0"));
    CHECK(has(svg, "Joints of a &amp; b"));
}

TEST_CASE("sizes: discs by set in the stereonet's colours, blocks beside") {
    auto joints = planes();
    for (const double radius : {1.0, 3.0}) {
        joints.push_back({"D", Vec3::UnitZ(), Fracture{Vec3::Zero(), 0, 0, radius}});
    }
    Model model;
    Block block;
    block.shape = *makeBox(Vec3::Zero(), Vec3::Ones());
    model.blocks = {block, block};
    const std::string svg = sizesSvg(joints, model, "Sizes");
    CHECK(has(svg, "D, discs: 2"));
    CHECK(has(svg, "blocks: 2"));
    CHECK(count(svg, "class=\"curve curve3\"") == 2);  // the curve and its line in the legend
    CHECK(has(sizesSvg(planes(), model, "Sizes"), "volume [m3]"));
    CHECK_FALSE(has(sizesSvg(planes(), model, "Sizes"), "radius [m]"));
}

}  // namespace talus::tools
