// talus replay: the page's bytes are the file's, the summary is that of the run, --verify computes the run
// again.

#include <doctest/doctest.h>

#include <regex>

#include <algorithm>

#include "replay/page.h"
#include "replay/terminal.h"
#include "support/snapshots.h"
#include "talus/searches.h"
#include "tools/program.h"

using namespace talus::tools::testing;
using nlohmann::json;

namespace {

struct File {
    TemporaryFolder folder;
    std::string path = folder / "run.mcap", page = folder / "run.html";
    json result;

    File() {
        const std::string scenario = folder.write("run.toml", talus::test::runScenarioText("0.02"));
        result = runTalus({"run", scenario, "-o", path, "--full-every", "5", "--json", "--quiet"}).json();
    }
};

const File& file() {
    static const File made;
    return made;
}

std::string decoded(const std::string& base64) {
    static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned group = 0;
    int bits = 0;
    for (const char letter : base64) {
        if (letter == '=') break;
        group = group << 6 | static_cast<unsigned>(letters.find(letter));
        if ((bits += 6) >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 255);
    }
    return bytes;
}

/// The snapshot file inside a page, piece by piece.
std::string snapshotIn(const std::string& page) {
    const std::string open = "<script class=\"snapshot\" type=\"text/plain\">";
    std::string bytes;
    for (std::size_t at = page.find(open); at != std::string::npos; at = page.find(open, at + 1)) {
        const std::size_t begin = at + open.size();
        bytes += decoded(page.substr(begin, page.find('<', begin) - begin));
    }
    return bytes;
}

json course(const std::string& path) { return runTalus({"replay", path, "--json"}).json(); }

}  // namespace

TEST_CASE("replay -o: the page holds the file, byte for byte, and nothing from elsewhere") {
    const Outcome made = runTalus({"replay", file().path, "-o", file().page, "--json"});
    REQUIRE(made.exit_code == 0);
    const std::string page = contentOf(file().page);
    CHECK(made.json().at("bytes") == page.size());
    CHECK(snapshotIn(page) == contentOf(file().path));
    CHECK(page.starts_with("<!doctype html>"));
    for (const char* word : {"src=", "href=", "@import", "<!--SNAPSHOT-->"}) {
        CAPTURE(word);
        const std::string head = page.substr(0, page.find("<script"));
        CHECK(head.find(word) == std::string::npos);
    }
    CHECK(runTalus({"replay", file().path, "-o", file().page}).exit_code == 0);  // a page may be made again
}

TEST_CASE("the page has words for the load of every search and every limit analysis") {
    const std::string page = talus::tools::replayPage("");
    std::smatch match;
    REQUIRE(std::regex_search(
        page, match, std::regex("<script id=\"searches\" type=\"application/json\">([^<]*)</script>")));
    const json words = json::parse(match[1].str());
    const auto check = [&](const std::string& name, const talus::VariedQuantity& load) {
        CAPTURE(name);
        const json& said = words.at(name);
        CHECK(said.at("text") == load.text);
        CHECK(said.at("unit") == load.unit);
        CHECK(said.at("scale").get<double>() == load.scale);
    };
    for (const talus::LoadSearch& search : talus::loadSearches()) check(search.name, *search.load);
    for (const talus::VariedQuantity& load : talus::variedQuantities())
        check(std::string("limit-analysis --for ") + load.name, load);
    CHECK(words.size() == talus::loadSearches().size() + talus::variedQuantities().size());
}

TEST_CASE("replay -o: bytes of any length survive base64, large files go in pieces") {
    for (const std::size_t size : {0u, 1u, 2u, 3u, 1000u, (12u << 20) + 5u}) {
        std::string bytes(size, '\0');
        unsigned state = 1;
        for (char& byte : bytes) byte = static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
        CHECK(snapshotIn(talus::tools::replayPage(bytes)) == bytes);
    }
}

TEST_CASE("replay -o: nothing else is overwritten without --force") {
    const TemporaryFolder folder;
    const std::string other = folder.write("notes.html", "<p>mine</p>");
    CHECK(runTalus({"replay", file().path, "-o", other}).exit_code == 2);
    CHECK(contentOf(other) == "<p>mine</p>");
    CHECK(runTalus({"replay", file().path, "-o", other, "--force"}).exit_code == 0);
    CHECK(runTalus({"replay", file().path, "-o", file().path, "--force"}).exit_code == 2);
    CHECK(runTalus({"replay", file().path, "-o", folder / "no/such/page.html"}).exit_code == 4);
    CHECK(runTalus({"replay", folder / "absent.mcap"}).exit_code == 2);
    CHECK(runTalus({"replay", file().path, "--every", "2"}).exit_code == 2);  // only with -o
}

TEST_CASE("replay -o: chosen frames, and a cut file, become a whole snapshot file") {
    const TemporaryFolder folder;
    const std::string page = folder / "part.html";
    REQUIRE(runTalus({"replay", file().path, "-o", page, "--from", "0.005", "--to", "0.015", "--every", "3",
                      "--no-contacts"})
                .exit_code == 0);
    const json all = course(file().path);
    const json part = course(folder.write("part.mcap", snapshotIn(contentOf(page))));
    CHECK(part.at("ended") == "finished");
    REQUIRE(part.at("frames").size() == 5);  // 5, 8, 11, 14 and 15 ms
    for (const json& frame : part.at("frames")) CHECK(frame.at("full") == false);
    CHECK(part.at("frames")[1].at("state_hash") == all.at("frames")[8].at("state_hash"));
    CHECK(part.at("frames")[4].at("state_hash") == all.at("frames")[15].at("state_hash"));
    CHECK(runTalus({"replay", file().path, "-o", page, "--from", "7"}).exit_code == 2);

    const std::string bytes = contentOf(file().path);
    const std::string cut = folder.write("cut.mcap", bytes.substr(0, bytes.size() / 2));
    REQUIRE(runTalus({"replay", cut, "-o", page}).exit_code == 0);
    const json whole = course(folder.write("whole.mcap", snapshotIn(contentOf(page))));
    CHECK(whole.at("faults").empty());
    CHECK(whole.at("frames").size() == course(cut).at("frames").size());
    CHECK(whole.at("ended") != "finished");
}

TEST_CASE("replay: the terminal shows the course of the run") {
    const json summary = course(file().path);
    CHECK(summary.at("frames").size() == 21);
    CHECK(summary.at("state_hash") == file().result.at("state_hash"));
    const std::string text = runTalus({"replay", file().path, "--rows", "4"}).out;
    CHECK(text.find("largest displacement") != std::string::npos);
    CHECK(text.find(file().result.at("state_hash").get<std::string>()) != std::string::npos);
    CHECK(text.find(summary.at("frames")[0].at("state_hash").get<std::string>()) != std::string::npos);
}

TEST_CASE("sparklines: lowest to highest, the largest of several, logarithmic") {
    using talus::tools::sparkline;
    CHECK(sparkline({0, 1, 2, 3, 4, 5, 6, 7}, 8, false, false) == "_.-=+*%#");
    CHECK(sparkline({0, 7}, 8, false, true) == "▁█");
    CHECK(sparkline({0, 0, 7, 0}, 2, false, false) == "_#");
    CHECK(sparkline({3, 3, 3}, 8, false, false) == "___");
    CHECK(sparkline({1e-7, 1}, 8, true, false) == "_#");
    CHECK(sparkline({0, 1e-4, 1}, 8, true, false) == "_+#");
    CHECK(sparkline({}, 8, false, false).empty());
}

TEST_CASE("replay --verify: a sound run computes to the same bits, on any number of threads") {
    for (const char* threads : {"1", "2"}) {
        const Outcome outcome = runTalus({"replay", file().path, "--verify", "--json", "--threads", threads});
        REQUIRE(outcome.exit_code == 0);
        CHECK(outcome.json().at("equal") == true);
        CHECK(outcome.json().at("frames") == 21);
        CHECK(outcome.json().at("stretches").size() == 5);
    }
}

TEST_CASE("replay --verify: a forged frame is found out, with its stretch") {
    const TemporaryFolder folder;
    const talus::formats::Scenario scenario =
        *talus::formats::parseScenario(talus::test::runScenarioText("0.01"), "run.toml");

    const talus::test::Recorded run = talus::test::record(scenario.model, 5);
    REQUIRE(talus::test::writeFile(folder / "true.mcap", scenario, run).empty());
    CHECK(runTalus({"replay", folder / "true.mcap", "--verify", "--quiet"}).exit_code == 0);

    talus::test::Recorded forged = run;
    forged.lights[3].state_hash ^= 1;
    REQUIRE(talus::test::writeFile(folder / "forged.mcap", scenario, forged).empty());
    const Outcome outcome = runTalus({"replay", folder / "forged.mcap", "--verify", "--json", "--quiet"});
    CHECK(outcome.exit_code == 2);
    const json found = outcome.json();
    CHECK(found.at("equal") == false);
    CHECK(std::count_if(found.at("stretches").begin(), found.at("stretches").end(),
                        [](const json& stretch) { return stretch.at("equal") == false; }) == 1);
}
