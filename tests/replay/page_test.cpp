// The replay page in a browser: page.test.mjs opens it in headless Chromium. Needs node, npm, chromium and the package of
// package.json, which is installed beside the test program once.

#include <doctest/doctest.h>

#include <cstdlib>

#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus::tools::testing;

namespace {

bool succeeds(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

/// The folder with the script and its package; empty when they cannot be had.
std::string nodeFolder() {
    const std::filesystem::path source = std::string(TALUS_SOURCE_DIR) + "/tests/replay";
    const std::filesystem::path folder =
        std::filesystem::path(TALUS_PROGRAM).parent_path().parent_path() / "tests/replay-node";
    if (!succeeds("node --version") || !succeeds("npm --version") || !succeeds("chromium --version"))
        return "";
    std::filesystem::create_directories(folder);
    for (const char* name : {"package.json", "package-lock.json", "page.test.mjs"})
        std::filesystem::copy_file(source / name, folder / name,
                                   std::filesystem::copy_options::overwrite_existing);
    if (!std::filesystem::exists(folder / "node_modules/playwright-core") &&
        !succeeds("cd '" + folder.string() + "' && npm ci --ignore-scripts"))
        return "";
    return folder.string();
}

/// The laboratory slope with soft joints, steep enough to fail within half a second.
std::string slopeText() {
    return "[run]\nduration_s = 0.4\nframe_interval_s = 0.01\n[gravity]\ntilt_deg = 19.0\n[damping]\n"
           "contact = 1e-5\n[material.granite]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e8\n"
           "shear_stiffness = 1e8\nfriction_deg = 19.5\n[[stack]]\ncolumns = 7\nrows = 5\nslices = 3\n"
           "block = [0.2, 0.1, 0.1]\n[[water]]\nfissure = 5\ndepth = 0.35\n";
}

}  // namespace

TEST_SUITE("slow: replay page") {
    TEST_CASE("the page plays, seeks, picks and tells why in headless Chromium") {
        const std::string node = nodeFolder();
        if (node.empty()) {
            MESSAGE("skipped: node, npm, chromium or playwright-core are not to be had here");
            return;
        }
        const TemporaryFolder folder;
        const std::string run = folder / "slope.mcap", page = folder / "slope.html", said = folder / "said";
        REQUIRE(runTalus({"run", folder.write("slope.toml", slopeText()), "-o", run, "--quiet"}).exit_code ==
                0);
        REQUIRE(runTalus({"replay", run, "-o", page}).exit_code == 0);
        const std::string command = "cd '" + node + "' && node page.test.mjs '" + page +
                                    "' \"$(command -v chromium)\" > '" + said + "' 2>&1";
        const int status = std::system(command.c_str());
        INFO(contentOf(said));
        CHECK(status == 0);
        CHECK(contentOf(said).find("9 passed, 0 failed") != std::string::npos);
    }
}
