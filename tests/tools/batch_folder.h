#pragma once
// Batches in folders of their own, and what they left there.

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "batch/rows.h"
#include "tools/program.h"

namespace talus::tools::testing {

using batch::Row;

inline const std::string kGrid = "[[grid]]\nfield = \"joint.default.friction_deg\"\nvalues = [10.0, 15.0]\n";

inline std::string draws(int samples) {
    return "samples = " + std::to_string(samples) +
           "\n[[random]]\nfield = \"joint.default.friction_deg\"\ndistribution = \"uniform\"\nmin = 10\nmax "
           "= 14\n";
}

/// A folder with a scenario and a sweep over it.
struct BatchFolder {
    explicit BatchFolder(const std::string& sweep, const std::string& analysis = "critical-angle",
                         const std::string& scenario = blockScenario(0, 12)) {
        folder.write("block.toml", scenario);
        path = folder.write("sweep.toml",
                            "scenario = \"block.toml\"\nanalysis = \"" + analysis + "\"\n" + sweep);
    }
    std::vector<std::string> command(std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments = {"batch", path, "-o", out(), "--json", "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
    Outcome run(std::vector<std::string> more = {}) const { return runTalus(command(std::move(more))); }
    std::string out() const { return folder / "out"; }

    TemporaryFolder folder;
    std::string path;
};

inline std::vector<std::string> linesOf(const std::string& path) {
    std::stringstream text(contentOf(path));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

/// Rows by run, without what depends on the clock. Every run once, every row whole.
inline std::map<int, std::string> rowsOf(const std::string& path) {
    const auto lines = linesOf(path);
    REQUIRE(!lines.empty());
    const Row header = csvFields(lines[0]);
    const auto time = std::find(header.begin(), header.end(), "cpu_seconds") - header.begin();
    std::map<int, std::string> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        Row cells = csvFields(lines[i]);
        REQUIRE(cells.size() == header.size());
        cells[static_cast<std::size_t>(time)].clear();
        CHECK(rows.emplace(std::stoi(cells[0]), csvLine(cells)).second);
    }
    return rows;
}

inline std::size_t rowCount(const std::string& path) {
    const std::string text = contentOf(path);
    const auto feeds = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    return feeds > 0 ? feeds - 1 : 0;
}

}  // namespace talus::tools::testing
