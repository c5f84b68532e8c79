#include "sweep/case_table.h"

#include "files/csv_line.h"
#include "toml/scalar_text.h"

namespace talus::formats::sweep {

namespace {

using Cell = CaseTable::Cell;

struct Line {
    std::string_view text;
    int number = 0;
};

std::vector<Line> linesOf(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // spreadsheets write a byte order mark
    std::vector<Line> lines;
    for (int number = 1; !text.empty(); ++number) {
        const auto length = std::min(text.find('\n'), text.size());
        const std::string_view line = withoutBlanks(text.substr(0, length));
        if (!line.empty() && !line.starts_with('#')) lines.push_back({text.substr(0, length), number});
        text.remove_prefix(std::min(length + 1, text.size()));
    }
    return lines;
}

class CaseReader {
 public:
    explicit CaseReader(const std::string& path) : path_(path) {}

    Result<CaseTable> read(std::string_view text) {
        const auto lines = linesOf(text);
        if (lines.size() < 2)
            return Error{"", "found no cases, allowed: a header and at least one row", path_};
        separator_ = separatorOf(lines.front().text);
        table_.header = cells(lines.front(), true);
        for (std::size_t i = 1; i < lines.size(); ++i) {
            auto row = cells(lines[i], false);
            if (row.size() != table_.header.size())
                fault(lines[i].number, 1,
                      "found " + std::to_string(row.size()) + " values, allowed: one per column, " +
                          std::to_string(table_.header.size()));
            table_.rows.push_back(std::move(row));
        }
        if (!errors_.empty()) return errors_;
        return std::move(table_);
    }

 private:
    void fault(int line, int column, std::string message) {
        if (errors_.size() < 50) errors_.push_back({"", std::move(message), path_, line, column});
    }

    /// A cell's text from `at` on; moves `at` behind the separator that ends it.
    std::string cellText(const Line& line, std::size_t& at, bool& was_quoted) {
        at = std::min(line.text.find_first_not_of(' ', at), line.text.size());
        was_quoted = at < line.text.size() && line.text[at] == '"';
        if (!was_quoted) {
            const auto end = std::min(line.text.find(separator_, at), line.text.size());
            const std::string text(withoutBlanks(line.text.substr(at, end - at)));
            at = end;
            return text;
        }
        std::string text;
        const std::size_t begin = at++;
        for (;; ++at) {
            if (at >= line.text.size()) {
                fault(line.number, static_cast<int>(begin) + 1,
                      "found a quote that does not end on its line");
                return text;
            }
            if (line.text[at] != '"')
                text += line.text[at];
            else if (line.text.substr(at, 2) == "\"\"")
                text += line.text[at++];
            else
                break;
        }
        at = std::min(line.text.find(separator_, at), line.text.size());
        return text;
    }

    std::vector<Cell> cells(const Line& line, bool as_text) {
        std::vector<Cell> row;
        for (std::size_t at = 0; at <= line.text.size(); ++at) {
            const int column = static_cast<int>(at) + 1;
            bool was_quoted = false;
            std::string text = cellText(line, at, was_quoted);
            if (text.empty()) fault(line.number, column, "found an empty cell, allowed: a value");
            if (std::string wrong = was_quoted ? "" : cellFault(text, separator_); !wrong.empty())
                fault(line.number, column, std::move(wrong));
            row.push_back({as_text || was_quoted ? SweepValue(std::move(text)) : toml::scalarOf(text),
                           line.number, column});
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
