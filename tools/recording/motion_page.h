#pragma once
// The page of a time history: displacements over time above the ground motion, and the permanent
// displacements, block by block.

#include <optional>
#include <string>
#include <vector>

#include "cli/json_fwd.h"
#include "talus/formats/scenario.h"
#include "talus/simulation.h"

namespace talus::tools {

/// Follows a run for its page.
class MotionWatch {
 public:
    /// The same output, observed by the watch; it must outlive the watch.
    RunOutput watching(RunOutput output);

    /// The report, as report/README.md documents it.
    Json report(const formats::Scenario& scenario, const RunResult& result, const Json& provenance) const;

 private:
    struct Instant {
        double time = 0;                   ///< [s]
        std::vector<double> displacement;  ///< of the watched blocks [m]
        double kinetic_energy = 0;         ///< [J]
        std::vector<double> supports;      ///< forces [N]
        std::optional<Vec3> ground;        ///< its acceleration [m/s^2]
    };
    struct Farthest {
        double time = 0, displacement = 0;  ///< of all blocks [s], [m]
    };

    Json displacements(const formats::Scenario& scenario) const;
    Json supports() const;
    Json record() const;
    void overItsTime(Json& plot) const;

    std::vector<Instant> instants_;
    std::vector<Farthest> farthest_;
    std::vector<std::string> support_names_;
};

}  // namespace talus::tools
