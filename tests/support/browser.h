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

/// Runs `node SCRIPT arguments`, SCRIPT a path below tests/. $CHROMIUM in the arguments is its path.
inline ScriptOutcome runScript(const std::string& script, const std::string& arguments) {
    const std::filesystem::path source = std::string(TALUS_SOURCE_DIR) + "/tests";
    const std::filesystem::path folder =
        std::filesystem::path(TALUS_PROGRAM).parent_path().parent_path() / "tests/replay-node";
    const std::filesystem::path copy = folder / std::filesystem::path(script).filename();
    if (!succeeds("node --version") || !succeeds("npm --version") || !succeeds("chromium --version"))
        return {true, 0, ""};
    std::filesystem::create_directories(folder);
    constexpr auto kReplace = std::filesystem::copy_options::overwrite_existing;
    for (const char* name : {"package.json", "package-lock.json"})
        std::filesystem::copy_file(source / "replay" / name, folder / name, kReplace);
    std::filesystem::copy_file(source / script, copy, kReplace);
    std::filesystem::copy_file(source / "replay/opened.mjs", folder / "opened.mjs", kReplace);
    if (!std::filesystem::exists(folder / "node_modules/playwright-core") &&
        !succeeds("cd '" + folder.string() + "' && npm ci --ignore-scripts"))
        return {true, 0, ""};
    const TemporaryFolder results;
    const int status =
        std::system(("cd '" + folder.string() + "' && CHROMIUM=\"$(command -v chromium)\" && node '" +
                     copy.string() + "' " + arguments + " > '" + (results / "said") + "' 2>&1")
                        .c_str());
    return {false, status, contentOf(results / "said")};
}

}  // namespace talus::tools::testing
