// talus blocks: what it draws of a scenario that has nothing to plot on a net.

#include <doctest/doctest.h>

#include <filesystem>

#include "cli/json.h"
#include "tools/program.h"

using namespace talus::tools;
using namespace talus::tools::testing;

namespace {

constexpr const char* kStack =
    "[material.granite]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e10\n"
    "shear_stiffness = 1e10\nfriction_deg = 30.0\n[[stack]]\ncolumns = 2\nrows = 2\nslices = 1\n"
    "block = [0.2, 0.1, 0.1]\n";

}  // namespace

TEST_CASE("blocks: without joint sets the picture is drawn and the stereonet left out, with a warning") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("stack.toml", kStack);
    const std::string picture = folder / "stack.svg", net = folder / "poles.svg";
    const Outcome outcome =
        runTalus({"blocks", scenario, "-o", picture, "--stereonet", net, "--sizes", folder / "sizes.svg"});
    CHECK(outcome.exit_code == 0);
    CHECK(contentOf(picture).find("<svg") != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(net));
    CHECK(outcome.err.find("warning: --stereonet: no joint set in " + scenario) != std::string::npos);
    CHECK(outcome.err.find("warning: --sizes: no joint set in " + scenario) != std::string::npos);

    const Outcome said =
        runTalus({"blocks", scenario, "-o", picture, "--stereonet", net, "--json", "--quiet"});
    REQUIRE(said.exit_code == 0);
    CHECK(Json::parse(said.out).at("warnings").dump().find("no joint set") != std::string::npos);
}

TEST_CASE("blocks: says how many discs were drawn, and what P32 they have") {
    const TemporaryFolder folder;
    const std::string set = "dip_deg = 40\ndip_direction_deg = 270\nradius = 2.0\n";
    const std::string scenario = folder.write(
        "network.toml", std::string(kStack).substr(0, std::string(kStack).find("[[stack]]")) +
                            "[rock_mass]\nregion = { box = { min = [0, 0, 0], max = [8, 8, 8] } }\n"
                            "[[fracture_set]]\nname = \"F\"\nfisher = 30\np32 = 0.3\n" +
                            set + "[[fracture_set]]\ncount = 5\n" + set);
    const Json result = Json::parse(runTalus({"blocks", scenario, "--json", "--quiet"}).out);
    const Json& sets = result.at("fracture_sets");
    REQUIRE(sets.size() == 2);
    CHECK(sets[0].at("name") == "F");
    CHECK(sets[0].at("p32").get<double>() == doctest::Approx(0.3).epsilon(0.01));
    CHECK(sets[1].at("name") == "fracture_set[1]");
    CHECK(sets[1].at("discs") == 5);
    CHECK(runTalus({"blocks", scenario, "--quiet"}).out.find("discs of F") != std::string::npos);
}

TEST_CASE("blocks: no two files have one name") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("stack.toml", kStack), one = folder / "one.svg";
    for (const std::vector<std::string>& files :
         {std::vector<std::string>{"-o", one, "--stereonet", one}, {"--sizes", one, "--stereonet", one}}) {
        std::vector<std::string> arguments{"blocks", scenario};
        arguments.insert(arguments.end(), files.begin(), files.end());
        CHECK(runTalus(arguments).exit_code == 2);
        CHECK_FALSE(std::filesystem::exists(one));
    }
}

TEST_CASE("blocks: Ctrl-C ends it at once whatever it is at, and leaves no picture") {
    const TemporaryFolder folder;
    std::string text = kStack;
    const std::string small = "columns = 2\nrows = 2\nslices = 1";
    text.replace(text.find(small), small.size(), "columns = 120\nrows = 120\nslices = 6");
    const std::string scenario = folder.write("stack.toml", text), picture = folder / "stack.svg";
    int interrupted = 0;
    for (const double begun : {0.05, 0.2, 0.4, 0.6, 0.8}) {
        Program program({"blocks", scenario, "-o", picture});
        waitFor([&] { return program.hasBegun(begun) || program.endsWithin(0); });
        program.signal(SIGINT);
        CHECK(program.endsWithin(kSlower * 0.5));
        const Outcome outcome = program.outcome();
        if (outcome.exit_code == 0) continue;  // it was done already
        ++interrupted;
        CHECK(outcome.exit_code == 130);
        CHECK_FALSE(std::filesystem::exists(picture));
        CHECK(std::distance(std::filesystem::directory_iterator(folder / "."), {}) == 1);  // the scenario
    }
    CHECK(interrupted > 0);
}

TEST_CASE("blocks: a stereonet alone needs a joint set, and a file's name is looked at first") {
    const TemporaryFolder folder;
    const std::string scenario = folder.write("stack.toml", kStack), net = folder / "poles.svg";
    const Outcome outcome = runTalus({"blocks", scenario, "--stereonet", net});
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.find("--stereonet: found no joint set in " + scenario) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(net));
    const Outcome wrong = runTalus({"blocks", folder / "none", "--stereonet", folder / "poles.png"});
    CHECK(wrong.exit_code == 2);
    CHECK(wrong.err.find("allowed: a name that ends in") != std::string::npos);
}
