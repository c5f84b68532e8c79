#pragma once
// The support required for a factor of safety: the pretension of bolts, or the number of bolts of a pattern.

#include <optional>
#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/json_fwd.h"
#include "talus/analysis.h"
#include "talus/formats/scenario.h"

namespace talus::tools {

enum class DesignedBy : std::uint8_t {
    pretension,  ///< each bolt pulls with one share of its yield force from the start, and with no more
    number       ///< the spacing of a pattern, along and up alike; in the end one of the two
};

struct SupportQuestion {
    double factor = 1.5;  ///< of safety that is wanted
    DesignedBy by = DesignedBy::pretension;
    std::string bolt{};        ///< a bolt or a pattern by its name; empty: all of them
    double tolerance = 0.005;  ///< width of the bracket of the pretension, over the yield force
};

/// The factor of safety with one amount of support.
struct SupportTrial {
    double amount = 0;  ///< share of the yield force, or factor on the pattern's spacing along
    double up = 0;      ///< factor on the pattern's spacing up
    double spacing_along = 0, spacing_up = 0;  ///< of the pattern: what the slope has room for [m]
    std::size_t bolts = 0;                     ///< that are asked about
    SearchStatus status = SearchStatus::undecided;
    double factor =
        0;  ///< infinite where it is stable up to the largest factor tried, 0 where it falls whatever the
            ///< strength
    std::vector<std::string> warnings{};  ///< of its search
};

struct SupportDesign {
    enum class Status : std::uint8_t { found, not_needed, not_reached, undecided, interrupted };
    Status status = Status::undecided;
    std::vector<SupportTrial> trials;
    std::optional<SupportTrial> enough, too_little;  ///< the least sufficient amount, and the next below it
    std::vector<std::string> warnings;               ///< of the search that decides
    double yield_force = 0;                          ///< of the bolts, where they are alike; else 0 [N]
    double spacing_along = 0, spacing_up = 0;        ///< as the scenario has it [m]
    double width = 0, height = 0;                    ///< of the faces with the pattern, along and up [m]
    std::vector<std::string> sets;                   ///< of --set: the scenario with the sufficient amount
    double wall_seconds = 0;
};

/// Throws BadInput: no such bolts, faults of the model.
SupportDesign designSupport(const SupportQuestion& question, const formats::Scenario& scenario,
                            const Control& control);

const char* toString(SupportDesign::Status status);
int exitCode(const SupportDesign& design);
Json supportDesignJson(const SupportQuestion& question, const SupportDesign& design,
                       const formats::Scenario& scenario, const Common& common);
std::string supportDesignText(const SupportQuestion& question, const SupportDesign& design,
                              const formats::Scenario& scenario);

}  // namespace talus::tools
