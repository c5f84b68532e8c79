// The house: folders are floors, and includes run one way. A file sees its own floor and those below it, and
// inside a floor no two files see each other in a circle.

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// Folders of one library from the ground up; files that lie in none of them are on the top floor.
struct House {
    const char* root;
    std::vector<std::string> floors;
};

const std::vector<House>& houses() {
    static const std::vector<House> all{
        {"engine/src", {"simd",           "geometry",     "rock_mass", "model",    "law",         "state",
                        "flow",           "forces",       "measure",   "validate", "step",        "contacts",
                        "build",          "frame",        "checks",    "failure",  "equilibrium", "history",
                        "limit_analysis", "block_theory", "search",    "theory",   "kinematics"}},
        {"formats/src",
         {"files", "toml", "mesh", "scenario", "sweep", "schema", "history", "mcap", "snapshot", "export"}},
        {"tools",
         {"cli", "report", "schemas", "recording", "inspect", "replay", "answers", "slope_report", "batch",
          "reproduction", "verification", "python", "commands"}},
    };
    return all;
}

/// Public headers that describe what is built on the lower floors, and the lowest floor of the engine that may
/// see each. Every other public header is for all floors.
const std::map<std::string, std::string>& lowestFloors() {
    static const std::map<std::string, std::string> all{
        {"rock_mass", "rock_mass"},       {"ending_sets", "rock_mass"},
        {"model_check", "build"},         {"analysis", "failure"},
        {"simulation", "history"},        {"limit_analysis", "limit_analysis"},
        {"block_theory", "block_theory"}, {"searches", "limit_analysis"},
        {"search_rules", "equilibrium"},  {"theory", "search"},
        {"kinematics", "kinematics"}};
    return all;
}

/// Module (path without extension, from the house's root) -> modules it includes.
using Includes = std::map<std::string, std::set<std::string>>;

bool isSource(const fs::path& path) { return path.extension() == ".cpp" || path.extension() == ".h"; }

/// Files of all folders but those that a package manager fills. \param beside  further folder that includes
/// may name
Includes includesOf(const fs::path& root, const fs::path& beside = {}) {
    Includes result;
    static const std::regex line("^\\s*#\\s*include\\s+\"([^\"]+)\"");
    const fs::recursive_directory_iterator end;
    for (fs::recursive_directory_iterator entry(root); entry != end; ++entry) {
        const fs::path path = entry->path();
        if (path.filename() == "node_modules") entry.disable_recursion_pending();
        if (!isSource(path)) continue;
        fs::path module = path.lexically_relative(root);
        auto& seen = result[module.replace_extension().generic_string()];
        std::ifstream file(path);
        std::smatch match;
        for (std::string text; std::getline(file, text);) {
            if (!std::regex_search(text, match, line)) continue;
            const bool known =
                fs::exists(root / match[1].str()) || (!beside.empty() && fs::exists(beside / match[1].str()));
            if (!known) continue;  // of another library, or generated
            seen.insert(fs::path(match[1].str()).replace_extension().generic_string());
        }
    }
    return result;
}

/// Whether a folder has code: scripts and data need no floor.
bool holdsSources(const fs::path& folder) {
    const fs::directory_iterator entries(folder);
    return std::any_of(begin(entries), end(entries),
                       [](const auto& entry) { return isSource(entry.path()); });
}

std::string folderOf(const std::string& module) { return module.substr(0, module.find('/')); }

std::size_t floorOf(const House& house, const std::string& module) {
    if (module.find('/') == std::string::npos) return house.floors.size();
    const auto found = std::find(house.floors.begin(), house.floors.end(), folderOf(module));
    return static_cast<std::size_t>(found - house.floors.begin());
}

/// A circle of includes that goes through `module`, or nothing.
std::vector<std::string> circleFrom(const Includes& includes, const std::string& start) {
    std::vector<std::string> way;
    std::set<std::string> been;
    std::function<bool(const std::string&)> visit = [&](const std::string& module) {
        way.push_back(module);
        const auto found = includes.find(module);
        if (found != includes.end())
            for (const std::string& next : found->second) {
                if (next == module) continue;
                if (next == start) return true;
                if (been.insert(next).second && visit(next)) return true;
            }
        way.pop_back();
        return false;
    };
    return visit(start) ? way : std::vector<std::string>{};
}

std::string joined(const std::vector<std::string>& way) {
    std::string text;
    for (const std::string& module : way) text += module + " -> ";
    return text + way.front();
}

}  // namespace

TEST_CASE("every folder of a library has its floor") {
    for (const House& house : houses())
        for (const auto& entry : fs::directory_iterator(fs::path(TALUS_SOURCE_DIR) / house.root)) {
            if (!entry.is_directory() || !holdsSources(entry.path())) continue;
            const std::string folder = entry.path().filename().string();
            CAPTURE(house.root);
            CAPTURE(folder);
            CHECK(std::count(house.floors.begin(), house.floors.end(), folder) == 1);
        }
}

TEST_CASE("no include runs up") {
    for (const House& house : houses()) {
        const Includes includes = includesOf(fs::path(TALUS_SOURCE_DIR) / house.root);
        REQUIRE(includes.size() > 10);
        for (const auto& [module, seen] : includes)
            for (const std::string& other : seen) {
                const std::string arrow = std::string(house.root) + ": " + module + " -> " + other;
                CAPTURE(arrow);
                CHECK(floorOf(house, other) <= floorOf(house, module));
            }
    }
}

TEST_CASE("the engine's lower floors do not see the faces of higher ones") {
    const House& engine = houses().front();
    const Includes includes =
        includesOf(fs::path(TALUS_SOURCE_DIR) / engine.root, fs::path(TALUS_SOURCE_DIR) / "engine/include");
    std::size_t seen_faces = 0;
    for (const auto& [module, seen] : includes)
        for (const std::string& other : seen) {
            if (!other.starts_with("talus/")) continue;
            const auto lowest = lowestFloors().find(other.substr(std::string("talus/").size()));
            if (lowest == lowestFloors().end()) continue;
            ++seen_faces;
            const std::string arrow = module + " -> " + other;
            CAPTURE(arrow);
            CHECK(floorOf(engine, module) >= floorOf(engine, lowest->second + "/"));
        }
    CHECK(seen_faces > 10);
}

TEST_CASE("no includes run round") {
    std::vector<House> all = houses();
    all.push_back({"engine/include", {}});
    all.push_back({"formats/include", {}});
    for (const House& house : all) {
        const Includes includes = includesOf(fs::path(TALUS_SOURCE_DIR) / house.root);
        for (const auto& [module, seen] : includes)
            if (const std::vector<std::string> way = circleFrom(includes, module); !way.empty())
                FAIL_CHECK(house.root << ": " << joined(way));
    }
}

TEST_CASE("a circle and a step up are found where there are some") {
    const House house{"", {"low", "high"}};
    const Includes includes{{"low/a", {"low/b"}}, {"low/b", {"low/a"}}, {"high/c", {"low/a"}}};
    CHECK(circleFrom(includes, "low/a").size() == 2);
    CHECK(circleFrom(includes, "high/c").empty());
    CHECK(floorOf(house, "high/c") > floorOf(house, "low/a"));
    CHECK(floorOf(house, "top") > floorOf(house, "high/c"));
}
