#pragma once
// What holds blocks in place beside contacts, as results say it: bolts.

#include <string>
#include <vector>

namespace talus {

/// Something that a support has or has not done: {"slipped", "slipped in its grout", true}.
struct SupportSign {
    std::string key;   ///< in JSON
    std::string text;  ///< for people
    bool is = false;

    bool operator==(const SupportSign&) const = default;
};

/// One support as it stands, where it carries most.
struct SupportReport {
    std::string name;
    double force = 0;        ///< [N]
    double utilisation = 0;  ///< force over what it can carry there, 0..1
    bool broken = false;     ///< somewhere
    std::vector<SupportSign> signs{};

    bool operator==(const SupportReport&) const = default;
};

/// All of one kind, in the model's order. A result has one for each kind there is, empty when the model has
/// none of it.
struct Supports {
    std::string kind;  ///< as results call the list of them: "bolts"
    std::vector<SupportReport> reports;
};

}  // namespace talus
