#pragma once
// A sweep over a small slope, in a folder of its own.

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "formats/scenario/scenario_texts.h"
#include "support/files.h"
#include "talus/formats/sweep.h"

namespace talus::formats {

inline std::string slope() { return properties() + stack() + "[[water]]\nfissure = 1\ndepth = 0.05\n"; }

struct SweepFile {
    explicit SweepFile(const std::string& text, const std::string& scenario = slope()) {
        folder.write("slope.toml", scenario);
        path = folder.write("sweep.toml", text);
    }
    Sweep read() const {
        auto sweep = readSweep(path);
        for (const Error& error : sweep.errors()) FAIL_CHECK(format(error));
        REQUIRE(sweep.ok());
        return *sweep;
    }
    /// "LINE:COLUMN FIELD: MESSAGE" of the first error.
    std::string fault() const {
        const auto sweep = readSweep(path);
        if (sweep.ok()) return "none";
        const Error& error = sweep.errors().front();
        return std::filesystem::path(error.file).filename().string() + ":" + std::to_string(error.line) +
               ":" + std::to_string(error.column) + " " + error.field + ": " + error.message;
    }
    test::TemporaryFolder folder;
    std::string path;
};

}  // namespace talus::formats
