// The rooms of tools/ include each other one way.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace {

/// Each may include itself and what stands before it; main.cpp may include all.
const std::vector<std::string> kRooms = {"cli",    "report", "recording",    "inspect",
                                         "replay", "batch",  "reproduction", "commands"};

std::size_t place(const std::string& room) {
    return static_cast<std::size_t>(std::find(kRooms.begin(), kRooms.end(), room) - kRooms.begin());
}

/// The rooms that a file includes from.
std::vector<std::string> includedBy(const std::filesystem::path& file) {
    static const std::regex include(R"re(^\s*#\s*include\s+"([a-z_]+)/[^"]*")re");
    std::vector<std::string> rooms;
    std::ifstream text(file);
    std::smatch match;
    for (std::string line; std::getline(text, line);)
        if (std::regex_search(line, match, include) && place(match[1]) < kRooms.size())
            rooms.push_back(match[1]);
    return rooms;
}

bool isSource(const std::filesystem::path& path) {
    return path.extension() == ".h" || path.extension() == ".cpp";
}

}  // namespace

TEST_CASE("every source of the command line is in a room, and rooms include only those before them") {
    const std::filesystem::path tools = std::filesystem::path(TALUS_SOURCE_DIR) / "tools";
    std::size_t sources = 0, includes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(tools))
        if (isSource(entry.path())) CHECK(entry.path().filename() == "main.cpp");
    for (const std::string& room : kRooms)
        for (const auto& entry : std::filesystem::directory_iterator(tools / room)) {
            if (!isSource(entry.path())) continue;
            ++sources;
            for (const std::string& included : includedBy(entry.path())) {
                ++includes;
                CAPTURE(entry.path().string());
                CAPTURE(included);
                CHECK(place(included) <= place(room));
            }
        }
    CHECK(sources > 50);
    CHECK(includes > 100);
}
