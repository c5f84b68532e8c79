#include "sweep/case_table.h"

#include "files/csv_line.h"
#include "toml/scalar_text.h"

namespace talus::formats::sweep {

namespace {

using Cell = CaseTable::Cell;

class CaseReader {
 public:
    explicit CaseReader(const std::string& path) : path_(path) {}

    Result<CaseTable> read(std::string_view text) {
        CsvLines lines(text);
        if (lines.next()) {
            separator_ = separatorOf(lines.line());
            table_.header = cells(lines, true);
        }
        while (lines.next()) {
            auto row = cells(lines, false);
            if (row.size() != table_.header.size())
                fault(lines.number(), 1,
                      "found " + std::to_string(row.size()) + " values, allowed: one per column, " +
                          std::to_string(table_.header.size()));
            table_.rows.push_back(std::move(row));
        }
        if (table_.rows.empty())
            return Error{"", "found no cases, allowed: a header and at least one row", path_};
        if (!errors_.empty()) return errors_;
        return std::move(table_);
    }

 private:
    void fault(int line, int column, std::string message) {
        if (errors_.size() < 50) errors_.push_back({"", std::move(message), path_, line, column});
    }

    std::vector<Cell> cells(const CsvLines& lines, bool as_text) {
        std::vector<Cell> row;
        for (CsvCell& cell : cellsOf(lines.line(), separator_)) {
            if (!cell.closed)
                fault(lines.number(), cell.column, "found a quote that does not end on its line");
            else if (cell.text.empty())
                fault(lines.number(), cell.column, "found an empty cell, allowed: a value");
            if (std::string wrong = cell.quoted ? "" : cellFault(cell.text, separator_); !wrong.empty())
                fault(lines.number(), cell.column, std::move(wrong));
            row.push_back(
                {as_text || cell.quoted ? SweepValue(std::move(cell.text)) : toml::scalarOf(cell.text),
                 lines.number(), cell.column});
        }
        return row;
    }

    const std::string& path_;
    char separator_ = ',';
    CaseTable table_;
    std::vector<Error> errors_;
};

}  // namespace

Result<CaseTable> parseCases(const std::string& text, const std::string& path) {
    return CaseReader(path).read(text);
}

}  // namespace talus::formats::sweep
