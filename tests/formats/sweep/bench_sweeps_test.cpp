// The sweeps of this repository: all of them are good.

#include <doctest/doctest.h>

#include <filesystem>

#include "talus/formats/sweep.h"

namespace talus::formats {

TEST_CASE("every sweep under bench/ reads, and its last run is a scenario") {
    const std::filesystem::path bench = std::filesystem::path(TALUS_SOURCE_DIR) / "bench";
    int sweeps = 0;
    for (const char* folder : {"sweeps", "paper/sweeps"})
        for (const auto& file : std::filesystem::directory_iterator(bench / folder)) {
            const std::string name = file.path().filename().string();
            if (file.path().extension() != ".toml" || name == "slope.toml") continue;
            CAPTURE(name);
            const auto sweep = readSweep(file.path().string());
            for (const Error& error : sweep.errors()) FAIL_CHECK(format(error));
            REQUIRE(sweep.ok());
            CHECK(sweep->runs() > 1);
            CHECK(scenarioOf(*sweep, runOf(*sweep, sweep->runs() - 1)).ok());
            ++sweeps;
        }
    CHECK(sweeps >= 5);
}

}  // namespace talus::formats
