// The replay page gives each block the role of the engine's rule, for the same motions. Needs node.

#include <doctest/doctest.h>

#include <cstdlib>
#include <random>
#include <regex>

#include "replay/page.h"
#include "support/skip.h"
#include "talus/motion_roles.h"
#include "tools/program.h"

using namespace talus;
using namespace talus::tools::testing;
using nlohmann::json;

namespace {

/// Blocks of which some stand, some slide behind others, some turn.
std::vector<BlockDisplacement> someDisplacements(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    std::vector<BlockDisplacement> displacements(40);
    for (BlockDisplacement& block : displacements) {
        block.free = uniform() < 0.9;
        block.position = Vec3(10 * uniform(), 3 * uniform(), 2 * uniform());
        block.radius = 0.2 + uniform();
        block.mass = 100 + 1000 * uniform();
        if (!block.free) continue;
        const double scale = std::pow(10.0, -5 * uniform());
        block.translation = scale * uniform();
        block.rotation = uniform() < 0.5 ? 0 : scale * uniform();
    }
    return displacements;
}

json ruleOfPage() {
    const std::string page = tools::replayPage("");
    std::smatch match;
    REQUIRE(std::regex_search(
        page, match, std::regex("<script id=\"motion-rule\" type=\"application/json\">([^<]*)</script>")));
    return json::parse(match[1].str());
}

/// What the page knows: positions at the start and displacements, here along y.
json inputOf(const std::vector<BlockDisplacement>& displacements, double smallest) {
    json header{{"failure", nullptr}}, frame, radius = json::array();
    for (std::size_t b = 0; b < displacements.size(); ++b) {
        const BlockDisplacement& block = displacements[b];
        header["names"].push_back("b" + std::to_string(b));
        header["motion"].push_back(block.free ? 0 : 1);
        header["size"].push_back(smallest);
        header["mass"].push_back(block.mass);
        header["centroid"]["x"].push_back(block.position.x());
        header["centroid"]["y"].push_back(block.position.y() - block.translation);
        header["centroid"]["z"].push_back(block.position.z());
        for (const char* list : {"displacement", "rotation"})
            for (const char* axis : {"x", "z"}) frame[list][axis].push_back(0);
        frame["displacement"]["y"].push_back(block.translation);
        frame["rotation"]["y"].push_back(block.rotation);
        radius.push_back(block.radius);
    }
    return {{"rule", ruleOfPage()}, {"header", header}, {"frame", frame}, {"radius", radius}};
}

}  // namespace

TEST_CASE("the page's roles are those of the one rule") {
    if (std::system("node --version >/dev/null 2>&1") != 0) return test::skip("node is not to be had here");
    const TemporaryFolder folder;
    for (const unsigned seed : {1U, 2U, 3U}) {
        CAPTURE(seed);
        const auto displacements = someDisplacements(seed);
        const double smallest = 0.3;
        const std::string input = folder.write("input.json", inputOf(displacements, smallest).dump());
        const std::string output = folder / "output.json";
        const std::string source = TALUS_SOURCE_DIR;
        REQUIRE(std::system(("node '" + source + "/tests/replay/roles.mjs' '" + source + "' '" + input +
                             "' > '" + output + "'")
                                .c_str()) == 0);
        const json found = json::parse(contentOf(output));
        const auto roles = motionRoles(displacements, MotionRule::kDeflectionOfSize * smallest);
        int moving = 0, standing = 0;
        for (std::size_t b = 0; b < displacements.size(); ++b) {
            CAPTURE(b);
            const int expected = !displacements[b].free             ? 0
                                 : roles[b] == FailureMode::none    ? 2
                                 : roles[b] == FailureMode::sliding ? 3
                                                                    : 4;
            CHECK(found.at("roles")[b] == expected);
            (expected > 2 ? moving : standing) += 1;
        }
        CHECK(moving > 5);
        CHECK(standing > 5);
        CHECK(found.at("mode") == toString(overallMode(displacements, roles)));
    }
}
