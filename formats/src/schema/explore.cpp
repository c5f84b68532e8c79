#include "schema/explore.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace talus::formats::schema {

namespace {

using toml::Asked;
using toml::Questions;
using Kind = Asked::Kind;
using Value = nlohmann::ordered_json;  ///< of a document; a tree of TOML's values

constexpr int kMostRounds = 10;
constexpr std::size_t kContexts = 4;      // choices of named tables that are tried beside each other table
constexpr const char* kName = "default";  ///< of everything, so that what refers to something finds it

/// As TOML, tables inline.
std::string tomlText(const Value& value) {
    std::string text;
    if (value.is_object()) {
        for (const auto& [key, each] : value.items())
            text += (text.empty() ? "" : ", ") + ("\"" + key + "\" = ") + tomlText(each);
        return "{" + text + "}";
    }
    if (!value.is_array()) return value.dump();
    for (const Value& each : value) text += (text.empty() ? "" : ", ") + tomlText(each);
    return "[" + text + "]";
}

std::string documentText(const Value& root) {
    std::string text;
    for (const auto& [key, value] : root.items()) text += "\"" + key + "\" = " + tomlText(value) + "\n";
    return text;
}

double numberIn(const Interval& range) {
    for (const double value : {1.0, 0.5, range.min, range.max, 0.5 * (range.min + range.max)})
        if (range.contains(value)) return value;
    return 0;
}

std::string below(const std::string& table, const std::string& key) {
    return table.empty() ? key : table + "." + key;
}

/// Documents made of what is known so far.
class Documents {
 public:
    /// \param context  which of its choices a named table makes, where it has some: others refer to it
    Documents(const Questions& known, std::size_t context) : known_(known), context_(context) {}

    /// Neither asked for, nor, of an array, its elements.
    bool isUnknown(const std::string& field) const {
        const auto asked = known_.asked().find(field);
        if (asked == known_.asked().end()) return true;
        return asked->second.front().kind == Kind::array && isUnknown(field + "[]");
    }
    bool isCount(const std::string& field) const {
        const auto asked = known_.asked().find(field);
        return asked != known_.asked().end() && asked->second.front().kind == Kind::integer;
    }

    /// Values that may stand in a field: one of each kind that was asked for; of an unknown one, some to see
    /// what is asked.
    std::vector<Value> valuesOf(const std::string& field) const {
        const auto asked = known_.asked().find(field);
        if (asked == known_.asked().end()) return {1, kName, Value::array(), Value::object()};
        std::vector<Value> values;
        for (const Asked& one : asked->second) addValues(field, one, values);
        return values;
    }

    /// A table with what it must have, and nothing else.
    Value leastTable(const std::string& field) const {
        Value table = Value::object();
        const auto known = known_.tables().find(field);
        if (known == known_.tables().end()) return table;
        for (const std::string& key : known->second.keys)
            if (isRequired(known->second, key)) table[key] = valuesOf(below(field, key)).front();
        return table;
    }

    /// All sections with what they must have, and `content` in one table.
    Value around(const std::string& table, const Value& content) const {
        Value root = table.empty() ? content : leastTable("");
        for (const std::string& key : known_.tables().at("").keys)
            if (!root.contains(key) && isSection(key)) root[key] = valuesOf(key).front();
        if (!table.empty()) put(root, "", table, content);
        return root;
    }

 private:
    static bool isRequired(const Questions::Table& table, const std::string& key) {
        return table.required_now.contains(key) || (table.required && table.required->contains(key));
    }

    bool isSection(const std::string& key) const {
        const auto asked = known_.asked().find(key);
        return asked != known_.asked().end() && asked->second.front().kind >= Kind::table;
    }

    void addValues(const std::string& field, const Asked& asked, std::vector<Value>& values) const {
        switch (asked.kind) {
            case Kind::number:
                return values.emplace_back(numberIn(asked.range)), void();
            case Kind::integer:
                // Two, so that a bound which follows from another value is seen to change.
                for (const std::int64_t value : {2, 3})
                    values.emplace_back(std::clamp(value, asked.bounds.min, asked.bounds.max));
                return;
            case Kind::boolean:
                return values.emplace_back(true), void();
            case Kind::text:
                return values.emplace_back(kName), void();
            case Kind::scalar:
                return values.emplace_back(1), void();
            case Kind::choice:
                return values.insert(values.end(), asked.choices.begin(), asked.choices.end()), void();
            case Kind::array:
                return addArrays(field, asked, values);
            case Kind::table:
                return values.push_back(leastTable(field)), void();
            case Kind::tables:
                return values.push_back(Value::array({leastTable(field + "[]")})), void();
            case Kind::named_tables:
                return values.push_back(Value{{kName, namedTable(below(field, kName))}}), void();
            case Kind::named_values:
                for (const Value& value : valuesOf(below(field, kName)))
                    values.push_back(Value{{kName, value}});
                return;
        }
    }

    /// Of the length that is wanted, else of some, each kind of elements.
    void addArrays(const std::string& field, const Asked& asked, std::vector<Value>& values) const {
        const std::vector<Value> elements =
            known_.asked().contains(field + "[]")
                ? valuesOf(field + "[]")
                : std::vector<Value>{1, kName, Value::array({1, 2}), Value::object()};
        for (const Value& element : elements)
            for (const std::size_t length :
                 asked.length ? std::vector{*asked.length} : std::vector<std::size_t>{2, 1, 4})
                values.push_back(Value(length, element));
    }

    /// Puts a table where its field says; tables on the way have what they must have.
    void put(Value& table, const std::string& at, const std::string& field, const Value& content) const {
        const std::string rest = field.substr(at.empty() ? 0 : at.size() + 1);
        const std::string step = rest.substr(0, rest.find('.'));
        const std::string next = below(at, step);
        const bool is_list = step.ends_with("[]");
        const std::string key = is_list ? step.substr(0, step.size() - 2) : step;
        Value inner = next == field ? content : leastTable(next);
        if (next != field) put(inner, next, field, content);
        table[key] = is_list ? Value::array({std::move(inner)}) : std::move(inner);
    }

    /// A named table with one of its choices.
    Value namedTable(const std::string& field) const {
        Value table = leastTable(field);
        const auto known = known_.tables().find(field);
        if (known == known_.tables().end()) return table;
        for (const std::string& key : known->second.keys) {
            const auto asked = known_.asked().find(below(field, key));
            if (asked == known_.asked().end() || asked->second.front().kind != Kind::choice) continue;
            const auto& choices = asked->second.front().choices;
            table[key] = choices[context_ % choices.size()];
        }
        return table;
    }

    const Questions& known_;
    std::size_t context_;
};

/// What a table may hold: nothing else than it must, each key alone, in pairs, and all of them.
/// \param few  what is unknown, each alone
std::vector<Value> contentsOf(const Documents& documents, const Questions::Table& table,
                              const std::string& field, bool few) {
    const Value least = documents.leastTable(field);
    std::vector<Value> contents{least};
    Value all = least;
    const auto with = [&](Value content, const std::string& key, const Value& value) {
        content[key] = value;
        contents.push_back(std::move(content));
    };
    const auto pair = [&](const std::string& a, const Value& of_a, const std::string& b, const Value& of_b) {
        Value content = least;
        content[a] = of_a;
        with(std::move(content), b, of_b);
    };
    const auto values = [&](const std::string& key) { return documents.valuesOf(below(field, key)); };
    const bool complete = std::none_of(table.keys.begin(), table.keys.end(), [&](const std::string& key) {
        return documents.isUnknown(below(field, key));
    });
    for (auto a = table.keys.begin(); a != table.keys.end(); ++a) {
        if (few && !documents.isUnknown(below(field, *a))) continue;
        const std::vector<Value> of_a = values(*a);
        for (const Value& value : of_a) with(least, *a, value);
        all[*a] = of_a.front();
        if (field.empty() || few) continue;  // sections stand side by side anyway
        for (auto b = std::next(a); b != table.keys.end(); ++b) {
            // Pairs find what is read only with another key, and bounds that follow from another number.
            if (complete && !documents.isCount(below(field, *a)) && !documents.isCount(below(field, *b)))
                continue;
            const std::vector<Value> of_b = values(*b);
            for (const Value& value : of_a) pair(*a, value, *b, of_b.front());
            for (const Value& value : of_b) pair(*a, of_a.front(), *b, value);
        }
    }
    // What is still unknown, with any two others.
    for (const std::string& key : table.keys) {
        if (!documents.isUnknown(below(field, key)) || field.empty() || few) continue;
        for (auto a = table.keys.begin(); a != table.keys.end(); ++a)
            for (auto b = std::next(a); b != table.keys.end(); ++b) {
                if (*a == key || *b == key) continue;
                Value content = least;
                content[*a] = values(*a).front();
                content[*b] = values(*b).front();
                with(std::move(content), key, 1);
            }
    }
    contents.push_back(all);
    return contents;
}

/// How much is known of a table and what is in it.
std::size_t questionsBelow(const Questions& known, const std::string& table) {
    std::size_t count = 0;
    for (const auto& [field, asked] : known.asked())
        if (table.empty() || field.starts_with(table + ".")) count += asked.size();
    for (const auto& [field, inner] : known.tables()) count += field.starts_with(table);
    return count;
}

}  // namespace

Questions explore(const Reading& read) {
    Questions questions;
    read("", questions);
    std::map<std::string, std::size_t> explored;  // what was known of a table when its documents were read
    for (int round = 0; round < kMostRounds; ++round) {
        const Questions known = questions;
        for (const auto& [field, table] : known.tables()) {
            const std::size_t now = questionsBelow(known, field);
            if (std::exchange(explored[field], now) == now) continue;
            for (std::size_t context = 0; context < kContexts; ++context) {
                const Documents documents(known, context);
                for (const Value& content : contentsOf(documents, table, field, context > 0))
                    read(documentText(documents.around(field, content)), questions);
            }
        }
        if (questions.count() == known.count()) break;
    }
    questions.finish();
    return questions;
}

}  // namespace talus::formats::schema
