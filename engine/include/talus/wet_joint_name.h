#pragma once
// Names of joints that searches derive for wet interfaces: "default@0.4wet" where 40 % of the area is wet.

#include <optional>
#include <string>
#include <string_view>

namespace talus {

struct WetJointName {
    std::string joint;  ///< as the scenario names it
    double share = 0;   ///< of the area that is wet, 0..1

    std::string text() const;  ///< "default@0.4wet"
};

/// Nothing where the name is not that of such a joint.
std::optional<WetJointName> readWetJointName(std::string_view name);

/// The name of any joint as people read it: "default (40 % wet)".
std::string jointText(const std::string& name);

}  // namespace talus
