#pragma once
// The readers' queries of a document: keys that a table may and must have, and their allowed values. They
// describe the format: schema/explore.h lets the readers read and records the queries.

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "talus/interval.h"

namespace talus::formats::toml {

struct Bounds {
    std::int64_t min = 0;
    std::int64_t max = 0;
};

/// Values that a reader accepts under a key.
struct Asked {
    enum class Kind : std::uint8_t {
        number,
        integer,
        boolean,
        text,
        choice,  ///< one of some texts
        scalar,  ///< a number, a text or a boolean
        array,   ///< what its elements are is asked of them
        table,
        tables,        ///< [[key]]
        named_tables,  ///< [key.NAME]
        named_values   ///< key = { NAME = ... }
    };
    Kind kind = Kind::text;
    Interval range{};                     ///< of a number
    Bounds bounds{};                      ///< of an integer
    std::vector<std::string> choices{};   ///< of a choice
    std::optional<std::size_t> length{};  ///< of an array; any when nothing
};

/// The questions of any number of readings, by field: "stack[].columns", whatever the index.
class Questions {
 public:
    struct Table {
        std::vector<std::string> keys;
        std::optional<std::set<std::string>>
            required;                          ///< those asked for at every reading without such faults
        std::set<std::string> required_now{};  ///< at the reading that goes on
        bool faulty_now = false;
    };

    void ask(std::string_view field, Asked what);
    void read(std::string_view table, const std::vector<std::string>& keys);  ///< a reading begins
    void require(std::string_view table, std::string_view key);
    void fault(std::string_view field);  ///< of a wrong kind: what its table requires was not all asked for
    void finish();                       ///< all readings have come to their end

    const std::map<std::string, std::vector<Asked>>& asked() const { return asked_; }
    const std::map<std::string, Table>& tables() const { return tables_; }
    std::size_t count() const { return count_; }  ///< different questions so far

 private:
    static void close(Table& table);

    std::map<std::string, std::vector<Asked>> asked_;
    std::map<std::string, Table> tables_;
    std::size_t count_ = 0;
};

}  // namespace talus::formats::toml
