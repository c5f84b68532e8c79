// The picture of blocks: names where they fit, none on another, and a compass that grows with the picture.

#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <regex>

#include "report/blocks_files.h"

namespace talus::tools {

namespace {

constexpr double kDeg = std::numbers::pi / 180;

/// A wall of blocks of 1 m, along x and up.
Model wall(int wide, int high) {
    Model model;
    for (int i = 0; i < wide; ++i)
        for (int k = 0; k < high; ++k) {
            Block block;
            block.name = "b" + std::to_string(100 + i * high + k);
            block.shape = *makeBox(Vec3(i, 0, k), Vec3(i + 1, 1, k + 1));
            model.blocks.push_back(block);
        }
    return model;
}

struct Name {
    double x, y;
    std::string text;
};

std::vector<Name> namesIn(const std::string& svg) {
    static const std::regex kName(
        "<text x=\"([-0-9.]+)\" y=\"([-0-9.]+)\" text-anchor=\"middle\" class=\"name\">([^<]*)<");
    std::vector<Name> names;
    for (std::sregex_iterator it(svg.begin(), svg.end(), kName), end; it != end; ++it)
        names.push_back({std::stod((*it)[1]), std::stod((*it)[2]), (*it)[3]});
    return names;
}

/// Length of the compass' needle, seen from above [px].
double needleOf(const std::string& svg) {
    static const std::regex kNeedle(
        "<polygon points=\"[-0-9.]+,([-0-9.]+) [-0-9.]+,([-0-9.]+)[^\"]*\" class=\"needle\"");
    std::smatch found;
    REQUIRE(std::regex_search(svg, found, kNeedle));
    return std::abs(std::stod(found[1]) - std::stod(found[2]));
}

}  // namespace

TEST_CASE("blocks: where there are many each has its name as long as there is room, and no two names meet") {
    const std::string svg = blocksSvg(wall(10, 8), {180 * kDeg, 20 * kDeg}, "Wall");
    const std::vector<Name> names = namesIn(svg);
    CHECK(names.size() == 80);
    for (std::size_t a = 0; a < names.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            CAPTURE(names[a].text + " " + names[b].text);
            CHECK((std::abs(names[a].x - names[b].x) > 24 || std::abs(names[a].y - names[b].y) > 11));
        }
}

TEST_CASE("blocks: where there is no room there is no name but of the blocks that are larger") {
    Model model = wall(60, 2);
    model.blocks[0].name = "large";
    model.blocks[0].shape = *makeBox(Vec3(0, 0, 2), Vec3(20, 1, 12));
    const std::vector<Name> names = namesIn(blocksSvg(model, {180 * kDeg, 20 * kDeg}, "Wall"));
    REQUIRE(names.size() == 1);
    CHECK(names[0].text == "large");
}

TEST_CASE("blocks: the compass is larger on a larger picture") {
    const View plan{180 * kDeg, 90 * kDeg};
    Model tall;
    tall.blocks.resize(1);
    tall.blocks[0].name = "tall";
    tall.blocks[0].shape = *makeBox(Vec3::Zero(), Vec3(1, 2, 1));
    const double flat = needleOf(blocksSvg(wall(10, 1), plan, "Flat"));
    CHECK(flat > 40);
    CHECK(needleOf(blocksSvg(tall, plan, "Tall")) > 1.2 * flat);
}

TEST_CASE("blocks: the picture of a tall model fits a sheet of paper, in its middle") {
    Model tall;
    tall.blocks.resize(1);
    tall.blocks[0].name = "tall";
    tall.blocks[0].shape = *makeBox(Vec3::Zero(), Vec3(1, 1, 20));
    const std::string svg = blocksSvg(tall, {180 * kDeg, 0}, "Tall");
    const std::size_t at = svg.find("height=\"") + 8;
    CHECK(std::stod(svg.substr(at)) < 1250);
    // 20 m are 1080 px, so its one face is 54 px wide, about x = 450 px.
    CHECK(svg.find("points=\"423.0,") != std::string::npos);
    CHECK(svg.find(" 477.0,") != std::string::npos);
}

}  // namespace talus::tools
