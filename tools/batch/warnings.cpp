#include "batch/warnings.h"

#include <algorithm>
#include <cctype>

namespace talus::tools::batch {

namespace {

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// Whether a digit behind it belongs to a name.
bool isOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '['; }

std::size_t endOfDigits(std::string_view text, std::size_t at) {
    while (at < text.size() && isDigit(text[at])) ++at;
    return at;
}

/// Where the number ends that begins here: 12, 0.5, 1.2e-05.
std::size_t endOfNumber(std::string_view text, std::size_t at) {
    at = endOfDigits(text, at);
    if (at + 1 < text.size() && text[at] == '.' && isDigit(text[at + 1])) at = endOfDigits(text, at + 1);
    if (at >= text.size() || text[at] != 'e') return at;
    const std::size_t exponent =
        at + 1 + (at + 1 < text.size() && (text[at + 1] == '-' || text[at + 1] == '+'));
    const std::size_t end = endOfDigits(text, exponent);
    return end > exponent ? end : at;
}

bool endsWithSign(const std::string& text) {
    return !text.empty() && text.back() == '-' && (text.size() == 1 || text[text.size() - 2] == ' ');
}

}  // namespace

std::string withoutNumbers(std::string_view warning) {
    std::string text;
    bool quoted = false;
    for (std::size_t at = 0; at < warning.size();) {
        const char c = warning[at];
        if (c == '"') quoted = !quoted;
        const bool of_name = !quoted && at > 0 && isOfName(warning[at - 1]);
        if (!isDigit(c) || of_name) {
            text += c;
            ++at;
            continue;
        }
        if (endsWithSign(text)) text.pop_back();
        text += '#';
        at = endOfNumber(warning, at);
    }
    return text;
}

void WarningCount::add(std::uint64_t run, std::string_view cell) {
    const std::string_view between = kBetweenWarnings;
    while (!cell.empty()) {
        const std::size_t end = std::min(cell.find(between), cell.size());
        addOne(run, cell.substr(0, end));
        cell.remove_prefix(std::min(end + between.size(), cell.size()));
    }
}

void WarningCount::addOne(std::uint64_t run, std::string_view text) {
    const auto [place, is_new] = places_.try_emplace(withoutNumbers(text), counted_.size());
    if (is_new) {
        counted_.push_back({{std::string(text), run, 1, false}, run});
        return;
    }
    Counted& counted = counted_[place->second];
    if (counted.last != run) ++counted.group.runs;
    counted.last = run;
    counted.group.differs = counted.group.differs || counted.group.text != text;
}

std::vector<WarningGroup> WarningCount::groups() const {
    std::vector<WarningGroup> groups;
    for (const Counted& counted : counted_) groups.push_back(counted.group);
    std::stable_sort(groups.begin(), groups.end(),
                     [](const auto& a, const auto& b) { return a.runs > b.runs; });
    return groups;
}

std::string warningLine(const WarningGroup& group, std::uint64_t of) {
    return std::to_string(group.runs) + " of " + std::to_string(of) + (of == 1 ? " run" : " runs") +
           (group.differs ? ", with the numbers of run " + std::to_string(group.first) : "") + ": " +
           group.text;
}

std::string warningLines(const std::vector<WarningGroup>& groups, std::uint64_t of) {
    std::string lines;
    for (std::size_t k = 0; k < std::min(groups.size(), kMostWarningsShown); ++k)
        lines += "warning: " + warningLine(groups[k], of) + "\n";
    const std::string more = moreWarnings(groups);
    return more.empty() ? lines : lines + "warning: " + more + "\n";
}

std::string moreWarnings(const std::vector<WarningGroup>& groups) {
    if (groups.size() <= kMostWarningsShown) return "";
    return "and " + std::to_string(groups.size() - kMostWarningsShown) + " more in the column " + kWarnings +
           " of results.csv";
}

}  // namespace talus::tools::batch
