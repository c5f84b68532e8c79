#pragma once
// The laboratory's scatter, computed: every interface draws its own friction angle from the range measured on
// the model's blocks. Many samples, dry and with water in each fissure, stand beside the three laboratory
// repeats.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "report/figures.h"

namespace talus::tools {

struct ScatterCase {
    int fissure = 0;                      ///< 0: dry
    std::array<double, 3> repeats_deg{};  ///< of the laboratory
    std::uint64_t runs = 0, failed = 0;   ///< failed: no answer
    std::vector<double> angles_deg;       ///< sorted
};

struct Scatter {
    std::uint64_t samples = 0;
    std::vector<ScatterCase> cases;  ///< in the order of the laboratory's table
    double cpu_seconds = 0;
    bool complete = false;
};

/// Computes `samples` samples of bench/paper/sweeps/laboratory-scatter.toml in `folder`, where sweep,
/// scenario and rows stay: the same call continues where it was stopped. Throws FileRefused, BadInput.
Scatter computeScatter(std::uint64_t samples, const std::string& folder, const Common& common);

Json scatterJson(const Scatter& scatter);
Plot plotScatter(const Scatter& scatter);
Json scatterSection(const Scatter& scatter);  ///< of the page

}  // namespace talus::tools
