#include "toml/table_reader.h"

#include <algorithm>
#include <cmath>

#include "toml/wording.h"

namespace talus::formats::toml {

namespace {

constexpr std::size_t kMaxNameLength = 100;

std::string countWord(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// True if `node` is an array of the length wanted.
bool checkArray(Report& report, Node node, const std::string& field, const std::string& what,
                std::optional<std::size_t> length) {
    const std::string allowed = "an array of " + (length ? countWord(*length, what) : what + "s");
    if (node.kind() != Kind::array) {
        reportFound(report, node, field, allowed);
        return false;
    }
    if (!length || node.size() == *length) return true;
    report.add(node.place(), field,
               "found an array of " + countWord(node.size(), "value") + ", allowed: " + allowed);
    return false;
}

using AskedKind = Asked::Kind;

Asked numberIn(const Interval& range) { return {.kind = AskedKind::number, .range = range}; }
Asked integerIn(Bounds bounds) { return {.kind = AskedKind::integer, .bounds = bounds}; }
Asked arrayOf(std::optional<std::size_t> length) { return {.kind = AskedKind::array, .length = length}; }

std::optional<std::string> textIn(Report& report, Node node, const std::string& field) {
    if (node.kind() == Kind::text) return node.text();
    reportFound(report, node, field, "a string");
    return std::nullopt;
}

void askNumbers(Report& report, const std::string& field, const Interval& range,
                std::optional<std::size_t> length) {
    ask(report, field, [&] { return arrayOf(length); });
    ask(report, elementField(field, 0), [&] { return numberIn(range); });
}

/// "; is it in UNIT?", or nothing.
std::string meantUnit(double value, const UnitMixUp& mix_up) {
    return mix_up.looksLike(value) ? "; is it in " + std::string(mix_up.unit) + "?" : std::string();
}

}  // namespace

std::string mixUpWarning(const std::string& field, const std::string& found, double value,
                         const UnitMixUp& mix_up) {
    const std::string meant = meantUnit(value, mix_up);
    return meant.empty() ? meant : field + ": found " + found + meant;
}

std::string allowedText(const Interval& interval) {
    const auto& [min, max, open_min, open_max] = interval;
    std::string text;
    if (std::isfinite(min)) text = (open_min ? "greater than " : "at least ") + numberText(min);
    if (std::isfinite(min) && std::isfinite(max)) text += " and ";
    if (std::isfinite(max)) text += (open_max ? "less than " : "at most ") + numberText(max);
    return text.empty() ? "a finite number" : text;
}

void reportFound(Report& report, Node node, const std::string& field, const std::string& allowed) {
    if (report.questions() != nullptr) report.questions()->fault(field);
    report.add(node.place(), field, "found " + describe(node) + ", allowed: " + allowed);
}

std::optional<double> readNumber(Report& report, Node node, const std::string& field, const Interval& range,
                                 const UnitMixUp& mix_up) {
    ask(report, field, [&] { return numberIn(range); });
    if (!node.isNumber()) {
        const bool any = !std::isfinite(range.min) && !std::isfinite(range.max);
        reportFound(report, node, field, any ? "a number" : "a number, " + allowedText(range));
        return std::nullopt;
    }
    const double value = node.number();
    const std::string found = valueText(node);
    if (range.contains(value)) {
        if (auto doubt = mixUpWarning(field, found, value, mix_up); !doubt.empty())
            report.warn(std::move(doubt));
        return value;
    }
    const std::string allowed = std::isfinite(value) ? allowedText(range) : "a finite number";
    report.add(node.place(), field, "found " + found + ", allowed: " + allowed + meantUnit(value, mix_up));
    return std::nullopt;
}

std::optional<std::int64_t> readInteger(Report& report, Node node, const std::string& field, Bounds bounds) {
    ask(report, field, [&] { return integerIn(bounds); });
    const std::string least = std::to_string(bounds.min);
    const std::string range = bounds.min == bounds.max ? least : least + " to " + std::to_string(bounds.max);
    if (node.kind() != Kind::integer) {
        reportFound(report, node, field, "an integer, " + range);
        return std::nullopt;
    }
    const std::int64_t value = node.integer();
    if (value >= bounds.min && value <= bounds.max) return value;
    report.add(node.place(), field, "found " + std::to_string(value) + ", allowed: " + range);
    return std::nullopt;
}

std::optional<std::string> readText(Report& report, Node node, const std::string& field) {
    ask(report, field, [] { return Asked{.kind = AskedKind::text}; });
    return textIn(report, node, field);
}

std::optional<std::vector<double>> readNumbers(Report& report, Node node, const std::string& field,
                                               const Interval& range, std::optional<std::size_t> length) {
    askNumbers(report, field, range, length);
    if (!checkArray(report, node, field, "number", length)) return std::nullopt;
    std::vector<double> values;
    values.reserve(node.size());
    for (std::size_t i = 0; i < node.size(); ++i)
        if (const auto value = readNumber(report, node.at(i), elementField(field, i), range))
            values.push_back(*value);
    if (values.size() < node.size()) return std::nullopt;
    return values;
}

std::optional<Vec3> readVector(Report& report, Node node, const std::string& field, const Interval& range) {
    const auto values = readNumbers(report, node, field, range, 3);
    if (!values) return std::nullopt;
    return Vec3((*values)[0], (*values)[1], (*values)[2]);
}

TableReader::TableReader(Report& report, Node table, std::string field, std::vector<std::string> allowed)
    : report_(report), table_(table), place_(table.place()), field_(std::move(field)) {
    if (!field_.empty()) report_.mark(field_, place_);
    if (report_.questions() != nullptr) report_.questions()->read(field_, allowed);
    for (const Entry& entry : table_.entries()) {
        if (std::find(allowed.begin(), allowed.end(), entry.key) != allowed.end()) {
            report_.mark(fieldOf(entry.key), entry.value.place());
            continue;
        }
        if (report_.full()) {  // further faults are only counted
            report_.add(entry.place, {}, {});
            continue;
        }
        // A near key that is there already is not what was meant in a file; one that overrides a file's may
        // be.
        std::vector<std::string> absent;
        for (const std::string& key : allowed)
            if (!has(key)) absent.push_back(key);
        const auto meant = nearest(entry.key, absent);
        if (meant) meant_.push_back(*meant);
        const auto there = meant ? std::nullopt : nearest(entry.key, allowed);
        const std::string near = there ? " (near " + quoted(*there) + ", which has a value)" : "";
        report_.add(entry.place, fieldOf(entry.key),
                    "found an unknown key " + quoted(entry.key) + near +
                        (meant ? ", did you mean " + quoted(*meant) + "?" : ", allowed: " + listed(allowed)));
    }
}

std::string TableReader::fieldOf(std::string_view key) const { return joinField(field_, key); }

Place TableReader::placeOf(std::string_view key) const {
    const auto node = find(key);
    return node ? node->place() : place_;
}

void TableReader::require(std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) {
        if (report_.questions() != nullptr) report_.questions()->require(field_, key);
        if (!has(key) && !isMeant(key)) error(key, "missing; this key is required");
    }
}

bool TableReader::isMeant(std::string_view key) const {
    return std::find(meant_.begin(), meant_.end(), key) != meant_.end();
}

std::vector<std::string> TableReader::present(const std::vector<std::string>& keys) const {
    std::vector<std::string> found;
    for (const std::string& key : keys)
        if (has(key)) found.push_back(key);
    return found;
}

bool TableReader::requireOneOf(const std::vector<std::string>& keys) {
    const auto found = present(keys);
    if (found.size() == 1) return true;
    if (found.empty() && std::any_of(keys.begin(), keys.end(), [&](const auto& key) { return isMeant(key); }))
        return false;
    if (found.empty())
        error(keys.front(), "missing; one of these is required: " + listed(keys));
    else
        error(found[1], "found " + listed(found) + " together, allowed: exactly one of " + listed(keys));
    return false;
}

void TableReader::error(std::string_view key, std::string message) {
    report_.add(placeOf(key), fieldOf(key), std::move(message));
}

std::optional<double> TableReader::number(std::string_view key, const Interval& range,
                                          const UnitMixUp& mix_up) {
    ask(key, [&] { return numberIn(range); });
    const auto node = find(key);
    return node ? readNumber(report_, *node, fieldOf(key), range, mix_up) : std::nullopt;
}

std::optional<std::int64_t> TableReader::integer(std::string_view key, Bounds bounds) {
    ask(key, [&] { return integerIn(bounds); });
    const auto node = find(key);
    return node ? readInteger(report_, *node, fieldOf(key), bounds) : std::nullopt;
}

std::optional<bool> TableReader::boolean(std::string_view key) {
    ask(key, [] { return Asked{.kind = AskedKind::boolean}; });
    const auto node = find(key);
    if (!node) return std::nullopt;
    if (node->kind() == Kind::boolean) return node->boolean();
    reportFound(report_, *node, fieldOf(key), "true or false");
    return std::nullopt;
}

std::optional<std::string> TableReader::text(std::string_view key) {
    ask(key, [] { return Asked{.kind = AskedKind::text}; });
    const auto node = find(key);
    return node ? readText(report_, *node, fieldOf(key)) : std::nullopt;
}

std::optional<std::size_t> TableReader::choice(std::string_view key,
                                               const std::vector<std::string>& allowed) {
    ask(key, [&] { return Asked{.kind = AskedKind::choice, .choices = allowed}; });
    const auto node = find(key);
    const auto value = node ? textIn(report_, *node, fieldOf(key)) : std::nullopt;
    if (!value) return std::nullopt;
    const auto found = std::find(allowed.begin(), allowed.end(), *value);
    if (found != allowed.end()) return static_cast<std::size_t>(found - allowed.begin());
    std::string list;
    for (const std::string& name : allowed) list += (list.empty() ? "" : ", ") + quoted(name);
    if (report_.questions() != nullptr) report_.questions()->fault(fieldOf(key));
    error(key, "found " + quoted(*value) + ", allowed: " + list);
    return std::nullopt;
}

std::optional<Vec3> TableReader::vector(std::string_view key, const Interval& range) {
    askNumbers(report_, fieldOf(key), range, 3);
    const auto node = find(key);
    return node ? readVector(report_, *node, fieldOf(key), range) : std::nullopt;
}

std::optional<std::vector<double>> TableReader::numbers(std::string_view key, const Interval& range,
                                                        std::optional<std::size_t> length) {
    askNumbers(report_, fieldOf(key), range, length);
    const auto node = find(key);
    return node ? readNumbers(report_, *node, fieldOf(key), range, length) : std::nullopt;
}

std::optional<std::vector<std::string>> TableReader::texts(std::string_view key,
                                                           std::optional<std::size_t> length) {
    ask(key, [&] { return arrayOf(length); });
    toml::ask(report_, elementField(fieldOf(key), 0), [] { return Asked{.kind = AskedKind::text}; });
    const auto node = find(key);
    if (!node || !checkArray(report_, *node, fieldOf(key), "string", length)) return std::nullopt;
    std::vector<std::string> values;
    for (std::size_t i = 0; i < node->size(); ++i)
        if (auto value = readText(report_, node->at(i), elementField(fieldOf(key), i)))
            values.push_back(std::move(*value));
    if (values.size() < node->size()) return std::nullopt;
    return values;
}

std::optional<Node> TableReader::array(std::string_view key) {
    ask(key, [] { return arrayOf(std::nullopt); });
    const auto node = find(key);
    if (!node || node->kind() == Kind::array) return node;
    reportFound(report_, *node, fieldOf(key), "an array");
    return std::nullopt;
}

std::optional<TableReader> TableReader::table(std::string_view key, std::vector<std::string> allowed) {
    ask(key, [] { return Asked{.kind = AskedKind::table}; });
    const auto node = find(key);
    if (!node) return std::nullopt;
    if (node->kind() == Kind::table) return TableReader(report_, *node, fieldOf(key), std::move(allowed));
    reportFound(report_, *node, fieldOf(key), "a table");
    return std::nullopt;
}

std::vector<FieldNode> TableReader::tables(std::string_view key) {
    ask(key, [] { return Asked{.kind = AskedKind::tables}; });
    const auto node = find(key);
    if (!node) return {};
    const std::string allowed = "tables that begin with [[" + std::string(key) + "]]";
    std::vector<FieldNode> tables;
    if (node->kind() != Kind::array) {
        reportFound(report_, *node, fieldOf(key), allowed);
        return tables;
    }
    for (std::size_t i = 0; i < node->size(); ++i) {
        FieldNode element{elementField(fieldOf(key), i), "", node->at(i)};
        if (element.node.kind() == Kind::table)
            tables.push_back(std::move(element));
        else
            reportFound(report_, element.node, element.field, allowed);
    }
    return tables;
}

std::vector<FieldNode> TableReader::namedTables(std::string_view key) {
    ask(key, [] { return Asked{.kind = AskedKind::named_tables}; });
    const auto node = find(key);
    if (!node) return {};
    const std::string allowed = "tables that begin with [" + std::string(key) + ".NAME]";
    std::vector<FieldNode> tables;
    if (node->kind() != Kind::table) {
        reportFound(report_, *node, fieldOf(key), allowed);
        return tables;
    }
    for (const Entry& entry : node->entries()) {
        FieldNode element{joinField(fieldOf(key), entry.key), entry.key, entry.value};
        if (entry.value.kind() == Kind::table)
            tables.push_back(std::move(element));
        else
            reportFound(report_, entry.value, element.field, allowed);
    }
    return tables;
}

std::optional<std::string> TableReader::name(std::string_view key, bool may_be_empty) {
    auto value = text(key);
    if (!value) return std::nullopt;
    const bool has_control =
        std::any_of(value->begin(), value->end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    if (value->size() <= kMaxNameLength && !has_control && (may_be_empty || !value->empty())) return value;
    error(key, "found " + quoted(*value) + ", allowed: " + (may_be_empty ? "0" : "1") + " to " +
                   std::to_string(kMaxNameLength) + " bytes without control characters");
    return std::nullopt;
}

}  // namespace talus::formats::toml
