#pragma once
// Made-up rows for the tests of what a batch says.

#include "batch/summary.h"

namespace talus::tools::batch::samples {

inline std::string lineOf(const Row& cells) {
    std::string line = csvLine(cells);
    line.pop_back();
    return line;
}

/// Two cases of ten samples: the answer is the friction angle less the case's depth.
inline StoredBatch madeUp() {
    using Role = Column::Role;
    StoredBatch batch;
    BatchInfo& info = batch.info;
    info.analysis = "critical-angle";
    info.runs = 20;
    info.cases = 2;
    info.samples = 10;
    info.thresholds = {14.5, 1, 40};
    for (const char* name : {"run", "case", "sample"})
        info.columns.push_back({name, "integer", "", "", Role::key});
    info.columns.push_back({"water[0].depth", "number", "m", "", Role::varied, "grid"});
    info.columns.push_back({"phi", "number", "deg", "", Role::varied, "random"});
    info.columns.push_back({"status", "string", "", ""});
    for (const char* name : {"critical_angle_deg", "bracket_low_deg", "bracket_high_deg"})
        info.columns.push_back({name, "number", "deg", ""});
    for (const char* name : {"failure_mode", "reason"}) info.columns.push_back({name, "string", "", ""});
    for (int run = 0; run < 20; ++run) {
        const int depth = run % 2, sample = run / 2, angle = 10 + sample - depth;
        batch.lines[static_cast<std::uint64_t>(run)] =
            lineOf({std::to_string(run), std::to_string(depth), std::to_string(sample), std::to_string(depth),
                    std::to_string(10 + sample), "found", std::to_string(angle), std::to_string(angle - 1),
                    std::to_string(angle + 1), sample < 3 ? "toppling" : "sliding", ""});
    }
    return batch;
}

}  // namespace talus::tools::batch::samples
