#pragma once
// Supports, the reinforcement that holds blocks beside contacts, as results list them: bolts.

#include <string>
#include <vector>

namespace talus {

/// An event of a support: {"slipped", "slipped in its grout", true}.
struct SupportSign {
    std::string key;   ///< in JSON
    std::string text;  ///< in text
    bool is = false;

    bool operator==(const SupportSign&) const = default;
};

/// One support at its section of largest force.
struct SupportReport {
    std::string name;
    double force = 0;        ///< [N]
    double utilisation = 0;  ///< force over what it can carry there, 0..1
    bool broken = false;     ///< somewhere
    std::vector<SupportSign> signs{};

    bool operator==(const SupportReport&) const = default;
};

/// All supports of one kind, in the model's order. A result has one list for each kind, empty when the model
/// has none.
struct Supports {
    std::string kind;  ///< name of the list in results: "bolts"
    std::vector<SupportReport> reports;
};

}  // namespace talus
