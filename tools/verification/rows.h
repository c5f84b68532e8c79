#pragma once
// The rows of the verification manual: bench/verification/rows.csv and the scenarios it names, which travel
// in the program.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace talus::tools {

/// A computed quantity and its reference. Values are in the unit at the end of `quantity`.
struct VerificationRow {
    std::string section, name;
    std::string scenario;  ///< "paper/dry": in bench/, without .toml
    std::string set;       ///< a change of it: "[joint.default] friction_deg = 18.0"
    std::string quantity;  ///< "critical_angle_deg", ...: verification/compute.h
    double reference = 0;
    std::optional<double> low, high;  ///< the band; neither: reported, not judged
    bool ceiling_is_high = false;     ///< the band's upper end is that of limit analysis
    std::string kind;                 ///< closed_form, published, laboratory, bound
    double seconds = 0;               ///< approximate time on one core
    std::string source, others;       ///< source of the reference; results of other programs and tests
    std::optional<double> found;      ///< of a row that is known to be outside its band: the value it has
    std::string why;                  ///< and the reason, where it is known

    bool judged() const { return low.has_value(); }
};

/// Up to this a row belongs to --quick [s].
inline constexpr double kQuickSeconds = 3;

/// The table's rows. Throws BadInput with its line for one that is malformed.
std::vector<VerificationRow> readRows(std::string_view csv, const std::string& path);
std::vector<VerificationRow> verificationRows();  ///< those that travel in the program

/// The text of a row's scenario, with what it changes. Throws BadInput where there is none of this name.
std::string scenarioText(const VerificationRow& row);

/// "fissure-1", and for a changed one "fissure-1-friction_deg-18.0": a file's name without its ending.
std::string scenarioName(const VerificationRow& row);

}  // namespace talus::tools
