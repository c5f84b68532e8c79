#pragma once
// The verification manual: rows as JSON, CSV and text, and the page.

#include <string>
#include <vector>

#include "cli/json.h"
#include "verification/compute.h"

namespace talus::tools {

struct Manual {
    std::vector<VerifiedRow> rows;
    bool quick = false, interrupted = false;
    double wall_seconds = 0;
    Json provenance;

    std::size_t outside() const;     ///< rows that are outside their bands
    std::size_t unexpected() const;  ///< rows that differ from the table: newly outside, or inside again
    std::size_t judged() const;
};

Json manualJson(const Manual& manual);
std::string manualCsv(const Manual& manual);
std::string manualText(const Manual& manual);  ///< a line a row, for the terminal

/// The report of the page (report/README.md); scenarios lie in the folder `scenarios` beside it.
Json manualReport(const Manual& manual);

/// Side view of a scenario (along y), turned by its tilt; blocks in the colours of their motion.
Json problemPicture(const VerifiedRow& row);

}  // namespace talus::tools
