#pragma once
// The values of the verification manual. The rows of a scenario share its computations.
//
//   critical_angle_deg, safety_factor, critical_k   the answer of a search (its answer_key)
//   decided                                         of the factor of safety: 1 equilibrium or failure was
//                                                   found, 0 neither
//   falls_at_start                                  of the critical angle: 1 it falls where the search
//                                                   starts, 0 it is stable there
//   limit_tilt_deg, limit_factor, limit_horizontal  the middle of limit analysis's bracket
//   speed_m_s, way_m                                of the first watched block, at the end of a time history
//   lowest_at_s, velocity_kept                      of a block that rocks: when its centroid is lowest, and
//                                                   the share of its velocity there left after the impact
//   pull_stiffness_n_m, most_force_n                of the first support: its force over the displacement of
//                                                   that block, and its greatest
//   energy_change, energy_gain                      largest change, and largest gain between two frames, of
//                                                   the kinetic, elastic and gravity energy, over the
//                                                   largest kinetic one
//   discharge_m3_s                                  of steady flow, into the network
//   level_m                                         of the first water whose level changes, when its tables
//                                                   end

#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "talus/analysis.h"
#include "talus/formats/scenario.h"
#include "verification/rows.h"

namespace talus::tools {

/// Results of one scenario by one analysis.
struct Computed {
    formats::Scenario scenario;
    std::map<std::string, double> values;  ///< by quantity; without those not found
    std::string status;                    ///< of the analysis, or an error
    std::vector<BlockMotion> motions;      ///< of a search: how blocks move at failure
    double load = 0;                       ///< of a search: the answer, in SI units
    double wall_seconds = 0;
};

struct VerifiedRow {
    VerificationRow what;
    std::optional<double> value, high;  ///< the band's upper end
    std::shared_ptr<const Computed> computed;

    double difference() const { return *value - what.reference; }
    /// Inside its band; always true for reported rows without a band.
    bool ok() const { return !what.judged() || (value && high && *value >= *what.low && *value <= *high); }
    /// As the table says: inside, or outside with the value it states, within a quarter of the band.
    bool asStated() const {
        if (!what.found) return ok();
        return !ok() && value && high && std::abs(*value - *what.found) <= 0.25 * (*high - *what.low);
    }
};

/// Computes all rows, costly ones first, each in one of the threads. After `stop` rows not computed are left
/// out.
std::vector<VerifiedRow> verify(const std::vector<VerificationRow>& rows, int threads,
                                const std::atomic<bool>& stop,
                                const std::function<void(const Progress&)>& progress);

}  // namespace talus::tools
