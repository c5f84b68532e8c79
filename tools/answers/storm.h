#pragma once
// The factor of safety over a rain: what `talus storm` computes, writes and says, and Python's function of
// that name.

#include <optional>
#include <string>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "report/figures.h"
#include "talus/formats/scenario.h"
#include "talus/storm.h"

namespace talus::tools {

struct StormRequest {
    StormSettings settings{};
    std::string plot, csv;  ///< files; empty: not written
};

/// Computes, and writes the files that are wanted. Throws BadInput, FileRefused.
StormResult stormOf(const formats::Scenario& scenario, const StormRequest& request, const Common& common,
                    const Control& control);

int exitCode(const StormResult& result);
Json stormJson(const StormResult& result, const formats::Scenario& scenario, const Common& common);
std::string stormText(const StormResult& result, const formats::Scenario& scenario);

/// A row a time. \param comments  whole lines above the header
std::string stormCsv(const StormResult& result, const std::string& comments);

/// Factor and level over time. \param scenario  in the title
Plot stormPlot(const StormResult& result, const std::string& scenario);

}  // namespace talus::tools
