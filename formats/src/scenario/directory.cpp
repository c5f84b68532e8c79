#include "scenario/directory.h"

#include <algorithm>
#include <charconv>
#include <unordered_set>

namespace talus::formats::scenario {

namespace {

constexpr std::size_t kMaxCandidates = 5000;  // names looked through for "did you mean"

/// A name of the form PREFIXc<column>r<row>s<slice>, taken apart; 1-based as written.
struct StackName {
    std::string prefix;
    int column = 0, row = 0, slice = 0;
};

/// Takes `letter` and the number behind it off the end of `text`; no leading zeros, so that names are unique.
bool takeNumber(std::string_view& text, char letter, int& value) {
    const auto at = text.rfind(letter);
    if (at == std::string_view::npos || at + 1 == text.size() || text[at + 1] == '0') return false;
    const char* end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + at + 1, end, value);
    if (read.ec != std::errc() || read.ptr != end || value < 1) return false;
    text = text.substr(0, at);
    return true;
}

std::optional<StackName> splitStackName(std::string_view name) {
    StackName parts;
    if (!takeNumber(name, 's', parts.slice) || !takeNumber(name, 'r', parts.row) ||
        !takeNumber(name, 'c', parts.column))
        return std::nullopt;
    parts.prefix = std::string(name);
    return parts;
}

/// Prefix of the stack that would own this name.
std::optional<std::string> stackPrefix(const std::string& name) {
    constexpr std::string_view kFloor = "floor";
    if (const auto parts = splitStackName(name)) return parts->prefix;
    if (name.size() >= kFloor.size() && name.compare(name.size() - kFloor.size(), kFloor.size(), kFloor) == 0)
        return name.substr(0, name.size() - kFloor.size());
    return std::nullopt;
}

}  // namespace

BlockDirectory::BlockDirectory(Report& report, const std::vector<Stack>& stacks,
                               const std::vector<PlacedBlock>& placed)
    : stacks_(stacks) {
    for (std::size_t i = 0; i < stacks.size(); ++i) {
        const Stack& stack = stacks[i];
        if (stack.name_known) addStackName(report, i);
        complete_ = complete_ && stack.shape_known;
        if (stack.shape_known)
            first_placed_ = static_cast<std::int32_t>(stack.first_block + stack.blockCount());
    }
    addPlaced(report, placed);
}

void BlockDirectory::addStackName(Report& report, std::size_t index) {
    const Stack& stack = stacks_[index];
    const auto [first, is_new] = stack_by_name_.emplace(stack.name, index);
    if (is_new) return;
    report.add(stack.name_place, stack.field + ".name",
               "found the name " + quoted(stack.name) + " of " + stacks_[first->second].field +
                   " again, allowed: a name of its own, the prefix of its blocks' names");
}

void BlockDirectory::addPlaced(Report& report, const std::vector<PlacedBlock>& placed) {
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const std::string& name = placed[i].block.name;
        complete_ = complete_ && placed[i].name_known;
        if (!placed[i].name_known) continue;
        if (find(name))
            report.add(placed[i].name_place, placed[i].block.field + ".name",
                       "found the name " + quoted(name) + " of another block, allowed: a name of its own");
        placed_.emplace(name, first_placed_ + static_cast<std::int32_t>(i));
        placed_names_.push_back(name);
    }
}

void BlockDirectory::add(Report& report, const std::vector<std::string>& names, std::int32_t first,
                         Place place, const std::string& field) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (find(names[i])) {
            report.add(
                place, field,
                "found the name " + quoted(names[i]) +
                    " of another block, allowed: another prefix by the key name, or names of their own");
            return;
        }
        placed_.emplace(names[i], first + static_cast<std::int32_t>(i));
        if (placed_names_.size() < kMaxCandidates) placed_names_.push_back(names[i]);
    }
}

std::optional<std::int32_t> BlockDirectory::findInStack(const Stack& stack, const std::string& name) const {
    if (name == stack.floorName()) return stack.floorIndex();
    const auto parts = splitStackName(name);
    if (!parts || !stack.hasBlock(parts->column - 1, parts->row - 1, parts->slice - 1)) return std::nullopt;
    return stack.blockIndex(parts->column - 1, parts->row - 1, parts->slice - 1);
}

std::optional<std::int32_t> BlockDirectory::find(const std::string& name) const {
    if (const auto placed = placed_.find(name); placed != placed_.end()) return placed->second;
    const auto prefix = stackPrefix(name);
    if (!prefix) return std::nullopt;
    const auto stack = stack_by_name_.find(*prefix);
    if (stack == stack_by_name_.end() || !stacks_[stack->second].shape_known) return std::nullopt;
    return findInStack(stacks_[stack->second], name);
}

std::vector<std::string> BlockDirectory::candidates() const {
    std::vector<std::string> names(
        placed_names_.begin(),
        placed_names_.begin() + static_cast<std::ptrdiff_t>(std::min(placed_names_.size(), kMaxCandidates)));
    for (const Stack& stack : stacks_) {
        if (names.size() >= kMaxCandidates) break;
        names.push_back(stack.floorName());
        for (int column = 0; column < stack.columns; ++column)
            for (int row = 0; row < stack.heights[static_cast<std::size_t>(column)]; ++row)
                for (int slice = 0; slice < stack.slices && names.size() < kMaxCandidates; ++slice)
                    names.push_back(stack.blockName(column, row, slice));
    }
    return names;
}

std::string BlockDirectory::hint(const std::string& name) const {
    const auto parts = splitStackName(name);
    const auto found = parts ? stack_by_name_.find(parts->prefix) : stack_by_name_.end();
    if (found == stack_by_name_.end()) return suggestion(name, candidates());
    const Stack& stack = stacks_[found->second];
    const bool has_column = parts->column <= stack.columns;
    const int height = has_column ? stack.heights[static_cast<std::size_t>(parts->column - 1)] : stack.rows;
    return ", allowed: columns 1 to " + std::to_string(stack.columns) + ", rows 1 to " +
           std::to_string(height) + (has_column ? " in this column" : "") + ", slices 1 to " +
           std::to_string(stack.slices);
}

std::optional<std::int32_t> BlockDirectory::resolve(Report& report, Place place, const std::string& field,
                                                    const std::string& name) const {
    if (const auto index = find(name)) return index;
    if (complete_)
        report.add(place, field,
                   "found the unknown block " + quoted(name) + (report.full() ? "" : hint(name)));
    return std::nullopt;
}

void BlockDirectory::checkNames(Report& report, Node list, const std::string& field) const {
    std::unordered_set<std::string> seen;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Node node = list.at(i);
        if (node.kind() != Kind::text) continue;  // reported where the list was read
        resolve(report, node.place(), elementField(field, i), node.text());
        if (!seen.insert(node.text()).second)
            report.add(node.place(), elementField(field, i),
                       "found " + quoted(node.text()) + " again, allowed: each block once");
    }
}

}  // namespace talus::formats::scenario
