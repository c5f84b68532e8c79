#pragma once
// Scripts that look at pages in headless Chromium: they need node, npm, chromium and the package of
// tests/replay/package.json, which is installed beside the test program once.

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tools/program.h"

namespace talus::tools::testing {

inline bool succeeds(const std::string& command) {
    return std::system((command + " >/dev/null 2>&1").c_str()) == 0;
}

struct ScriptOutcome {
    bool is_skipped = false;  ///< node, npm, chromium or the package are not to be had here
    int status = 0;
    std::string said;
};

/// Installs the package of tests/replay/package.json into folder/node_modules, unless it is there. Tests that
/// run at the same time wait for each other; an install that was cut short, or of another list, is done anew.
inline bool installsPackage(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    const std::string list = std::string(TALUS_SOURCE_DIR) + "/tests/replay/package-lock.json";
    const std::string is_there = "cmp -s '" + list + "' node_modules/installed-from";
    const std::string install = "cp '" + std::string(TALUS_SOURCE_DIR) + "/tests/replay/package.json' '" +
                                list + "' . && npm ci --ignore-scripts && cp '" + list +
                                "' node_modules/installed-from";
    return succeeds("cd '" + folder.string() + "' && exec 9>lock && flock 9 && { " + is_there + " || { " +
                    install + "; }; }");
}

/// Runs `node SCRIPT arguments`, SCRIPT a path below tests/, from a folder of its own. $CHROMIUM in the
/// arguments is its path.
inline ScriptOutcome runScript(const std::string& script, const std::string& arguments) {
    const std::filesystem::path source = std::string(TALUS_SOURCE_DIR) + "/tests";
    const std::filesystem::path installed =
        std::filesystem::path(TALUS_PROGRAM).parent_path().parent_path() / "tests/replay-node";
    if (!succeeds("node --version") || !succeeds("npm --version") || !succeeds("chromium --version") ||
        !installsPackage(installed))
        return {true, 0, ""};
    const TemporaryFolder folder;
    const std::string name = std::filesystem::path(script).filename().string();
    std::filesystem::create_directory_symlink(installed / "node_modules", folder / "node_modules");
    std::filesystem::copy_file(source / script, folder / name);
    std::filesystem::copy_file(source / "replay/opened.mjs", folder / "opened.mjs");
    const int status =
        std::system(("cd '" + (folder / "") + "' && CHROMIUM=\"$(command -v chromium)\" && node '" + name +
                     "' " + arguments + " > said 2>&1")
                        .c_str());
    return {false, status, contentOf(folder / "said")};
}

}  // namespace talus::tools::testing
