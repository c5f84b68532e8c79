// The picture of a failure: who is coloured how, and how far what fails is moved.

#include "answers/search_picture.h"

#include <doctest/doctest.h>

#include <regex>
#include <set>

using namespace talus;
using namespace talus::tools;

namespace {

Block box(const char* name, const Vec3& min, const Vec3& max, Motion motion = Motion::free) {
    Block block;
    block.name = name;
    block.shape = *makeBox(min, max);
    block.motion = motion;
    return block;
}

/// A floor with two blocks on it, apart.
formats::Scenario scenario(double depth = 1) {
    formats::Scenario scenario;
    scenario.path = "folder/two.toml";
    scenario.model.blocks = {box("floor", {-1, 0, -1}, {6, 1, 0}, Motion::fixed),
                             box("low", {0, 0, 0}, {1, 1, 1}), box("high", {3, 0, 0}, {4, depth, 1})};
    return scenario;
}

SearchResult lowSlides() {
    SearchResult result;
    result.status = SearchStatus::found;
    result.answer = 1.25;
    result.mode = FailureMode::sliding;
    result.moving_blocks = {"low"};
    BlockMotion motion;
    motion.block = "low";
    motion.moving = true;
    motion.translation = Vec3(-1e-3, 0, 0);
    result.motions = {motion};
    return result;
}

std::string picture(const SearchResult& result, const formats::Scenario& of) {
    return searchPicture(*loadSearch("safety-factor"), result, of);
}

/// Left ends of what is drawn of a block [px].
double leftOf(const std::string& svg, const std::string& block) {
    const std::regex polygon("points=\"([^\"]*)\" class=\"block\"><title>" + block + "<");
    double left = 1e9;
    for (std::sregex_iterator it(svg.begin(), svg.end(), polygon), end; it != end; ++it) {
        const std::string points = (*it)[1];
        static const std::regex kPoint("([-0-9.]+),[-0-9.]+");
        for (std::sregex_iterator at(points.begin(), points.end(), kPoint); at != end; ++at)
            left = std::min(left, std::stod((*at)[1]));
    }
    return left;
}

std::string colourOf(const std::string& svg, const std::string& block) {
    std::smatch found;
    REQUIRE(std::regex_search(
        svg, found, std::regex("<polygon fill=\"(#[0-9a-f]{6})\"[^>]*class=\"block\"><title>" + block)));
    return found[1];
}

bool says(const std::string& svg, const std::string& words) { return svg.find(words) != std::string::npos; }

}  // namespace

TEST_CASE("failing blocks have their own colour, and are moved by half their size") {
    const std::string svg = picture(lowSlides(), scenario());
    const std::set<std::string> colours{colourOf(svg, "low"), colourOf(svg, "high"), colourOf(svg, "floor")};
    CHECK(colours.size() == 3);
    CHECK(says(svg, ">two.toml: factor of safety 1.2500, sliding</text>"));
    CHECK(says(svg, "displacements enlarged 500 times"));
    for (const char* words : {">stands<", ">fixed<", ">fails<"}) CHECK(says(svg, words));

    SearchResult still = lowSlides();
    still.motions.clear();
    const double moved = leftOf(picture(still, scenario()), "low") - leftOf(svg, "low");
    CHECK(moved > 0.4 * 860 / 7);  // of a metre, the floor being 7 m wide
    CHECK(moved < 0.6 * 860 / 7);
}

TEST_CASE("each group has its colour, and those left out theirs") {
    SearchResult result = lowSlides();
    result.groups = {{.factor = 1.25, .blocks = {"low"}}, {.factor = 1.5, .blocks = {"high"}}};
    const std::string svg = picture(result, scenario());
    CHECK(colourOf(svg, "low") != colourOf(svg, "high"));
    CHECK(says(svg, ">fails at 1.2500<"));
    CHECK(says(svg, ">then at 1.5000<"));

    result.groups.clear();
    result.fallen_at_start = {"high"};
    CHECK(says(picture(result, scenario()), ">removed before<"));
}

TEST_CASE("one slice is seen in section, others obliquely; a turn goes about the block's middle") {
    CHECK(says(picture(lowSlides(), scenario()), "height="));
    const auto high = [](const std::string& svg) {
        std::smatch found;
        REQUIRE(std::regex_search(svg, found, std::regex("viewBox=\"0 0 900.0 ([0-9.]+)\"")));
        return std::stod(found[1]);
    };
    CHECK(high(picture(lowSlides(), scenario(2))) > 1.1 * high(picture(lowSlides(), scenario(1))));
}

TEST_CASE("where nothing fails the slope is drawn as it is") {
    SearchResult result;
    result.status = SearchStatus::stable_to_stop;
    result.low = 100;
    const std::string svg = picture(result, scenario());
    CHECK(says(svg, "stable up to the largest load tried"));
    CHECK_FALSE(says(svg, "displacements enlarged"));
    CHECK_FALSE(says(svg, ">fails"));
}
