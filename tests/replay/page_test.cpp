// The replay page in a browser: page.test.mjs opens it in headless Chromium.

#include <doctest/doctest.h>

#include "support/browser.h"
#include "support/skip.h"
#include "support/snapshots.h"
#include "tools/program.h"

using namespace talus::tools::testing;

namespace {

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
        const TemporaryFolder folder;
        const std::string run = folder / "slope.mcap", page = folder / "slope.html";
        REQUIRE(runTalus({"run", folder.write("slope.toml", slopeText()), "-o", run, "--quiet"}).exit_code ==
                0);
        REQUIRE(runTalus({"replay", run, "-o", page}).exit_code == 0);
        const ScriptOutcome seen = runScript("replay/page.test.mjs", "'" + page + "' \"$CHROMIUM\"");
        if (seen.is_skipped)
            return talus::test::skip("node, npm, chromium or playwright-core are not to be had here");
        INFO(seen.said);
        CHECK(seen.status == 0);
        CHECK(seen.said.find("9 passed, 0 failed") != std::string::npos);
    }
}
