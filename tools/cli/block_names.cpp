#include "cli/block_names.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace talus::tools {

namespace {

struct Item {
    std::string text;
    std::size_t blocks = 1;
};

using Cells = std::set<std::pair<int, int>>;  ///< (row, slice)

/// Takes "<letter><digits>" off the end of `name`.
std::optional<int> takeNumber(std::string& name, char letter) {
    const std::size_t at = name.rfind(letter);
    if (at == std::string::npos || at + 1 == name.size()) return std::nullopt;
    int value = 0;
    const char* end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + at + 1, end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    name.resize(at);
    return value;
}

std::string range(char letter, int low, int high) {
    return letter + std::to_string(low) + (high > low ? "-" + std::to_string(high) : "");
}

/// " r1-5 s1-3" for each full rectangle of cells: rows with the same run of slices are merged.
std::vector<Item> rectangles(const Cells& cells) {
    struct Run {
        int low_row, high_row, low_slice, high_slice;
    };
    std::vector<Run> runs;
    for (const auto& [row, slice] : cells) {
        if (!runs.empty() && runs.back().low_row == row && runs.back().high_slice + 1 == slice) {
            runs.back().high_slice = slice;
        } else {
            runs.push_back({row, row, slice, slice});
        }
    }
    std::vector<Run> merged;
    for (const Run& run : runs) {
        const auto below = std::find_if(merged.begin(), merged.end(), [&run](const Run& other) {
            return other.high_row + 1 == run.low_row && other.low_slice == run.low_slice &&
                   other.high_slice == run.high_slice;
        });
        if (below != merged.end()) {
            below->high_row = run.high_row;
        } else {
            merged.push_back(run);
        }
    }
    std::vector<Item> items;
    for (const Run& run : merged)
        items.push_back(
            {" " + range('r', run.low_row, run.high_row) + " " + range('s', run.low_slice, run.high_slice),
             static_cast<std::size_t>(run.high_row - run.low_row + 1) *
                 static_cast<std::size_t>(run.high_slice - run.low_slice + 1)});
    return items;
}

/// Neighbouring columns with the same cells become one range.
std::vector<Item> boxes(const std::string& prefix, const std::map<int, Cells>& columns) {
    std::vector<Item> items;
    for (auto first = columns.begin(); first != columns.end();) {
        auto last = first;
        for (auto next = std::next(first);
             next != columns.end() && next->first == last->first + 1 && next->second == first->second; ++next)
            last = next;
        const auto count = static_cast<std::size_t>(last->first - first->first + 1);
        for (const Item& cells : rectangles(first->second))
            items.push_back(
                {prefix + range('c', first->first, last->first) + cells.text, count * cells.blocks});
        first = std::next(last);
    }
    return items;
}

struct Range {
    int low = 0, high = 0;
};

/// Takes "<letter><digits>" or "<letter><digits>-<digits>" off the end of `text`.
std::optional<Range> takeRange(std::string& text, char letter) {
    std::string rest = text;
    const std::size_t dash = rest.find_last_not_of("0123456789");
    std::optional<int> high;
    if (dash != std::string::npos && rest[dash] == '-') {
        high = takeNumber(rest, '-');
        if (!high) return std::nullopt;
    }
    const auto low = takeNumber(rest, letter);
    if (!low || (high && *high < *low)) return std::nullopt;
    text = std::move(rest);
    return Range{*low, high.value_or(*low)};
}

bool takeBlank(std::string& text) {
    if (text.empty() || text.back() != ' ') return false;
    text.pop_back();
    return true;
}

/// The names of "<prefix>c1-7 r1-5 s1-3"; other items are names.
void expand(const std::string& item, std::vector<std::string>& names) {
    std::string prefix = item;
    const auto slices = takeRange(prefix, 's');
    const bool blank = takeBlank(prefix);
    const auto rows = takeRange(prefix, 'r');
    const bool another = takeBlank(prefix);
    const auto columns = takeRange(prefix, 'c');
    if (!slices || !blank || !rows || !another || !columns) return names.push_back(item);
    for (int c = columns->low; c <= columns->high; ++c)
        for (int r = rows->low; r <= rows->high; ++r)
            for (int s = slices->low; s <= slices->high; ++s)
                names.push_back(prefix + "c" + std::to_string(c) + "r" + std::to_string(r) + "s" +
                                std::to_string(s));
}

}  // namespace

std::optional<StackName> stackName(std::string name) {
    const auto slice = takeNumber(name, 's');
    const auto row = slice ? takeNumber(name, 'r') : std::nullopt;
    const auto column = row ? takeNumber(name, 'c') : std::nullopt;
    if (!column) return std::nullopt;
    return StackName{name, *column, *row, *slice};
}

std::string compactNames(const std::vector<std::string>& names, std::size_t limit) {
    std::vector<std::pair<std::string, std::map<int, Cells>>> stacks;  // in the order of the names
    std::unordered_map<std::string, std::size_t> place;
    std::vector<Item> items, others;
    for (const std::string& name : names) {
        if (const auto cell = stackName(name)) {
            const auto [known, is_new] = place.emplace(cell->prefix, stacks.size());
            if (is_new) stacks.push_back({cell->prefix, {}});
            stacks[known->second].second[cell->column].emplace(cell->row, cell->slice);
        } else {
            others.push_back({name});
        }
    }
    for (const auto& [prefix, columns] : stacks)
        for (Item& item : boxes(prefix, columns)) items.push_back(std::move(item));
    items.insert(items.end(), others.begin(), others.end());

    std::string text;
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i >= limit) {
            left_out += items[i].blocks;
        } else {
            text += (i > 0 ? ", " : "") + items[i].text;
        }
    }
    return left_out > 0
               ? text + " and " + std::to_string(left_out) + (left_out == 1 ? " more block" : " more blocks")
               : text;
}

std::vector<std::string> expandedNames(std::string_view list) {
    constexpr std::string_view kBetween = ", ";
    std::vector<std::string> names;
    while (!list.empty()) {
        const std::size_t end = list.find(kBetween);
        expand(std::string(list.substr(0, end)), names);
        list.remove_prefix(end == std::string_view::npos ? list.size() : end + kBetween.size());
    }
    return names;
}

}  // namespace talus::tools
