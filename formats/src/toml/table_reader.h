#pragma once
// Typed access to one table of a scenario. Every read checks the type and the range. It reports a fault at
// its place and then returns nothing, so that reading continues and all faults are found in one pass.

#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "talus/interval.h"
#include "talus/polyhedron.h"
#include "toml/document.h"
#include "toml/report.h"

namespace talus::formats::toml {

std::string allowedText(const Interval& interval);  ///< "greater than 0 and at most 10"

inline constexpr double kMaxLength =
    1e6;  ///< [m]; far beyond any slope, near enough that sums stay exact to 1e-9 m

inline constexpr Interval kAnyNumber{};
inline constexpr Interval kPositive = Interval::positive();
inline constexpr Interval kNotNegative = Interval::notNegative();
inline constexpr Interval kLength{0, kMaxLength};                              ///< [m]
inline constexpr Interval kCoordinate{-kMaxLength, kMaxLength, false, false};  ///< [m]
inline constexpr Interval kSize{0, kMaxLength, true, false};                   ///< [m]
inline constexpr Interval kTiltDeg{-90, 90, true, true};

inline constexpr double kRadPerDeg = 3.14159265358979323846 / 180;

/// A table with its field ("stack[0]", "joint.default") and the last part of that, when it is a name.
struct FieldNode {
    std::string field;
    std::string name;
    Node node;
};

/// "FIELD: found VALUE; is it in UNIT?" of a number that is allowed; empty where it looks like no other unit.
std::string mixUpWarning(const std::string& field, const std::string& found, double value,
                         const UnitMixUp& mix_up);

// One node each; `field` names it in messages. A number that looks like another unit is reported so: beside
// the fault, or as a warning where it is allowed.
std::optional<double> readNumber(Report& report, Node node, const std::string& field, const Interval& range,
                                 const UnitMixUp& mix_up = {});
std::optional<std::int64_t> readInteger(Report& report, Node node, const std::string& field, Bounds bounds);
std::optional<std::string> readText(Report& report, Node node, const std::string& field);
/// \param length the number of elements wanted, any when nothing
std::optional<std::vector<double>> readNumbers(Report& report, Node node, const std::string& field,
                                               const Interval& range, std::optional<std::size_t> length);
std::optional<Vec3> readVector(Report& report, Node node, const std::string& field, const Interval& range);

/// Records the query, if wanted.
template <class What>
void ask(Report& report, const std::string& field, const What& what) {
    if (report.questions() != nullptr) report.questions()->ask(field, what());
}

/// Adds `found X, allowed: Y`.
void reportFound(Report& report, Node node, const std::string& field, const std::string& allowed);

class TableReader {
 public:
    /// Reports the keys that are not among `allowed`. \pre `table` is a table
    TableReader(Report& report, Node table, std::string field, std::vector<std::string> allowed);

    const std::string& field() const { return field_; }
    std::string fieldOf(std::string_view key) const;
    Place place() const { return place_; }
    Place placeOf(std::string_view key) const;  ///< of the key's value, else of the table

    bool has(std::string_view key) const { return table_.find(key).has_value(); }
    std::optional<Node> find(std::string_view key) const { return table_.find(key); }

    bool isMeant(std::string_view key) const;  ///< an unknown key is near to this absent one

    /// Reports those of `keys` that are missing, unless a misspelt key shows what was meant.
    void require(std::initializer_list<std::string_view> keys);
    void error(std::string_view key, std::string message);

    /// True if exactly one of `keys` is there; else that is reported, unless a misspelt key shows what was
    /// meant.
    bool requireOneOf(const std::vector<std::string>& keys);
    std::vector<std::string> present(
        const std::vector<std::string>& keys) const;  ///< those of `keys` that are there

    // Nothing when the key is missing or its value is not allowed (which is then reported).
    std::optional<double> number(std::string_view key, const Interval& range, const UnitMixUp& mix_up = {});
    std::optional<std::int64_t> integer(std::string_view key, Bounds bounds);
    std::optional<bool> boolean(std::string_view key);
    std::optional<std::string> text(std::string_view key);
    std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string>& allowed);
    std::optional<Vec3> vector(std::string_view key, const Interval& range);
    std::optional<std::vector<double>> numbers(std::string_view key, const Interval& range,
                                               std::optional<std::size_t> length);
    std::optional<std::vector<std::string>> texts(std::string_view key, std::optional<std::size_t> length);
    std::optional<Node> array(std::string_view key);
    std::optional<TableReader> table(std::string_view key, std::vector<std::string> allowed);
    std::vector<FieldNode> tables(std::string_view key);       ///< the elements of an array of tables
    std::vector<FieldNode> namedTables(std::string_view key);  ///< [key.NAME]: in the order of the file

    /// Names of blocks and stacks end up in tables and files: short, and without control characters.
    std::optional<std::string> name(std::string_view key, bool may_be_empty);

 private:
    /// Also of a key that is not there.
    template <class What>
    void ask(std::string_view key, const What& what) const {
        if (report_.questions() != nullptr) report_.questions()->ask(fieldOf(key), what());
    }

    Report& report_;
    Node table_;
    Place place_;
    std::string field_;
    std::vector<std::string> meant_;  ///< keys that misspelt ones stand for
};

}  // namespace talus::formats::toml
