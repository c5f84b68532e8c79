#include "toml/questions.h"

#include <algorithm>
#include <utility>

namespace talus::formats::toml {

namespace {

/// "stack[12].columns" -> "stack[].columns"
std::string patternOf(std::string_view field) {
    std::string pattern;
    bool index = false;
    for (const char letter : field) {
        if (letter == ']') index = false;
        if (!index) pattern += letter;
        if (letter == '[') index = true;
    }
    return pattern;
}

bool same(const Asked& a, const Asked& b) {
    return a.kind == b.kind && a.range.min == b.range.min && a.range.max == b.range.max &&
           a.range.open_min == b.range.open_min && a.range.open_max == b.range.open_max &&
           a.bounds.min == b.bounds.min && a.bounds.max == b.bounds.max && a.choices == b.choices &&
           a.length == b.length;
}

}  // namespace

void Questions::ask(std::string_view field, Asked what) {
    std::vector<Asked>& all = asked_[patternOf(field)];
    if (std::any_of(all.begin(), all.end(), [&](const Asked& known) { return same(known, what); })) return;
    all.push_back(std::move(what));
    ++count_;
}

void Questions::read(std::string_view table, const std::vector<std::string>& keys) {
    const auto [place, is_new] = tables_.try_emplace(patternOf(table));
    if (is_new)
        ++count_;
    else
        close(place->second);
    for (const std::string& key : keys)
        if (std::find(place->second.keys.begin(), place->second.keys.end(), key) == place->second.keys.end())
            place->second.keys.push_back(key);
}

void Questions::require(std::string_view table, std::string_view key) {
    tables_[patternOf(table)].required_now.emplace(key);
}

void Questions::fault(std::string_view field) {
    const std::string pattern = patternOf(field);
    for (auto& [name, table] : tables_)
        if (pattern.starts_with(name + ".")) table.faulty_now = true;
}

void Questions::close(Table& table) {
    if (std::exchange(table.faulty_now, false)) {
        table.required_now.clear();
        return;
    }
    if (!table.required) {
        table.required = table.required_now;
    } else {
        std::erase_if(*table.required,
                      [&](const std::string& key) { return !table.required_now.contains(key); });
    }
    table.required_now.clear();
}

void Questions::finish() {
    for (auto& [field, table] : tables_) close(table);
}

}  // namespace talus::formats::toml
