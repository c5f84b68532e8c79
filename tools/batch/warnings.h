#pragma once
// Warnings of a batch's runs: each distinct text once, with the number of runs that have it.

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace talus::tools::batch {

/// Of the column with a run's warnings, and between two of them.
inline constexpr const char *kWarnings = "warnings", *kBetweenWarnings = " | ";
inline constexpr std::size_t kMostWarningsShown = 20;  ///< on the console and the page

/// Runs whose warnings differ by numbers alone.
struct WarningGroup {
    std::string text;         ///< as in the first of these runs
    std::uint64_t first = 0;  ///< number of that run
    std::uint64_t runs = 0;
    bool differs = false;  ///< another run has other numbers in it
};

/// A warning with "#" in place of numbers. Digits of names stay ("water[0]", "J1"); in quotes, where blocks are
/// named by row and column, all are replaced.
std::string withoutNumbers(std::string_view warning);

/// Counts the runs of each warning.
class WarningCount {
 public:
    /// \param cell  the column of a run. \pre runs come in ascending order
    void add(std::uint64_t run, std::string_view cell);
    std::vector<WarningGroup> groups() const;  ///< the most frequent first, then by run

 private:
    struct Counted {
        WarningGroup group;
        std::uint64_t last = 0;
    };
    void addOne(std::uint64_t run, std::string_view text);

    std::vector<Counted> counted_;
    std::unordered_map<std::string, std::size_t> places_;  ///< by the text without numbers
};

/// "3 of 6 runs: TEXT"
std::string warningLine(const WarningGroup& group, std::uint64_t of);

/// Lines of the console; empty without warnings.
std::string warningLines(const std::vector<WarningGroup>& groups, std::uint64_t of);

/// "and 4 more in the column warnings of results.csv", or nothing where all are shown.
std::string moreWarnings(const std::vector<WarningGroup>& groups);

}  // namespace talus::tools::batch
